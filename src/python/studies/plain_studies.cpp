#include <algorithm>

#include "../../app/processors.hpp"
#include "../bindings.hpp"
#include "hamjet/error.hpp"
#include "studied.hpp"

// Studies of which Python has nothing but report and tables: one class for all of them.

namespace hamjet::python {
namespace {

/// The study of a scene's table; `table` is empty for the one that works without.
Studied<io::DoneStudy> study_of_table(const std::string& table, const GivenScene& given,
                                      const py::object& progress) {
  const auto all = io::study_descriptions();
  if (std::ranges::find(all, table, &io::StudyDescription::table) == all.end()) {
    throw Error(ErrorKind::usage, "study: no study works on a table of this name");
  }
  return interruptibly(progress, [scene = scene_of(given, table), file = given.file,
                                  table](const ProgressCallback& report) {
    return io::naming_file(file, [&] {
      return Studied<io::DoneStudy>(
          io::study_of_table(table).study(scene, {report, origin(), cli::usable_processors()}),
          [](const io::DoneStudy& study) { return study.report(); });
    });
  });
}

std::vector<io::TableView> tables_of(const io::DoneStudy& study) { return study.tables(); }

}  // namespace

void bind_plain_studies(py::module_& module) {
  module.def("declarations", &declarations);
  bind_study<io::DoneStudy>(module, "PlainStudy", &tables_of);
  module.def("study_of_table", &study_of_table, py::arg("table"), py::arg("scene"),
             py::arg("progress"));
}

}  // namespace hamjet::python
