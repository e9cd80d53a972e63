#include "box_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "../../store/result_table.hpp"
#include "../../text/quantity_text.hpp"

namespace hamjet::io {
namespace {

/// The returns that burns make.
std::vector<const BurnedReturn*> burned_returns(const BoxControl& box) {
  std::vector<const BurnedReturn*> burned;
  for (const BoxReturn& one : box.returns) {
    if (one.burned() != nullptr) burned.push_back(one.burned());
  }
  return burned;
}

std::optional<double> burned_propellant_kg(const BoxControl& box) {
  std::optional<double> sum;
  for (const BurnedReturn* const one : burned_returns(box)) {
    if (const auto taken = one->plan.propellant_kg()) sum = sum.value_or(0) + *taken;
  }
  return sum;
}

std::optional<double> burned_farthest(const BoxControl& box) {
  std::optional<double> farthest;
  for (const BurnedReturn* const one : burned_returns(box)) {
    farthest = std::max(farthest.value_or(0), one->farthest);
  }
  return farthest;
}

/// What burns in place of the impulses take; empty without a thruster.
std::string burns_text(const BoundedFormation& formation) {
  const BoxControl& box = *formation.box;
  const auto burned = burned_returns(box);
  if (burned.empty() || !box.burns_failure().empty()) return "";
  double longest = 0;
  for (const BurnedReturn* const one : burned) {
    for (const FiniteBurn& burn : one->plan.burns)
      longest = std::max(longest, burn.end - burn.start);
  }
  std::string text =
      fmt::format("; burns of the thruster in their place, of at most {}, take {:.4g} m/s",
                  duration_text(longest * formation.scene.units.time_s), box.burns_m_s());
  if (const auto taken = burned_propellant_kg(box)) text += fmt::format(" and {:.4g} kg", *taken);
  return text + fmt::format(", and lead it at most {:.4g} half widths from the middle",
                            burned_farthest(box).value_or(0));
}

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
  text += burns_text(formation);
  if (!box.is_kept()) return text + ". Check failed: " + box_failure(box) + ".";
  return text + fmt::format(
                    "; flown, it is never farther from the middle than {:.4g} of the half "
                    "widths.",
                    box.farthest);
}

std::string box_failure(const BoxControl& box) {
  if (box.is_held()) return "bounded.box: burns do not keep the deputy: " + box.burns_failure();
  return fmt::format(
      "bounded.box: the deputy was not kept inside, on its way back it was up to {:.4g} half "
      "widths from the middle; other return_orbits (shorter ones) or a wider box may keep it",
      box.farthest);
}

TableView box_table(const BoundedFormation& formation) {
  const BoxControl& box = *formation.box;
  const BoxSettings& settings = formation.scene.bounded->box;
  ResultTable<BoxReturn> table(
      "box", "/box", {"returns"},
      "The returns of a deputy that is kept in a box, of two impulses each.");
  table.leave_rows_out_of_json();
  table.add_scalars("half_widths_m", "m", "the half widths of the box along R, T and N",
                    *settings.half_widths_m);
  table.add_scalar("reference", "",
                   "the middle of the box: a place at rest, or the deputy of the first size",
                   settings.reference == BoxReference::member ? "member" : "rest");
  table.add_scalar("days", "", "the number of days over which the deputy is kept", box.days);
  table.add_scalar("returns", "", "the number of returns into the box", box.returns.size());
  table.add_scalar("total_change_m_s", "m/s", "the sum of all impulses", box.change_m_s());
  table.add_scalar("change_m_s_a_day", "m/s a day", "the sum of all impulses, over the days",
                   box.change_a_day_m_s());
  table.add_scalar("farthest_of_all", "",
                   "the farthest that the flown deputy is from the middle, in half widths",
                   box.farthest);
  table.add_scalar("held", "", "whether the deputy is never outside of the box", box.is_held());
  table.add_scalar("places_a_revolution", "",
                   "the number of places of a revolution at which the deputy is looked for",
                   BoxControl::places_a_revolution);
  table.add_scalars("least_m", "m", "the least of the deputy's coordinates along R, T and N",
                    box.least_m);
  table.add_scalars("most_m", "m", "the greatest of the deputy's coordinates along R, T and N",
                    box.most_m);
  table.add_scalars("start_canonical", "", "the state of the deputy at the start, canonical",
                    told_state(formation.scene, box.start));
  const double unit = formation.scene.units.time_s;
  table.add("time_s", "s", "the time of the first impulse, since the start",
            [=](const BoxReturn& one) { return one.time * unit; });
  table.add("duration_s", "s", "the time from the first impulse to the second",
            [=](const BoxReturn& one) { return one.duration * unit; });
  table.add("change_m_s", "m/s", "the sum of the magnitudes of both impulses",
            &BoxReturn::change_m_s);
  table.add_array("first_m_s", {"first_r_m_s", "first_t_m_s", "first_n_m_s"}, "m/s",
                  "the first impulse along the chief's R, T and N", &BoxReturn::first_m_s);
  table.add_array("second_m_s", {"second_r_m_s", "second_t_m_s", "second_n_m_s"}, "m/s",
                  "the second impulse along the chief's R, T and N", &BoxReturn::second_m_s);
  table.add("miss_m", "m", "the distance from the middle at which the flight ends",
            &BoxReturn::miss_m);
  table.add("farthest", "", "the farthest from the middle on the way, in half widths",
            &BoxReturn::farthest);
  table.add_scalar("burns_total_change_m_s", "m/s",
                   "the sum of the changes of the burns that were found",
                   burned_returns(box).empty() ? std::nullopt : std::optional(box.burns_m_s()));
  table.add_scalar("burns_held", "",
                   "whether burns make all returns, and lead nowhere outside of the box",
                   formation.scene.thruster ? std::optional(box.is_kept()) : std::nullopt);
  table.add_scalar("burns_propellant_kg", "kg", "the propellant of all burns",
                   burned_propellant_kg(box));
  table.add_scalar("burns_farthest_of_all", "",
                   "the farthest that the deputy is from the middle on returns by burns, in half "
                   "widths",
                   burned_farthest(box));
  const auto of_burns = [](auto value) {
    return [value](const BoxReturn& one) {
      using Value = std::remove_cvref_t<std::invoke_result_t<decltype(value), const BurnedReturn&>>;
      const BurnedReturn* const burned = one.burned();
      return burned != nullptr ? std::optional<Value>(std::invoke(value, *burned)) : std::nullopt;
    };
  };
  for (const std::size_t burn : {0, 1}) {
    const std::string name = burn == 0 ? "first_burn" : "second_burn";
    const std::string which =
        burn == 0 ? "the burn in place of the first impulse" : "the burn in place of the second";
    const auto of_burn = [=](auto value) {
      return of_burns(
          [=](const BurnedReturn& one) { return std::invoke(value, one.plan.burns[burn]); });
    };
    table.add(name + "_s", "s", "how long " + which + " lasts",
              of_burn([=](const FiniteBurn& of) { return (of.end - of.start) * unit; }));
    table.add(name + "_start_s", "s", "when " + which + " begins, since the start",
              [=](const BoxReturn& one) {
                const BurnedReturn* const burned = one.burned();
                return burned != nullptr
                           ? std::optional((one.time + burned->plan.burns[burn].start) * unit)
                           : std::nullopt;
              });
    table.add(name + "_m_s", "m/s", "the velocity change of " + which,
              of_burn(&FiniteBurn::change_m_s));
    table.add_array(name + "_direction",
                    {name + "_direction_1", name + "_direction_2", name + "_direction_3"}, "",
                    "the unit vector of " + which +
                        " along the axes of the thruster's attitude: R, T, N of the deputy's own "
                        "orbit, or the inertial axes",
                    of_burn(&FiniteBurn::direction));
  }
  table.add("burns_m_s", "m/s", "the sum of the velocity changes of both burns",
            of_burns([](const BurnedReturn& one) { return one.plan.change_m_s(); }));
  table.add("burns_miss_m", "m", "the distance at which burns miss the end of the impulses",
            of_burns([](const BurnedReturn& one) { return one.plan.miss_m; }));
  table.add("burns_farthest", "",
            "the farthest from the middle on the way by burns, in half widths",
            of_burns(&BurnedReturn::farthest));
  table.add(
      "burns_failure", "", "why burns cannot replace the impulses; empty where they can",
      [](const BoxReturn& one) { return one.burns ? one.burns->plan.failure : std::string(); });
  return std::move(table).view(box.returns, {box.returns.size()});
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
    ChartCurve curve = unmarked_line(titles[i], i);
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
