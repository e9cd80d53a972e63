#pragma once

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/algebra/matrix.hpp"
#include "hamjet/detail/dynamics/slice_evaluator.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "phase_space_scale.hpp"

namespace hamjet {

/// Coordinates w of the deviations x at a point z* where a flow is cut, in which the map behind the
/// cut is expanded:
///
///   w_1 = (H(z* + x) - H(z*)) / |S g| ,   w_i = Q_i . S^-1 x  (i >= 2) ,   g = grad H(z*) ,
///
/// with S diagonal, 1 for positions and momentum_scale for momenta, so that the coordinates do not
/// depend on units, and Q orthogonal, with Q_1 along S g and Q_2 along the flow S^-1 J g.
///
/// The deviations x themselves would not serve, because a flow shears along itself at a rate that
/// depends on the energy. Deviations of size 1 at the start have a size of about the elapsed time k
/// at the cut, along the flow, and the map behind the cut multiplies a change of energy by k. In x
/// both effects meet as terms of degree d and size k^(2d) whose sum has size k^d: over 60
/// revolutions at order 4 no digit is left. In w the long direction and the energy are separate
/// variables, one with small coefficients and large arguments and the other the reverse, so that
/// nothing cancels. (A rotation of x is not enough: along a straight line in the direction of the
/// flow the energy changes in second order.) Composed jets then have the error of the unsplit jet.
///
/// H serves as a coordinate as far as its second-order terms are smaller than its linear ones. Near
/// an equilibrium this distance is much smaller than that over which the vector field changes.
/// There the motion is nearly linear and shears little, and w = S^-1 x is used, as for linear
/// systems.
///
/// For a system with time H is taken at the time of the cut. Any coordinates give the same jet; the
/// more slowly the flow changes H, or the Jacobi integral in its place, the fewer digits are lost.
template <class Real>
class CutCoordinates {
 public:
  /// `space` must have as many variables as the system has components.
  CutCoordinates(const DynamicalSystem& system, const std::vector<Real>& state,
                 const ClockTime& time, const SpacePointer& space)
      : system_(&system),
        time_(time),
        energy_(conserved_list(system).value_or(system.hamiltonian)),
        state_(state),
        space_(space),
        order_(working_order(system, space->order())),
        n_(system.dimension()) {
    find_axes();
    form_start();
    if (uses_energy_) return;
    axes_ = Matrix<Real>::Identity(n_, n_);
    form_linear_start();
  }

  /// The jet z* + x(w), from which the map behind the cut is integrated.
  const FlowJet<Real>& start() const { return start_; }

  /// The coordinates w of a jet about z*, without constant terms.
  std::vector<Series<Real>> of(const FlowJet<Real>& jet) const {
    const SpacePointer& space = jet[0].space_pointer();
    std::vector<Series<Real>> result(n_, Series<Real>(space));
    for (std::size_t j = 0; j < n_; ++j) {
      if (j == 0 && uses_energy_) continue;
      for (std::size_t i = 0; i < n_; ++i) {
        const Real factor = axis(i, j) / scale(i);
        for (std::size_t k = 1; k < space->size(); ++k) result[j][k] += factor * jet[i][k];
      }
    }
    if (uses_energy_) {
      const int order = working_order(*system_, space->order());
      SliceEvaluator<Real, Real> energy = evaluator(energy_, space, order);
      for (std::size_t i = 0; i < n_; ++i) {
        std::copy_n(jet[i].coefficients().data(), space->first(order + 1), energy.input(i));
        // Because of rounding, the nominal of the jet may be slightly off the cut.
        *energy.input(i) = state_[i];
      }
      energy.evaluate_all();
      for (std::size_t k = 1; k < space->first(order + 1); ++k) {
        result[0][k] = energy.output(0)[k] / slope_;
      }
    }
    return result;
  }

 private:
  /// H serves as a coordinate if it does so over this fraction of the distance over which the field
  /// changes.
  static constexpr double smallest_reach = 0.1;

  const Real& scale(std::size_t i) const { return i < n_ / 2 ? position_scale_ : momentum_scale_; }
  const Real& axis(std::size_t i, std::size_t j) const {
    return axes_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }

  /// An evaluator of a list at the time of the cut.
  SliceEvaluator<Real, Real> evaluator(const OperationList& list, const SpacePointer& space,
                                       int order) const {
    SliceEvaluator<Real, Real> result(list, space, order);
    if (result.has_time()) result.set_time(time_.template in<Real>());
    return result;
  }

  void find_axes() {
    // The scale is a power of two, so that scaling rounds nothing.
    momentum_scale_ = Real(std::exp2(
        std::round(std::log2(momentum_scale(*system_, std::span<const Real>(state_), time_)))));
    SliceEvaluator<Real, Real> energy = evaluator(energy_, space_, 0);
    for (std::size_t i = 0; i < n_; ++i) *energy.input(i) = state_[i];
    energy.evaluate_constant_terms();
    const std::size_t half = n_ / 2;
    Matrix<Real> plane(n_, 2);
    for (std::size_t i = 0; i < n_; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const std::size_t conjugate = i < half ? i + half : i - half;
      const Real turned = energy.output_gradient(0, conjugate);
      plane(row, 0) = energy.output_gradient(0, i) * scale(i);
      plane(row, 1) = (i < half ? turned : Real(-turned)) / scale(i);
    }
    // Householder's reflections give an orthogonal matrix for any columns.
    axes_ = plane.householderQr().householderQ() * Matrix<Real>::Identity(n_, n_);
    slope_ = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      slope_ += axis(i, 0) * plane(static_cast<Eigen::Index>(i), 0);
    }
  }

  /// Forms x(w) degree by degree: the slices of x_1 follow from the lower slices of H, by H(z* +
  /// x(w)) = H(z*) + |S g| w_1.
  void form_start() {
    form_linear_start();
    uses_energy_ = order_ >= 2 && slope_ != 0 && !system_->vector_field.is_linear_system();
    if (uses_energy_) form_energy_start();
  }

  void form_linear_start() {
    start_.clear();
    for (const Real& value : state_) start_.emplace_back(space_, value);
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) {
        start_[i][space_->linear_index(j)] = scale(i) * axis(i, j);
      }
    }
  }

  void form_energy_start() {
    SliceEvaluator<Real, Real> energy = evaluator(energy_, space_, order_);
    for (std::size_t i = 0; i < n_; ++i) {
      std::copy_n(start_[i].coefficients().data(), space_->first(order_ + 1), energy.input(i));
    }
    energy.evaluate_constant_terms();
    energy.complete(1);
    for (int d = 2; d <= order_; ++d) {
      energy.evaluate_remainder(d);
      if (d == 2 && !is_coordinate(energy)) {
        uses_energy_ = false;
        return;
      }
      for (std::size_t k = space_->first(d); k < space_->first(d + 1); ++k) {
        const Real change = -energy.remainder(0)[k] / slope_;
        for (std::size_t i = 0; i < n_; ++i) {
          start_[i][k] = scale(i) * axis(i, 0) * change;
          energy.input(i)[k] = start_[i][k];
        }
      }
      energy.complete(d);
    }
  }

  /// Whether H serves as a coordinate; `energy` must have its slices of degree 1 and 2 on the
  /// linear x(w).
  bool is_coordinate(const SliceEvaluator<Real, Real>& energy) const {
    double curvature = 0;
    for (std::size_t k = space_->first(2); k < space_->first(3); ++k) {
      curvature = std::max(curvature, std::abs(static_cast<double>(energy.remainder(0)[k])));
    }
    const double slope = std::abs(static_cast<double>(slope_));
    return std::isfinite(curvature) && slope >= smallest_reach * field_reach() * curvature;
  }

  /// The distance, in w, over which the vector field f changes by as much as its linear part: the
  /// least of (|f_1| / |f_d|)^(1/(d-1)) over the degrees d, where f_d is the largest coefficient of
  /// the degree on the linear x(w), scaled.
  double field_reach() const {
    SliceEvaluator<Real, Real> field = evaluator(system_->vector_field, space_, order_);
    for (std::size_t i = 0; i < n_; ++i) {
      std::copy_n(start_[i].coefficients().data(), space_->first(2), field.input(i));
    }
    field.evaluate_all();
    double linear = 0;
    double reach = std::numeric_limits<double>::infinity();
    for (int d = 1; d <= order_; ++d) {
      double largest = 0;
      for (std::size_t i = 0; i < n_; ++i) {
        for (std::size_t k = space_->first(d); k < space_->first(d + 1); ++k) {
          largest =
              std::max(largest, std::abs(static_cast<double>(Real(field.output(i)[k] / scale(i)))));
        }
      }
      if (d == 1) {
        linear = largest;
      } else if (largest > 0) {
        reach = std::min(reach, std::pow(linear / largest, 1.0 / (d - 1)));
      }
    }
    return reach;
  }

  const DynamicalSystem* system_;
  ClockTime time_;
  OperationList energy_;  ///< what the flow keeps, or H
  std::vector<Real> state_;
  SpacePointer space_;
  int order_;
  std::size_t n_;
  Real position_scale_ = 1;
  Real momentum_scale_ = 1;
  Matrix<Real> axes_;  ///< the columns of Q
  Real slope_ = 0;     ///< the component of S g along the first axis: |S g| up to its sign
  bool uses_energy_ = false;
  FlowJet<Real> start_;
};

}  // namespace hamjet
