#pragma once

#include <vector>

#include "../../store/table_view.hpp"
#include "../../studies/uncertainty/uncertainty.hpp"

namespace hamjet::io {

/// A row for each time, state, family, order and component, and for those of flown samples, which
/// have no order; and what holds for the whole result.
TableView moments_table(const UncertaintyResult& result);

/// Moments of m polynomials, of one row that holds all and m components.
TableView moments_of_polynomials(const Cumulants& moments);

/// moments_table; its columns along times, states and orders, of the polynomials in Cartesian
/// coordinates (`cartesian`), of the scene's other coordinates (`charted`), of its domains
/// (`split`) and of flown samples, without orders (`flown`); the domains; and the tables of
/// collisions and of passive safety that the result has.
std::vector<TableView> uncertainty_tables(const UncertaintyResult& result);

}  // namespace hamjet::io
