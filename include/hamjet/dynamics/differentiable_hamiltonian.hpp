#pragma once

#include "hamjet/algebra/matrix.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"
#include "hamjet/dynamics/slice_evaluator.hpp"

namespace hamjet {

/// First and second derivatives of a Hamiltonian at one point, by z = (q, p).
template <class Real>
struct HamiltonianDerivatives {
  Vector<Real> gradient;  ///< 2n
  Matrix<Real> hessian;   ///< 2n x 2n
};

/// A Hamiltonian H: R^2n -> R on plain numbers, for methods that need one of its values at a time.
/// Evaluation reuses storage, so that one object serves one thread.
template <class Real>
class DifferentiableHamiltonian {
 public:
  DifferentiableHamiltonian() = default;
  DifferentiableHamiltonian(const DifferentiableHamiltonian&) = delete;
  DifferentiableHamiltonian& operator=(const DifferentiableHamiltonian&) = delete;
  virtual ~DifferentiableHamiltonian() = default;

  /// 2n.
  virtual Eigen::Index dimension() const = 0;
  /// H(z). Not finite outside the domain of H.
  virtual Real value(const Vector<Real>& z) = 0;
  /// Valid until the next call.
  virtual const HamiltonianDerivatives<Real>& derivatives(const Vector<Real>& z) = 0;
};

/// The Hamiltonian of a system: its gradient is the one that is derived from the recorded list, the
/// Hessian the Jacobian of that.
template <class Real>
class RecordedHamiltonian final : public DifferentiableHamiltonian<Real> {
 public:
  explicit RecordedHamiltonian(const DynamicalSystem& system)
      : hamiltonian_(system.hamiltonian),
        gradient_(gradient(system.hamiltonian)),
        space_(SeriesSpace::create(system.dimension(), 0)),
        value_(hamiltonian_, space_, 0),
        slope_(gradient_, space_, 0) {
    derivatives_.gradient.resize(dimension());
    derivatives_.hessian.resize(dimension(), dimension());
  }

  Eigen::Index dimension() const override {
    return static_cast<Eigen::Index>(hamiltonian_.inputs());
  }

  Real value(const Vector<Real>& z) override {
    evaluate(value_, z);
    return *value_.output(0);
  }

  const HamiltonianDerivatives<Real>& derivatives(const Vector<Real>& z) override {
    evaluate(slope_, z);
    for (Eigen::Index i = 0; i < dimension(); ++i) {
      const auto row = static_cast<std::size_t>(i);
      derivatives_.gradient(i) = *slope_.output(row);
      for (Eigen::Index j = 0; j < dimension(); ++j) {
        derivatives_.hessian(i, j) = slope_.output_gradient(row, static_cast<std::size_t>(j));
      }
    }
    return derivatives_;
  }

 private:
  using Evaluator = SliceEvaluator<Real, Real>;

  static void evaluate(Evaluator& evaluator, const Vector<Real>& z) {
    for (Eigen::Index i = 0; i < z.size(); ++i)
      *evaluator.input(static_cast<std::size_t>(i)) = z(i);
    evaluator.evaluate_constant_terms();
  }

  OperationList hamiltonian_;
  OperationList gradient_;
  SpacePointer space_;
  Evaluator value_;
  Evaluator slope_;
  HamiltonianDerivatives<Real> derivatives_;
};

}  // namespace hamjet
