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
  double margin = 0;  ///< decades to leave free at either end
  double floor = 0;   ///< logarithmic y: smaller values, zeros too, say nothing and are drawn here
  std::string floor_name;        ///< "the rounding of double precision"
  std::vector<double> includes;  ///< places that it must reach
  /// x alone: what one of the units of a second axis at the top is; 0 is without.
  double top_unit = 0;
  std::string top_label;
};

ChartAxis logarithmic_axis(std::string label, AxisUnit unit = AxisUnit::power);

/// A line, a set of markers or both.
struct ChartCurve {
  std::string title;                  ///< empty: not in the legend
  std::size_t style = 0;              ///< dashes, marker and colour
  std::optional<std::size_t> colour;  ///< where it is not the style's
  bool has_line = true;
  bool has_markers = true;
  bool is_filled = true;
  bool is_background = false;  ///< the line is broad, pale and grey
  bool is_cloud = false;       ///< the markers are so many that they are small, pale and grey
  int marker_interval = 1;
  std::vector<std::pair<double, double>> points;
  std::vector<std::size_t> gaps;  ///< the line is broken before these points
  std::vector<double> ticks;      ///< where a short vertical stroke says that there is no value
  std::vector<double> values;  ///< values of the points, whose colours replace the curve's; or none
};

/// A curve of this title and style that is a line without markers; its points are yet to be added.
inline ChartCurve unmarked_line(std::string title = {}, std::size_t style = 0) {
  ChartCurve curve;
  curve.title = std::move(title);
  curve.style = style;
  curve.has_markers = false;
  return curve;
}

/// A straight line over the whole chart. Those of one title look alike and share an entry of the
/// legend.
struct ChartRule {
  bool is_vertical = false;
  double place = 0;
  std::string title;      ///< empty: not in the legend
  bool is_faint = false;  ///< one of many
};
/// A range of x that is shaded over the whole height, behind the curves.
struct ChartBand {
  double from = 0;
  double to = 0;
};
/// A text in one of the corners.
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
  std::string label;  ///< label of the colour scale
  bool is_logarithmic = false;
  std::vector<ChartCell> cells;  ///< not empty; where one has no width or height, all are points
};

/// A plot before it is drawn.
struct Chart {
  std::string name;                ///< name of the file; letters, digits and hyphens
  std::string title;               ///< heading in the page
  std::string reading;             ///< how to read it, a paragraph of plain text
  std::vector<std::string> notes;  ///< what is not drawn, or not where it belongs
  std::string missing;             ///< if there is nothing to draw, the reason
  bool is_isometric = false;       ///< a unit is as long along x as along y
  bool is_panel = false;           ///< stands beside others, drawn narrow in every window
  ChartAxis x;
  ChartAxis y;
  std::optional<ChartMap> map;  ///< behind the curves
  std::string value_label;      ///< the label of the values that the curves' colours stand for
  std::vector<ChartCurve> curves;
  std::vector<ChartCurve> at_limit;  ///< below a logarithmic axis, and put at its limit
  std::vector<ChartRule> rules;
  std::vector<ChartBand> bands;  ///< cut off where the axis ends
  std::vector<ChartCornerText> corners;
};

/// Fits a chart for drawing: takes out the curves that have nothing to draw, sets the axes' ranges
/// from the others; cuts bands at the ends of x; lifts what is below the floor of y to it, which
/// becomes a rule, moves zeros of a logarithmic y that has no floor to `at_limit`, takes out what
/// cannot be drawn at all, and says each in the notes. A chart that is left without curves says so
/// in `missing`.
void fit(Chart& chart);

/// What a chart is drawn as.
enum class Drawing { wide_svg, narrow_svg, pdf, png };

/// The commands that give the values from the least to the most their colours.
std::string colour_commands(const std::string& label, double least, double most,
                            bool is_logarithmic, bool is_of_lines);

/// The parts of a script that draw a map: the commands before `plot`, with the data, and what is
/// plotted.
std::string map_commands(const ChartMap& map);
std::string map_plot(const ChartMap& map);

/// The size of a drawing that is an SVG, in points: a legend of many entries takes room of its own
/// below the plot.
struct DrawingSize {
  std::size_t width;
  std::size_t height;
};
DrawingSize size_of(const Chart& chart, Drawing drawing);

/// The gnuplot script that draws a fitted chart to the standard output.
std::string gnuplot_script(const Chart& chart, Drawing drawing);

/// An SVG of gnuplot as a part of a page: without its prologue, its tooltips and its opaque ground,
/// every id with the prefix, and with a description for those who do not see it.
std::string inline_svg(const std::string& svg, const std::string& prefix,
                       const std::string& description);

}  // namespace hamjet::io
