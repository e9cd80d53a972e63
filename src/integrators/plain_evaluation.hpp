#pragma once

#include <cstddef>
#include <vector>

#include "hamjet/dynamics/slice_evaluator.hpp"
#include "real_number.hpp"

namespace hamjet {

/// A list run on plain numbers: series of order 0. Values and exact first derivatives.
template <class Real>
class PlainEvaluation {
 public:
  explicit PlainEvaluation(const OperationList& list)
      : inputs_(list.inputs()),
        outputs_(list.outputs().size()),
        evaluator_(list, SeriesSpace::create(list.inputs(), 0), 0) {}

  void evaluate(const std::vector<Real>& inputs) {
    for (std::size_t i = 0; i < inputs_; ++i) *evaluator_.input(i) = inputs[i];
    evaluator_.evaluate_constant_terms();
  }
  const Real& value(std::size_t output) const { return *evaluator_.output(output); }
  const Real& derivative(std::size_t output, std::size_t input) const {
    return evaluator_.output_gradient(output, input);
  }
  bool is_finite() const {
    bool result = true;
    for (std::size_t i = 0; i < outputs_; ++i) result &= hamjet::is_finite(value(i));
    return result;
  }

 private:
  std::size_t inputs_;
  std::size_t outputs_;
  SliceEvaluator<Real, Real> evaluator_;
};

/// The size of the terms that a Hamiltonian's value is made of, for judging round-off: the energy
/// itself and each variable times its derivative. `hamiltonian` was evaluated at z.
template <class Real>
Real energy_scale(const PlainEvaluation<Real>& hamiltonian, const std::vector<Real>& z) {
  Real scale = magnitude(hamiltonian.value(0));
  for (std::size_t i = 0; i < z.size(); ++i) {
    scale += magnitude(Real(hamiltonian.derivative(0, i) * z[i]));
  }
  return scale;
}

}  // namespace hamjet
