#include <fmt/format.h>

#include <algorithm>

#include "chart.hpp"
#include "gnuplot.hpp"

namespace hamjet::io {
namespace {

/// Viridis of S. van der Walt and N. Smith (2015): as bright as it is large, for the colour-blind
/// and on grey paper too.
constexpr fmt::format_string<const char*> palette =
    "set palette defined (0 '#440154', 1 '#46327E', 2 '#365C8D', 3 '#277F8E', 4 '#1FA187', "
    "5 '#4AC16D'{})\n";
/// The bright end, for areas alone: a line of these colours is lost on its ground.
constexpr const char* bright_end = ", 6 '#A0DA39', 7 '#FDE725'";

bool are_points(const ChartMap& map) {
  return std::any_of(map.cells.begin(), map.cells.end(), [](const ChartCell& cell) {
    return cell.left == cell.right || cell.lower == cell.upper;
  });
}

}  // namespace

std::string colour_commands(const std::string& label, double least, double most,
                            bool is_logarithmic, bool is_of_lines) {
  std::string text = fmt::format(palette, is_of_lines ? "" : bright_end);
  if (least < most) {
    text += fmt::format("set cbrange [{:.17g}:{:.17g}]\n", least, most);
    if (is_logarithmic) text += "set logscale cb 10\n";
  } else {
    text += fmt::format("set cbrange [{:.17g}:{:.17g}]\nset cbtics ('{:g}' {:.17g})\n", least - 1,
                        least + 1, least, least);
  }
  return text + fmt::format("set cblabel {} noenhanced offset 1.5,0\nset format cb '%g'\n",
                            gnuplot_literal(label));
}

std::string map_commands(const ChartMap& map) {
  const auto [least, most] =
      std::minmax_element(map.cells.begin(), map.cells.end(),
                          [](const ChartCell& a, const ChartCell& b) { return a.value < b.value; });
  std::string text =
      colour_commands(map.label, least->value, most->value, map.is_logarithmic, false);
  text += "$map << END\n";
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
