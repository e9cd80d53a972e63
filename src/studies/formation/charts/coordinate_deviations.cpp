#include "coordinate_deviations.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <numeric>
#include <random>
#include <vector>

#include "../../random_direction.hpp"
#include "free_coordinates.hpp"
#include "hamjet/detail/dynamics/differentiable_function.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {
namespace {

constexpr std::size_t degrees = 3;

/// The Jacobian of the rates of the coordinates at a state and a time, 3 x 6.
Matrix<double> jacobian_of_rates(DifferentiableFunction<double>& rates,
                                 const std::vector<double>& state, double time) {
  if (rates.has_time()) {
    rates.evaluate(state, time);
  } else {
    rates.evaluate(state);
  }
  return rates.jacobian();
}

}  // namespace

std::optional<VelocityLaw> velocity_law(const DynamicalSystem& system,
                                        const std::vector<double>& about) {
  if (system.degrees_of_freedom != degrees || system.dimension() != 2 * degrees) {
    return std::nullopt;
  }
  std::vector<std::size_t> inputs(2 * degrees);
  std::iota(inputs.begin(), inputs.end(), std::size_t{0});
  const std::vector<std::size_t> outputs = {0, 1, 2};
  DifferentiableFunction<double> rates(restrict_list(system.vector_field, inputs, outputs));
  const Matrix<double> law = jacobian_of_rates(rates, about, 0);
  if (!law.allFinite()) return std::nullopt;
  // A law that is not linear, or changes with time, differs at one of a few random places.
  constexpr int places = 8;
  constexpr double rounding = 1e-13;
  std::mt19937_64 generator(1);
  for (int k = 1; k <= places; ++k) {
    std::vector<double> state = about;
    const std::vector<double> direction = random_direction(generator, state.size());
    for (std::size_t i = 0; i < state.size(); ++i) {
      state[i] += 0.1 * (1 + std::abs(state[i])) * direction[i];
    }
    const Matrix<double> other = jacobian_of_rates(rates, state, 0.37 * k);
    if (!((other - law).norm() <= rounding * law.norm())) return std::nullopt;
  }
  VelocityLaw result;
  result.by_positions = law.leftCols<3>();
  result.by_momenta = law.rightCols<3>();
  if (!Eigen::FullPivLU<Eigen::Matrix3d>(result.by_momenta).isInvertible()) return std::nullopt;
  return result;
}

std::string missing_for_deviations(const Scene& asked) {
  const Scene scene = with_free_coordinates(asked);
  const SharedSystem system = make_system(scene);
  if (scene.system.own_text && !scene.system.own_text->states.empty()) {
    return "not available for a vector field, got system.vector_field, must be a Hamiltonian: "
           "this study is of a symplectic map of coordinates and momenta";
  }
  if (system->parameters > 0) {
    return fmt::format(
        "expands in coordinates and momenta alone, got jet.variables with {}, must "
        "be without it",
        state_parameters(scene.system)[0]);
  }
  if (system->degrees_of_freedom != degrees) {
    return fmt::format(
        "not available for this system, got {} of freedom, must be an orbit or a "
        "Hamiltonian of one to three coordinates",
        system->degrees_of_freedom == 1 ? std::string("one degree")
                                        : fmt::format("{} degrees", system->degrees_of_freedom));
  }
  if (!velocity_law(*system, scene.nominal)) {
    return "not available for this Hamiltonian, got rates of the coordinates that are not linear "
           "in coordinates and momenta with constant coefficients, must be as in (px^2 + py^2 + "
           "pz^2)/2 + y*px - x*py + V(x, y, z), so that a velocity has one momentum everywhere";
  }
  return "";
}

std::string missing_for_thrust(const Scene& asked) {
  constexpr double rounding = 1e-13;
  const Scene scene = with_free_coordinates(asked);
  const SharedSystem system = make_system(scene);
  const auto law = velocity_law(*system, scene.nominal);
  if (law && law->by_momenta.isIdentity(rounding)) return "";
  return "not available for this Hamiltonian, got rates of the coordinates that change with the "
         "momenta by other factors than 1, must be of a unit mass as in (px^2 + py^2 + pz^2)/2 + "
         "y*px - x*py + V(x, y, z), so that an acceleration changes the momenta at its own rate";
}

}  // namespace hamjet
