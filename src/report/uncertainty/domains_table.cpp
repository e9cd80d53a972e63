#include "domains_table.hpp"

#include <cstddef>
#include <string>
#include <vector>

#include "../../store/result_table.hpp"

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
  const auto names = component_names(result.scene.uncertainty->frame);
  const auto add_centre = [&](std::size_t first, const std::string& unit, const std::string& ending,
                              const std::string& of) {
    std::vector<std::string> parts;
    for (std::size_t i = first; i < first + 3; ++i) {
      parts.push_back("centre_" + std::string(names[i]) + ending);
    }
    table.add_array("centre" + ending, parts, unit,
                    "the " + of +
                        " of its centre at the start, from the spacecraft's mean, along the frame "
                        "of the results",
                    [first](const RowOfDomain& row) {
                      const Vector<double>& centre = row.domain->centre;
                      const auto begin = centre.begin() + static_cast<std::ptrdiff_t>(first);
                      return std::vector<double>(begin, begin + 3);
                    });
  };
  add_centre(0, "m", "_m", "position");
  add_centre(3, "m/s", "_m_s", "velocity");
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
