#include "box_report.hpp"

#include <fmt/format.h>

#include <array>

#include "../../store/columns.hpp"
#include "../../store/json_values.hpp"
#include "../../text/quantity_text.hpp"
#include "../formation/transfer_json.hpp"

namespace hamjet::io {
namespace {

constexpr std::array<std::string_view, 3> box_axes = {"r", "t", "n"};

std::string_view reference_text(const BoundedFormation& formation) {
  return formation.scene.bounded->box.reference == BoxReference::member
             ? "the deputy of the first size"
             : "its place, at rest";
}

}  // namespace

std::string box_verdict(const BoundedFormation& formation) {
  const BoxControl& box = *formation.box;
  const Eigen::Vector3d& widths = *formation.scene.bounded->box.half_widths_m;
  std::string text = fmt::format(
      "Kept for {:.6g} days in a box of +-{:.4g}, {:.4g} and {:.4g} m "
      "along R, T and N about {}, it takes {}",
      box.days, widths[0], widths[1], widths[2], reference_text(formation),
      counted(box.returns.size(), "return"));
  if (!box.returns.empty()) {
    text += fmt::format(" of two impulses, {:.4g} m/s together or {:.4g} m/s a day",
                        box.change_m_s(), box.change_a_day_m_s());
  }
  if (!box.is_held()) return text + ". Check failed: " + box_failure(box) + ".";
  return text + fmt::format(
                    "; flown, it is never farther from the middle than {:.4g} of the half "
                    "widths.",
                    box.farthest);
}

std::string box_failure(const BoxControl& box) {
  return fmt::format(
      "bounded.box: the deputy was not kept inside, on its way back it was up to {:.4g} half "
      "widths from the middle; other return_orbits (shorter ones) or a wider box may keep it",
      box.farthest);
}

std::string box_csv(const BoundedFormation& formation) {
  const double unit = formation.scene.units.time_s;
  Columns<BoxReturn> columns;
  columns.add("time_s", [=](const BoxReturn& one) { return one.time * unit; });
  columns.add("duration_s", [=](const BoxReturn& one) { return one.duration * unit; });
  columns.add("change_m_s", &BoxReturn::change_m_s);
  for (std::size_t i = 0; i < box_axes.size(); ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    columns.add(fmt::format("first_{}_m_s", box_axes[i]),
                [=](const BoxReturn& one) { return one.first_m_s[axis]; });
  }
  for (std::size_t i = 0; i < box_axes.size(); ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    columns.add(fmt::format("second_{}_m_s", box_axes[i]),
                [=](const BoxReturn& one) { return one.second_m_s[axis]; });
  }
  columns.add("miss_m", &BoxReturn::miss_m);
  columns.add("farthest", &BoxReturn::farthest);
  return columns.csv(formation.box->returns);
}

nlohmann::ordered_json box_json(const BoundedFormation& formation) {
  const BoxControl& box = *formation.box;
  const BoxSettings& settings = formation.scene.bounded->box;
  return {{"half_widths_m", vector_json(*settings.half_widths_m)},
          {"reference", settings.reference == BoxReference::member ? "member" : "rest"},
          {"days", box.days},
          {"returns", box.returns.size()},
          {"change_m_s", box.change_m_s()},
          {"change_m_s_a_day", box.change_a_day_m_s()},
          {"farthest", json_number(box.farthest)},
          {"held", box.is_held()},
          {"places_a_revolution", BoxControl::places_a_revolution},
          {"least_m", vector_json(box.least_m)},
          {"most_m", vector_json(box.most_m)},
          {"start_canonical", told_state(formation.scene, box.start)}};
}

Chart box_chart(const BoundedFormation& formation) {
  const Eigen::Vector3d& widths = *formation.scene.bounded->box.half_widths_m;
  Chart chart;
  chart.name = "bounded-box";
  chart.title = "In the box";
  chart.x.label = "time (days)";
  chart.y.label = "from the middle (half widths)";
  chart.y.includes = {-1, 1};
  chart.reading =
      "Where the deputy is, as it was flown with the whole field and its impulses, from the box's "
      "middle along the chief's R, T and N; the faces are at -1 and 1.";
  constexpr std::array<const char*, 3> titles = {"R", "T", "N"};
  constexpr double day_s = 86400;
  for (std::size_t i = 0; i < titles.size(); ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    ChartCurve curve;
    curve.title = titles[i];
    curve.style = i;
    curve.has_markers = false;
    for (const BoxControl::Place& place : formation.box->places) {
      curve.points.emplace_back(place.time * formation.scene.units.time_s / day_s,
                                place.from_reference_m[axis] / widths[axis]);
    }
    chart.curves.push_back(std::move(curve));
  }
  for (const double face : {-1.0, 1.0}) chart.rules.push_back({false, face, "faces", false});
  return chart;
}

}  // namespace hamjet::io
