#include "sweep_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "../scene/key_title.hpp"
#include "../text/html_text.hpp"

namespace hamjet::io {
namespace {

using Place = std::pair<double, double>;

/// The value of an item's key; the study has made sure that it is a number.
double key_value(const SweepStudy& study, std::size_t item, std::size_t key) {
  const std::string& text = study.items[item][key];
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// The edges of the cells about sorted places: in the middle between two, geometrically where the
/// axis is logarithmic; the outermost cells reach as far beyond as within.
std::vector<double> edges(const std::vector<double>& places, bool is_logarithmic) {
  const auto forth = [&](double x) { return is_logarithmic ? std::log(x) : x; };
  const auto back = [&](double x) { return is_logarithmic ? std::exp(x) : x; };
  if (places.size() == 1) {
    const double width = places[0] == 0 ? 1 : std::abs(places[0]) / 4;
    return {places[0] - width, places[0] + width};
  }
  std::vector<double> result(places.size() + 1);
  for (std::size_t i = 1; i < places.size(); ++i) {
    result[i] = back((forth(places[i - 1]) + forth(places[i])) / 2);
  }
  const std::size_t last = places.size() - 1;
  result[0] = back(2 * forth(places[0]) - forth(result[1]));
  result[last + 1] = back(2 * forth(places[last]) - forth(result[last]));
  return result;
}

std::vector<double> distinct_values(const SweepStudy& study, std::size_t key) {
  std::vector<double> values;
  for (std::size_t i = 0; i < study.items.size(); ++i) values.push_back(key_value(study, i, key));
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

ChartCurve marks(std::string title, std::size_t style, std::vector<Place> places) {
  ChartCurve curve;
  curve.title = std::move(title);
  curve.style = style;
  curve.has_line = false;
  curve.is_filled = false;
  curve.points = std::move(places);
  return curve;
}

std::string label_of(const SweepColumn& column) {
  return column.unit.empty() ? column.name : fmt::format("{} ({})", column.name, column.unit);
}

}  // namespace

std::optional<double> sweep_number(const std::optional<SweepRow>& row, std::size_t column) {
  if (!row) return std::nullopt;
  const double* number = std::get_if<double>(&row->values[column]);
  return number != nullptr ? std::optional(*number) : std::nullopt;
}

Chart sweep_map(const SweepStudy& study, const SweepRows& rows) {
  const SweepMap& settings = *study.map;
  Chart chart;
  chart.name = "map";
  chart.title = study.title;
  chart.x.label = key_title(study.keys[settings.x].name);
  chart.y.label = key_title(study.keys[settings.y].name);
  chart.x.is_logarithmic = study.keys[settings.x].is_logarithmic;
  chart.y.is_logarithmic = study.keys[settings.y].is_logarithmic;

  std::map<Place, double> least;
  std::map<Place, bool> without;  // whether one of the place has no row at all
  for (std::size_t i = 0; i < study.items.size(); ++i) {
    const Place place(key_value(study, i, settings.x), key_value(study, i, settings.y));
    const std::optional<double> value = sweep_number(rows.rows[i], settings.value);
    if (value && (!settings.is_logarithmic || *value > 0)) {
      const auto [entry, is_new] = least.emplace(place, *value);
      if (!is_new) entry->second = std::min(entry->second, *value);
    } else {
      without[place] |= !rows.rows[i].has_value();
    }
  }
  if (least.empty()) {
    chart.missing = "No item has a value.";
    return chart;
  }
  const std::vector<double> xs = distinct_values(study, settings.x);
  const std::vector<double> ys = distinct_values(study, settings.y);
  const std::vector<double> x_edges = edges(xs, chart.x.is_logarithmic);
  const std::vector<double> y_edges = edges(ys, chart.y.is_logarithmic);
  chart.map = ChartMap{label_of(study.columns[settings.value]), settings.is_logarithmic, {}};
  const auto index = [](const std::vector<double>& values, double value) {
    return static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), value) -
                                    values.begin());
  };
  for (const auto& [place, value] : least) {
    const std::size_t i = index(xs, place.first);
    const std::size_t j = index(ys, place.second);
    // The places of a list lie anywhere, and are drawn as points.
    chart.map->cells.push_back(
        study.is_grid ? ChartCell{x_edges[i], x_edges[i + 1], y_edges[j], y_edges[j + 1], value}
                      : ChartCell{place.first, place.first, place.second, place.second, value});
  }
  const auto best = std::min_element(
      least.begin(), least.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const std::string& unit = study.columns[settings.value].unit;
  chart.curves.push_back(
      marks(fmt::format("least: {:.6g}{}{}", best->second, unit.empty() ? "" : " ", unit), 1,
            {best->first}));
  std::vector<Place> missing;
  std::vector<Place> failed;
  for (const auto& [place, is_missing] : without) {
    if (least.contains(place)) continue;
    (is_missing ? missing : failed).push_back(place);
  }
  if (!failed.empty()) chart.curves.push_back(marks("no value", 7, std::move(failed)));
  if (!missing.empty()) chart.curves.push_back(marks("missing", 2, std::move(missing)));
  return chart;
}

}  // namespace hamjet::io
