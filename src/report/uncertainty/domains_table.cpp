#include "domains_table.hpp"

#include <cstddef>
#include <vector>

#include "../centre_columns.hpp"

namespace hamjet::io {
namespace {

struct RowOfDomain {
  const UncertaintyDomains* of;
  const UncertaintyDomain* domain;
};

}  // namespace

TableView domains_table(const UncertaintyResult& result) {
  ResultTable<RowOfDomain> table(
      "domains", "", {"domains"},
      "The domains that deviations were split into, each with polynomials about its centre.");
  table.add("spacecraft", "", "whose deviations they are",
            [](const RowOfDomain& row) { return row.of->spacecraft; });
  add_centre(table, result.scene.uncertainty->frame, "the spacecraft's mean",
             [](const RowOfDomain& row) -> const Vector<double>& { return row.domain->centre; });
  table.add("share", "", "the probability of a deviation in it",
            [](const RowOfDomain& row) { return row.domain->share; });
  table.add("error_m", "m",
            "the estimate of the largest error of a coordinate of the position within 3 standard "
            "deviations",
            [](const RowOfDomain& row) { return row.domain->error_m; });
  std::vector<RowOfDomain> rows;
  for (const UncertaintyDomains& of : result.domains) {
    for (const UncertaintyDomain& domain : of.domains) rows.push_back({&of, &domain});
  }
  return std::move(table).view(rows, {rows.size()});
}

}  // namespace hamjet::io
