#include "directional_flow.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <span>
#include <utility>

#include "../algebra/instantiated_real.hpp"
#include "hamjet/algebra/extended.hpp"
#include "line_restriction.hpp"
#include "lines_side_by_side.hpp"
#include "real_number.hpp"

namespace hamjet {
namespace {

/// A number with a random sign and a size between 1/2 and 1. (The distributions of the standard
/// library differ between implementations.)
double signed_size(std::mt19937_64& generator) {
  const auto bits = static_cast<double>(static_cast<std::int64_t>(generator()) >> 11);
  const double x = bits * 0x1p-52;  // in [-1, 1)
  return x < 0 ? (x - 1) / 2 : (x + 1) / 2;
}

}  // namespace

template <class Real>
DirectionalFlow<Real>::DirectionalFlow(const FlowProblem<Real>& problem, std::size_t count,
                                       std::shared_ptr<FieldAtStates<Real>> field)
    : problem_(problem),
      field_(field ? std::move(field) : std::make_shared<FieldAtStates<Real>>(*problem.system)),
      line_space_(SeriesSpace::create(1, problem.space->order())) {
  const std::size_t n = problem.system->degrees_of_freedom;
  const std::span<const Real> state(problem.initial_state);
  const double scale = field_->momentum_scale(state, problem.start_time);
  const std::vector<double> gradient = field_->energy_gradient(state, problem.start_time);
  const auto along_field = [&](std::size_t v) {
    return v < n ? gradient[n + v] : v < 2 * n ? -gradient[v - n] : 0;
  };
  const double of_parameters = std::cbrt(scale * scale);  // in_momentum_unit
  const auto unit = [&](std::size_t v) { return v < n ? 1 : v < 2 * n ? scale : of_parameters; };
  std::mt19937_64 generator(1);
  for (std::size_t j = 0; j < count; ++j) {
    std::vector<Real>& direction = directions_.emplace_back();
    for (const std::size_t v : problem.variables) {
      double size = signed_size(generator);
      const double sign = j == 0 ? gradient[v] : (j == 1 ? along_field(v) : 0);
      if (sign != 0) size = std::copysign(size, sign);
      direction.emplace_back(size * unit(v));
    }
  }
  starts_ = restrict(starting_jet(problem));
}

template <class Real>
typename DirectionalFlow<Real>::Lines DirectionalFlow<Real>::integrate(
    const Integrate& integrate) const {
  return lines(integrate(problem()));
}

template <class Real>
FlowProblem<Real> DirectionalFlow<Real>::problem() const {
  FlowProblem<Real> all = problem_;
  all.initial_jet = side_by_side(starts_);
  all.space = (*all.initial_jet)[0].space_pointer();
  // The variables stand for the parameter s of each line; the initial jet defines which deviations
  // they move.
  all.variables.resize(starts_.size());
  std::iota(all.variables.begin(), all.variables.end(), std::size_t{0});
  return all;
}

template <class Real>
typename DirectionalFlow<Real>::Lines DirectionalFlow<Real>::lines(const FlowJet<Real>& jet) const {
  return line_by_line(jet);
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
  const double scale = field_->momentum_scale(end, problem_.start_time + problem_.duration);
  std::vector<double> result;
  for (std::size_t d = 0; d < line_space_->size(); ++d) {
    double difference = 0;
    double size = 0;
    for (std::size_t j = 0; j < lines.size(); ++j) {
      for (std::size_t i = 0; i < 2 * n; ++i) {
        const double unit = i < n ? 1 : 1 / scale;
        const Real& wanted = reference[j][i][d];
        const double miss = unit * std::abs(static_cast<double>(Real(lines[j][i][d] - wanted)));
        if (!(miss <= difference)) difference = miss;
        if (std::isnan(difference)) difference = std::numeric_limits<double>::infinity();
        size = std::max(size, unit * std::abs(static_cast<double>(wanted)));
      }
    }
    result.push_back(difference > 0 ? difference / std::max(size, least_with_digits) : 0);
  }
  return result;
}

template class DirectionalFlow<InstantiatedReal>;

}  // namespace hamjet
