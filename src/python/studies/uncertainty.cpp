#include <pybind11/stl.h>

#include <cstdint>
#include <span>
#include <vector>

#include "../../app/processors.hpp"
#include "../../report/uncertainty/collision_table.hpp"
#include "../../report/uncertainty/moments_table.hpp"
#include "../../report/uncertainty/uncertainty_report.hpp"
#include "../arrays.hpp"
#include "studied.hpp"

// Moments of uncertain states, and of any polynomials of Gaussian variables.

namespace hamjet::python {
namespace {

Studied<UncertaintyResult> study_moments(const GivenScene& given, const py::object& progress) {
  const auto study = [](const Scene& scene, const ProgressCallback& report) {
    return study_uncertainty(scene, report, cli::usable_processors());
  };
  return studied(given, progress, "uncertainty", study, &io::uncertainty_report);
}

/// The study of [uncertainty.collision] alone, as the columns of its tables.
py::dict collision_of(const GivenScene& given, const py::object& progress) {
  return columns_of_tables(interruptibly(
      progress,
      [scene = scene_of(given, "uncertainty"), file = given.file](const ProgressCallback& report) {
        return io::naming_file(file, [&] {
          return io::collision_tables(study_collision(scene, cli::usable_processors(), report));
        });
      }));
}

/// States of samples that were flown, (samples, 6), copies of the study's.
py::array_t<double> flown_states(const Studied<UncertaintyResult>& studied, std::size_t time,
                                 std::size_t state) {
  const UncertaintyResult& result = *studied.result();
  if (time >= result.points.size() || state >= result.points[time].states.size()) {
    throw Error(ErrorKind::usage, "flown_states: no such time or state");
  }
  const Matrix<double>& states = result.points[time].states[state].flown_states;
  // Columns of six numbers are rows of an array that runs the other way.
  std::vector<double> numbers(states.data(), states.data() + states.size());
  return python::array_of(std::move(numbers), {states.cols(), states.rows()});
}

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Exponents = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>;

py::dict moments_of_polynomials(const Numbers& coefficients, const Exponents& exponents,
                                const Numbers& covariance) {
  const auto size = covariance.shape(0);
  std::vector<double> entries(covariance.data(), covariance.data() + covariance.size());
  const Covariance checked(
      Eigen::Map<const Matrix<double>>(entries.data(), size, covariance.shape(1)));
  const auto map =
      polynomials_of_rows({coefficients.data(), static_cast<std::size_t>(coefficients.size())},
                          {exponents.data(), static_cast<std::size_t>(exponents.size())},
                          static_cast<std::size_t>(exponents.shape(1)));
  std::vector<io::TableView> tables;
  {
    const py::gil_scoped_release released;
    tables = {
        io::moments_of_polynomials(Cumulants::of_polynomials(in_standard_normals(map, checked)))};
  }
  return columns_of_tables(tables)["polynomials"];
}

}  // namespace

void bind_uncertainty(py::module_& module) {
  bind_study<UncertaintyResult>(module, "UncertaintyStudy", &io::uncertainty_tables)
      .def("flown_states", &flown_states);
  module.def("study_uncertainty", &study_moments, py::arg("scene"), py::arg("progress"));
  module.def("study_collision", &collision_of, py::arg("scene"), py::arg("progress"));
  module.def("polynomial_moments", &moments_of_polynomials, py::arg("coefficients"),
             py::arg("exponents"), py::arg("covariance"));
}

}  // namespace hamjet::python
