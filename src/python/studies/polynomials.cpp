#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "../../app/jet_conversion.hpp"
#include "../../store/text_file.hpp"
#include "../../studies/arcs.hpp"
#include "../../text/scene_message.hpp"
#include "../../text/scene_refusal.hpp"
#include "../arrays.hpp"
#include "../bindings.hpp"
#include "../given_scene.hpp"
#include "../interruptible.hpp"
#include "../pickling.hpp"
#include "../refusal.hpp"
#include "../relative_rows.hpp"
#include "hamjet/formats/jet_file.hpp"
#include "hamjet/studies/validity.hpp"
#include "polynomials_study.hpp"

namespace hamjet::python {

PolynomialsStudy::PolynomialsStudy(Scene scene, std::string file)
    : scene_(std::move(scene)), file_(std::move(file)) {
  require_unsplit(*scene_, "hamjet.polynomials");
  evaluated_ = std::make_shared<const cli::EvaluatedScene>(cli::evaluated_scene(*scene_));
}

py::object PolynomialsStudy::evaluate_relative(const py::object& states, const std::string& frame,
                                               const std::optional<std::string>& to,
                                               const std::optional<std::string>& derivatives,
                                               std::optional<int> degree, bool is_strict) const {
  if (degree && (*degree < 1 || *degree > order())) {
    refuse(fmt::format("degree: got {}, must be 1 to the order, {}", *degree, order()));
  }
  return relative_states(evaluated_->chief, *evaluated_, states,
                         {{frame, to, derivatives, cli::Caller::module}, degree}, is_strict);
}

py::array_t<double> PolynomialsStudy::reach(double tolerance_m, int samples,
                                            const py::object& progress) const {
  if (!scene_) refuse("reach: deputies are flown in a scene, and these polynomials are stored");
  Scene measured = *scene_;
  measured.coordinates = evaluated_->coordinates;
  measured.validity = scene_->validity.value_or(ValiditySettings{});
  measured.validity->times = {scene_->duration};
  measured.validity->tolerance_m = tolerance_m;
  measured.validity->samples = samples;
  measured.validity->separation_m.reset();
  const ValidityResult result =
      interruptibly(progress, [measured, file = file_](const ProgressCallback& report) {
        return io::naming_file(file, [&] { return study_validity(measured, report); });
      });
  std::vector<double> found;
  for (const ValidityEntry& entry : result.points.back().entries) {
    found.push_back(entry.proved_m);
  }
  return array_of(std::move(found));
}

namespace {

/// The coordinates by name in place of the wanted ones, as `hamjet convert` has its options.
CoordinatesAtEnds named_coordinates(CoordinatesAtEnds wanted,
                                    const std::optional<std::string>& both,
                                    const std::optional<std::string>& end) {
  const auto named = [](const char* argument, const std::string& name) {
    const auto& names = jet_coordinates_names;
    const auto* const found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      refuse(fmt::format("{}: got {}, must be {}", argument, io::in_quotes(name),
                         fmt::join(names, ", ")));
    }
    return static_cast<JetCoordinates>(found - names.begin());
  };
  if (both) wanted = named("coordinates", *both);
  if (end) wanted.end = named("end_coordinates", *end);
  return wanted;
}

/// Of results of a run, or of a file; in other coordinates where they are named.
PolynomialsStudy load_polynomials(const std::filesystem::path& path,
                                  const std::optional<std::string>& run,
                                  const std::optional<std::string>& coordinates,
                                  const std::optional<std::string>& end_coordinates,
                                  const GivenScene* given) {
  std::optional<Scene> scene;
  if (given != nullptr) scene = given->flow_jet(io::SceneUnits::told);
  return interruptibly(py::none(), [=](const ProgressCallback&) {
    const auto wanted_of = [&](const io::StoredJet& one) {
      return named_coordinates(one.coordinates, coordinates, end_coordinates);
    };
    // What is converted is the jet in positions and momenta, as the command does.
    std::optional<io::StoredJet> stored = io::read_stored_polynomials(path, run);
    if (!stored || wanted_of(*stored) != stored->coordinates) {
      stored = io::read_jet_file(path, run);
    }
    if (!is_orbit(stored->model) || stored->variables.size() != 6) {
      refuse(fmt::format("load: {}: polynomials are of orbits in all six variables",
                         io::printable_path(path)));
    }
    const CoordinatesAtEnds wanted = wanted_of(*stored);
    if (wanted == stored->coordinates) return PolynomialsStudy(cli::evaluated_jet(*stored));
    return PolynomialsStudy(
        cli::evaluated_jet(cli::converted_jet(*stored, wanted, io::printable_path(path),
                                              scene ? &*scene : nullptr, cli::Caller::module)
                               .stored));
  });
}

PolynomialsStudy integrate(const GivenScene& given, const py::object& progress) {
  const Scene scene = given.flow_jet();
  return interruptibly(progress, [scene, file = given.file](const ProgressCallback&) {
    return io::naming_file(file, [&] { return PolynomialsStudy(scene, file); });
  });
}

}  // namespace

void bind_polynomials(py::module_& module) {
  py::class_<PolynomialsStudy> study(module, "PolynomialsStudy");
  bind_copies(study);
  study.def_property_readonly("scene", &PolynomialsStudy::scene)
      .def_property_readonly("run", &PolynomialsStudy::run)
      .def_property_readonly("order", &PolynomialsStudy::order)
      .def_property_readonly("variables", &PolynomialsStudy::variables)
      .def_property_readonly("coordinates", &PolynomialsStudy::coordinates)
      .def_property_readonly("end_coordinates", &PolynomialsStudy::end_coordinates)
      .def_property_readonly("duration_s", &PolynomialsStudy::duration_s)
      .def("evaluate_relative", &PolynomialsStudy::evaluate_relative, py::arg("states"),
           py::arg("frame"), py::arg("to"), py::arg("derivatives"), py::arg("degree"),
           py::arg("strict"))
      .def("reach", &PolynomialsStudy::reach, py::arg("tolerance_m"), py::arg("samples"),
           py::arg("progress"));
  module.def("load_polynomials", &load_polynomials, py::arg("path"), py::arg("run"),
             py::arg("coordinates"), py::arg("end_coordinates"), py::arg("scene"));
  module.def("integrate_polynomials", &integrate, py::arg("scene"), py::arg("progress"));
}

}  // namespace hamjet::python
