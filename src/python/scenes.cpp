#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <toml++/toml.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "../scene/document/scene_document.hpp"
#include "../scene/document/scene_text.hpp"
#include "../scene/scene_sections.hpp"
#include "../text/scene_message.hpp"
#include "arithmetic_scope.hpp"
#include "bindings.hpp"
#include "given_scene.hpp"
#include "hamjet/error.hpp"

namespace hamjet::python {
namespace {

namespace py = pybind11;

/// No scene nests its tables half as deep; a table within itself would never end.
constexpr int deepest_tables = 20;

/// A place in the tables, for messages.
struct Place {
  const std::string& scene;
  std::string key;

  Place below(const std::string& name) const {
    return {scene, key.empty() ? name : key + "." + name};
  }
  [[noreturn]] void fail(const std::string& problem) const {
    const std::string head = key.empty() ? scene : scene + ": " + key;
    throw Error(ErrorKind::scene, head + ": " + problem);
  }
};

std::string text_of(const py::handle& value) {
  return io::printable(py::str(value).cast<std::string>());
}

/// The text in UTF-8; throws for a string that holds what is no text.
std::string utf8(const py::handle& text, const Place& place) {
  Py_ssize_t size = 0;
  const char* bytes = PyUnicode_AsUTF8AndSize(text.ptr(), &size);
  if (bytes == nullptr) {
    PyErr_Clear();
    place.fail("not a text, got a string with a lone surrogate, must be Unicode");
  }
  std::string result(bytes, static_cast<std::size_t>(size));
  if (result.find('\0') != std::string::npos) place.fail("not a text, got a NUL character in it");
  return result;
}

std::int64_t integer(const py::handle& value, const Place& place) {
  int overflow = 0;
  const long long number = PyLong_AsLongLongAndOverflow(value.ptr(), &overflow);
  if (overflow != 0) {
    place.fail(
        fmt::format("out of range, got {}, an integer must be within 64 bits", text_of(value)));
  }
  return number;
}

toml::table table_of(const py::handle& mapping, const Place& place, int depth);
toml::array array_of(const py::handle& sequence, const Place& place, int depth);

/// Calls `put` with the TOML value of a Python value.
template <class Put>
void convert_value(const py::handle& given, const Place& place, int depth, const Put& put) {
  if (depth > deepest_tables) {
    place.fail(fmt::format("nested too deep, must be at most {} tables", deepest_tables));
  }
  py::object value = py::reinterpret_borrow<py::object>(given);
  // Arrays and scalars of NumPy.
  if (py::hasattr(value, "dtype") && py::hasattr(value, "tolist")) value = value.attr("tolist")();
  if (PyBool_Check(value.ptr()) != 0) {
    put(value.cast<bool>());
  } else if (PyLong_Check(value.ptr()) != 0) {
    put(integer(value, place));
  } else if (PyFloat_Check(value.ptr()) != 0) {
    put(value.cast<double>());
  } else if (PyUnicode_Check(value.ptr()) != 0) {
    put(utf8(value, place));
  } else if (py::isinstance(value, py::module_::import("collections.abc").attr("Mapping"))) {
    put(table_of(value, place, depth + 1));
  } else if (PyList_Check(value.ptr()) != 0 || PyTuple_Check(value.ptr()) != 0) {
    put(array_of(value, place, depth + 1));
  } else {
    place.fail(
        fmt::format("wrong type, got {}, must be a bool, int, float, str, list, tuple, dict "
                    "or NumPy array; leave out what is not wanted",
                    text_of(py::type::of(value).attr("__name__"))));
  }
}

toml::table table_of(const py::handle& mapping, const Place& place, int depth) {
  toml::table table;
  for (const py::handle item : mapping.attr("items")()) {
    const auto pair = py::reinterpret_borrow<py::tuple>(item);
    if (PyUnicode_Check(py::object(pair[0]).ptr()) == 0) {
      place.fail(fmt::format("wrong key, got {}, must be a string", text_of(pair[0])));
    }
    const std::string key = utf8(pair[0], place);
    convert_value(pair[1], place.below(io::printable(key)), depth,
                  [&](auto&& value) { table.insert_or_assign(key, std::move(value)); });
  }
  return table;
}

toml::array array_of(const py::handle& sequence, const Place& place, int depth) {
  toml::array array;
  std::size_t index = 0;
  for (const py::handle element : sequence) {
    convert_value(element, place.below(std::to_string(index)), depth,
                  [&](auto&& value) { array.push_back(std::move(value)); });
    ++index;
  }
  return array;
}

std::vector<io::Override> overrides_of(
    const std::vector<std::pair<std::string, std::string>>& pairs) {
  std::vector<io::Override> overrides;
  for (const auto& [key, value] : pairs) overrides.push_back({key, value});
  return overrides;
}

using Overrides = std::vector<std::pair<std::string, std::string>>;

GivenScene scene_of_text(const std::string& text, const std::string& name,
                         const Overrides& overrides) {
  const ArithmeticScope arithmetic;
  const auto read = [&](io::SceneUnits units) {
    return io::parse_study(text, name, overrides_of(overrides), units);
  };
  return {read, name};
}

GivenScene scene_of_file(const std::filesystem::path& file, const Overrides& overrides) {
  const std::string text = io::read_scene_file(file);
  return scene_of_text(text, file.string(), overrides);
}

GivenScene scene_of_tables(const py::object& mapping, const std::string& name,
                           const Overrides& overrides) {
  const ArithmeticScope arithmetic;
  const io::SceneDocument document =
      io::make_document(table_of(mapping, {name, ""}, 0), name, overrides_of(overrides));
  return {[&](io::SceneUnits units) { return io::read_document(document, name, units); }, name};
}

/// Checks the table `[system]` alone, and returns the names of the variables.
std::vector<std::string> checked_system(const py::object& mapping, const std::string& name) {
  toml::table tables;
  tables.insert_or_assign("system", table_of(mapping, {name, "system"}, 0));
  const io::SceneDocument document = io::make_document(std::move(tables), name, {});
  const io::TableReader root(document.table, "", document.source, &io::all_studies().front().top);
  const SystemSettings settings = io::read_system(root);
  const auto names = variable_names(settings);
  return {names.begin(), names.end()};
}

}  // namespace

void bind_scenes(py::module_& module) {
  py::class_<GivenScene>(module, "GivenScene", "A scene that was read and checked.")
      .def_property_readonly("is_flow_jet", &GivenScene::is_flow_jet)
      .def_property_readonly("warnings", &GivenScene::warnings);
  module.def("scene_of_file", &scene_of_file, py::arg("file"), py::arg("overrides"));
  module.def("scene_of_text", &scene_of_text, py::arg("text"), py::arg("name"),
             py::arg("overrides"));
  module.def("checked_system", &checked_system, py::arg("system"), py::arg("name"));
  module.def("scene_of_tables", &scene_of_tables, py::arg("tables"), py::arg("name"),
             py::arg("overrides"));
}

}  // namespace hamjet::python
