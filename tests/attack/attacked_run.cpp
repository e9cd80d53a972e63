#include "attacked_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <chrono>
#include <cmath>
#include <numbers>

#include "hamjet/error.hpp"
#include "hamjet/scene/scene_reader.hpp"

namespace hamjet::attack {
namespace {

/// An exception that passes through hamjet's runner.
struct TooSlow {};

using Seconds = std::chrono::duration<double>;

double largest(const double* values, std::size_t n) {
  double result = 0;
  for (std::size_t i = 0; i < n; ++i) result = std::max(result, std::abs(values[i]));
  return result;
}

/// The state in the units of the scene, with the 64 bits of long double.
std::vector<long double> state_of(const DrawnScene& drawn) {
  std::vector<long double> state(drawn.position.begin(), drawn.position.end());
  state.insert(state.end(), drawn.velocity.begin(), drawn.velocity.end());
  if (!drawn.elements) return state;
  const auto& [a, e, i_deg, raan_deg, argp_deg, ta_deg] = *drawn.elements;
  const long double degree = std::numbers::pi_v<long double> / 180;
  const long double i = i_deg * degree, node = raan_deg * degree, w = argp_deg * degree,
                    nu = ta_deg * degree, eccentricity = e;
  const long double p = a * (1 - eccentricity * eccentricity);
  const long double r = p / (1 + eccentricity * std::cos(nu)), v = std::sqrt(drawn.mu_km3_s2 / p);
  // Perifocal axes in the inertial frame.
  const long double along[] = {
      std::cos(node) * std::cos(w) - std::sin(node) * std::sin(w) * std::cos(i),
      std::sin(node) * std::cos(w) + std::cos(node) * std::sin(w) * std::cos(i),
      std::sin(w) * std::sin(i)};
  const long double across[] = {
      -std::cos(node) * std::sin(w) - std::sin(node) * std::cos(w) * std::cos(i),
      -std::sin(node) * std::sin(w) + std::cos(node) * std::cos(w) * std::cos(i),
      std::cos(w) * std::sin(i)};
  for (int c = 0; c < 3; ++c) {
    state.push_back(r * (std::cos(nu) * along[c] + std::sin(nu) * across[c]));
  }
  for (int c = 0; c < 3; ++c) {
    state.push_back(v * (-std::sin(nu) * along[c] + (eccentricity + std::cos(nu)) * across[c]));
  }
  return state;
}

}  // namespace

AttackedRun run_hamjet(const std::string& toml, double most_seconds) {
  AttackedRun attacked;
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] { return Seconds(std::chrono::steady_clock::now() - start).count(); };
  try {
    attacked.scene = io::parse_scene(toml, "attack.toml");
    attacked.result = propagate(*attacked.scene, [&](const std::string&, double) {
      if (seconds() > most_seconds) throw TooSlow();
    });
    attacked.exit_code = exit_code(*attacked.result);
    const RunResult& run = attacked.run();
    attacked.message = run.failure;
    for (const std::string& check : run.failed_checks) {
      attacked.message += (attacked.message.empty() ? "" : "; ") + check;
    }
  } catch (const Error& error) {
    attacked.exit_code = error.exit_code();
    attacked.message = error.what();
  } catch (const TooSlow&) {
    attacked.is_too_slow = true;
  }
  attacked.seconds = seconds();
  return attacked;
}

Model canonical_model(const Scene& scene, const Model& drawn) {
  Model model = drawn;
  model.radius = scene.canonical_radius;
  for (int n = 2; n <= 20; ++n) model.zonal[static_cast<std::size_t>(n)] = scene.system.J[n];
  return model;
}

std::string misread(const DrawnScene& drawn, const Scene& scene) {
  std::vector<long double> state = state_of(drawn);
  long double length = 1, time = 1;
  if (drawn.is_orbit) {
    length = drawn.length_km ? static_cast<long double>(*drawn.length_km)
                             : std::hypot(state[0], state[1], state[2]);
    time = std::sqrt(length * length * length / static_cast<long double>(drawn.mu_km3_s2));
  }
  const std::size_t n = drawn.model.degrees_of_freedom;
  if (scene.nominal.size() != 2 * n) return "the state has another number of components";
  // The tolerance is two units in the last place of the largest component, for one rounding and for
  // the 64 bits here.
  const auto is_near = [](double read, long double own, long double size) {
    return std::abs(static_cast<long double>(read) - own) <= 0x1p-51L * size;
  };
  const auto message = [](const std::string& what, double read, long double own) {
    return fmt::format("{} was read as {:.17g}, should be {:.17g}", what, read,
                       static_cast<double>(own));
  };
  for (std::size_t c = 0; c < 2 * n; ++c) {
    state[c] = c < n ? state[c] / length : state[c] * time / (drawn.is_orbit ? length : 1);
  }
  for (std::size_t c = 0; c < 2 * n; ++c) {
    long double size = 0;
    for (std::size_t i = 0; i < n; ++i) size = std::max(size, std::abs(state[c < n ? i : n + i]));
    if (!is_near(scene.nominal[c], state[c], size)) {
      return message(fmt::format("component {} of the state", c), scene.nominal[c], state[c]);
    }
  }
  const long double duration = drawn.duration_s / time, radius = drawn.model.radius / length;
  if (!is_near(scene.duration, duration, std::abs(duration))) {
    return message("the duration", scene.duration, duration);
  }
  if (drawn.is_orbit && !is_near(scene.canonical_radius, radius, radius)) {
    return message("the radius", scene.canonical_radius, radius);
  }
  for (int k = 2; drawn.is_orbit && k <= 20; ++k) {
    const double own = drawn.model.zonal[static_cast<std::size_t>(k)];
    if (scene.system.J[k] != own) return message(fmt::format("J{}", k), scene.system.J[k], own);
  }
  return {};
}

std::vector<double> draw_unit_direction(const Scene& scene, RandomNumbers& random) {
  std::vector<double> direction(scene.nominal.size(), 0);
  for (const std::size_t c : scene.variables) {
    const double part = random.uniform(0.5, 1);
    direction[c] = random.chance(0.5) ? part : -part;
  }
  return direction;
}

std::vector<double> draw_direction(const Scene& scene, const Model& model, RandomNumbers& random) {
  const std::size_t n = model.degrees_of_freedom;
  double q = largest(scene.nominal.data(), n), p = largest(scene.nominal.data() + n, n);
  if (const double ratio = momentum_of_amplitude(model); ratio > 0) {
    q = std::max(q, p / ratio);
    if (q == 0) q = 1;
    p = q * ratio;
  }
  std::vector<double> direction = draw_unit_direction(scene, random);
  for (std::size_t c = 0; c < 2 * n; ++c) direction[c] *= c < n ? q : p;
  return direction;
}

JetAlongLine along_line(const FlowJet<Extended>& jet, const ComputedProblem& problem,
                        const std::vector<double>& direction, const LineReference& reference) {
  const std::size_t dimension = direction.size();
  const SeriesSpace& space = *problem.space;
  const auto degrees = static_cast<std::size_t>(space.order()) + 1;
  JetAlongLine result;
  result.coefficients.assign(dimension, std::vector<DoubleDouble>(degrees));
  std::vector<std::vector<double>> squares(dimension, std::vector<double>(degrees, 0));
  result.largest_term.assign(degrees, 0);
  const double largest_position = largest(direction.data(), dimension / 2);
  const double largest_momentum = largest(direction.data() + dimension / 2, dimension / 2);
  for (std::size_t m = 0; m < space.size(); ++m) {
    DoubleDouble power(1);
    double largest_power = 1;
    const auto exponents = space.exponents(m);
    for (std::size_t v = 0; v < exponents.size(); ++v) {
      const std::size_t variable = problem.components[problem.variables[v]];
      for (int i = 0; i < exponents[v]; ++i) {
        power *= DoubleDouble(direction[variable]);
        largest_power *= variable < dimension / 2 ? largest_position : largest_momentum;
      }
    }
    const auto k = static_cast<std::size_t>(space.degree(m));
    for (std::size_t c = 0; c < jet.size(); ++c) {
      const auto high = static_cast<double>(jet[c][m]);
      const auto low = static_cast<double>(Extended(jet[c][m] - high));
      const DoubleDouble term = DoubleDouble(high, low) * power;
      const std::size_t component = problem.components[c];
      result.coefficients[component][k] += term;
      const double size =
          component < dimension / 2 ? reference.position_size : reference.momentum_size;
      const double scaled = magnitude(term) / size;
      squares[component][k] += scaled * scaled;
      result.largest_term[k] =
          std::max(result.largest_term[k], std::abs(high) * largest_power / size);
    }
  }
  result.independent_sum.assign(degrees, 0);
  for (const std::vector<double>& component : squares) {
    for (std::size_t k = 0; k < degrees; ++k) {
      result.independent_sum[k] = std::max(result.independent_sum[k], std::sqrt(component[k]));
    }
  }
  return result;
}

std::vector<double> aligned_direction(const FlowJet<Extended>& jet, const ComputedProblem& problem,
                                      const std::function<std::vector<double>()>& draw) {
  constexpr int candidates = 8;
  std::vector<double> best;
  double best_agreement = -1;
  for (int i = 0; i < candidates; ++i) {
    const std::vector<double> direction = draw();
    const std::size_t n = direction.size() / 2;
    LineReference sizes;
    sizes.position_size = std::max(largest(direction.data(), n), DBL_MIN);
    sizes.momentum_size = std::max(largest(direction.data() + n, n), DBL_MIN);
    const JetAlongLine line = along_line(jet, problem, direction, sizes);
    double agreement = 0;
    for (std::size_t c = 0; c < 2 * n; ++c) {
      const double size = c < n ? sizes.position_size : sizes.momentum_size;
      agreement = std::max(agreement, magnitude(line.coefficients[c].back()) / size /
                                          std::max(line.independent_sum.back(), DBL_MIN));
    }
    if (agreement > best_agreement) {
      best = direction;
      best_agreement = agreement;
    }
  }
  return best;
}

RelativeErrors relative_errors(const JetAlongLine& jet, const LineReference& reference) {
  RelativeErrors errors;
  const std::size_t dimension = jet.coefficients.size();
  for (std::size_t k = 0; k < reference.size.size(); ++k) {
    double error = 0;
    for (std::size_t c = 0; c < dimension; ++c) {
      const double size = c < dimension / 2 ? reference.position_size : reference.momentum_size;
      const double difference =
          magnitude(jet.coefficients[c][k] - reference.coefficients[c][k]) / size;
      error = difference >= error ? difference : error;
      if (!std::isfinite(difference)) error = HUGE_VAL;
    }
    const double size = std::max({jet.independent_sum[k], jet.largest_term[k], reference.size[k]});
    const auto relative = [&](double x) { return x == 0 ? 0 : x / size; };
    errors.error.push_back(relative(error));
    errors.uncertainty.push_back(relative(reference.uncertainty[k]));
    const double cancellation =
        reference.size[k] > 0 ? std::max(1.0, jet.independent_sum[k] / reference.size[k]) : 1;
    // The result itself is rounded too.
    errors.floor.push_back(std::max(cancellation * relative(reference.floor[k]),
                                    relative(0x1p-53 * jet.independent_sum[k])));
  }
  return errors;
}

}  // namespace hamjet::attack
