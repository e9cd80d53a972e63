#pragma once

#include <string>

#include "../../store/table_view.hpp"
#include "../../studies/bounded/bounded_formation.hpp"
#include "../drawing/chart.hpp"

namespace hamjet::io {

// What is shown of a deputy that was kept in a box; `formation` has one.

/// What it costs, in a sentence or two.
std::string box_verdict(const BoundedFormation& formation);

/// Why the deputy was not kept in the box, where it was not.
std::string box_failure(const BoxControl& box);

/// A row a return.
TableView box_table(const BoundedFormation& formation);

/// The distances from the reference along R, T and N over the time, in parts of the box; not
/// fitted.
Chart box_chart(const BoundedFormation& formation);

}  // namespace hamjet::io
