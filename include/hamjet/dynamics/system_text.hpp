#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hamjet/dynamics/dynamical_system.hpp"
#include "hamjet/dynamics/expression_text.hpp"

namespace hamjet {

/// A system as its user writes it: coordinates, momenta and a Hamiltonian, or states and their
/// vector field.
///
/// A vector field x' = f(x) is computed as the Hamiltonian lambda_1 f_1(x) + ... of the states and
/// of as many adjoint variables lambda_i, which stay 0 where they begin with 0. Its positions are
/// the states, and a jet in these variables is that of the vector field.
struct SystemText {
  std::vector<std::string> coordinates = {};
  std::vector<std::string> momenta = {};  ///< the momenta of the coordinates, in their order
  std::vector<std::string> states = {};   ///< empty for a Hamiltonian
  std::vector<NamedText> parameters = {};
  /// Names of those parameters with which states end; the others are constants, or depend on these.
  std::vector<std::string> state_parameters = {};
  std::vector<NamedText> definitions = {};
  std::string hamiltonian = {};
  std::vector<NamedText> vector_field = {};  ///< the derivative of each state by the time

  bool is_hamiltonian() const noexcept { return states.empty(); }
  std::size_t degrees_of_freedom() const noexcept {
    return is_hamiltonian() ? coordinates.size() : states.size();
  }
  /// The names of (q, p) and of the parameters of the state; the adjoint variable of a state x is
  /// lambda_x.
  std::vector<std::string> variables() const;
  bool operator==(const SystemText&) const = default;
};

/// The most degrees of freedom of a system that is given as text.
inline constexpr std::size_t most_degrees_of_freedom_of_text = 8;

/// The values of the parameters of the state, rounded. Throws as make_system.
std::vector<double> state_parameter_values(const SystemText& text);

/// The system. A rotation of two coordinates, and of their momenta, that leaves it unchanged is
/// found and declared. Throws ExpressionTextError for whatever is wrong in the text; parts are
/// named as the members of SystemText: "coordinates", "hamiltonian", "vector_field.x",
/// "parameters.mu".
DynamicalSystem make_system(std::string name, const SystemText& text);

/// Throws ExpressionTextError unless the Hamiltonian (or the vector field) and the equations of
/// motion have finite values at a state (q, p, c) and time.
void require_finite_at(const SystemText& text, const DynamicalSystem& system,
                       std::span<const double> state, double time = 0);

/// What is almost surely a mistake though it can be computed, as pairs of part and text: names that
/// nothing uses, momenta without which a coordinate cannot move.
std::vector<std::pair<std::string, std::string>> likely_mistakes(const SystemText& text,
                                                                 const DynamicalSystem& system);

/// A system's Hamiltonian as text in these variables (q, p), from which the same list is made.
/// Throws Error(usage) if it has fields or functions of the time.
SystemText system_text(const DynamicalSystem& system, std::vector<std::string> coordinates,
                       std::vector<std::string> momenta);

}  // namespace hamjet
