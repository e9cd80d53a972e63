#pragma once

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../../app/report_origin.hpp"
#include "../../app/scene_refusal.hpp"
#include "../../report/study_description.hpp"
#include "../arrays.hpp"
#include "../given_scene.hpp"
#include "../interruptible.hpp"
#include "../written_set.hpp"
#include "hamjet/detail/report/study_report.hpp"
#include "table_arrays.hpp"

// What the bindings of studies of more than one spacecraft have in common.

namespace hamjet::python {

/// A study's result, and the files that the command writes of it, made when they are asked for.
template <class Result>
class Studied {
 public:
  using MakeReport = std::function<io::StudyReport(const Result&)>;

  Studied(Result result, MakeReport make_report)
      : result_(std::make_shared<const Result>(std::move(result))),
        make_report_(std::move(make_report)) {}

  const std::shared_ptr<const Result>& result() const { return result_; }
  const io::StudyReport& report() const {
    if (!report_) {
      auto made = interruptibly(py::none(), [result = result_, make = make_report_](
                                                const ProgressCallback&) { return make(*result); });
      // Another thread may have come first; what it has handed out stays.
      if (!report_) report_ = std::make_shared<const io::StudyReport>(std::move(made));
    }
    return *report_;
  }

 private:
  std::shared_ptr<const Result> result_;
  MakeReport make_report_;
  mutable std::shared_ptr<const io::StudyReport> report_;
};

/// What reports say of where they come from.
inline io::ReportOrigin origin() { return cli::report_origin("the Python module hamjet"); }

/// The scene of a study's table, as the study's command takes it; `table` is empty where the study
/// works without one.
inline Scene scene_of(const GivenScene& given, std::string_view table) {
  Scene scene = given.flow_jet();
  io::require_scene_of(io::study_of_table(table), scene, given.file);
  return scene;
}

/// The study of a scene's table, done by `study` and told by `make_report`.
template <class Result, class Study>
Studied<Result> studied(const GivenScene& given, const py::object& progress, std::string_view table,
                        Study study,
                        io::StudyReport (*make_report)(const Result&, const io::ReportOrigin&)) {
  return interruptibly(progress, [scene = scene_of(given, table), file = given.file, study,
                                  make_report](const ProgressCallback& report) {
    return Studied<Result>(
        cli::study_of(file, [&] { return study(scene, report); }),
        [make_report](const Result& result) { return make_report(result, origin()); });
  });
}

/// Columns of numbers that grow row by row.
struct Table {
  std::vector<double> numbers = {};

  void add(double number) { numbers.push_back(number); }
  void add(const Eigen::Vector3d& vector) {
    for (const double x : vector) numbers.push_back(x);
  }
  py::array_t<double> array(std::vector<py::ssize_t> shape = {}) {
    return array_of(std::move(numbers), std::move(shape));
  }
};

/// Binds what the studies have in common; `tables` gives the tables of a result, the study's own
/// first.
template <class Result>
py::class_<Studied<Result>> bind_study(py::module_& module, const char* name,
                                       std::vector<io::TableView> (*tables)(const Result&)) {
  return py::class_<Studied<Result>>(module, name)
      .def_property_readonly("summary",
                             [](const Studied<Result>& s) { return s.report().summary(); })
      .def_property_readonly("failure", [](const Studied<Result>& s) { return s.report().failure; })
      .def("columns",
           [tables](const Studied<Result>& s) { return columns_of_tables(tables(*s.result())); })
      .def("rows",
           [tables](const Studied<Result>& s) { return rows_of_tables(tables(*s.result())); })
      .def("write", [](const Studied<Result>& s, const std::filesystem::path& directory) {
        write_set(s.report(), directory);
      });
}

/// Binds what the studies have in common; `csv` and `arrays` make the table's text and the arrays
/// of a result.
template <class Result>
py::class_<Studied<Result>> bind_study(py::module_& module, const char* name,
                                       std::string (*csv)(const Result&),
                                       py::dict (*arrays)(const Result&)) {
  return py::class_<Studied<Result>>(module, name)
      .def_property_readonly("summary",
                             [](const Studied<Result>& s) { return s.report().summary(); })
      .def_property_readonly("failure", [](const Studied<Result>& s) { return s.report().failure; })
      .def_property_readonly("csv", [csv](const Studied<Result>& s) { return csv(*s.result()); })
      .def("arrays", [arrays](const Studied<Result>& s) { return arrays(*s.result()); })
      .def("write", [](const Studied<Result>& s, const std::filesystem::path& directory) {
        write_set(s.report(), directory);
      });
}

}  // namespace hamjet::python
