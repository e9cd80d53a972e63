#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "../../text/html_text.hpp"
#include "chart.hpp"
#include "gnuplot.hpp"

namespace hamjet::io {
namespace {

/// Okabe and Ito's colours, which the colour-blind can tell apart, grey in place of their yellow,
/// which white paper swallows.
constexpr std::array<const char*, 8> colours = {"#0072B2", "#D55E00", "#000000", "#009E73",
                                                "#CC79A7", "#56B4E9", "#E69F00", "#777777"};
/// Four dashes and five markers: their pairs repeat after twenty series only, on paper without
/// colour.
constexpr std::array<const char*, 4> dashes = {"1", "(14,5)", "(4,4)", "(14,4,3,4)"};
/// gnuplot's markers: square, circle, triangle, diamond, pentagon; each with its hollow twin.
constexpr std::array<int, 5> filled_markers = {7, 5, 9, 13, 15};
constexpr int triangle_down = 11;

struct Layout {
  std::string terminal;
  bool is_narrow = false;
  double line_width = 1.6;
  double marker_size = 0.9;
};

/// Entries of a legend that find room in one column beside the plot.
constexpr std::size_t most_rows_beside = 18;

/// Dashes of the rules, in the order of their titles.
constexpr std::array<const char*, 3> rule_dashes = {"(6,4)", "(2,3)", "(10,3,2,3)"};

/// The titles of the rules without repetition, with the empty one of those without a title.
std::vector<std::string> rule_titles(const Chart& chart) {
  std::vector<std::string> titles;
  for (const ChartRule& rule : chart.rules) {
    if (std::find(titles.begin(), titles.end(), rule.title) == titles.end()) {
      titles.push_back(rule.title);
    }
  }
  return titles;
}

std::size_t legend_rows(const Chart& chart) {
  const std::vector<std::string> rules = rule_titles(chart);
  return static_cast<std::size_t>(
      std::count_if(chart.curves.begin(), chart.curves.end(),
                    [](const ChartCurve& curve) { return !curve.title.empty(); }) +
      std::count_if(rules.begin(), rules.end(),
                    [](const std::string& title) { return !title.empty(); }));
}

std::string svg_terminal(const Chart& chart, Drawing drawing, int font_size) {
  const DrawingSize size = size_of(chart, drawing);
  return fmt::format("svg enhanced size {},{} dynamic font 'sans-serif,{}' background 'white'",
                     size.width, size.height, font_size);
}

Layout layout_of(const Chart& chart, Drawing drawing) {
  switch (drawing) {
    case Drawing::narrow_svg:
      return {svg_terminal(chart, drawing, 13), true, 1.5, 0.8};
    case Drawing::pdf:
      return {"pdfcairo enhanced color size 8in,4.4in font 'sans-serif,12'", false, 1.8, 0.7};
    case Drawing::png:
      return {"pngcairo enhanced color size 1600,880 font 'sans-serif,20'", false, 2.4, 1.6};
    case Drawing::wide_svg:
      break;
  }
  return {svg_terminal(chart, drawing, 14)};
}

/// What a decade is called on an axis.
std::string decade_text(AxisUnit unit, int exponent) {
  const double value = std::pow(10, exponent);
  const bool has_prefix = exponent >= -15 && exponent < 15;
  // Nobody counts in kiloseconds.
  if (unit == AxisUnit::seconds && has_prefix && exponent < 3) return duration_text(value);
  if (unit == AxisUnit::metres && has_prefix) return length_text(value);
  const char* name = unit == AxisUnit::seconds ? " s" : unit == AxisUnit::metres ? " m" : "";
  return (exponent == 0 ? "1" : fmt::format("10^{{{}}}", exponent)) + name;
}

/// Ticks of a logarithmic axis: whole decades, few enough to be read, the others without a number.
std::string decades(const char* axis, const ChartAxis& settings, int most) {
  const int lower = static_cast<int>(std::lround(std::log10(settings.lower)));
  const int upper = static_cast<int>(std::lround(std::log10(settings.upper)));
  int step = 1;
  while ((upper - lower) / step > most) ++step;
  // Prefixes go by thousands.
  if (settings.unit != AxisUnit::power && step == 2) step = 3;
  std::string list;
  for (int e = lower; e <= upper; ++e) {
    const bool is_major = ((e % step) + step) % step == 0;
    list += fmt::format("{}{} 1e{} {}", list.empty() ? "" : ", ",
                        gnuplot_literal(is_major ? decade_text(settings.unit, e) : ""), e,
                        is_major ? 0 : 1);
    for (int digit = 2; step == 1 && upper - lower <= 6 && e < upper && digit < 10; ++digit) {
      list += fmt::format(", '' {}e{} 1", digit, e);
    }
  }
  return fmt::format("set logscale {0} 10\nset {0}tics ({1})\n", axis, list);
}

/// The largest of 1, 2 or 5 times a power of ten that is no larger than the number.
double round_number_below(double number) {
  const double power = std::pow(10, std::floor(std::log10(number) + 1e-9));
  const double digit = number / power * (1 + 1e-9);
  return power * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
}

/// The least of these numbers that is no smaller than the number.
double round_number_above(double number) {
  const double below = round_number_below(number);
  return below < number * (1 - 1e-9) ? round_number_below(2.5 * below * (1 + 1e-9)) : below;
}

std::string axis_commands(const char* axis, const ChartAxis& settings, int most_numbers) {
  std::string text =
      fmt::format("set {}label {} noenhanced\n", axis, gnuplot_literal(settings.label));
  text += fmt::format("set {}range [{:.17g}:{:.17g}]\n", axis,
                      settings.is_reversed ? settings.upper : settings.lower,
                      settings.is_reversed ? settings.lower : settings.upper);
  if (settings.is_logarithmic) return text + decades(axis, settings, most_numbers);
  text += fmt::format("set format {} '%g'\n", axis);
  if (settings.is_integer) return text + fmt::format("set {}tics 1\n", axis);
  return text + fmt::format("set {}tics {:.6g}\n", axis,
                            round_number_above((settings.upper - settings.lower) / most_numbers));
}

/// The axis at the top, which counts the same in another unit.
std::string top_axis(const ChartAxis& x) {
  if (!(x.top_unit > 0)) return "";
  return fmt::format(
      "set border 7 lc rgb '#444444'\n{}set x2range [{:.17g}:{:.17g}]\nset x2tics format '%g'\n"
      "set x2label {} noenhanced\n",
      x.is_logarithmic ? "set logscale x2 10\n" : "", x.lower / x.top_unit, x.upper / x.top_unit,
      gnuplot_literal(x.top_label));
}

/// The step between ticks: the same along both axes where their numbers find room on the shorter
/// one and are at least three there, else smaller on that.
double isometric_step(const ChartAxis& axis, double longer) {
  constexpr double fewest_ticks = 3;
  double step = longer;
  const auto ticks = [&] {
    return std::floor(axis.upper / step + 1e-9) - std::ceil(axis.lower / step - 1e-9) + 1;
  };
  while (ticks() < fewest_ticks) step = round_number_below(0.99 * step);
  return step;
}

std::string isometric_ticks(const Chart& chart) {
  const double most_ticks = chart.is_panel ? 6 : 10;
  const double width =
      std::max(chart.x.upper - chart.x.lower, chart.y.upper - chart.y.lower) / most_ticks;
  const double step = round_number_above(width);
  return fmt::format(
      "set size ratio -1\nset format x '%.10g'\nset format y '%.10g'\nset xtics {:.6g}\nset ytics "
      "{:.6g}\n",
      isometric_step(chart.x, step), isometric_step(chart.y, step));
}

std::string decorations(const Chart& chart) {
  std::string text;
  for (const ChartBand& band : chart.bands) {
    text += fmt::format(
        "set object rectangle from first {:.17g}, graph 0 to first {:.17g}, graph 1 behind "
        "fillcolor rgb '#E4E4E4' fillstyle solid noborder\n",
        band.from, band.to);
  }
  for (const ChartCornerText& corner : chart.corners) {
    // The longest name takes two lines, so that it stays on its side of the boundary.
    const bool is_long = corner.text.size() > 20;
    const std::size_t middle = is_long ? corner.text.find(' ', corner.text.size() / 2 - 2) : 0;
    const auto part = [&](double height, const std::string& line) {
      return fmt::format(
          "set label {} at graph {}, graph {} {} noenhanced textcolor rgb '#444444'\n",
          gnuplot_literal(line), corner.is_right ? 0.985 : 0.015, height,
          corner.is_right ? "right" : "left");
    };
    text +=
        part(corner.is_top ? 0.96 : 0.04, is_long ? corner.text.substr(0, middle) : corner.text);
    if (is_long) text += part(corner.is_top ? 0.91 : 0.09, corner.text.substr(middle + 1));
  }
  return text;
}

std::string data_block(const std::string& name, const ChartCurve& curve) {
  std::string text = fmt::format("${} << END\n", name);
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const bool is_broken = std::find(curve.gaps.begin(), curve.gaps.end(), i) != curve.gaps.end();
    // An empty line breaks the line; two would begin another set.
    if (is_broken && i > 0) text += "\n";
    text += fmt::format("{:.10g} {:.10g}", curve.points[i].first, curve.points[i].second);
    if (!curve.values.empty()) text += fmt::format(" {:.10g}", curve.values[i]);
    text += '\n';
  }
  return text + "END\n";
}

/// The colours of curves that have values, one scale for all of them.
std::string value_colours(const Chart& chart) {
  std::vector<double> all;
  for (const ChartCurve& curve : chart.curves) {
    all.insert(all.end(), curve.values.begin(), curve.values.end());
  }
  if (all.empty()) return "";
  const auto [least, most] = std::minmax_element(all.begin(), all.end());
  return colour_commands(chart.value_label, *least, *most, false, true);
}

/// Strokes at the lower edge, one row a curve so that none hides another.
std::string tick_block(const std::string& name, const ChartCurve& curve, const ChartAxis& y,
                       std::size_t row, std::size_t rows) {
  const double decades = std::log10(y.upper / y.lower);
  const double height = std::min(0.03, 0.12 / static_cast<double>(std::max<std::size_t>(rows, 1)));
  const double low = y.lower * std::pow(10, decades * height * static_cast<double>(row));
  const double high = low * std::pow(10, decades * height * 0.8);
  std::string text = fmt::format("${} << END\n", name);
  for (const double tick : curve.ticks) {
    text += fmt::format("{0:.10g} {1:.10g}\n{0:.10g} {2:.10g}\n\n", tick, low, high);
  }
  return text + "END\n";
}

std::string title_option(const std::string& title) {
  return title.empty() ? "notitle" : fmt::format("title {} noenhanced", gnuplot_literal(title));
}

const char* colour_of(const ChartCurve& curve) {
  return colours[curve.colour.value_or(curve.style) % colours.size()];
}

std::string curve_command(const std::string& block, const ChartCurve& curve, const Layout& layout) {
  if (!curve.values.empty()) {
    return fmt::format("${} using 1:2:3 with lines lc palette lw {} {}", block,
                       1.6 * layout.line_width, title_option(curve.title));
  }
  if (curve.is_background) {
    return fmt::format("${} using 1:2 with lines lc rgb '#D8D8D8' lw {} dt 1 {}", block,
                       6 * layout.line_width, title_option(curve.title));
  }
  if (curve.is_cloud) {
    return fmt::format("${} using 1:2 with points lc rgb '#999999' pt 7 ps {} {}", block,
                       0.3 * layout.marker_size, title_option(curve.title));
  }
  const char* colour = colour_of(curve);
  const int marker =
      filled_markers[curve.style % filled_markers.size()] - (curve.is_filled ? 0 : 1);
  std::string text = fmt::format("${} using 1:2 with ", block);
  text += curve.has_line ? (curve.has_markers ? "linespoints" : "lines") : "points";
  text += fmt::format(" lc rgb '{}' lw {}", colour, layout.line_width);
  if (curve.has_line) text += fmt::format(" dt {}", dashes[curve.style % dashes.size()]);
  if (curve.has_markers) {
    text += fmt::format(" pt {} ps {}", marker, layout.marker_size);
    if (curve.marker_interval > 1) text += fmt::format(" pi {}", curve.marker_interval);
  }
  return text + " " + title_option(curve.title);
}

/// How the rules of one title are drawn.
std::string rule_look(const Chart& chart, std::size_t title) {
  const std::string name = rule_titles(chart)[title];
  const bool is_faint = std::any_of(chart.rules.begin(), chart.rules.end(), [&](const auto& rule) {
    return rule.title == name && rule.is_faint;
  });
  return fmt::format("with lines lc rgb '{}' lw 1 dt {}", is_faint ? "#AAAAAA" : "#444444",
                     rule_dashes[title % rule_dashes.size()]);
}

/// The rules of one title as curves, for gnuplot does not dash its arrows everywhere.
std::string rule_block(const Chart& chart, std::size_t title) {
  std::string text = fmt::format("$rules{} << END\n", title);
  const std::string name = rule_titles(chart)[title];
  for (const ChartRule& rule : chart.rules) {
    if (rule.title != name) continue;
    text += rule.is_vertical ? fmt::format("{0:.17g} {1:.17g}\n{0:.17g} {2:.17g}\n\n", rule.place,
                                           chart.y.lower, chart.y.upper)
                             : fmt::format("{1:.17g} {0:.17g}\n{2:.17g} {0:.17g}\n\n", rule.place,
                                           chart.x.lower, chart.x.upper);
  }
  return text + "END\n";
}

}  // namespace

DrawingSize size_of(const Chart& chart, Drawing drawing) {
  const std::size_t rows = legend_rows(chart);
  if (drawing == Drawing::narrow_svg) return {420, 400 + 20 * rows};
  return {900, 500 + (rows > most_rows_beside ? 11 * rows : 0)};
}

std::string gnuplot_script(const Chart& chart, Drawing drawing) {
  const Layout layout = layout_of(chart, drawing);
  std::string script = "set encoding utf8\nset terminal " + layout.terminal + "\nset output\n";
  script += "set border 3 lc rgb '#444444'\nset tics nomirror scale 0.8, 0.4\n";
  script += "set grid xtics ytics lc rgb '#DDDDDD' lw 0.7 dt 1\n";
  if (layout.is_narrow) {
    script += "set key outside bottom center vertical Left reverse maxcols 1 samplen 3 height 1\n";
  } else if (!chart.corners.empty() || chart.map || legend_rows(chart) > most_rows_beside) {
    // Names in the corners need the whole width, as do the scale of the colours and a legend that
    // would take two columns.
    script += "set key outside bottom center horizontal Left reverse samplen 2 height 1\n";
  } else {
    script += "set key outside right top vertical Left reverse samplen 3 spacing 1.2\n";
  }
  if (layout.is_narrow) script += "set rmargin 3\n";
  // A file stands alone; in a page and in a figure the title is above the drawing.
  if (drawing == Drawing::pdf || drawing == Drawing::png) {
    script += fmt::format("set title {} noenhanced\n", gnuplot_literal(chart.title));
  }
  script += axis_commands("x", chart.x, layout.is_narrow ? 5 : 9) +
            axis_commands("y", chart.y, layout.is_narrow ? 8 : 10) + top_axis(chart.x) +
            (chart.is_isometric ? isometric_ticks(chart) : "") + decorations(chart);
  script += value_colours(chart);
  std::vector<std::string> plots;
  if (chart.map) {
    script += map_commands(*chart.map);
    plots.push_back(map_plot(*chart.map));
  }
  const std::vector<std::string> titles = rule_titles(chart);
  for (std::size_t i = 0; i < titles.size(); ++i) {
    script += rule_block(chart, i);
    plots.push_back(fmt::format("$rules{} using 1:2 {} notitle", i, rule_look(chart, i)));
  }
  const auto rows = static_cast<std::size_t>(
      std::count_if(chart.curves.begin(), chart.curves.end(),
                    [](const ChartCurve& curve) { return !curve.ticks.empty(); }));
  std::size_t row = 0;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const ChartCurve& curve = chart.curves[i];
    if (!curve.points.empty()) {
      script += data_block(fmt::format("curve{}", i), curve);
      plots.push_back(curve_command(fmt::format("curve{}", i), curve, layout));
    }
    if (curve.ticks.empty()) continue;
    script += tick_block(fmt::format("ticks{}", i), curve, chart.y, row++, rows);
    plots.push_back(
        fmt::format("$ticks{} using 1:2 with lines lc rgb '{}' lw {} dt 1 {}", i, colour_of(curve),
                    layout.line_width,
                    // A curve that exists nowhere has its name in the legend all the same.
                    title_option(curve.points.empty() ? curve.title : "")));
  }
  for (std::size_t i = 0; i < chart.at_limit.size(); ++i) {
    const ChartCurve& zeros = chart.at_limit[i];
    script += data_block(fmt::format("zeros{}", i), zeros);
    plots.push_back(fmt::format("$zeros{} using 1:2 with points lc rgb '{}' pt {} ps {} notitle", i,
                                colour_of(zeros), triangle_down, layout.marker_size * 1.2));
  }
  // The rules lie behind the curves, and come after them in the legend.
  for (std::size_t i = 0; i < titles.size(); ++i) {
    if (titles[i].empty()) continue;
    plots.push_back(fmt::format("NaN {} {}", rule_look(chart, i), title_option(titles[i])));
  }
  return script + fmt::format("plot {}\n", fmt::join(plots, ", \\\n  "));
}

}  // namespace hamjet::io
