#include "scene_uncertain_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../studies/earth_system.hpp"
#include "../studies/harmonic_parameter.hpp"
#include "../text/scene_message.hpp"

namespace hamjet::io {
namespace {

constexpr std::string_view parameters_key = "parameters";
constexpr std::string_view covariances_key = "parameter_covariances";
/// For the difference of two spacecraft a quadrature takes 2 N + 1 nodes for each.
constexpr std::size_t most_common = 3;

std::string names_of_parameters(const EarthSettings& earth) {
  std::vector<std::string> names;
  for (const EarthParameter& parameter : earth_parameters()) names.push_back(parameter.name);
  names.push_back(HarmonicParameter::names_of_field(earth.degree, earth.order));
  return fmt::format("{}", fmt::join(names, ", "));
}

/// The parameter of a key of `parameters`, whose force the scene has.
EarthParameter parameter_of(const TableReader& parameters, const std::string& name,
                            const Scene& scene) {
  if (!scene.system.earth) {
    parameters.fail(name, fmt::format("of another model than earth, got {}, must be left out, or "
                                      "beside system.model = \"earth\"",
                                      parameters.found(name)));
  }
  const std::optional<EarthParameter> parameter = earth_parameter(name);
  if (!parameter || parameter->name != name) {
    parameters.fail(name,
                    fmt::format("no parameter of the forces, got {}, must be one of {}",
                                parameters.found(name), names_of_parameters(*scene.system.earth)));
  }
  if (const auto force = parameter->missing ? parameter->missing(scene.system) : std::nullopt) {
    parameters.fail(name, fmt::format("{}, got {}, must be left out, or {}", force->what,
                                      parameters.found(name), force->right));
  }
  return *parameter;
}

/// The value of a parameter of the forces on the chief, or on the deputy.
double value_of(const EarthParameter& parameter, const Scene& scene, bool is_deputy) {
  const bool is_drag = parameter.name == drag_parameter;
  if (!is_deputy || (!is_drag && parameter.name != radiation_parameter)) {
    return parameter.value(scene.system);
  }
  return coefficient_of_owner(scene, true, is_drag).value_or(0);
}

/// Warns of a standard deviation within which a parameter would change its sign.
void warn_if_beyond(const TableReader& parameters, const std::string& name, double deviation,
                    double value) {
  if (value == 0 || deviation <= std::abs(value)) return;
  parameters.warn(name,
                  fmt::format("more than the parameter itself, got a standard deviation of {:.6g} "
                              "beside a value of {:.6g}, should be at most {:.6g}: within it the "
                              "force changes its sign",
                              deviation, value, std::abs(value)));
}

/// The standard deviation of each parameter of the table that is not 0.
std::vector<UncertainParameter> read_parameters_of_forces(const TableReader& parameters,
                                                          const Scene& scene, bool is_deputy) {
  std::vector<UncertainParameter> result;
  for (const std::string& name : parameters.keys()) {
    const EarthParameter parameter = parameter_of(parameters, name, scene);
    const double deviation = parameters.number(name);
    if (deviation < 0) {
      parameters.fail(name,
                      fmt::format("no standard deviation, got {}, must be at least 0", deviation));
    }
    warn_if_beyond(parameters, name, deviation, value_of(parameter, scene, is_deputy));
    if (deviation > 0) result.push_back({name, deviation, {}});
  }
  return result;
}

/// Reads the covariances of parameters with the state.
void read_covariances(const TableReader& covariances, StateUncertainty& state,
                      const std::vector<UncertainParameter>& common) {
  for (const std::string& name : covariances.keys()) {
    const auto is_it = [&](const UncertainParameter& one) { return one.name == name; };
    if (std::any_of(common.begin(), common.end(), is_it)) {
      covariances.fail(name,
                       fmt::format("of a parameter that all spacecraft share, got {}, must be left "
                                   "out: with one state of them it cannot covary alone",
                                   covariances.found(name)));
    }
    const auto own = std::find_if(state.parameters.begin(), state.parameters.end(), is_it);
    if (own == state.parameters.end()) {
      covariances.fail(name, fmt::format("of a parameter that is known exactly, got {}, must stand "
                                         "beside a standard deviation above 0 in parameters.{}",
                                         covariances.found(name), name));
    }
    own->covariances = covariances.numbers(name, 6);
    if (const auto fault =
            Covariance::fault_of(state.joint_matrix(), component_names(state.frame))) {
      covariances.fail(name, *fault + "; number 7 and those behind it are parameters");
    }
  }
}

}  // namespace

std::vector<SceneKey> uncertain_parameter_keys() {
  ValueForm of_table;
  of_table.type = ValueForm::Type::table;
  return {{"parameters", form::words("table of numbers, each 0 or above", of_table),
           absent::other("known exactly"),
           "standard deviations of parameters of the forces, by the names in `jet.variables` "
           "(earth): those of the spacecraft, which are its drag, radiation and thrust, and in "
           "`[uncertainty]` those that all share, such as `density_factor`"},
          {"parameter_covariances", form::words("table of arrays of 6 numbers", of_table),
           absent::other("0"),
           "covariances of a spacecraft's own parameter with its position and velocity along the "
           "axes of the frame, in the parameter's unit times m and m/s"}};
}

std::optional<double> coefficient_of_owner(const Scene& scene, bool is_deputy, bool is_drag) {
  if (!scene.system.earth) return std::nullopt;
  const EarthSettings& earth = *scene.system.earth;
  if (!(is_drag ? earth.atmosphere.has_value() : earth.radiation.has_value())) return std::nullopt;
  const double chief = is_drag ? earth.drag_m2_kg : earth.radiation_m2_kg;
  if (!is_deputy) return chief;
  return (is_drag ? scene.deputy->drag_m2_kg : scene.deputy->radiation_m2_kg).value_or(chief);
}

bool has_uncertain_parameters(const TableReader& table) { return table.has(parameters_key); }

void read_uncertain_parameters(const TableReader& table, const Scene& scene,
                               StateUncertainty& state, std::vector<UncertainParameter>* common) {
  std::vector<UncertainParameter> shared;
  if (table.has(parameters_key)) {
    const TableReader parameters = table.table(parameters_key);
    for (UncertainParameter& one :
         read_parameters_of_forces(parameters, scene, common == nullptr)) {
      const auto is_it = [&](const UncertainParameter& other) { return other.name == one.name; };
      if (!is_of_all_spacecraft(one.name)) {
        // A file may have told it already.
        if (std::any_of(state.parameters.begin(), state.parameters.end(), is_it)) {
          parameters.fail(one.name, fmt::format("told by the file too, got {}, must be left out",
                                                parameters.found(one.name)));
        }
        state.parameters.push_back(std::move(one));
        continue;
      }
      if (common == nullptr) {
        parameters.fail(one.name, fmt::format("of all spacecraft, got {}, must stand in "
                                              "uncertainty.parameters",
                                              parameters.found(one.name)));
      }
      if (shared.size() == most_common) {
        parameters.fail(one.name,
                        fmt::format("too many parameters that all spacecraft share, got {} of "
                                    "them, must be at most {}",
                                    shared.size() + 1, most_common));
      }
      shared.push_back(std::move(one));
    }
  }
  if (table.has(covariances_key)) read_covariances(table.table(covariances_key), state, shared);
  if (common != nullptr) *common = std::move(shared);
}

}  // namespace hamjet::io
