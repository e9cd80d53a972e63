#pragma once

#include "hamjet/studies/comparison.hpp"

namespace hamjet::io {

/// Calls visit(name, member) for every member of a run, const or not, in the order of JSON. A
/// member that is added to the structure and here is written and read back by `--resume`; one of
/// type double has a column in CSV as well.
template <class Run, class Visit>
void for_each_member(Run& run, const Visit& visit) {
  visit("settings", run.settings);
  visit("series", run.series);
  visit("order", run.order);
  visit("failure", run.failure);
  visit("left_out", run.left_out);
  visit("statistics", run.statistics);
  visit("multiply_adds", run.multiply_adds);
  visit("memory_bytes", run.memory_bytes);
  visit("seconds", run.seconds);
  visit("error_by_degree", run.error_by_degree);
  visit("error_estimate_by_degree", run.error_estimate_by_degree);
  visit("error_at_formation_m", run.error_at_formation_m);
  visit("exactness", run.exactness);
  visit("exactness_failure", run.exactness_failure);
  visit("symplecticity", run.symplecticity);
  visit("energy_error", run.energy_error);
  visit("corner", run.corner);
}

}  // namespace hamjet::io
