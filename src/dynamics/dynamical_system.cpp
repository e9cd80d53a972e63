#include "hamjet/dynamics/dynamical_system.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// The rows of M^-1 if all q' are linear functions of p alone with constant coefficients.
std::optional<std::vector<Extended>> inverse_mass(const OperationList& field) {
  const std::size_t n = field.variables() / 2;
  std::vector<Extended> matrix(n * n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const Operation& o = field.operations()[field.outputs()[i]];
    if (o.code == OperationCode::input && o.u >= n && o.u < 2 * n) {
      matrix[i * n + o.u - n] = 1;
      continue;
    }
    if (o.code != OperationCode::linear || o.constant != 0) return std::nullopt;
    for (const LinearTerm& term : o.terms) {
      const Operation& from = field.operations()[term.value];
      if (from.code != OperationCode::input || from.u < n || from.u >= 2 * n) return std::nullopt;
      matrix[i * n + from.u - n] = term.coefficient;
    }
  }
  return matrix;
}

std::optional<SecondOrderForm> second_order_form(const OperationList& field,
                                                 std::size_t parameters) {
  if (parameters > 0) return std::nullopt;
  const std::size_t n = field.variables() / 2;
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

/// The vector field of z' = J grad H, and of parameters that stay.
OperationList hamiltonian_field(const OperationList& hamiltonian, std::size_t parameters) {
  const std::size_t n = (hamiltonian.variables() - parameters) / 2;
  const OperationList grad = gradient(hamiltonian);
  return record(
      hamiltonian.inputs(),
      [&](std::span<const Expression> z) {
        const std::vector<Expression> values = replay(grad, z);
        std::vector<Expression> field;
        for (std::size_t i = 0; i < n; ++i) field.push_back(values[grad.outputs()[n + i]]);
        for (std::size_t i = 0; i < n; ++i) field.push_back(-values[grad.outputs()[i]]);
        field.resize(2 * n + parameters, Expression(0));
        return field;
      },
      hamiltonian.has_time());
}

/// The shortest wave of the fields in a list.
int waves_of(const OperationList& list) {
  int waves = 0;
  for (const Operation& o : list.operations()) {
    for (const FieldPart& part : o.parts) waves = std::max(waves, part.field->waves_on_a_circle());
  }
  return waves;
}

/// Indices of the inputs (or outputs) q_i and p_i of the kept degrees of freedom, and of all
/// parameters.
std::vector<std::size_t> kept_indices(std::span<const std::size_t> kept,
                                      const DynamicalSystem& system) {
  const std::size_t n = system.degrees_of_freedom;
  std::vector<std::size_t> result(kept.begin(), kept.end());
  for (const std::size_t i : kept) result.push_back(n + i);
  for (std::size_t k = 2 * n; k < system.dimension(); ++k) result.push_back(k);
  return result;
}

}  // namespace

DynamicalSystem make_system(std::string name, OperationList hamiltonian,
                            std::optional<OperationList> vector_field, std::size_t parameters) {
  const std::size_t dimension = hamiltonian.variables();
  if (dimension <= parameters || (dimension - parameters) % 2 != 0 ||
      hamiltonian.outputs().size() != 1) {
    throw Error(ErrorKind::usage,
                "system '" + name +
                    "': a Hamiltonian has 2n inputs (q, p), perhaps parameters and the time, and "
                    "one output");
  }
  OperationList field =
      vector_field ? std::move(*vector_field) : hamiltonian_field(hamiltonian, parameters);
  if (field.variables() != dimension || field.outputs().size() != dimension) {
    throw Error(ErrorKind::usage, "system '" + name +
                                      "': a vector field has the inputs of the Hamiltonian, and "
                                      "an output for each of them but the time");
  }
  if (!hamiltonian.depends_on_time() && !field.depends_on_time()) {
    hamiltonian = at_time(hamiltonian, 0);
    field = at_time(field, 0);
  } else {
    hamiltonian = with_time(hamiltonian);
    field = with_time(field);
  }
  DynamicalSystem system;
  system.name = std::move(name);
  system.degrees_of_freedom = (dimension - parameters) / 2;
  system.parameters = parameters;
  system.second_order = second_order_form(field, parameters);
  system.waves_on_a_circle = std::max(waves_of(hamiltonian), waves_of(field));
  system.hamiltonian = std::move(hamiltonian);
  system.vector_field = std::move(field);
  return system;
}

DynamicalSystem with_force(const DynamicalSystem& system, const ForceFunction& force) {
  const std::size_t n = system.degrees_of_freedom;
  const OperationList gravity = with_time(system.vector_field);
  OperationList field = record(
      gravity.inputs(),
      [&](std::span<const Expression> z) {
        std::vector<Expression> rates = recorded_outputs(gravity, z);
        const std::vector<Expression> f = force(z);
        for (std::size_t i = 0; i < n; ++i) rates[n + i] += f.at(i);
        return rates;
      },
      true);
  DynamicalSystem result =
      make_system(system.name, system.hamiltonian, std::move(field), system.parameters);
  result.waves_on_a_circle = system.waves_on_a_circle;
  result.break_times = system.break_times;
  result.is_hamiltonian = false;
  return result;
}

std::optional<OperationList> conserved_list(const DynamicalSystem& system) {
  switch (system.conserved_quantity()) {
    case ConservedQuantity::none:
      return std::nullopt;
    case ConservedQuantity::energy:
      return system.hamiltonian;
    case ConservedQuantity::jacobi_integral:
      break;
  }
  const std::size_t n = system.degrees_of_freedom;
  return record(
      2 * n + 1,
      [&](std::span<const Expression> z) {
        Expression momentum(0);
        for (const auto& [i, j] : system.uniform_rotation->planes) {
          momentum += z[i] * z[n + j] - z[j] * z[n + i];
        }
        const Expression energy = recorded_outputs(system.hamiltonian, z)[0];
        return std::vector<Expression>{energy - system.uniform_rotation->rate * momentum};
      },
      true);
}

std::vector<std::size_t> needed_degrees_of_freedom(const DynamicalSystem& system,
                                                   std::span<const double> nominal,
                                                   std::span<const std::size_t> variables) {
  const std::size_t n = system.degrees_of_freedom;
  std::vector<bool> needed(n, false);
  for (const std::size_t v : variables) {
    if (v < 2 * n) needed[v % n] = true;
  }
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
    const OperationList field = restrict_list(system.vector_field, kept_indices(kept, system), all);
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
  const std::vector<std::size_t> indices = kept_indices(kept, system);
  const std::vector<std::size_t> scalar{0};
  DynamicalSystem restricted =
      make_system(system.name, restrict_list(system.hamiltonian, indices, scalar),
                  restrict_list(system.vector_field, indices, indices), system.parameters);
  restricted.is_hamiltonian = system.is_hamiltonian;
  restricted.waves_on_a_circle = system.waves_on_a_circle;
  restricted.break_times = system.break_times;
  if (system.uniform_rotation) {
    UniformRotation rotation{{}, system.uniform_rotation->rate};
    for (const auto& [i, j] : system.uniform_rotation->planes) {
      const auto first = std::find(kept.begin(), kept.end(), i);
      const auto second = std::find(kept.begin(), kept.end(), j);
      // Positions that are not kept are zero, so that a rotation of one of a plane alone is none.
      if ((first == kept.end()) != (second == kept.end())) rotation.rate = 0;
      if (first == kept.end() || second == kept.end()) continue;
      rotation.planes.push_back({static_cast<std::size_t>(first - kept.begin()),
                                 static_cast<std::size_t>(second - kept.begin())});
    }
    const bool is_kept = rotation.rate == system.uniform_rotation->rate;
    if (is_kept && !restricted.is_autonomous()) restricted.uniform_rotation = std::move(rotation);
  }
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
