#include <fmt/format.h>

#include <algorithm>

#include "chart.hpp"
#include "gnuplot.hpp"

namespace hamjet::io {
namespace {

/// Viridis of S. van der Walt and N. Smith (2015): as bright as it is large, for the colour-blind
/// and on grey paper too.
constexpr const char* palette =
    "set palette defined (0 '#440154', 1 '#46327E', 2 '#365C8D', 3 '#277F8E', 4 '#1FA187', "
    "5 '#4AC16D', 6 '#A0DA39', 7 '#FDE725')\n";

bool are_points(const ChartMap& map) {
  return std::any_of(map.cells.begin(), map.cells.end(), [](const ChartCell& cell) {
    return cell.left == cell.right || cell.lower == cell.upper;
  });
}

}  // namespace

std::string map_commands(const ChartMap& map) {
  const auto [least, most] =
      std::minmax_element(map.cells.begin(), map.cells.end(),
                          [](const ChartCell& a, const ChartCell& b) { return a.value < b.value; });
  std::string text = palette;
  if (least->value < most->value) {
    text += fmt::format("set cbrange [{:.17g}:{:.17g}]\n", least->value, most->value);
    if (map.is_logarithmic) text += "set logscale cb 10\n";
  } else {
    text += fmt::format("set cbrange [{:.17g}:{:.17g}]\nset cbtics ('{:g}' {:.17g})\n",
                        least->value - 1, least->value + 1, least->value, least->value);
  }
  text += fmt::format("set cblabel {} noenhanced\nset format cb '%g'\n$map << END\n",
                      gnuplot_literal(map.label));
  for (const ChartCell& cell : map.cells) {
    text += fmt::format("{:.10g} {:.10g} {:.10g} {:.10g} {:.10g} {:.10g} {:.10g}\n",
                        (cell.left + cell.right) / 2, (cell.lower + cell.upper) / 2, cell.left,
                        cell.right, cell.lower, cell.upper, cell.value);
  }
  return text + "END\n";
}

std::string map_plot(const ChartMap& map) {
  if (are_points(map)) return "$map using 1:2:7 with points pt 5 ps 1 lc palette notitle";
  return "$map using 1:2:3:4:5:6:7 with boxxyerror lc palette fs solid 1 noborder notitle";
}

}  // namespace hamjet::io
