#include "directional_flow.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <span>

#include "../algebra/instantiated_real.hpp"
#include "hamjet/algebra/extended.hpp"
#include "line_restriction.hpp"
#include "phase_space_scale.hpp"

namespace hamjet {
namespace {

/// Up to this order two lines cost less together (measured: 0.6 of the time at order 1, 0.85 at 3):
/// what the nominal takes, once instead of twice, is more than what the products of both variables
/// do.
constexpr int highest_order_together = 3;

/// A number with a random sign and a size between 1/2 and 1. The standard library's distributions
/// differ between implementations.
double signed_size(std::mt19937_64& generator) {
  const auto bits = static_cast<double>(static_cast<std::int64_t>(generator()) >> 11);
  const double x = bits * 0x1p-52;  // in [-1, 1)
  return x < 0 ? (x - 1) / 2 : (x + 1) / 2;
}

/// The gradient of the Hamiltonian at a state.
template <class Real>
std::vector<double> energy_gradient(const DynamicalSystem& system, std::span<const Real> state) {
  SliceEvaluator<Real, Real> energy(system.hamiltonian, SeriesSpace::create(1, 0), 0);
  for (std::size_t i = 0; i < state.size(); ++i) *energy.input(i) = state[i];
  energy.evaluate_constant_terms();
  std::vector<double> result;
  for (std::size_t i = 0; i < state.size(); ++i) {
    result.push_back(static_cast<double>(energy.output_gradient(0, i)));
  }
  return result;
}

}  // namespace

template <class Real>
DirectionalFlow<Real>::DirectionalFlow(const FlowProblem<Real>& problem, std::size_t count)
    : problem_(problem), line_space_(SeriesSpace::create(1, problem.space->order())) {
  const std::size_t n = problem.system->degrees_of_freedom;
  const std::span<const Real> state(problem.initial_state);
  const double scale = momentum_scale(*problem.system, state);
  const std::vector<double> gradient = energy_gradient(*problem.system, state);
  const auto field = [&](std::size_t v) { return v < n ? gradient[n + v] : -gradient[v - n]; };
  std::mt19937_64 generator(1);
  for (std::size_t j = 0; j < count; ++j) {
    std::vector<Real>& direction = directions_.emplace_back();
    for (const std::size_t v : problem.variables) {
      double size = signed_size(generator);
      const double sign = j == 0 ? gradient[v] : (j == 1 ? field(v) : 0);
      if (sign != 0) size = std::copysign(size, sign);
      direction.emplace_back(v < n ? size : size * scale);
    }
  }
  starts_ = restrict(starting_jet(problem));
}

template <class Real>
typename DirectionalFlow<Real>::Lines DirectionalFlow<Real>::integrate(
    const Integrate& integrate) const {
  const bool is_cheaper_together =
      starts_.size() == 2 && problem_.space->order() <= highest_order_together;
  if (is_cheaper_together) return integrate_together(integrate);
  Lines result;
  for (const FlowJet<Real>& start : starts_) {
    FlowProblem<Real> line = problem_;
    line.space = line_space_;
    line.variables = {0};  // stands for s; the initial jet says what s moves
    line.initial_jet = start;
    result.push_back(integrate(line));
  }
  return result;
}

template <class Real>
typename DirectionalFlow<Real>::Lines DirectionalFlow<Real>::integrate_together(
    const Integrate& integrate) const {
  const std::size_t count = starts_.size();
  FlowProblem<Real> all = problem_;
  all.space = SeriesSpace::create(count, problem_.space->order());
  all.variables.resize(count);
  std::iota(all.variables.begin(), all.variables.end(), std::size_t{0});
  // Where the powers of each line's variable stand, by line and degree.
  std::vector<std::vector<std::size_t>> places(count);
  for (std::size_t j = 0; j < count; ++j) {
    std::vector<std::uint8_t> exponents(count, 0);
    for (std::size_t d = 0; d < line_space_->size(); ++d) {
      exponents[j] = static_cast<std::uint8_t>(d);
      places[j].push_back(all.space->index(exponents));
    }
  }
  const std::size_t components = starts_[0].size();
  FlowJet<Real> start(components, Series<Real>(all.space));
  Lines result(count, FlowJet<Real>(components, Series<Real>(line_space_)));
  const auto for_each = [&](const auto& visit) {
    for (std::size_t j = 0; j < count; ++j) {
      for (std::size_t i = 0; i < components; ++i) {
        for (std::size_t d = 0; d < line_space_->size(); ++d) visit(j, i, d, places[j][d]);
      }
    }
  };
  for_each([&](std::size_t j, std::size_t i, std::size_t d, std::size_t place) {
    start[i][place] = starts_[j][i][d];
  });
  all.initial_jet = std::move(start);
  const FlowJet<Real> end = integrate(all);
  for_each([&](std::size_t j, std::size_t i, std::size_t d, std::size_t place) {
    result[j][i][d] = end[i][place];
  });
  return result;
}

template <class Real>
typename DirectionalFlow<Real>::Lines DirectionalFlow<Real>::restrict(
    const FlowJet<Real>& jet) const {
  Lines result;
  for (const std::vector<Real>& direction : directions_) {
    result.push_back(restrict_to_line(jet, direction, line_space_));
  }
  return result;
}

template <class Real>
std::vector<double> DirectionalFlow<Real>::relative_difference(const Lines& lines,
                                                               const Lines& reference) const {
  const std::size_t n = problem_.system->degrees_of_freedom;
  std::vector<Real> end;
  for (const Series<Real>& component : reference.at(0)) end.push_back(component[0]);
  const double scale = momentum_scale(*problem_.system, std::span<const Real>(end));
  std::vector<double> result;
  for (std::size_t d = 0; d < line_space_->size(); ++d) {
    double difference = 0;
    double size = 0;
    for (std::size_t j = 0; j < lines.size(); ++j) {
      for (std::size_t i = 0; i < lines[j].size(); ++i) {
        const double unit = i < n ? 1 : 1 / scale;
        const Real& wanted = reference[j][i][d];
        const double miss = unit * std::abs(static_cast<double>(Real(lines[j][i][d] - wanted)));
        if (!(miss <= difference)) difference = miss;
        if (std::isnan(difference)) difference = std::numeric_limits<double>::infinity();
        size = std::max(size, unit * std::abs(static_cast<double>(wanted)));
      }
    }
    result.push_back(difference > 0 ? difference / size : 0);
  }
  return result;
}

template class DirectionalFlow<InstantiatedReal>;

}  // namespace hamjet
