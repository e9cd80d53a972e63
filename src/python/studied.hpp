#pragma once

#include <pybind11/stl/filesystem.h>

#include <functional>
#include <memory>
#include <utility>

#include "../app/report_origin.hpp"
#include "../app/required_tables.hpp"
#include "../studies/arcs.hpp"
#include "bindings.hpp"
#include "given_scene.hpp"
#include "hamjet/detail/report/study_report.hpp"
#include "interruptible.hpp"
#include "written_set.hpp"

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

/// The scene for `command`, which does not split flows into arcs.
inline Scene unsplit(const GivenScene& given, const std::string& command) {
  Scene scene = given.flow_jet();
  cli::study_of(given.file, [&] { require_unsplit(scene, command); });
  return scene;
}

/// Binds what the studies have in common.
template <class Result>
py::class_<Studied<Result>> bind_study(py::module_& module, const char* name) {
  return py::class_<Studied<Result>>(module, name)
      .def_property_readonly("summary",
                             [](const Studied<Result>& s) { return s.report().summary(); })
      .def_property_readonly("failure", [](const Studied<Result>& s) { return s.report().failure; })
      .def("write", [](const Studied<Result>& s, const std::filesystem::path& directory) {
        write_set(s.report(), directory);
      });
}

}  // namespace hamjet::python
