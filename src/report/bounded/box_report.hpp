#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../../studies/bounded/bounded_formation.hpp"
#include "../drawing/chart.hpp"

namespace hamjet::io {

// What is shown of a deputy that was kept in a box; `formation` has one.

/// What it costs, in a sentence or two.
std::string box_verdict(const BoundedFormation& formation);

/// Why the deputy was not kept in the box, where it was not.
std::string box_failure(const BoxControl& box);

/// `box.csv`: one row a return, with the states at both impulses.
std::string box_csv(const BoundedFormation& formation);

/// The entry `box` of `summary.json`.
nlohmann::ordered_json box_json(const BoundedFormation& formation);

/// The distances from the reference along R, T and N over the time, in parts of the box; not
/// fitted.
Chart box_chart(const BoundedFormation& formation);

}  // namespace hamjet::io
