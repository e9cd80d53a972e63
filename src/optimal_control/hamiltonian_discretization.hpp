#pragma once

#include "advance_map.hpp"
#include "discretization.hpp"
#include "reduced_hamiltonian.hpp"

namespace hamjet {

/// The approach "optimise, then discretise": the canonical equations of the reduced Hamiltonian are
/// solved by the symplectic scheme of the discrete modified Hamilton's principle,
///
///   z_(k+1) - z_k = tau J grad Hbar(z^d) ,   z^d = (x^d, p^d) .
///
/// Source: Guibout and Bloch, eq. tmp4 and the Stormer form of the Heisenberg problem. By the
/// paper's diagram the result equals that of the discrete maximum principle.
class HamiltonianDiscretization : public AdvanceMap {
 public:
  HamiltonianDiscretization(const OptimalControlProblem& problem, Discretization discretization,
                            double step);

  AdvancedPoint advance(const Eigen::VectorXd& point,
                        const Eigen::VectorXd& control_guess) override;

 private:
  ReducedHamiltonian hamiltonian_;
  double step_;
  Eigen::VectorXd weights_;  ///< weight of each component of z_(k+1) in z^d
};

}  // namespace hamjet
