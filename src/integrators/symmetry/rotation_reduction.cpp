#include "rotation_reduction.hpp"

#include <algorithm>
#include <cmath>

#include "../../algebra/instantiated_real.hpp"
#include "../real_number.hpp"
#include "hamjet/algebra/elementary_functions.hpp"
#include "section_turn.hpp"

namespace hamjet {
namespace {

/// If |y0|^2, which is at most 1, is below this number, phi is not left out: its series converge
/// for deviations up to |y0| in scaled coordinates. On a polar orbit positions or momenta have at
/// least 0.5.
constexpr double least_square = 0.25;

/// The sizes of all positions and of all momenta, by which the coordinates of each kind are scaled;
/// 1 for a size that vanishes.
template <class Real>
std::array<Real, 2> sizes_of(const std::vector<Real>& state, std::size_t degrees_of_freedom) {
  using std::sqrt;
  std::array<Real, 2> squares = {Real(0), Real(0)};
  const std::size_t n = degrees_of_freedom;
  for (std::size_t i = 0; i < 2 * n; ++i) squares[i / n] += state[i] * state[i];
  for (Real& x : squares) x = x > 0 ? Real(sqrt(x)) : Real(1);
  return squares;
}

/// A quarter turn of every pair of coordinates.
template <class T>
std::vector<T> quarter_turn(const std::vector<T>& y) {
  std::vector<T> turned = y;
  for (std::size_t i = 0; i + 1 < y.size(); i += 2) {
    turned[i] = -y[i + 1];
    turned[i + 1] = y[i];
  }
  return turned;
}

}  // namespace

template <class Real>
std::optional<RotationReduction<Real>> RotationReduction<Real>::of(
    const FlowProblem<Real>& problem) {
  const auto& planes = problem.system->rotated_planes;
  const bool is_asked = problem.symmetry != FlowSymmetry::none && !problem.initial_jet;
  const bool has_jet = problem.duration != 0 && working_order(problem) >= 1;
  if (!is_asked || !has_jet || planes.empty()) return std::nullopt;
  const std::array<Real, 2> sizes =
      sizes_of(problem.initial_state, problem.system->degrees_of_freedom);
  std::vector<Real> scales;
  Real largest(0);
  std::size_t section = 0;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    Real square(0);
    for (const std::size_t i : planes[k]) {
      const auto& variables = problem.variables;
      if (std::find(variables.begin(), variables.end(), i) == variables.end()) return std::nullopt;
      scales.push_back(Real(1) / sizes[i / problem.system->degrees_of_freedom]);
      const Real y = problem.initial_state[i] * scales.back();
      square += y * y;
    }
    if (!(square > largest)) continue;
    largest = square;
    section = k;
  }
  if (!(largest >= Real(least_square))) return std::nullopt;
  return RotationReduction(problem, scales, section);
}

template <class Real>
RotationReduction<Real>::RotationReduction(const FlowProblem<Real>& problem,
                                           const std::vector<Real>& scales, std::size_t section)
    : planes_(problem.system->rotated_planes),
      section_(2 * section),
      scales_(scales),
      whole_space_(problem.space),
      reduced_(problem) {
  const auto& variables = problem.variables;
  for (const auto& plane : planes_) rotated_.insert(rotated_.end(), plane.begin(), plane.end());
  for (const std::size_t i : rotated_) {
    rotated_places_.push_back(static_cast<std::size_t>(
        std::find(variables.begin(), variables.end(), i) - variables.begin()));
  }
  for (std::size_t k = 0; k < variables.size(); ++k) {
    if (std::find(rotated_.begin(), rotated_.end(), variables[k]) == rotated_.end()) {
      passive_places_.push_back(k);
    }
  }
  const int order = problem.space->order();
  rotated_space_ = SeriesSpace::create(rotated_.size(), order);
  sigma_space_ = SeriesSpace::create(rotated_.size() - 1, order);
  Numbers y0;
  for (std::size_t k = 0; k < rotated_.size(); ++k) {
    y0.push_back(problem.initial_state[rotated_[k]] * scales_[k]);
  }
  set_basis(y0);
  set_reduced_problem(problem);
  set_series(y0);
  set_powers();
  set_blocks(*problem.space);
}

/// The basis of sigma: the direction away from the axis in the section's plane, and all coordinates
/// outside this plane. Each of these coordinates is a deviation by itself: a direction across
/// several would mix deviations that grow along the orbit with others that do not, and leave the
/// latter with the rounding of the former.
template <class Real>
void RotationReduction<Real>::set_basis(const Numbers& y0) {
  using std::sqrt;
  const Real length = sqrt(y0[section_] * y0[section_] + y0[section_ + 1] * y0[section_ + 1]);
  for (std::size_t k = 0; k < y0.size(); ++k) {
    if (k == section_ + 1) continue;
    Numbers axis(y0.size(), Real(0));
    if (k == section_) {
      axis[k] = y0[k] / length;
      axis[k + 1] = y0[k + 1] / length;
    } else {
      axis[k] = Real(1);
    }
    basis_.push_back(std::move(axis));
  }
}

template <class Real>
void RotationReduction<Real>::set_reduced_problem(const FlowProblem<Real>& problem) {
  reduced_.symmetry = FlowSymmetry::none;
  reduced_.space = SeriesSpace::create(problem.space->variables() - 1, problem.space->order());
  reduced_.variables.clear();
  FlowJet<Real> start;
  for (const Real& value : problem.initial_state) start.emplace_back(reduced_.space, value);
  for (std::size_t j = 0; j < basis_.size(); ++j) {
    const auto largest =
        std::max_element(basis_[j].begin(), basis_[j].end(),
                         [](const Real& a, const Real& b) { return magnitude(a) < magnitude(b); });
    reduced_.variables.push_back(
        rotated_[static_cast<std::size_t>(std::distance(basis_[j].begin(), largest))]);
    for (std::size_t k = 0; k < rotated_.size(); ++k) {
      start[rotated_[k]][reduced_.space->linear_index(j)] = basis_[j][k] / scales_[k];
    }
  }
  for (std::size_t j = 0; j < passive_places_.size(); ++j) {
    const std::size_t component = problem.variables[passive_places_[j]];
    reduced_.variables.push_back(component);
    start[component][reduced_.space->linear_index(basis_.size() + j)] = Real(1);
  }
  reduced_.initial_jet = std::move(start);
}

template <class Real>
void RotationReduction<Real>::set_series(const Numbers& y0) {
  const std::size_t count = y0.size();
  std::vector<Series<Real>> y;
  for (std::size_t k = 0; k < count; ++k) {
    y.emplace_back(rotated_space_, y0[k]);
    y.back()[rotated_space_->linear_index(k)] = scales_[k];
  }
  const std::size_t i = section_, j = section_ + 1;
  const SectionTurn<Real> turn({y0[i], y0[j]}, y[i], y[j]);
  cosine_ = turn.cosine;
  sine_ = turn.sine;
  const std::vector<Series<Real>> turned = quarter_turn(y);
  // The components of R(-phi) y - y0 along the basis.
  for (const Numbers& axis : basis_) {
    Series<Real> along(rotated_space_);
    Series<Real> turned_along(rotated_space_);
    for (std::size_t k = 0; k < count; ++k) {
      along += axis[k] * y[k];
      turned_along += axis[k] * turned[k];
    }
    Series<Real> sigma = *cosine_ * along - *sine_ * turned_along;
    sigma[0] = Real(0);
    sigma_.push_back(std::move(sigma));
  }
}

template <class Real>
void RotationReduction<Real>::set_powers() {
  powers_.emplace_back(rotated_space_, Real(1));
  for (std::size_t m = 1; m < sigma_space_->size(); ++m) {
    const auto exponents = sigma_space_->exponents(m);
    std::vector<std::uint8_t> before(exponents.begin(), exponents.end());
    std::size_t factor = 0;
    while (before[factor] == 0) ++factor;
    --before[factor];
    if (sigma_space_->degree(m) == 1) {
      powers_.push_back(sigma_[factor]);
    } else {
      powers_.push_back(powers_[sigma_space_->index(before)] * sigma_[factor]);
    }
  }
}

template <class Real>
void RotationReduction<Real>::set_blocks(const SeriesSpace& whole) {
  const int order = whole.order();
  std::vector<std::uint8_t> in_whole(whole.variables(), 0);
  std::vector<std::uint8_t> in_reduced(whole.variables() - 1, 0);
  const auto add = [&](int degree) {
    Block block;
    block.degree = order - degree;
    for (std::size_t m = 0; m < sigma_space_->first(block.degree + 1); ++m) {
      std::copy_n(sigma_space_->exponents(m).begin(), basis_.size(), in_reduced.begin());
      block.reduced.push_back(reduced_.space->index(in_reduced));
    }
    for (std::size_t m = 0; m < rotated_space_->first(block.degree + 1); ++m) {
      const auto exponents = rotated_space_->exponents(m);
      for (std::size_t k = 0; k < rotated_.size(); ++k) {
        in_whole[rotated_places_[k]] = exponents[k];
      }
      block.whole.push_back(whole.index(in_whole));
    }
    blocks_.push_back(std::move(block));
  };
  if (passive_places_.empty()) {
    add(0);
    return;
  }
  const SpacePointer passive = SeriesSpace::create(passive_places_.size(), order);
  for (std::size_t m = 0; m < passive->size(); ++m) {
    const auto exponents = passive->exponents(m);
    for (std::size_t j = 0; j < passive_places_.size(); ++j) {
      in_whole[passive_places_[j]] = exponents[j];
      in_reduced[basis_.size() + j] = exponents[j];
    }
    add(passive->degree(m));
  }
}

template <class Real>
FlowJet<Real> RotationReduction<Real>::expand(const FlowJet<Real>& reduced) const {
  FlowJet<Real> jet;
  for (std::size_t i = 0; i < reduced.size(); ++i) jet.emplace_back(whole_space_);
  FlowJet<Real> parts(reduced.size(), Series<Real>(rotated_space_));
  for (const Block& block : blocks_) {
    const std::size_t count = block.whole.size();
    for (std::size_t i = 0; i < reduced.size(); ++i) {
      Real* const part = parts[i].coefficients().data();
      std::fill(part, part + count, Real(0));
      for (std::size_t m = 0; m < block.reduced.size(); ++m) {
        // A power has no terms below its own degree.
        const Real factor = reduced[i][block.reduced[m]];
        const Real* const power = powers_[m].coefficients().data();
        for (std::size_t k = rotated_space_->first(sigma_space_->degree(m)); k < count; ++k) {
          part[k] += factor * power[k];
        }
      }
    }
    const auto add_product = [&](const Series<Real>& turn, const Series<Real>& part, Numbers& sum,
                                 Numbers& scratch, int sign) {
      for (int d = 0; d <= block.degree; ++d) {
        if (d > 0) {
          interior_product(*rotated_space_, d, turn.coefficients().data(),
                           part.coefficients().data(), scratch.data());
        }
        for (std::size_t k = rotated_space_->first(d); k < rotated_space_->first(d + 1); ++k) {
          Real product = turn[0] * part[k];
          if (d > 0) product += scratch[k] + turn[k] * part[0];
          sum[k] += Real(sign) * product;
        }
      }
    };
    for (std::size_t i = 0; i < reduced.size(); ++i) {
      const auto at = std::find(rotated_.begin(), rotated_.end(), i);
      if (at == rotated_.end()) {
        for (std::size_t k = 0; k < count; ++k) jet[i][block.whole[k]] = parts[i][k];
        continue;
      }
      // R(phi): in the first coordinate of a plane the sine has a minus sign.
      const auto place = static_cast<std::size_t>(at - rotated_.begin());
      const bool is_first = place % 2 == 0;
      const std::size_t other = rotated_[is_first ? place + 1 : place - 1];
      Numbers sum(count, Real(0));
      Numbers scratch(rotated_space_->size(), Real(0));
      add_product(*cosine_, parts[i], sum, scratch, 1);
      add_product(*sine_, parts[other], sum, scratch, is_first ? -1 : 1);
      for (std::size_t k = 0; k < count; ++k) jet[i][block.whole[k]] = sum[k];
    }
  }
  return jet;
}

template class RotationReduction<InstantiatedReal>;

}  // namespace hamjet
