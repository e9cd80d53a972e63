#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <type_traits>

#include "../formats/relative_frame_text.hpp"
#include "../integrators/momentum_unit.hpp"
#include "../studies/formation/charts/coordinate_deviations.hpp"
#include "../studies/formation/charts/free_coordinates.hpp"
#include "../text/quantity_text.hpp"
#include "../text/scene_message.hpp"
#include "scene_lasting_thrust.hpp"
#include "scene_relative_motion.hpp"
#include "starts/scene_manoeuvres.hpp"

namespace hamjet::io {
namespace {

constexpr std::size_t degrees_of_freedom = 3;

/// On a circular orbit, at this distance (in revolutions) from a half revolution, the normal
/// velocity is 1 / sin(2 pi 0.01) = 16 times that of a quarter revolution.
constexpr double default_revolutions = 0.01;

constexpr int most_feedback_instants = 64;

/// A table that names its frame.
struct FramedTable {
  TableReader table;
  RelativeFrame frame;
  std::string head;  ///< head of a message about the key that names the frame
};

/// Requires that the frame of a further table is that of the first one.
void require_one_frame(const FramedTable& first, const FramedTable& other) {
  if (first.frame == other.frame) return;
  const bool has_derivatives_only = other.table.has("derivatives") && !other.table.has("frame");
  const std::string_view key = has_derivatives_only ? "derivatives" : "frame";
  other.table.fail(key, fmt::format("different frames, got {}, where {} has {}, must be the same",
                                    frame_text(other.frame), first.head, frame_text(first.frame)));
}

bool names_frame(const TableReader& table) {
  return table.has("frame") || table.has("derivatives");
}

/// The frame that a table or [transfer] names; otherwise that of the scene's deputy, or RTN.
RelativeFrame frame_of(const TableReader& table, const TableReader& transfer,
                       const std::optional<DeputySettings>& deputy, const Nominal& nominal) {
  const bool is_named = names_frame(table) || names_frame(transfer);
  return deputy && !is_named ? deputy->frame : read_relative_frame(table, transfer, nominal);
}

/// Reads one end of the transfer; `fallback` is the table [transfer].
template <class State>
FramedTable read_end(const TableReader& fallback, std::string_view key, const Nominal& nominal,
                     const std::optional<DeputySettings>& deputy, State& state) {
  const TableReader end = fallback.table(key);
  end.check_keys();
  const RelativeFrame frame = frame_of(end, fallback, deputy, nominal);
  if constexpr (std::is_same_v<State, ArrivalState>) {
    state = read_arrival(end, nominal);
  } else {
    refuse_manoeuvres(end);
    state = read_relative_state(end, nominal, frame);
  }
  const bool is_of_fallback = !end.has("frame") && fallback.has("frame");
  const TableReader& named = is_of_fallback ? fallback : end;
  return {end, frame, named.head(named.has("frame") ? "frame" : "")};
}

std::string read_kind(const TableReader& transfer, std::size_t told) {
  std::string kind = TransferSettings().kind;
  transfer.read_if_any("kind", kind);
  const std::string letters = explicit_kind(kind, told);
  if (letters.empty()) {
    transfer.fail("kind",
                  fmt::format("unknown kind, got {}, must be auto, F1, F2, F3, F4, or {} q "
                              "or p for the final variables, a hyphen, and as many for the initial "
                              "{}, as in {}",
                              in_quotes(kind), counted(told, "letter"), told == 1 ? "one" : "ones",
                              explicit_kind("F2", told)));
  }
  if (told == degrees_of_freedom || kind == "auto") return kind;
  // What moves freely is told by its coordinates.
  const std::string free(degrees_of_freedom - told, 'q');
  return letters.substr(0, told) + free + '-' + letters.substr(told + 1) + free;
}

/// The margin about singular times, in canonical units. Where there is no orbit, the last transfer
/// time stands for the period.
double read_singular_margin(const TableReader& transfer, const Nominal& nominal, double last) {
  const double period_of_circle =
      nominal.orbit ? 2 * std::numbers::pi * std::pow(initial_distance(nominal.state), 1.5)
                    : std::abs(last);
  const double period = nominal.period_s ? convert<double>(*nominal.period_s / nominal.scale.time_s)
                                         : period_of_circle;
  const bool has_seconds = transfer.has("singular_margin_s");
  if (!has_seconds && !transfer.has("singular_margin_orbits")) return default_revolutions * period;
  const std::string_view key =
      transfer.exactly_one_of({"singular_margin_s", "singular_margin_orbits"});
  const double given = transfer.number(key);
  if (given < 0) {
    transfer.fail(key, fmt::format("negative, got {}, must be a number from 0", given));
  }
  if (!has_seconds && !nominal.period_s) {
    transfer.fail(key, fmt::format("no period, got {} of an orbit that is not elliptic, must be "
                                   "singular_margin_s",
                                   given));
  }
  const double margin = has_seconds ? nominal.scale.time_of_s(given) : given * period;
  if (!std::isfinite(margin)) {
    transfer.fail(key, fmt::format("out of range, got {}, which is {} in canonical units, must be "
                                   "within binary64 there",
                                   given, margin));
  }
  return margin;
}

/// Two impulses and a thrust that lasts, at listed times, are what a system without an orbit has.
void refuse_what_needs_orbit(const TableReader& transfer) {
  std::vector<std::string_view> keys = {"keep_out_m", "revolutions", "longest_coast_s", "waypoint",
                                        "singular_margin_orbits"};
  if (transfer.has("impulses") && transfer.choice("impulses") != 0) keys.push_back("impulses");
  refuse_keys_of_orbits(transfer, keys, "transfers of two impulses and of a thrust that lasts");
}

/// The ellipsoid that must stay free, in which neither end may lie.
Eigen::Vector3d read_keep_out(const TableReader& transfer, const TransferSettings& settings,
                              bool has_ends) {
  const std::vector<double> axes = transfer.positive_numbers("keep_out_m", 3);
  const Eigen::Vector3d semi_axes(axes[0], axes[1], axes[2]);
  // Along inertial axes only the flight shows whether an end lies in the ellipsoid.
  if (!has_ends || is_along_coordinates(settings.frame)) return semi_axes;
  for (const bool is_start : {true, false}) {
    // Only the flight shows whether an end of another form lies in the ellipsoid.
    if (!is_start && !settings.end.is_along_axes()) continue;
    const RelativeState& state = is_start ? settings.start : settings.end;
    if (state.position_m.cwiseQuotient(semi_axes).norm() >= 1) continue;
    transfer.fail("keep_out_m",
                  fmt::format("the {} lies in the ellipsoid, got [{}, {}, {}], must be smaller",
                              is_start ? "start" : "end", axes[0], axes[1], axes[2]));
  }
  return semi_axes;
}

const TableDescription& start_table() {
  static const TableDescription table = {joined<SceneKey>(
      {relative_frame_keys(absent::other("of `[transfer]`")), relative_state_keys()})};
  return table;
}

const TableDescription& end_table() {
  static const TableDescription table = {
      joined<SceneKey>({relative_frame_keys(absent::other("of `[transfer]`")), arrival_keys()}),
      "At the arrival, relative to where the chief is then."};
  return table;
}

const TableDescription& waypoint_table() {
  static const TableDescription table = {
      joined<SceneKey>({instant_keys(), {axes_keys().front()}}),
      "In the frame of `[transfer]`, relative to where the chief is then; the deputy makes an "
      "impulse at this place."};
  return table;
}

/// More revolutions take impulses beyond any spacecraft.
constexpr int most_revolutions = 20;

std::vector<int> read_revolutions(const TableReader& transfer, bool has_ends) {
  if (!has_ends) transfer.fail("revolutions", "no start and end, must be there with revolutions");
  std::vector<int> revolutions;
  const std::vector<double> given = transfer.numbers("revolutions");
  for (std::size_t i = 0; i < given.size(); ++i) {
    const bool is_whole = given[i] == std::floor(given[i]);
    const auto number = static_cast<int>(given[i]);
    const bool is_new =
        std::find(revolutions.begin(), revolutions.end(), number) == revolutions.end();
    if (!is_whole || std::abs(given[i]) > most_revolutions || !is_new) {
      transfer.fail_element("revolutions", i,
                            fmt::format("out of range, or twice, got {}, must be a whole number "
                                        "from -{} to {} that is there once",
                                        given[i], most_revolutions, most_revolutions));
    }
    revolutions.push_back(number);
  }
  return revolutions;
}

std::vector<Waypoint> read_waypoints(const TableReader& transfer, const Nominal& nominal,
                                     const std::vector<double>& times) {
  std::vector<Waypoint> waypoints;
  for (const TableReader& table : transfer.tables("waypoint")) {
    table.check_keys({waypoint_table().names(),
                      {"frame", "derivatives", "velocity_m_s"},
                      "a waypoint, which is a place in the frame of the table [transfer],"});
    Waypoint waypoint;
    const std::string_view key = read_instant(table, nominal, waypoint.time);
    waypoint.position_m = read_place(table, nominal).position_m;
    const double before = waypoints.empty() ? 0 : waypoints.back().time;
    const double last = times.back();
    if (!(waypoint.time * last > 0) || !(std::abs(waypoint.time) > std::abs(before)) ||
        !(std::abs(waypoint.time) < std::abs(last))) {
      table.fail(key, fmt::format("out of order, got {}, must be after the start and the waypoints "
                                  "before it, and before the last transfer time, of {:.10g} s",
                                  table.found(key), last * canonical_units(nominal.scale).time_s));
    }
    waypoints.push_back(waypoint);
  }
  return waypoints;
}

void read_thrust(const TableReader& transfer, const Scene& scene, TransferSettings& settings,
                 bool has_ends) {
  transfer.read_if_any("thrust", settings.thrust);
  if (!is_orbit(scene.system.model) && settings.thrust != TransferThrust::impulses) {
    const std::string missing = missing_for_thrust(scene);
    if (!missing.empty()) transfer.fail("thrust", missing);
    if (transfer.has("feedback") && told_coordinates(scene.system) < 3) {
      transfer.fail("feedback", fmt::format("a law of three coordinates, got {}, must be left out "
                                            "in a system of fewer",
                                            transfer.found("feedback")));
    }
  }
  transfer.read_if_any("thrust_order", settings.thrust_order);
  transfer.read_if_any("largest_thrust_m_s2", settings.largest_thrust_m_s2);
  transfer.read_if_any("feedback", settings.feedback);
  if (transfer.has("errors")) {
    if (!transfer.has("feedback")) {
      transfer.fail("errors",
                    fmt::format("no law to fly by, got {} without feedback, must be beside it",
                                transfer.found("errors")));
    }
    settings.errors = read_thrust_errors(transfer.table("errors"));
  }
  if (settings.thrust == TransferThrust::impulses) return;
  if (!has_ends && transfer.has("feedback")) {
    transfer.fail("feedback", "no start and end, must be there with it");
  }
  if (settings.times.back() < 0) {
    transfer.fail("thrust",
                  "transfer times before the start, must be after it with a thrust that lasts");
  }
}

}  // namespace

const TableDescription& transfer_table() {
  static const TransferSettings preset;
  const auto end = absent::other("required, but beside `[assignment]`");
  const auto margin = form::words("number from 0", form::number());
  static const TableDescription table = {joined<SceneKey>(
      {relative_frame_keys(absent::other("that of `[deputy]`, else `\"RTN\"`")),
       {{"start", form::table(start_table()),
         absent::other("`[deputy]`; none beside `[assignment]`"),
         "velocity before the first impulse"},
        {"end", form::table(end_table()), end, "velocity after the second impulse"}},
       transfer_time_keys(absent::other("another of these four")),
       {{"kind", form::words("kind of three degrees of freedom"), absent::value(preset.kind),
         "`auto` is the one whose inverted block changes least over the transfer"},
        {"tolerance_m", form::positive(), absent::value(preset.tolerance_m),
         "a transfer whose highest order misses by more than this is marked"},
        {"refine", form::boolean(), absent::value(preset.refine),
         "whether to correct all transfers by flying, not only those that miss by more than the "
         "tolerance"},
        {"refined_miss_m", form::positive(), absent::value(preset.refined_miss_m),
         "a correction goes on until the miss is below this"},
        {"singular_margin_s", margin, absent::other("`singular_margin_orbits`"),
         "a transfer nearer than this to a singular time is marked"},
        {"singular_margin_orbits", margin, absent::value(default_revolutions),
         "the same in periods of the nominal; without an orbit, in parts of the last time"},
        {"impulses", form::choice({"two", "optimal"}), absent::value("two"),
         "optimal: also the least velocity change by any number of impulses at any times"},
        {"thrust", form::choice(thrust_names()), absent::value("impulses"),
         "energy-optimal: also the thrust that lasts, with the least integral of its squared "
         "acceleration; fuel-optimal: from it that of `[thruster]` with the least integral of its "
         "acceleration, full or none; of one's own Hamiltonian if its mass is 1"},
        {"thrust_order", form::integer(1, 4), absent::value(preset.thrust_order),
         "order of that thrust's polynomials in states and costates"},
        {"largest_thrust_m_s2", form::positive(), absent::other("any"),
         "transfers whose thrust is at some time larger are marked, and not the least"},
        {"feedback", form::integer(1, most_feedback_instants), absent::other("none"),
         "also the least such thrust as polynomials of the deputy's state at so many equal parts "
         "of the way, and a flight by them; of three coordinates"},
        {"errors", form::table(thrust_errors_table()), absent::other("none are drawn"),
         "also flights by that law, and without it, under errors drawn at random"},
        {"budget_m_s", form::positive(), absent::other("none is looked for"),
         "the times at which the whole change is no more than this are found"},
        {"largest_impulse_m_s", form::positive(), absent::other("any"),
         "transfers of two with a larger impulse are marked, and not the least; optimal impulses "
         "are divided into such as are not larger"},
        {"impulse_gap_s", form::positive(), absent::other("a 72nd of the nominal's period"),
         "least time between optimal impulses that `largest_impulse_m_s` divides"},
        {"keep_out_m", form::array(form::positive(), 3), absent::other("none"),
         "semi-axes along R, T, N of an ellipsoid about the chief: transfers that enter it are "
         "marked, and not the least"},
        {"revolutions",
         form::words(fmt::format("array of integers from -{0} to {0}", most_revolutions),
                     form::array(form::integer(-most_revolutions, most_revolutions))),
         absent::other("none"),
         "also transfers that make so many whole revolutions more than the chief, from Lambert's "
         "problem; 0 is the other orbit that makes as many"},
        {"longest_coast_s", form::positive(), absent::other("the first impulse is at the start"),
         "also the least sum of two impulses of which the first may wait so long while the deputy "
         "drifts; optimal impulses may wait in any case"},
        {"waypoint", form::words("tables", form::array(form::table(waypoint_table()))),
         absent::other("none"),
         "places on the way: also transfers through all of them, with an impulse at each"},
        {"strict", form::boolean(), absent::value(preset.strict),
         "a miss beyond the tolerance is exit code 1"}}})};
  return table;
}

TransferSettings read_transfer(const TableReader& transfer, const Scene& scene,
                               const Nominal& nominal, bool needs_ends) {
  transfer.check_keys();
  require_deviations(transfer, scene);
  if (!nominal.orbit) refuse_what_needs_orbit(transfer);
  TransferSettings settings;
  std::optional<FramedTable> first;
  if (transfer.has("frame")) {
    first = {transfer, read_relative_frame(transfer, nominal), transfer.head("frame")};
  }
  const bool has_ends = needs_ends || transfer.has("start") || transfer.has("end");
  if (has_ends) {
    std::optional<FramedTable> start;
    if (!transfer.has("start") && !scene.deputy) {
      transfer.fail("start", "missing, must be a table, or the scene must have a table [deputy]");
    }
    if (transfer.has("start") || !scene.deputy) {
      start = read_end(transfer, "start", nominal, scene.deputy, settings.start);
    }
    const FramedTable end = read_end(transfer, "end", nominal, scene.deputy, settings.end);
    if (start) require_one_frame(*start, end);
    if (first) require_one_frame(*first, start ? *start : end);
    first = start ? *start : end;
    if (!start) settings.start = in_other_frame(transfer, nominal, *scene.deputy, end.frame);
  }
  settings.frame = first ? first->frame : frame_of(transfer, transfer, scene.deputy, nominal);
  settings.times = read_transfer_times(transfer, scene, nominal);
  settings.kind = read_kind(transfer, told_coordinates(scene.system));
  transfer.read_if_any("tolerance_m", settings.tolerance_m);
  transfer.read_if_any("refine", settings.refine);
  transfer.read_if_any("refined_miss_m", settings.refined_miss_m);
  settings.singular_margin = read_singular_margin(transfer, nominal, settings.times.back());
  transfer.read_if_any("impulses", settings.impulses);
  read_thrust(transfer, scene, settings, has_ends);
  transfer.read_if_any("budget_m_s", settings.budget_m_s);
  transfer.read_if_any("largest_impulse_m_s", settings.largest_impulse_m_s);
  if (transfer.has("impulse_gap_s")) {
    settings.impulse_gap = nominal.scale.time_of_s(transfer.number("impulse_gap_s"));
  }
  if (transfer.has("keep_out_m")) {
    settings.keep_out_m = read_keep_out(transfer, settings, has_ends);
  }
  if (transfer.has("revolutions")) settings.revolutions = read_revolutions(transfer, has_ends);
  if (transfer.has("longest_coast_s")) {
    if (!has_ends) transfer.fail("longest_coast_s", "no start and end, must be there with it");
    settings.longest_coast = nominal.scale.time_of_s(transfer.number("longest_coast_s"));
  }
  if (transfer.has("waypoint")) {
    if (!has_ends) transfer.fail("waypoint", "no start and end, must be there with waypoints");
    settings.waypoints = read_waypoints(transfer, nominal, settings.times);
  }
  transfer.read_if_any("strict", settings.strict);
  return settings;
}

}  // namespace hamjet::io
