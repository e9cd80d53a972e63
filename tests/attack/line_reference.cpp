#include "line_reference.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "extrapolation.hpp"

namespace hamjet::attack {
namespace {

constexpr long most_steps = 30000;

template <class T, int N>
LineState<T, N> start_of(const Model& model, const Line& line) {
  LineState<T, N> state;
  const std::size_t n = model.degrees_of_freedom;
  for (std::size_t i = 0; i < n; ++i) {
    state.q[i][0] = T(line.start[i]);
    state.q[i][1] = T(line.direction[i]);
    state.p[i][0] = T(line.start[n + i]);
    state.p[i][1] = T(line.direction[n + i]);
  }
  return state;
}

/// Errors for each degree, in units of the sizes of positions and momenta.
template <class T, int N>
std::vector<double> largest_difference(const LineState<T, N>& a, const LineState<T, N>& b,
                                       std::size_t n, const LineReference& reference) {
  std::vector<double> result;
  for (int k = 0; k <= N; ++k) {
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      largest = std::max({largest, magnitude(a.q[i][k] - b.q[i][k]) / reference.position_size,
                          magnitude(a.p[i][k] - b.p[i][k]) / reference.momentum_size});
    }
    result.push_back(largest);
  }
  return result;
}

/// Changes the coefficients of each degree by up to `part` of the largest of their group.
template <int N>
void disturb(LineState<double, N>& state, const Model& model, double part,
             std::mt19937_64& generator) {
  std::uniform_real_distribution<double> draw(-part, part);
  const std::size_t n = model.degrees_of_freedom;
  GroupSizes sizes(momentum_of_amplitude(model));
  sizes.include(state, n);
  for (int k = 0; k <= N; ++k) {
    const auto [position, momentum] = sizes.of_degree(k);
    for (std::size_t i = 0; i < n; ++i) {
      state.q[i][k] += position * draw(generator);
      state.p[i][k] += momentum * draw(generator);
    }
  }
}

/// Computes in double precision with changes that are larger by a factor and divided by the factor
/// afterwards, so that the rounding of this integration does not matter. The effect of the changes
/// is linear.
template <int N>
bool sample_floor(const Model& model, const Line& line, std::uint64_t seed,
                  LineReference& reference) {
  constexpr double enlarged = 0x1p-30;
  constexpr double half_ulp = 0x1p-53;
  const std::size_t n = model.degrees_of_freedom;
  const auto integrator = std::make_unique<Extrapolation<double, N>>(model, 1e-11);
  LineState<double, N> undisturbed = start_of<double, N>(model, line);
  if (!integrator->run(undisturbed, line.duration, most_steps)) return false;
  const auto steps = integrator->steps();
  reference.floor_steps = steps.size();
  std::mt19937_64 generator(seed);
  reference.floor.assign(static_cast<std::size_t>(N) + 1, 0);
  for (int sample = 0; sample < floor_samples; ++sample) {
    LineState<double, N> state = start_of<double, N>(model, line);
    integrator->replay(state, steps, [&](std::size_t, LineState<double, N>& before) {
      disturb(before, model, enlarged, generator);
    });
    disturb(state, model, enlarged, generator);
    const std::vector<double> change = largest_difference(state, undisturbed, n, reference);
    for (std::size_t k = 0; k < change.size(); ++k) {
      if (!std::isfinite(change[k])) return false;
      reference.floor[k] = std::max(reference.floor[k], change[k] * (half_ulp / enlarged));
    }
  }
  return true;
}

template <int N>
LineReference follow_to_order(const Model& model, const Line& line, std::uint64_t seed,
                              double tolerance, double second_tolerance) {
  const std::size_t n = model.degrees_of_freedom;
  LineReference reference;
  const auto fine = std::make_unique<Extrapolation<DoubleDouble, N>>(model, tolerance);
  auto state = start_of<DoubleDouble, N>(model, line);
  if (!fine->run(state, line.duration, most_steps)) {
    reference.failure = "the independent integrator cannot follow it";
    return reference;
  }
  // An oscillator may end at a turning point, so that its size is the largest size along the run.
  // At rest there is no size, and any size is right.
  GroupSizes sizes(momentum_of_amplitude(model));
  sizes.include(state, n);
  const auto [q_size, p_size] =
      (model.kind == ModelKind::zonal_gravity ? sizes : fine->sizes()).of_degree(0);
  reference.position_size = q_size > 0 ? q_size : 1;
  reference.momentum_size = p_size > 0 ? p_size : momentum_of_amplitude(model);
  if (line.has_unit_sizes) reference.position_size = reference.momentum_size = 1;
  const auto coarse = std::make_unique<Extrapolation<DoubleDouble, N>>(model, second_tolerance);
  auto second = start_of<DoubleDouble, N>(model, line);
  if (!coarse->run(second, line.duration, most_steps)) {
    reference.failure = "the independent integrator cannot follow it again";
    return reference;
  }
  reference.uncertainty = largest_difference(state, second, n, reference);
  reference.size = largest_difference(state, LineState<DoubleDouble, N>(), n, reference);
  for (std::size_t c = 0; c < 2 * n; ++c) {
    const LineSeries<DoubleDouble, N>& series = c < n ? state.q[c] : state.p[c - n];
    reference.coefficients.emplace_back(series.coefficients.begin(), series.coefficients.end());
  }
  if (!sample_floor<N>(model, line, seed, reference)) {
    reference.failure = "the floor cannot be sampled";
    return reference;
  }
  // Both runs are rounded to 106 bits. The weights of the extrapolation, 2 k^(2k) / (2k)! in row k,
  // amplify this rounding some thousandfold in the longest rows.
  for (std::size_t k = 0; k < reference.uncertainty.size(); ++k) {
    reference.uncertainty[k] =
        std::max(reference.uncertainty[k], 1e4 * 0x1p-53 * reference.floor[k]);
  }
  return reference;
}

template <int... Orders>
LineReference dispatch(std::integer_sequence<int, Orders...>, const Model& model, const Line& line,
                       std::uint64_t seed, double tolerance, double second_tolerance) {
  LineReference result;
  const bool is_known =
      ((line.order == Orders + 1 &&
        (result = follow_to_order<Orders + 1>(model, line, seed, tolerance, second_tolerance),
         true)) ||
       ...);
  if (!is_known) throw std::invalid_argument("a line's order is out of range");
  return result;
}

}  // namespace

LineReference follow(const Model& model, const Line& line, std::uint64_t seed, double tolerance,
                     double second_tolerance) {
  return dispatch(std::make_integer_sequence<int, most_order>(), model, line, seed, tolerance,
                  second_tolerance);
}

}  // namespace hamjet::attack
