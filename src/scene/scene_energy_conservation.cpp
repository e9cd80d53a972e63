#include <fmt/format.h>

#include <cmath>

#include "../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "scene_sections.hpp"

namespace hamjet::io {
namespace {

double read_first_step(const TableReader& table, double duration, const CanonicalScale& scale) {
  const std::string_view key = table.exactly_one_of({"first_step_canonical", "first_step_s"});
  const double given = table.number(key);
  const double step = key == "first_step_s" ? scale.time_of_s(given) : given;
  if (!std::isfinite(step) || step == 0) {
    table.fail(key, fmt::format("out of range, got {}, which is {} in canonical units, must be "
                                "within binary64 there",
                                table.found(key), step));
  }
  const double steps = std::ceil(std::abs(duration) / step);
  if (steps > largest_energy_conserving_step_count) {
    throw Error(
        ErrorKind::too_large,
        fmt::format("{}: too many steps, got {}, which takes about {:.3g} steps, must be "
                    "at least {:.3g} to keep within {:.0e}",
                    table.head(key), table.found(key), steps,
                    std::abs(duration) * (given / step) / largest_energy_conserving_step_count,
                    largest_energy_conserving_step_count));
  }
  return step;
}

/// Tables of a flow jet are not misspelt keys: the user should read why this study has no jet.
void refuse_jet(const TableReader& root) {
  for (const std::string_view key : {"jet", "integrator"}) {
    if (!root.has(key)) continue;
    root.fail(key, fmt::format("not available for the study energy-conservation, got a table of a "
                               "flow jet, must be left out: {}",
                               no_energy_conserving_jet));
  }
}

}  // namespace

const TableDescription& energy_conservation_table() {
  const auto other_duration = absent::other("another duration");
  static const TableDescription table = {
      {{"method", form::choice(energy_conserving_method_names()), absent::refused(),
        "the method, in its energy-conserving form"},
       {"first_step_canonical", form::positive(), absent::other("`first_step_s`"),
        "the first step, at most the duration; the other steps follow from the energy"},
       {"first_step_s", form::positive(), absent::other("`first_step_canonical`"), "the same"},
       {"duration_s", form::number(), other_duration, "not 0; negative is backwards"},
       {"duration_canonical", form::number(), other_duration, "the same"},
       {"expect", form::choice(energy_conservation_outcome_names()),
        absent::value(energy_conservation_outcome_names()[0]), "another outcome is exit code 1"},
       {"require_energy_error", form::positive(), absent::other("no check"),
        "largest relative error of the discrete energy"},
       {"duration_orbits",
        form::number(),
        other_duration,
        "the same in periods of the nominal",
        {orbits}}}};
  return table;
}

EnergyConservationStudy read_energy_conservation(const TableReader& root) {
  refuse_jet(root);
  EnergyConservationStudy study;
  const Nominal nominal = read_start(root, study);

  const TableReader table = root.table("energy_conservation");
  const bool has_orbits = is_orbit(study.system.model);
  check_keys_of_model(table, study.system.model);
  study.method = static_cast<EnergyConservingMethod>(table.choice("method"));
  study.duration = read_duration(table, has_orbits, nominal);
  if (study.duration == 0) {
    const std::string_view key =
        table.exactly_one_of({"duration_s", "duration_orbits", "duration_canonical"});
    table.fail(key, fmt::format("out of range, got {}, must not be 0", table.found(key)));
  }
  study.first_step = read_first_step(table, study.duration, nominal.scale);
  if (study.first_step > std::abs(study.duration)) {
    const std::string_view key = table.exactly_one_of({"first_step_canonical", "first_step_s"});
    table.fail(key, fmt::format("out of range, got {}, must not be longer than the duration",
                                table.found(key)));
  }
  table.read_if_any("expect", study.expected);
  table.read_if_any("require_energy_error", study.require_energy_error);
  return study;
}

}  // namespace hamjet::io
