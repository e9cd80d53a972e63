#include "hamilton_jacobi.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "../algebra/instantiated_real.hpp"
#include "hamjet/algebra/calculus.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/detail/algebra/monomial_values.hpp"
#include "hamjet/dynamics/relative_hamiltonian.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

template <class T>
void require_fitting(const DynamicalSystem& system, std::span<const T> nominal,
                     const PartialInversion<T>& inversion) {
  const std::size_t n = system.degrees_of_freedom;
  if (nominal.size() != 2 * n || inversion.kind.degrees_of_freedom() != n ||
      inversion.remaining_final.size() != n || inversion.remaining_initial.size() != n) {
    throw Error(ErrorKind::usage,
                "Hamilton-Jacobi equation: system, nominal and partial inversion differ in the "
                "number of degrees of freedom");
  }
}

/// The final deviations z(w) in the order (q, p).
template <class T>
std::vector<Series<T>> final_deviations(const PartialInversion<T>& inversion) {
  const SpacePointer& space = inversion.remaining_final[0].space_pointer();
  const std::size_t n = inversion.kind.degrees_of_freedom();
  std::vector<Series<T>> z(2 * n, Series<T>(space));
  for (std::size_t i = 0; i < n; ++i) {
    z[inversion.kind.final_variable(i)] = Series<T>::variable(space, i);
    z[inversion.kind.final_variable(i, false)] = inversion.remaining_final[i];
  }
  return z;
}

/// The relative vector field X(z(w)): the field at nominal + z(w) minus the field at the nominal.
template <class T>
std::vector<Series<T>> relative_vector_field(const DynamicalSystem& system,
                                             std::span<const T> nominal,
                                             const PartialInversion<T>& inversion) {
  std::vector<Series<T>> z = final_deviations(inversion);
  for (std::size_t i = 0; i < z.size(); ++i) z[i] += nominal[i];
  return without_constants(evaluate_on_series<T>(system.vector_field, z));
}

/// Returns start - sum over j of (d u / d w_f,j) X_f,j .
template <class T>
Series<T> minus_transport(Series<T> start, const Series<T>& u, const std::vector<Series<T>>& X,
                          const GeneratingFunctionKind& kind) {
  for (std::size_t j = 0; j < kind.degrees_of_freedom(); ++j) {
    start -= derivative(u, j) * X[kind.final_variable(j)];
  }
  return start;
}

/// The residual dS/dt|_w + H^h(z(w)) and the Hamiltonian H^h(z(w)).
template <class T>
struct Equation {
  Series<T> residual;
  Series<T> hamiltonian;
};

template <class T>
Equation<T> equation_of(const DynamicalSystem& system, std::span<const T> nominal,
                        const PartialInversion<T>& inversion) {
  Series<T> hamiltonian = hamiltonian_in_variables(system, nominal, inversion);
  Series<T> residual =
      generating_function(one_form(time_derivative(system, nominal, inversion))) + hamiltonian;
  return {std::move(residual), std::move(hamiltonian)};
}

template <class T>
double largest(std::span<const T> values) {
  double result = 0;
  for (const T& value : values) {
    const double size = std::abs(static_cast<double>(value));
    if (std::isnan(size)) return size;
    result = std::max(result, size);
  }
  return result;
}

}  // namespace

template <class T>
PartialInversion<T> time_derivative(const DynamicalSystem& system, std::span<const T> nominal,
                                    const PartialInversion<T>& inversion) {
  require_fitting(system, nominal, inversion);
  const std::vector<Series<T>> X = relative_vector_field(system, nominal, inversion);
  const GeneratingFunctionKind& kind = inversion.kind;
  PartialInversion<T> result;
  result.kind = kind;
  result.condition = inversion.condition;
  for (std::size_t i = 0; i < kind.degrees_of_freedom(); ++i) {
    result.remaining_final.push_back(
        minus_transport(X[kind.final_variable(i, false)], inversion.remaining_final[i], X, kind));
    result.remaining_initial.push_back(
        minus_transport(Series<T>(X[0].space_pointer()), inversion.remaining_initial[i], X, kind));
  }
  return result;
}

template <class T>
Series<T> hamiltonian_in_variables(const DynamicalSystem& system, std::span<const T> nominal,
                                   const PartialInversion<T>& inversion) {
  require_fitting(system, nominal, inversion);
  std::vector<Series<T>> z = final_deviations(inversion);
  const int order = z[0].order();
  const SpacePointer space = SeriesSpace::create(z.size(), order + 1);
  for (auto& component : z) component = in_space(component, space);
  const std::vector<Series<T>> hamiltonian{relative_hamiltonian(system, nominal, order)};
  return compose(hamiltonian, z)[0];
}

template <class T>
HamiltonJacobiTerms hamilton_jacobi_terms(const DynamicalSystem& system, std::span<const T> nominal,
                                          const PartialInversion<T>& inversion,
                                          std::span<const double> w) {
  const Equation<T> equation = equation_of(system, nominal, inversion);
  MonomialValues values(equation.residual.space_pointer());
  values.set_point(w);
  HamiltonJacobiTerms terms;
  const auto residual = convert_map<double>(std::vector<Series<T>>{equation.residual})[0];
  const auto hamiltonian = convert_map<double>(std::vector<Series<T>>{equation.hamiltonian})[0];
  for (int d = 2; d <= residual.order(); ++d) {
    terms.residual.push_back(values.slice(residual, d));
    terms.hamiltonian.push_back(values.slice(hamiltonian, d));
  }
  return terms;
}

template <class T>
std::vector<HamiltonJacobiResidual> hamilton_jacobi_by_degree(
    const DynamicalSystem& system, std::span<const T> nominal,
    const PartialInversion<T>& inversion) {
  const auto [residual, hamiltonian] = equation_of(system, nominal, inversion);
  std::vector<HamiltonJacobiResidual> result;
  for (int d = 2; d <= residual.order(); ++d) {
    const double value = largest<T>(residual.slice(d));
    const double scale = largest<T>(hamiltonian.slice(d));
    result.push_back({d, value, scale > 0 ? value / scale : value});
  }
  return result;
}

template PartialInversion<InstantiatedReal> time_derivative(
    const DynamicalSystem&, std::span<const InstantiatedReal>,
    const PartialInversion<InstantiatedReal>&);
template Series<InstantiatedReal> hamiltonian_in_variables(
    const DynamicalSystem&, std::span<const InstantiatedReal>,
    const PartialInversion<InstantiatedReal>&);
template HamiltonJacobiTerms hamilton_jacobi_terms(const DynamicalSystem&,
                                                   std::span<const InstantiatedReal>,
                                                   const PartialInversion<InstantiatedReal>&,
                                                   std::span<const double>);
template std::vector<HamiltonJacobiResidual> hamilton_jacobi_by_degree(
    const DynamicalSystem&, std::span<const InstantiatedReal>,
    const PartialInversion<InstantiatedReal>&);

}  // namespace hamjet
