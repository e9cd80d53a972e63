#include <fmt/format.h>

#include <string>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "hamjet/dynamics/mean_elements.hpp"
#include "hamjet/error.hpp"

// Orbits as states and as elements, row by row.

namespace hamjet::python {
namespace {

using Rows = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Row = std::array<double, 6>;

CartesianState state_of(const Row& row) {
  return {{row[0], row[1], row[2]}, {row[3], row[4], row[5]}};
}

Row row_of(const CartesianState& state) {
  Row row;
  for (std::size_t i = 0; i < 3; ++i) {
    row[i] = convert<double>(state.position_km[i]);
    row[3 + i] = convert<double>(state.velocity_km_s[i]);
  }
  return row;
}

/// Each of the rows, whose shape is (N, 6), by `convert_row`; errors say which row it was.
template <class ConvertRow>
py::array_t<double> converted(const Rows& rows, const ConvertRow& convert_row) {
  const py::ssize_t count = rows.shape(0);
  std::vector<double> numbers;
  numbers.reserve(static_cast<std::size_t>(6 * count));
  for (py::ssize_t k = 0; k < count; ++k) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    Row row;
    for (py::ssize_t i = 0; i < 6; ++i) row[static_cast<std::size_t>(i)] = rows.at(k, i);
    try {
      const Row result = convert_row(row);
      numbers.insert(numbers.end(), result.begin(), result.end());
    } catch (const Error& error) {
      throw Error(error.kind(), fmt::format("row {}: {}", k, error.what()));
    }
  }
  return array_of(std::move(numbers), {count, 6});
}

}  // namespace

void bind_elements(py::module_& module) {
  module.def("elements_of_states", [](const Rows& states, double mu) {
    return converted(states, [mu](const Row& row) {
      const OsculatingElements e = elements_from_state(state_of(row), mu);
      return Row{convert<double>(e.semi_major_axis_km),      convert<double>(e.eccentricity),
                 convert<double>(e.inclination_deg),         convert<double>(e.ascending_node_deg),
                 convert<double>(e.argument_of_perigee_deg), convert<double>(e.true_anomaly_deg)};
    });
  });
  module.def("states_of_elements", [](const Rows& elements, double mu) {
    return converted(elements, [mu](const Row& row) {
      return row_of(state_from_elements({row[0], row[1], row[2], row[3], row[4], row[5]}, mu));
    });
  });
  module.def("mean_states", [](const Rows& states, double mu, double radius, double J2) {
    return converted(states, [&](const Row& row) {
      return row_of(mean_of_osculating(state_of(row), {mu, radius, J2}));
    });
  });
  module.def("osculating_states", [](const Rows& states, double mu, double radius, double J2) {
    return converted(states, [&](const Row& row) {
      return row_of(osculating_of_mean(state_of(row), {mu, radius, J2}));
    });
  });
}

}  // namespace hamjet::python
