#include "jet_files.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "../app/replaceable_file.hpp"
#include "../app/rounding_note.hpp"
#include "../store/text_file.hpp"
#include "../store/whole_file.hpp"
#include "existing_file.hpp"
#include "hamjet/error.hpp"
#include "hamjet/formats/jet_file.hpp"
#include "interruptible.hpp"
#include "refusal.hpp"
#include "signature.hpp"

namespace hamjet::python {
namespace {

namespace py = pybind11;

constexpr const char* save_doc =
    R"(Writes the jet to a file, whole or not at all, as `hamjet convert` does.

path: its ending is the format; its folder must be there. overwrite: whether a file that is there is
replaced. A file .h5 (HDF5) holds everything, every digit of extended
precision too. Files .csv and .dace hold the coefficients alone, .dace in double precision (a
RuntimeWarning says so where digits are lost): `load` takes them beside the summary.json of their
results.

Raises UsageError for another ending, a file of results, or HDF5 in a build without it;
InputOutputError if it cannot be written, and of these ExistingFileError, a FileExistsError, where
a file would be replaced, and MissingFileError, a FileNotFoundError, where the folder is not there.)";

constexpr const char* load_doc =
    R"(Reads one jet, which `save`, `hamjet convert` or `hamjet run` has written, bit by bit.

path: a file .h5; a file .csv or .dace beside the summary.json of its results or one folder below;
or a directory of results. run: the label of the run; by default the first that has a result.
model, units, duration_canonical, nominal_initial: all of them for a file .dace from elsewhere,
which says nothing but its polynomials, the final state by the deviations; they are as in
`from_arrays`, and so are the state_parameters of such a file, if it has some.

Raises UsageError if no run has this label, InputOutputError if the file is not what was written,
and of these MissingFileError, a FileNotFoundError, if it is not there.)";

std::filesystem::path path_of(const py::object& given) {
  return py::module_::import("hamjet.arguments")
      .attr("path")(given, "path")
      .cast<std::filesystem::path>();
}

[[noreturn]] void throw_existing(const std::filesystem::path& file) {
  throw ExistingFile(file,
                     io::printable_path(file) + ": is there; overwrite=True would replace it");
}

/// Throws unless the file can be written, and replaced where it is there.
void require_new(const std::filesystem::path& file, bool may_replace) {
  std::error_code ignored;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!exists(folder, ignored)) {
    throw io::MissingFile(folder, io::printable_path(file) + ": cannot be written: the folder " +
                                      io::printable_path(folder) + " is not there");
  }
  cli::require_replaceable(file);
  if (!may_replace && exists(file, ignored)) throw_existing(file);
}

void save(const std::shared_ptr<Jet>& jet, const py::object& path, bool overwrite) {
  const std::filesystem::path file = path_of(path);
  const io::OutputFormat& format = io::jet_format(file);
  interruptibly(py::none(), [file, overwrite](const ProgressCallback&) {
    require_new(file, overwrite);
    return true;
  });
  if (const auto note = cli::rounding_note(jet->stored(), format)) {
    const std::string text = "save: " + *note;
    if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), 1) != 0) throw py::error_already_set();
  }
  interruptibly(py::none(), [jet, file, overwrite, &format](const ProgressCallback&) {
    io::WholeFile written(file);
    written.write(io::jet_file_content(jet->stored(), format));
    if (overwrite) {
      written.replace(io::Flush::yes);
    } else if (!written.put_where_nothing_is()) {
      throw_existing(file);
    }
    return true;
  });
}

/// The arguments of `load` that describe a jet from elsewhere go together.
void require_all(const std::vector<std::pair<const char*, bool>>& given) {
  std::vector<std::string> missing;
  for (const auto& [name, is_given] : given) {
    if (!is_given) missing.emplace_back(name);
  }
  if (missing.empty() || missing.size() == given.size()) return;
  refuse(fmt::format("load: a jet from elsewhere needs {} as well", fmt::join(missing, ", ")));
}

Jet load(const std::filesystem::path& file, const std::optional<std::string>& run,
         const io::JetDescription& foreign) {
  io::StoredJet stored = interruptibly(py::none(), [file, run, foreign](const ProgressCallback&) {
    return io::read_jet_file(file, run, foreign);
  });
  io::require_positions_and_momenta(stored, io::printable_path(file));
  for (const std::string& note : stored.notes) {
    const std::string text = "load: " + note;
    if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), 1) != 0) throw py::error_already_set();
  }
  return Jet(std::move(stored));
}

}  // namespace

void bind_jet_files(py::module_& module, py::class_<Jet, std::shared_ptr<Jet>>& jet) {
  jet.def("save", &save, py::arg("path"), py::kw_only(), py::arg("overwrite") = false,
          documented("save(self, path, *, overwrite=False)", save_doc).c_str())
      .def_static(
          "load",
          [](const py::object& path, const std::optional<std::string>& run,
             const std::optional<std::string>& model, const std::optional<CanonicalUnits>& units,
             std::optional<double> duration, const std::optional<std::vector<double>>& nominal,
             const std::optional<std::vector<std::string>>& parameters) {
            require_all({{"model", model.has_value()},
                         {"units", units.has_value()},
                         {"duration_canonical", duration.has_value()},
                         {"nominal_initial", nominal.has_value()}});
            io::JetDescription foreign{model, {}, {}, duration, nominal, parameters};
            if (units) {
              foreign.length_unit_km = units->length_km;
              foreign.time_unit_s = units->time_s;
            }
            return load(path_of(path), run, foreign);
          },
          py::arg("path"), py::arg("run") = py::none(), py::kw_only(),
          py::arg("model") = py::none(), py::arg("units") = py::none(),
          py::arg("duration_canonical") = py::none(), py::arg("nominal_initial") = py::none(),
          py::arg("state_parameters") = py::none(),
          documented("load(path, run=None, *, model=None, units=None, duration_canonical=None, "
                     "nominal_initial=None, state_parameters=None)",
                     load_doc)
              .c_str());
  module.def(
      "load_jet",
      [](const std::filesystem::path& directory, const std::optional<std::string>& run) {
        return interruptibly(py::none(), [directory, run](const ProgressCallback&) {
          return Jet(io::read_stored_jet(directory, run));
        });
      },
      py::arg("directory"), py::arg("run"));
}

}  // namespace hamjet::python
