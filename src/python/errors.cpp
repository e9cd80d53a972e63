#include <pybind11/stl/filesystem.h>

#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>

#include "../cli/process/interruption.hpp"
#include "../store/text_file.hpp"
#include "../text/scene_message.hpp"
#include "bindings.hpp"
#include "existing_file.hpp"
#include "hamjet/error.hpp"

namespace hamjet::python {
namespace {

namespace py = pybind11;

const char* class_name(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage:
      return "UsageError";
    case ErrorKind::scene:
      return "SceneError";
    case ErrorKind::numerical:
      return "NumericalError";
    case ErrorKind::input_output:
      return "InputOutputError";
    case ErrorKind::too_large:
      return "TooLargeError";
    case ErrorKind::check_failed:
      break;
  }
  return "Error";
}

/// Python's text; what is not UTF-8, as in the name of a file, is replaced.
py::object text_of(const std::string& message) {
  return py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(
      message.data(), static_cast<Py_ssize_t>(message.size()), "backslashreplace"));
}

/// The text with changes of the scene named as Python's argument, where the command has an option.
std::string with_overrides(std::string_view message) {
  const std::string option = io::override_source("");
  std::string text;
  for (std::size_t at = 0; at < message.size();) {
    if (message.substr(at).starts_with(option)) {
      // Each line of a message begins with the place of a mistake.
      text += at == 0 || message[at - 1] == '\n' ? "overrides: " : "override ";
      at += option.size();
    } else {
      text += message[at++];
    }
  }
  return text;
}

/// Raises one of the classes that know their file.
void raise_about_file(const char* class_name, const char* text, const std::filesystem::path& file) {
  const py::object type = py::module_::import("hamjet.errors").attr(class_name);
  const py::object raised = type(text_of(text), py::cast(file));
  PyErr_SetObject(type.ptr(), raised.ptr());
}

void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const io::MissingFile& error) {
    raise_about_file("MissingFileError", error.what(), error.file());
  } catch (const ExistingFile& error) {
    raise_about_file("ExistingFileError", error.what(), error.file());
  } catch (const Error& error) {
    const py::object type = py::module_::import("hamjet.errors").attr(class_name(error.kind()));
    PyErr_SetObject(type.ptr(), text_of(with_overrides(error.what())).ptr());
  } catch (const std::bad_alloc&) {
    PyErr_SetString(PyExc_MemoryError, cli::out_of_memory);
  }
}

}  // namespace

void bind_errors() { py::register_exception_translator(translate); }

}  // namespace hamjet::python
