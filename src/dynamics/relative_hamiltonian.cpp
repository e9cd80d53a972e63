#include "hamjet/dynamics/relative_hamiltonian.hpp"

#include "../algebra/instantiated_real.hpp"
#include "hamjet/algebra/calculus.hpp"
#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/dynamics/slice_evaluator.hpp"

namespace hamjet {

template <class Real>
std::vector<Series<Real>> evaluate_on_series(const OperationList& list,
                                             const std::vector<Series<Real>>& inputs) {
  if (inputs.size() != list.inputs() || inputs.empty()) {
    throw Error(ErrorKind::usage, "operation list: wrong number of inputs");
  }
  const SpacePointer& space = inputs[0].space_pointer();
  SliceEvaluator<Real, Real> evaluator(list, space, space->order());
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    require_same_space(*space, inputs[i].space());
    std::copy_n(inputs[i].coefficients().data(), space->size(), evaluator.input(i));
  }
  evaluator.evaluate_all();
  std::vector<Series<Real>> outputs;
  for (std::size_t i = 0; i < list.outputs().size(); ++i) {
    const Real* values = evaluator.output(i);
    outputs.emplace_back(space, std::vector<Real>(values, values + space->size()));
  }
  return outputs;
}

template <class Real>
Series<Real> relative_hamiltonian(const DynamicalSystem& system, std::span<const Real> nominal,
                                  int flow_order) {
  if (nominal.size() != system.dimension()) {
    throw Error(ErrorKind::usage, "relative Hamiltonian: the nominal has the wrong size");
  }
  const SpacePointer space = SeriesSpace::create(system.dimension(), flow_order + 1);
  std::vector<Series<Real>> inputs;
  for (std::size_t i = 0; i < nominal.size(); ++i) {
    inputs.push_back(Series<Real>::variable(space, i, nominal[i]));
  }
  Series<Real> result = evaluate_on_series<Real>(system.hamiltonian, inputs)[0];
  for (std::size_t k = 0; k < space->first(2); ++k) result[k] = Real(0);
  return result;
}

template <class Real>
std::vector<Series<Real>> canonical_vector_field(const Series<Real>& hamiltonian) {
  const std::size_t n = hamiltonian.space().variables() / 2;
  std::vector<Series<Real>> field;
  for (std::size_t i = 0; i < n; ++i) field.push_back(derivative(hamiltonian, n + i));
  for (std::size_t i = 0; i < n; ++i) field.push_back(-derivative(hamiltonian, i));
  return field;
}

template std::vector<Series<InstantiatedReal>> evaluate_on_series(
    const OperationList&, const std::vector<Series<InstantiatedReal>>&);
template Series<InstantiatedReal> relative_hamiltonian(const DynamicalSystem&,
                                                       std::span<const InstantiatedReal>, int);
template std::vector<Series<InstantiatedReal>> canonical_vector_field(
    const Series<InstantiatedReal>&);

}  // namespace hamjet
