#include <algorithm>

#include "hamjet/charts/canonical_chart.hpp"

namespace hamjet {
namespace {

constexpr std::array<std::string_view, all_charts.size()> names = {
    "cartesian", "spherical", "cylindrical", "poincare", "nodal"};

}  // namespace

std::string_view name_of(ChartName chart) { return names[static_cast<std::size_t>(chart)]; }

std::optional<ChartName> chart_of(std::string_view name) {
  const auto place = std::find(names.begin(), names.end(), name);
  if (place == names.end()) return std::nullopt;
  return all_charts[static_cast<std::size_t>(place - names.begin())];
}

}  // namespace hamjet
