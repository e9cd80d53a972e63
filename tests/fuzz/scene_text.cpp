#include <algorithm>
#include <cmath>
#include <set>

#include "fuzz_target.hpp"
#include "scene/starts/scene_of_conjunction.hpp"
#include "scene/study_reader.hpp"
#include "scene/tables/scene_errors.hpp"

// Target: the text of a scene of any study, and overrides. A line `#--set key=value` is a comment
// of TOML, and is given as an override too.

namespace hamjet::fuzz {
namespace {

constexpr std::size_t most_overrides = 8;

std::vector<io::Override> overrides_in(std::string_view text) {
  constexpr std::string_view option = "#--set ";
  std::vector<io::Override> overrides;
  while (!text.empty() && overrides.size() < most_overrides) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const std::size_t equals = line.find('=');
    if (!line.starts_with(option) || equals == std::string_view::npos) continue;
    overrides.push_back({std::string(line.substr(option.size(), equals - option.size())),
                         std::string(line.substr(equals + 1))});
  }
  return overrides;
}

template <class ModelScene>
void check_start(const ModelScene& scene) {
  const std::size_t dimension = 2 * degrees_of_freedom_of(scene.system);
  require(scene.name == "scene", "the scene's name");
  require(scene.nominal.size() == dimension, "the nominal has another dimension than the model");
  require_finite(scene.nominal, "nominal");
  require(dimension == variable_names(scene.system).size(), "names of the variables");
  const SystemSettings& system = scene.system;
  require_finite({system.mu_km3_s2, system.radius_km, system.mass_kg, system.stiffness_N_per_m,
                  system.second_stiffness_N_per_m, system.length_m, system.gravity_m_s2,
                  system.omega_rad_per_s, scene.canonical_radius, scene.duration},
                 "system");
  for (int n = ZonalCoefficients::lowest; n <= ZonalCoefficients::highest; ++n) {
    require(std::abs(system.J[n]) <= 1, "zonal coefficient");
  }
  require(std::isnormal(scene.units.length_km) && scene.units.length_km > 0 &&
              std::isnormal(scene.units.time_s) && scene.units.time_s > 0,
          "canonical units");
}

void check_positive(const std::optional<double>& number, std::string_view what) {
  require(!number || (std::isfinite(*number) && *number > 0), what);
}

void check_integrators(const Scene& scene) {
  require(!scene.integrators.empty(), "no integrator");
  std::set<std::string> labels;
  for (const IntegratorSettings& integrator : scene.integrators) {
    require(labels.insert(integrator.label).second, "two integrators of one label");
    require(integrator.label.find('/') == std::string::npos && integrator.label[0] != '.',
            "a label that leads out of the directory");
    require(integrator.step_canonical.has_value() != integrator.tolerance.has_value(),
            "neither step nor tolerance, or both");
    check_positive(integrator.step_canonical, "step");
    check_positive(integrator.tolerance, "tolerance");
    check_positive(integrator.require_relative_error, "require_relative_error");
    check_positive(integrator.require_symplecticity, "require_symplecticity");
    require(integrator.stages >= 1 && integrator.stages <= 12, "stages");
    require(integrator.beta >= 0 && integrator.beta <= 0.5, "beta");
  }
}

/// Times that move away from 0 on the side of the duration.
void check_times(const std::vector<double>& times, std::string_view what) {
  require_finite(times, what);
  for (std::size_t i = 1; i < times.size(); ++i) {
    require(std::abs(times[i]) > std::abs(times[i - 1]) && times[i] * times[i - 1] >= 0, what);
  }
}

void check_state(const RelativeState& state) {
  require(state.position_m.allFinite() && state.velocity_m_s.allFinite(), "relative state");
}

void check(const Scene& scene) {
  check_start(scene);
  require(scene.order >= 1 && scene.order <= 20, "order");
  require_ascending(scene.variables, scene.nominal.size(), "variables");
  check_integrators(scene);
  for (std::size_t i = 0; i < self_check_names().size(); ++i) {
    check_positive(scene.checks[static_cast<SelfCheckName>(i)].limit, "limit of a check");
  }
  check_positive(scene.separation, "separation");
  require(!scene.kinds || !scene.kinds->empty(), "no kinds");
  check_times(scene.relative_hamiltonian_times, "relative_hamiltonian");
  check_times(scene.jet_times, "times of jets");
  require_finite(scene.comparison.steps_canonical, "compare.steps_canonical");
  require_finite(scene.comparison.tolerances, "compare.tolerances");
  if (scene.transfer) {
    require(!scene.transfer->times.empty(), "no transfer times");
    check_times(scene.transfer->times, "transfer times");
    check_state(scene.transfer->start);
    check_state(scene.transfer->end);
    require_finite({scene.transfer->tolerance_m, scene.transfer->refined_miss_m,
                    scene.transfer->singular_margin},
                   "transfer");
  }
  if (scene.validity) {
    check_times(scene.validity->times, "validity times");
    require(scene.validity->semi_axes.size() == 3, "semi_axes");
    require_finite(scene.validity->semi_axes, "semi_axes");
  }
  if (scene.bounded) {
    require(!scene.bounded->sizes_m.empty() && scene.bounded->revolutions > 0, "bounded");
    require_finite(scene.bounded->sizes_m, "sizes");
    require_finite(
        {scene.bounded->phase_deg, scene.bounded->cross_track, scene.bounded->along_track},
        "bounded");
  }
  if (scene.deputy) check_state(scene.deputy->start);
  if (scene.assignment) {
    require(!scene.assignment->deputies.empty() && !scene.assignment->slots.empty(), "assignment");
    for (const RelativeState& state : scene.assignment->deputies) check_state(state);
    for (const RelativeState& state : scene.assignment->slots) check_state(state);
  }
}

void check(const EnergyConservationStudy& study) {
  check_start(study);
  require_finite({study.first_step, study.duration}, "energy conservation");
  require(study.first_step > 0 && study.first_step <= std::abs(study.duration), "first step");
}

void check(const CanonicalTransformationStudy& study) {
  check_start(study);
  require(study.duration > 0 && !study.steps.empty(), "canonical transformation");
  for (const double step : study.steps) check_positive(step, "step");
  for (const Extended& entry : study.transformation.matrix().reshaped()) {
    require(isfinite(entry), "matrix");
  }
}

void check(const OptimalControlStudy& study) {
  const std::size_t states = state_names(study.model).size();
  require(study.start.size() == states && study.end.size() == states, "sizes of the ends");
  require(study.costate_guess.empty() || study.costate_guess.size() == states, "costate");
  require_finite(study.start, "start");
  require_finite(study.costate_guess, "costate");
  for (const auto& end : study.end) require(!end || std::isfinite(*end), "end");
  require(study.steps >= 1 && study.duration > 0 && std::isfinite(study.duration), "control steps");
}

}  // namespace
}  // namespace hamjet::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hamjet;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto overrides = fuzz::overrides_in(text);
  fuzz::Refusal refusal{{ErrorKind::scene, ErrorKind::too_large, ErrorKind::usage},
                        {"scene.toml", "--set "},
                        io::most_errors_said};
  // An error in a file that the scene names begins with the name of the file, which may be any
  // text.
  if (text.find("_file") != std::string_view::npos) {
    refusal.kinds.push_back(ErrorKind::input_output);
    refusal.beginnings.emplace_back("");
  }
  // A message in place of a scene is refused as a file of its kind.
  if (io::is_conjunction_message(text)) refusal.kinds.push_back(ErrorKind::input_output);
  fuzz::is_read(
      [&] {
        std::visit([](const auto& study) { fuzz::check(study); },
                   io::parse_study(text, "scene.toml", overrides));
      },
      refusal);
  return 0;
}
