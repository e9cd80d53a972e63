#pragma once

#include <span>
#include <vector>

#include "hamjet/algebra/truncated_power_series.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// Runs a list on full series; returns its outputs as series in the space of the inputs.
template <class Real>
std::vector<Series<Real>> evaluate_on_series(const OperationList& list,
                                             const std::vector<Series<Real>>& inputs);

/// The relative Hamiltonian H^h about a point z of the nominal: the Taylor terms of degree 2..N+1
/// of H in the deviation from z. Its canonical equations are those of the relative motion, and a
/// flow's jet of order N solves them. Returns a series in 2n variables of order `flow_order` + 1.
/// Source: Guibout and Bloch, eq. l_hamilton_n (the coefficients here include the factorials).
template <class Real>
Series<Real> relative_hamiltonian(const DynamicalSystem& system, std::span<const Real> nominal,
                                  int flow_order);

/// The canonical vector field J grad H^h of a relative Hamiltonian, up to degree N, in the space of
/// H^h.
template <class Real>
std::vector<Series<Real>> canonical_vector_field(const Series<Real>& hamiltonian);

}  // namespace hamjet
