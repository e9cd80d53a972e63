#pragma once

#include <optional>
#include <span>

#include "hamjet/detail/algebra/matrix.hpp"
#include "hamjet/detail/dynamics/differentiable_function.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// First and second derivatives of a Hamiltonian with respect to z = (q, p), at one point.
template <class Real>
struct HamiltonianDerivatives {
  Vector<Real> gradient;  ///< 2n
  Matrix<Real> hessian;   ///< 2n x 2n
};

/// A Hamiltonian H: R^2n -> R on plain numbers, for methods that need one value at a time. An
/// evaluation reuses the object's storage, so that each thread needs an object of its own.
template <class Real>
class DifferentiableHamiltonian {
 public:
  DifferentiableHamiltonian() = default;
  DifferentiableHamiltonian(const DifferentiableHamiltonian&) = delete;
  DifferentiableHamiltonian& operator=(const DifferentiableHamiltonian&) = delete;
  virtual ~DifferentiableHamiltonian() = default;

  /// The dimension 2n of phase space.
  virtual Eigen::Index dimension() const = 0;
  /// The value H(z), which is not finite outside the domain of H.
  virtual Real value(const Vector<Real>& z) = 0;
  /// The derivatives of H at z; the reference is valid until the next call.
  virtual const HamiltonianDerivatives<Real>& derivatives(const Vector<Real>& z) = 0;
};

/// The Hamiltonian of a system; that of a system with time at one time, which must be set. Its
/// gradient is derived from the recorded list, and its Hessian is the Jacobian of the gradient.
template <class Real>
class RecordedHamiltonian final : public DifferentiableHamiltonian<Real> {
 public:
  explicit RecordedHamiltonian(const DynamicalSystem& system)
      : value_(system.hamiltonian), slope_(gradient(system.hamiltonian)) {}

  Eigen::Index dimension() const override { return static_cast<Eigen::Index>(value_.inputs()); }

  /// Sets the time of the system's clock for the evaluations that follow.
  void set_time(const Real& time) { time_ = time; }

  Real value(const Vector<Real>& z) override {
    evaluate(value_, z);
    return value_.value(0);
  }

  const HamiltonianDerivatives<Real>& derivatives(const Vector<Real>& z) override {
    evaluate(slope_, z);
    derivatives_.gradient = slope_.values();
    derivatives_.hessian = slope_.jacobian();
    return derivatives_;
  }

 private:
  void evaluate(DifferentiableFunction<Real>& function, const Vector<Real>& z) const {
    if (time_) {
      function.evaluate(numbers(z), *time_);
    } else {
      function.evaluate(numbers(z));
    }
  }
  static std::span<const Real> numbers(const Vector<Real>& z) {
    return {z.data(), static_cast<std::size_t>(z.size())};
  }

  DifferentiableFunction<Real> value_;
  DifferentiableFunction<Real> slope_;
  std::optional<Real> time_;
  HamiltonianDerivatives<Real> derivatives_;
};

}  // namespace hamjet
