#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <optional>
#include <type_traits>
#include <variant>

#include "../app/processors.hpp"
#include "../report/paper/paper_reports.hpp"
#include "../store/result_set.hpp"
#include "../store/text_file.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "given_scene.hpp"
#include "hamjet/error.hpp"
#include "hamjet/report/results.hpp"
#include "hamjet/store/output_directory.hpp"
#include "interruptible.hpp"
#include "jet.hpp"
#include "pickling.hpp"
#include "written_set.hpp"

namespace hamjet::python {
namespace {

/// The results of a scene; the package makes a Result of it.
struct Propagation {
  std::shared_ptr<const PropagationResult> result;
  std::string summary;

  const RunResult& run(std::size_t index) const { return result->runs.at(index); }
};

Propagation run_flow_jet(const GivenScene& given, std::optional<std::size_t> threads,
                         const py::object& progress) {
  const std::size_t count = threads ? *threads : cli::usable_processors();
  return interruptibly(progress, [scene = given.flow_jet(io::SceneUnits::told),
                                  count](const ProgressCallback& report) {
    auto result = std::make_shared<const PropagationResult>(propagate(scene, report, count));
    std::string summary = io::summary_json(*result);
    return Propagation{std::move(result), std::move(summary)};
  });
}

io::StudyReport run_other_study(const GivenScene& given, const py::object& progress) {
  return interruptibly(progress, [study = given.study](const ProgressCallback& report) {
    return std::visit(
        [&](const auto& scene) -> io::StudyReport {
          if constexpr (std::is_same_v<std::decay_t<decltype(scene)>, Scene>) {
            throw Error(ErrorKind::usage, "the scene has a flow jet");
          } else {
            return io::study_report(run_study(scene, report));
          }
        },
        study);
  });
}

py::object jet_of_run(const Propagation& propagation, std::size_t index) {
  const RunResult& run = propagation.run(index);
  if (!run.failure.empty()) return py::none();
  return py::cast(jet_of(*propagation.result, run));
}

/// The nominal as (times, states, energy errors), canonical.
py::tuple nominal(const Propagation& propagation, std::size_t index) {
  const RunResult& run = propagation.run(index);
  std::vector<double> times;
  std::vector<double> states;
  std::vector<double> energy_errors;
  for (const NominalPoint& point : run.nominal) {
    times.push_back(point.time);
    states.insert(states.end(), point.state.begin(), point.state.end());
    energy_errors.push_back(point.energy_error);
  }
  const py::ssize_t rows = size_of(times.size());
  return py::make_tuple(
      array_of(std::move(times)),
      array_of(std::move(states), {rows, size_of(propagation.result->scene.nominal.size())}),
      array_of(std::move(energy_errors)));
}

/// The figure's record as (times, exactness, conditions, energy errors, singular times), canonical;
/// None without a figure.
py::object along_time(const Propagation& propagation, std::size_t index) {
  const RunResult& run = propagation.run(index);
  if (!run.along_time) return py::none();
  std::vector<double> times;
  std::vector<double> exactness;
  std::vector<double> conditions;
  std::vector<double> energy_errors;
  for (const RunAlongTime::Point& point : run.along_time->points) {
    times.push_back(point.time);
    exactness.push_back(point.exactness.value_or(none));
    conditions.push_back(point.condition);
    energy_errors.push_back(point.energy_error);
  }
  return py::make_tuple(array_of(std::move(times)), array_of(std::move(exactness)),
                        array_of(std::move(conditions)), array_of(std::move(energy_errors)),
                        array_of(std::vector<double>(run.along_time->singular_times)));
}

std::string write_propagation(const Propagation& propagation,
                              const std::filesystem::path& directory) {
  return interruptibly(py::none(),
                       [result = propagation.result, directory](const ProgressCallback&) {
                         io::OutputDirectory output(directory);
                         std::optional<std::string> problem;
                         const std::string figure = io::figure_svg(*result, problem);
                         return io::write_results(*result, figure, output);
                       });
}

py::dict files_of(const io::StudyReport& report) {
  py::dict files;
  for (const io::ReportFile& file : report.files) {
    files[py::str(file.path.generic_string())] = file.content;
  }
  return files;
}

/// Texts of results by name, summary.json among them.
py::dict read_files(const std::filesystem::path& directory, const std::vector<std::string>& names) {
  // The command takes a jet from a file too, but results are more than their jets.
  std::error_code none;
  if (std::filesystem::is_regular_file(directory, none)) {
    throw Error(ErrorKind::input_output,
                fmt::format("{}: is a file, must be the directory of the results",
                            io::printable_path(directory)));
  }
  io::ResultSet set(directory, "summary.json");
  py::dict files;
  for (const std::string& name : names) files[py::str(name)] = set.read(name);
  files["summary.json"] = set.summary();
  set.verify();
  return files;
}

}  // namespace

void bind_runs(py::module_& module) {
  py::class_<Propagation>(module, "Propagation")
      .def_property_readonly("summary", [](const Propagation& p) { return p.summary; })
      .def("jet", &jet_of_run)
      .def("nominal", &nominal)
      .def("along_time", &along_time)
      .def("write", &write_propagation);
  py::class_<io::StudyReport> report(module, "StudyReport");
  bind_copies(report);
  report.def_property_readonly("summary", [](const io::StudyReport& r) { return r.summary(); })
      .def_property_readonly("exit_code", [](const io::StudyReport& r) { return r.exit_code; })
      .def_property_readonly("failure", [](const io::StudyReport& r) { return r.failure; })
      .def_property_readonly("files", &files_of)
      .def("write", &write_set);
  module.def("run_flow_jet", &run_flow_jet, py::arg("scene"), py::arg("threads"),
             py::arg("progress"));
  module.def("run_other_study", &run_other_study, py::arg("scene"), py::arg("progress"));
  module.def("read_files", &read_files, py::arg("directory"), py::arg("names"));
}

}  // namespace hamjet::python
