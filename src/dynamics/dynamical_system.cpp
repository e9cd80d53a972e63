#include "hamjet/dynamics/dynamical_system.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// The rows of M^-1 if all q' are linear functions of p alone with constant coefficients.
std::optional<std::vector<Extended>> inverse_mass(const OperationList& field) {
  const std::size_t n = field.inputs() / 2;
  std::vector<Extended> matrix(n * n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const Operation& o = field.operations()[field.outputs()[i]];
    if (o.code == OperationCode::input && o.u >= n) {
      matrix[i * n + o.u - n] = 1;
      continue;
    }
    if (o.code != OperationCode::linear || o.constant != 0) return std::nullopt;
    for (const LinearTerm& term : o.terms) {
      const Operation& from = field.operations()[term.value];
      if (from.code != OperationCode::input || from.u < n) return std::nullopt;
      matrix[i * n + from.u - n] = term.coefficient;
    }
  }
  return matrix;
}

std::optional<SecondOrderForm> second_order_form(const OperationList& field) {
  const std::size_t n = field.inputs() / 2;
  const auto matrix = inverse_mass(field);
  if (!matrix) return std::nullopt;
  for (std::size_t i = n; i < 2 * n; ++i) {
    if (field.dependencies(field.outputs()[i]) >> n != 0) return std::nullopt;
  }
  std::vector<std::size_t> positions(n);
  std::iota(positions.begin(), positions.end(), std::size_t{0});
  std::vector<std::size_t> forces(n);
  std::iota(forces.begin(), forces.end(), n);
  return SecondOrderForm{*matrix, restrict_list(field, positions, forces)};
}

/// The vector field of z' = J grad H.
OperationList hamiltonian_field(const OperationList& hamiltonian) {
  const std::size_t n = hamiltonian.inputs() / 2;
  const OperationList grad = gradient(hamiltonian);
  return record(2 * n, [&](std::span<const Expression> z) {
    const std::vector<Expression> values = replay(grad, z);
    std::vector<Expression> field;
    for (std::size_t i = 0; i < n; ++i) field.push_back(values[grad.outputs()[n + i]]);
    for (std::size_t i = 0; i < n; ++i) field.push_back(-values[grad.outputs()[i]]);
    return field;
  });
}

/// Indices of the inputs (or outputs) q_i and p_i of the kept degrees of freedom.
std::vector<std::size_t> phase_space_indices(std::span<const std::size_t> kept, std::size_t n) {
  std::vector<std::size_t> result(kept.begin(), kept.end());
  for (const std::size_t i : kept) result.push_back(n + i);
  return result;
}

}  // namespace

DynamicalSystem make_system(std::string name, OperationList hamiltonian,
                            std::optional<OperationList> vector_field) {
  const std::size_t dimension = hamiltonian.inputs();
  if (dimension == 0 || dimension % 2 != 0 || hamiltonian.outputs().size() != 1) {
    throw Error(ErrorKind::usage,
                "system '" + name + "': a Hamiltonian has 2n inputs (q, p) and one output");
  }
  OperationList field = vector_field ? std::move(*vector_field) : hamiltonian_field(hamiltonian);
  if (field.inputs() != dimension || field.outputs().size() != dimension) {
    throw Error(ErrorKind::usage,
                "system '" + name + "': a vector field has 2n inputs and 2n outputs");
  }
  DynamicalSystem system;
  system.name = std::move(name);
  system.degrees_of_freedom = dimension / 2;
  system.second_order = second_order_form(field);
  system.hamiltonian = std::move(hamiltonian);
  system.vector_field = std::move(field);
  return system;
}

std::vector<std::size_t> needed_degrees_of_freedom(const DynamicalSystem& system,
                                                   std::span<const double> nominal,
                                                   std::span<const std::size_t> variables) {
  const std::size_t n = system.degrees_of_freedom;
  std::vector<bool> needed(n, false);
  for (const std::size_t v : variables) needed[v % n] = true;
  for (std::size_t i = 0; i < 2 * n; ++i) {
    if (nominal[i] != 0) needed[i % n] = true;
  }
  // If the subspace is not invariant (derivatives of the other variables do not vanish identically
  // on it), the driven degrees of freedom join it, until nothing more is driven.
  while (true) {
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < n; ++i) {
      if (needed[i]) kept.push_back(i);
    }
    std::vector<std::size_t> all(2 * n);
    std::iota(all.begin(), all.end(), std::size_t{0});
    const OperationList field =
        restrict_list(system.vector_field, phase_space_indices(kept, n), all);
    bool grown = false;
    for (std::size_t i = 0; i < 2 * n; ++i) {
      if (!needed[i % n] && !output_vanishes(field, i)) {
        needed[i % n] = true;
        grown = true;
      }
    }
    if (!grown) return kept;
  }
}

DynamicalSystem restrict_system(const DynamicalSystem& system, std::span<const std::size_t> kept) {
  const std::size_t n = system.degrees_of_freedom;
  if (kept.size() == n) return system;
  const std::vector<std::size_t> indices = phase_space_indices(kept, n);
  const std::vector<std::size_t> scalar{0};
  DynamicalSystem restricted =
      make_system(system.name, restrict_list(system.hamiltonian, indices, scalar),
                  restrict_list(system.vector_field, indices, indices));
  restricted.waves_on_a_circle = system.waves_on_a_circle;
  // A rotation of the system is one of the subsystem if all coordinates that it turns are kept.
  for (const auto& [i, j] : system.rotated_planes) {
    const auto place = [&](std::size_t index) {
      return static_cast<std::size_t>(std::find(indices.begin(), indices.end(), index) -
                                      indices.begin());
    };
    if (place(i) == indices.size() || place(j) == indices.size()) {
      restricted.rotated_planes.clear();
      break;
    }
    restricted.rotated_planes.push_back({place(i), place(j)});
  }
  return restricted;
}

}  // namespace hamjet
