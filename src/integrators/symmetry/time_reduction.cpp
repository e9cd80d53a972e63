#include "time_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "../../algebra/instantiated_real.hpp"
#include "../phase_space_scale.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/detail/dynamics/slice_evaluator.hpp"
#include "section_turn.hpp"

namespace hamjet {
namespace {

/// The shift is not left out if the nominal's speed in the left-out variable is below this fraction
/// of its whole speed, in scaled coordinates: the coefficients of degree d of tau contain the
/// inverse of this fraction to the power d.
constexpr double least_part_of_speed = 0.25;

/// phi_tau of a jet that does not depend on the variable `time`, which then stands for tau.
template <class Real>
FlowJet<Real> flown(const DynamicalSystem& system, FlowJet<Real> z, std::size_t time) {
  const SeriesSpace& space = z[0].space();
  const int last = space.order() - 1;
  SliceEvaluator<Real, Real> field(system.vector_field, z[0].space_pointer(), last);
  const auto raised = space.raised(time);
  for (int d = 0; d <= last; ++d) {
    for (std::size_t i = 0; i < z.size(); ++i) {
      const Real* const from = z[i].coefficients().data();
      std::copy(from + space.first(d), from + space.first(d + 1), field.input(i) + space.first(d));
    }
    if (d == 0) {
      field.evaluate_constant_terms();
    } else {
      field.evaluate_remainder(d);
      field.complete(d);
    }
    for (std::size_t k = space.first(d); k < space.first(d + 1); ++k) {
      const Real power(space.exponents(k)[time] + 1);
      for (std::size_t i = 0; i < z.size(); ++i) z[i][raised[k]] = field.output(i)[k] / power;
    }
  }
  return z;
}

/// The linear parts of the starts, with a column for each variable.
template <class Real>
std::vector<std::vector<Real>> columns_of(const FlowProblem<Real>& problem) {
  std::vector<std::vector<Real>> columns;
  const FlowJet<Real> start = starting_jet(problem);
  for (std::size_t k = 0; k < problem.space->variables(); ++k) {
    std::vector<Real>& column = columns.emplace_back();
    for (const Series<Real>& component : start) {
      column.push_back(component[problem.space->linear_index(k)]);
    }
  }
  return columns;
}

/// The speed of the nominal in each variable at the start, including R(-psi), as fractions of its
/// whole speed; momenta are divided by momentum_scale. All are 0 at an equilibrium.
template <class Real>
std::vector<double> parts_of_speed(const FlowProblem<Real>& problem,
                                   const std::optional<LeftOutRotation>& rotation) {
  const std::size_t n = problem.system->degrees_of_freedom;
  const std::span<const Real> z(problem.initial_state);
  FieldAtStates<Real> field(*problem.system);
  const std::vector<double> gradient = field.energy_gradient(z, problem.start_time);
  const double scale = field.momentum_scale(z, problem.start_time);
  std::vector<double> speed;
  for (std::size_t i = 0; i < n; ++i) speed.push_back(gradient[n + i]);
  for (std::size_t i = 0; i < n; ++i) speed.push_back(-gradient[i]);
  double square = 0;
  for (std::size_t i = 0; i < 2 * n; ++i) {
    square += std::pow(i < n ? speed[i] : speed[i] / scale, 2);
  }
  std::vector<double> parts(problem.space->variables(), 0);
  if (!(square > 0)) return parts;
  const auto number = [&](std::size_t i) { return static_cast<double>(z[i]); };
  if (rotation) {
    // d psi/dt, by which the rotation's motion is removed.
    const auto [i, j] = rotation->section;
    const double rate = (number(i) * speed[j] - number(j) * speed[i]) /
                        (number(i) * number(i) + number(j) * number(j));
    for (const auto& [a, b] : rotation->planes) {
      speed[a] += rate * number(b);
      speed[b] -= rate * number(a);
    }
  }
  const auto columns = columns_of(problem);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    double along = 0;
    double length = 0;
    for (std::size_t i = 0; i < 2 * n; ++i) {
      const double unit = i < n ? 1 : 1 / scale;
      const double entry = unit * static_cast<double>(columns[k][i]);
      along += entry * unit * speed[i];
      length += entry * entry;
    }
    if (length > 0) parts[k] = std::abs(along) / std::sqrt(length * square);
  }
  return parts;
}

}  // namespace

template <class Real>
std::optional<TimeReduction<Real>> TimeReduction<Real>::of(
    const FlowProblem<Real>& problem, const std::optional<LeftOutRotation>& rotation) {
  if (problem.space->variables() < 2 || working_order(problem) < 1) return std::nullopt;
  const std::vector<double> parts = parts_of_speed(problem, rotation);
  const auto fastest = std::max_element(parts.begin(), parts.end());
  if (!(*fastest >= least_part_of_speed)) return std::nullopt;
  TimeReduction result(problem, rotation,
                       static_cast<std::size_t>(std::distance(parts.begin(), fastest)));
  if (!result.set_inner_map(problem)) return std::nullopt;
  return result;
}

template <class Real>
TimeReduction<Real>::TimeReduction(const FlowProblem<Real>& problem,
                                   const std::optional<LeftOutRotation>& rotation,
                                   std::size_t left_out)
    : system_(problem.system),
      space_(problem.space),
      left_out_(left_out),
      rotation_(rotation),
      reduced_(problem) {
  set_reduced_problem(problem);
}

template <class Real>
void TimeReduction<Real>::set_reduced_problem(const FlowProblem<Real>& problem) {
  reduced_.symmetry = FlowSymmetry::none;
  reduced_.space = SeriesSpace::create(space_->variables() - 1, space_->order());
  reduced_.variables.erase(reduced_.variables.begin() + static_cast<std::ptrdiff_t>(left_out_));
  std::vector<std::uint8_t> exponents(space_->variables(), 0);
  for (std::size_t m = 0; m < reduced_.space->size(); ++m) {
    const auto reduced = reduced_.space->exponents(m);
    for (std::size_t k = 0; k < reduced.size(); ++k) {
      exponents[k < left_out_ ? k : k + 1] = reduced[k];
    }
    places_.push_back(space_->index(exponents));
  }
  FlowJet<Real> start;
  for (const Series<Real>& component : starting_jet(problem)) {
    Series<Real>& reduced = start.emplace_back(reduced_.space);
    for (std::size_t m = 0; m < places_.size(); ++m) reduced[m] = component[places_[m]];
  }
  reduced_.initial_jet = std::move(start);
}

template <class Real>
FlowJet<Real> TimeReduction<Real>::shifted(const FlowJet<Real>& without_shift) const {
  FlowJet<Real> jet;
  for (const Series<Real>& component : without_shift) {
    Series<Real>& whole = jet.emplace_back(space_);
    for (std::size_t m = 0; m < places_.size(); ++m) whole[places_[m]] = component[m];
  }
  return flown(*system_, std::move(jet), left_out_);
}

template <class Real>
void TimeReduction<Real>::turn_back(FlowJet<Real>& jet) const {
  if (!rotation_) return;
  for (const auto& [i, j] : rotation_->planes) {
    const Series<Real> first = *cosine_ * jet[i] + *sine_ * jet[j];
    jet[j] = *cosine_ * jet[j] - *sine_ * jet[i];
    jet[i] = first;
  }
}

template <class Real>
bool TimeReduction<Real>::set_inner_map(const FlowProblem<Real>& problem) {
  FlowJet<Real> start = shifted(*reduced_.initial_jet);
  if (rotation_) {
    const auto [i, j] = rotation_->section;
    const SectionTurn<Real> turn({start[i][0], start[j][0]}, start[i], start[j]);
    cosine_ = turn.cosine;
    sine_ = turn.sine;
    turn_back(start);
  }
  start = without_constants(std::move(start));
  const auto columns = columns_of(problem);
  std::vector<Series<Real>> sigma;
  std::vector<bool> is_moved(start.size(), false);
  if (rotation_) {
    // The rotation has brought these coordinates to the section, up to rounding.
    for (const std::size_t i : rotation_->section) is_moved[i] = true;
  }
  for (const std::vector<Real>& column : columns) {
    Series<Real> along(space_);
    Real square(0);
    for (std::size_t i = 0; i < start.size(); ++i) {
      if (column[i] == Real(0)) continue;
      is_moved[i] = true;
      along += column[i] * start[i];
      square += column[i] * column[i];
    }
    sigma.push_back(along / square);
  }
  for (std::size_t i = 0; i < start.size(); ++i) {
    const auto& coefficients = start[i].coefficients();
    const bool stays = std::all_of(coefficients.begin(), coefficients.end(),
                                   [](const Real& x) { return x == Real(0); });
    if (!is_moved[i] && !stays) return false;
  }
  inner_ = inverse(sigma);
  return true;
}

template <class Real>
FlowJet<Real> TimeReduction<Real>::expand(const FlowJet<Real>& reduced) const {
  FlowJet<Real> jet = shifted(reduced);
  turn_back(jet);
  return compose(jet, inner_);
}

template class TimeReduction<InstantiatedReal>;

}  // namespace hamjet
