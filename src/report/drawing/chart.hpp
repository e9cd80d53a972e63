#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hamjet::io {

/// What the numbers along an axis are.
enum class AxisUnit { none, power, seconds, metres };

/// An axis of a chart. A logarithmic one runs over whole decades.
struct ChartAxis {
  std::string label;
  AxisUnit unit = AxisUnit::none;
  bool is_logarithmic = false;
  bool is_reversed = false;
  bool is_integer = false;
  double lower = 0;  ///< set by fit_axes
  double upper = 1;
  double margin = 0;    ///< decades to leave free at either end
  double smallest = 0;  ///< logarithmic: smaller values are drawn at the lower limit, as zeros are
  std::vector<double> includes;  ///< places that it must reach
};

ChartAxis logarithmic_axis(std::string label, AxisUnit unit = AxisUnit::power);

/// A line, a set of markers or both.
struct ChartCurve {
  std::string title;      ///< empty: not in the legend
  std::size_t style = 0;  ///< colour, dashes and marker
  bool has_line = true;
  bool has_markers = true;
  bool is_filled = true;
  int marker_interval = 1;
  std::vector<std::pair<double, double>> points;
  std::vector<std::size_t> gaps;  ///< the line is broken before these points
  std::vector<double> ticks;      ///< where a short vertical stroke says that there is no value
};

/// A straight line over the whole chart, or a text in one of its corners.
struct ChartRule {
  bool is_vertical = false;
  double place = 0;
};
/// A range of x that is shaded over the whole height, behind the curves.
struct ChartBand {
  double from = 0;
  double to = 0;
};
struct ChartCornerText {
  bool is_right = false;
  bool is_top = false;
  std::string text;
};

/// A value over the plane, in colour.
struct ChartCell {
  double left = 0;
  double right = 0;
  double lower = 0;
  double upper = 0;
  double value = 0;
};
struct ChartMap {
  std::string label;  ///< of the colours
  bool is_logarithmic = false;
  std::vector<ChartCell> cells;  ///< not empty; where one has no width or height, all are points
};

/// A plot before it is drawn.
struct Chart {
  std::string name;                ///< of the file; letters, digits and hyphens
  std::string title;               ///< heading in the page
  std::string reading;             ///< how to read it, a paragraph of plain text
  std::vector<std::string> notes;  ///< what is not drawn, or not where it belongs
  std::string missing;             ///< why there is nothing to draw, where there is nothing
  bool is_isometric = false;       ///< a unit is as long along x as along y
  ChartAxis x;
  ChartAxis y;
  std::optional<ChartMap> map;  ///< behind the curves
  std::vector<ChartCurve> curves;
  std::vector<ChartCurve> at_limit;  ///< below a logarithmic axis, and put at its limit
  std::vector<ChartRule> rules;
  std::vector<ChartBand> bands;  ///< cut off where the axis ends
  std::vector<ChartCornerText> corners;
};

/// Fits a chart for drawing: takes out the curves that have nothing to draw, sets the axes' ranges
/// from the others; cuts bands at the ends of x; moves what is below a logarithmic y to `at_limit`,
/// takes out what cannot be drawn at all, and says both in the notes. A chart that is left without
/// curves says so in `missing`.
void fit(Chart& chart);

/// What a chart is drawn as.
enum class Drawing { wide_svg, narrow_svg, pdf, png };

/// The parts of a script that draw a map: the commands before `plot`, with the data, and what is
/// plotted.
std::string map_commands(const ChartMap& map);
std::string map_plot(const ChartMap& map);

/// The gnuplot script that draws a fitted chart to the standard output.
std::string gnuplot_script(const Chart& chart, Drawing drawing);

/// An SVG of gnuplot as a part of a page: without its prologue, its tooltips and its opaque ground,
/// every id with the prefix, and with a description for those who do not see it.
std::string inline_svg(const std::string& svg, const std::string& prefix,
                       const std::string& description);

}  // namespace hamjet::io
