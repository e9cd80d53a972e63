#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "../formats/relative_frame_text.hpp"
#include "../integrators/momentum_unit.hpp"
#include "../text/scene_message.hpp"
#include "scene_relative_motion.hpp"

namespace hamjet::io {
namespace {

constexpr std::size_t degrees_of_freedom = 3;

/// At this distance from a half revolution the normal velocity on a circular orbit is
/// 1 / sin(2 pi 0.01) = 16 times what a quarter revolution takes.
constexpr double default_revolutions = 0.01;

/// A table that said in which frame it is.
struct FramedTable {
  TableReader table;
  RelativeFrame frame;
  std::string head;  ///< of the key that names the frame
};

/// The frame of a further table, which must be that of the first.
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

/// The frame that a table or [transfer] names, else that of the scene's deputy, else RTN.
RelativeFrame frame_of(const TableReader& table, const TableReader& transfer,
                       const std::optional<DeputySettings>& deputy) {
  const bool is_named = names_frame(table) || names_frame(transfer);
  return deputy && !is_named ? deputy->frame : read_relative_frame(table, transfer);
}

/// Reads one end of the transfer; `fallback` is the table [transfer].
FramedTable read_end(const TableReader& fallback, std::string_view key, const Nominal& nominal,
                     const std::optional<DeputySettings>& deputy, RelativeState& state) {
  const TableReader end = fallback.table(key);
  end.check_keys();
  const RelativeFrame frame = frame_of(end, fallback, deputy);
  state = key == "start" ? read_relative_state(end, nominal, frame) : read_arrival(end, nominal);
  const bool is_of_fallback = !end.has("frame") && fallback.has("frame");
  const TableReader& named = is_of_fallback ? fallback : end;
  return {end, frame, named.head(named.has("frame") ? "frame" : "")};
}

std::string read_kind(const TableReader& transfer) {
  std::string kind = TransferSettings().kind;
  transfer.read_if_any("kind", kind);
  if (explicit_kind(kind, degrees_of_freedom).empty()) {
    transfer.fail("kind",
                  fmt::format("unknown kind, got {}, must be auto, F1, F2, F3, F4, or 3 letters q "
                              "or p for the final variables, a hyphen, and as many for the initial "
                              "ones, as in {}",
                              in_quotes(kind), explicit_kind("F2", degrees_of_freedom)));
  }
  return kind;
}

/// The margin about singular times, canonical.
double read_singular_margin(const TableReader& transfer, const Nominal& nominal) {
  const double period_of_circle =
      2 * std::numbers::pi * std::pow(initial_distance(nominal.state), 1.5);
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

/// The ellipsoid to keep out of, in which neither end may lie.
Eigen::Vector3d read_keep_out(const TableReader& transfer, const TransferSettings& settings,
                              bool has_ends) {
  const std::vector<double> axes = transfer.positive_numbers("keep_out_m", 3);
  const Eigen::Vector3d semi_axes(axes[0], axes[1], axes[2]);
  // Along inertial axes the flight alone tells.
  if (!has_ends || settings.frame == RelativeFrame::inertial) return semi_axes;
  for (const bool is_start : {true, false}) {
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
         "a larger miss of the highest order is marked"},
        {"refine", form::boolean(), absent::value(preset.refine),
         "correct all by flying, not only those that miss by more than the tolerance"},
        {"refined_miss_m", form::positive(), absent::value(preset.refined_miss_m),
         "until the miss is below this"},
        {"singular_margin_s", margin, absent::other("`singular_margin_orbits`"),
         "nearer to a singular time is marked"},
        {"singular_margin_orbits", margin, absent::value(default_revolutions),
         "likewise, in periods of the nominal"},
        {"impulses", form::choice({"two", "optimal"}), absent::value("two"),
         "also the least velocity change with as many impulses, at such times, as it takes"},
        {"budget_m_s", form::positive(), absent::other("none is looked for"),
         "the times at which the whole change is no more than this are found"},
        {"largest_impulse_m_s", form::positive(), absent::other("any"),
         "transfers with a larger impulse are marked, and not the least"},
        {"keep_out_m", form::array(form::positive(), 3), absent::other("none"),
         "semi-axes along R, T, N of an ellipsoid about the chief: transfers that enter it are "
         "marked, and not the least"},
        {"strict", form::boolean(), absent::value(preset.strict),
         "a miss beyond the tolerance is exit code 1"}}})};
  return table;
}

TransferSettings read_transfer(const TableReader& transfer, const Scene& scene,
                               const Nominal& nominal, bool needs_ends) {
  transfer.check_keys();
  require_relative_motion(transfer, scene);
  TransferSettings settings;
  std::optional<FramedTable> first;
  if (transfer.has("frame")) {
    first = {transfer, read_relative_frame(transfer), transfer.head("frame")};
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
  settings.frame = first ? first->frame : frame_of(transfer, transfer, scene.deputy);
  settings.times = read_transfer_times(transfer, scene, nominal);
  settings.kind = read_kind(transfer);
  transfer.read_if_any("tolerance_m", settings.tolerance_m);
  transfer.read_if_any("refine", settings.refine);
  transfer.read_if_any("refined_miss_m", settings.refined_miss_m);
  settings.singular_margin = read_singular_margin(transfer, nominal);
  transfer.read_if_any("impulses", settings.impulses);
  transfer.read_if_any("budget_m_s", settings.budget_m_s);
  transfer.read_if_any("largest_impulse_m_s", settings.largest_impulse_m_s);
  if (transfer.has("keep_out_m")) {
    settings.keep_out_m = read_keep_out(transfer, settings, has_ends);
  }
  transfer.read_if_any("strict", settings.strict);
  return settings;
}

}  // namespace hamjet::io
