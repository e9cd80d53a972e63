#include <pybind11/stl.h>

#include <cstdint>
#include <span>
#include <vector>

#include "../../app/processors.hpp"
#include "../../formats/relative_frame_text.hpp"
#include "../../report/uncertainty/collision_arrays.hpp"
#include "../../report/uncertainty/uncertainty_arrays.hpp"
#include "../../report/uncertainty/uncertainty_report.hpp"
#include "../../report/uncertainty/uncertainty_view.hpp"
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

py::object array_of_numbers(io::NumberArray& array) {
  if (array.shape.empty()) return py::float_(array.numbers[0]);
  std::vector<py::ssize_t> shape;
  for (const std::size_t length : array.shape) shape.push_back(size_of(length));
  return python::array_of(std::move(array.numbers), std::move(shape));
}

/// The study of [uncertainty.collision] alone, as arrays.
py::dict collision_of(const GivenScene& given, const py::object& progress) {
  auto arrays = interruptibly(progress, [scene = scene_of(given, "uncertainty"),
                                         file = given.file](const ProgressCallback& report) {
    return cli::study_of(file, [&] {
      return io::collision_arrays(study_collision(scene, cli::usable_processors(), report));
    });
  });
  py::dict result;
  for (io::NumberArray& array : arrays) result[py::str(array.name)] = array_of_numbers(array);
  return result;
}

py::dict study_arrays(const UncertaintyResult& result) {
  py::dict arrays;
  for (io::NumberArray& array : io::uncertainty_arrays(result)) {
    arrays[py::str(array.name)] = array_of_numbers(array);
  }
  std::vector<std::string> states;
  for (const UncertainState& state : result.points.front().states) states.push_back(state.name);
  std::vector<std::string> components;
  for (const io::StateComponent& component : io::state_components(result)) {
    components.push_back(component.name);
  }
  const auto& names = result.points.back().charted_names;
  arrays["frame"] = io::frame_text(result.scene.uncertainty->frame);
  arrays["coordinates"] = std::string(name_of(result.coordinates));
  arrays["states"] = py::tuple(py::cast(states));
  arrays["components"] = py::tuple(py::cast(components));
  arrays["charted_components"] = py::tuple(py::cast(
      names[0].empty() ? std::vector<std::string>() : std::vector(names.begin(), names.end())));
  py::dict negentropy_in;
  for (const MomentsInCoordinates& compared : result.in_coordinates) {
    std::vector<double> numbers;
    for (const std::vector<Cumulants>& by_order : compared.by_order) {
      for (const Cumulants& moments : by_order) numbers.push_back(moments.negentropy());
    }
    if (!compared.refusal.empty()) continue;
    negentropy_in[py::str(std::string(name_of(compared.coordinates)))] =
        python::array_of(std::move(numbers),
                         {size_of(compared.states.size()), size_of(compared.by_order[0].size())});
  }
  arrays["negentropy_in"] = negentropy_in;
  arrays["samples"] = result.scene.uncertainty->samples;
  arrays["verdict"] = io::uncertainty_verdict(result);
  arrays["notes"] = py::tuple(py::cast(io::uncertainty_notes(result)));
  return arrays;
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
  std::vector<io::NumberArray> arrays;
  {
    const py::gil_scoped_release released;
    arrays = io::moments_arrays(Cumulants::of_polynomials(in_standard_normals(map, checked)));
  }
  py::dict result;
  for (io::NumberArray& array : arrays) {
    result[py::str(array.name)] = array_of_numbers(array);
  }
  return result;
}

}  // namespace

void bind_uncertainty(py::module_& module) {
  bind_study<UncertaintyResult>(module, "UncertaintyStudy", &io::moments_csv, &study_arrays)
      .def("flown_states", &flown_states);
  module.def("study_uncertainty", &study_moments, py::arg("scene"), py::arg("progress"));
  module.def("study_collision", &collision_of, py::arg("scene"), py::arg("progress"));
  module.def("polynomial_moments", &moments_of_polynomials, py::arg("coefficients"),
             py::arg("exponents"), py::arg("covariance"));
}

}  // namespace hamjet::python
