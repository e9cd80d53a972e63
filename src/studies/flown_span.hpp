#pragma once

#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// Times in canonical units; the first is at most 0 and the last at least.
struct FlownSpan {
  double first = 0;
  double last = 0;
};

/// The span in which any study of a scene flies. Forces that depend on the time must be known in
/// it.
FlownSpan flown_span(const Scene& scene);

/// The last arrival of a transfer, in canonical units: that of the longest one, which may begin
/// with the longest coast.
double last_arrival(const TransferSettings& settings);

}  // namespace hamjet
