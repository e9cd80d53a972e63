#include "uncertain_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../earth_system.hpp"
#include "../formation/formation_problem.hpp"
#include "hamjet/error.hpp"
#include "moments_in_coordinates.hpp"
#include "quadrature.hpp"

namespace hamjet {
namespace {

bool is_deputy(const InitialState& start) { return start.name == "deputy"; }

/// The start for given normal variables of the parameters that all spacecraft share. Its mean is a
/// deviation from that of the start.
InitialState with_given_common(const InitialState& start, const Vector<double>& normals) {
  const Matrix<double>& factor = start.covariance.factor();
  InitialState given = start;
  given.mean = factor.leftCols(start.common) * normals;
  given.covariance = Covariance::of_factor(factor.rightCols(factor.cols() - start.common));
  return given;
}

}  // namespace

Scene scene_of_start(const Scene& scene, const InitialState& start) {
  Scene own = is_deputy(start) ? with_deputy_coefficients(scene) : scene;
  for (const std::string& name : start.parameters) add_parameter(own.system, name);
  for (const double value : parameter_values(own.system)) {
    own.variables.push_back(own.nominal.size());
    own.nominal.push_back(value);
  }
  return own;
}

bool takes_own_flow(const Scene& scene, const InitialState& start) {
  return !start.parameters.empty() || (is_deputy(start) && !is_like_chief(scene));
}

void require_known_parameters(const Scene& scene, std::string_view table) {
  require_states_alone(scene, table);
  const UncertaintySettings& settings = *scene.uncertainty;
  const auto refuse = [&](const std::vector<UncertainParameter>& parameters) {
    if (parameters.empty()) return;
    throw Error(ErrorKind::scene,
                fmt::format("{}: is of states alone, got the uncertain parameter {}, must be "
                            "without uncertain parameters; moments have them",
                            table, parameters[0].name));
  };
  refuse(settings.common);
  if (settings.chief) refuse(settings.chief->parameters);
  if (settings.deputy) refuse(settings.deputy->parameters);
}

void require_moments_of_parameters(const Scene& scene, const std::vector<InitialState>& starts) {
  const UncertaintySettings& settings = *scene.uncertainty;
  const auto one = std::find_if(starts.begin(), starts.end(), [&](const InitialState& start) {
    return takes_own_flow(scene, start);
  });
  if (one == starts.end()) return;
  const std::string what = one->parameters.empty()
                               ? "a deputy that air or light moves otherwise than its chief"
                               : fmt::format("the uncertain parameter {}", one->parameters[0]);
  const auto refuse = [&](std::string_view key, std::string_view value) {
    throw Error(ErrorKind::scene,
                fmt::format("{}: beside {} the polynomials are of positions and velocities, got "
                            "\"{}\", must be left out",
                            key, what, value));
  };
  if (!(scene.coordinates == JetCoordinates::cartesian ||
        scene.coordinates == JetCoordinates::automatic)) {
    refuse("jet.coordinates", name_of(scene.coordinates));
  }
  if (!settings.coordinates.empty()) {
    refuse("uncertainty.coordinates", name_of(settings.coordinates[0]));
  }
}

std::vector<Cumulants> relative_moments(const std::vector<Series<double>>& deputy,
                                        const InitialState& of_deputy,
                                        const std::vector<Series<double>>& chief,
                                        const InitialState& of_chief) {
  // Fourth moments of polynomials of degree N have degree 4 N.
  const int nodes = 2 * deputy[0].order() + 1;
  const NormalQuadrature rule =
      product_quadrature(std::vector<int>(static_cast<std::size_t>(of_deputy.common), nodes));
  std::vector<std::vector<Cumulants>> parts(static_cast<std::size_t>(deputy[0].order()));
  for (Eigen::Index k = 0; k < rule.weights.size(); ++k) {
    const Vector<double> normals = rule.points.col(k);
    const auto relative =
        difference_by_order(moments_by_order(deputy, with_given_common(of_deputy, normals)),
                            moments_by_order(chief, with_given_common(of_chief, normals)));
    for (std::size_t n = 0; n < parts.size(); ++n) parts[n].push_back(relative[n]);
  }
  std::vector<Cumulants> moments;
  for (const std::vector<Cumulants>& of_order : parts) {
    moments.push_back(Cumulants::of_mixture(of_order, rule.weights));
  }
  return moments;
}

std::vector<ParameterEffect> parameter_effects(const std::vector<InitialState>& starts,
                                               const std::vector<Matrix<double>>& flows) {
  std::vector<ParameterEffect> effects;
  const auto column = [&](std::size_t s, std::size_t k) {
    return Vector<double>(flows[s].col(6 + static_cast<Eigen::Index>(k)));
  };
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const Vector<double> deviations = starts[s].covariance.standard_deviations();
    for (std::size_t k = 0; k < starts[s].parameters.size(); ++k) {
      const bool is_common = static_cast<Eigen::Index>(k) < starts[s].common;
      if (is_common && s > 0) continue;
      const double deviation = deviations[6 + static_cast<Eigen::Index>(k)];
      ParameterEffect effect{
          is_common ? "all" : starts[s].name, starts[s].parameters[k], deviation, {}};
      const auto add = [&](const std::string& state, const Vector<double>& by_parameter) {
        effect.along.push_back({state, deviation * by_parameter.cwiseAbs()});
      };
      if (is_common) {
        for (std::size_t other = 0; other < starts.size(); ++other) {
          add(starts[other].name, column(other, k));
        }
        if (starts.size() == 2) add("relative", column(1, k) - column(0, k));
      } else {
        add(starts[s].name, column(s, k));
        if (starts.size() == 2) add("relative", column(s, k));
      }
      effects.push_back(std::move(effect));
    }
  }
  return effects;
}

}  // namespace hamjet
