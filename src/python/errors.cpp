#include <pybind11/stl/filesystem.h>

#include <exception>
#include <new>
#include <string>

#include "../cli/process/interruption.hpp"
#include "../store/text_file.hpp"
#include "bindings.hpp"
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

void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const io::MissingFile& error) {
    const py::object type = py::module_::import("hamjet.errors").attr("MissingFileError");
    const py::object raised = type(text_of(error.what()), py::cast(error.file()));
    PyErr_SetObject(type.ptr(), raised.ptr());
  } catch (const Error& error) {
    const py::object type = py::module_::import("hamjet.errors").attr(class_name(error.kind()));
    PyErr_SetObject(type.ptr(), text_of(error.what()).ptr());
  } catch (const std::bad_alloc&) {
    PyErr_SetString(PyExc_MemoryError, cli::out_of_memory);
  }
}

}  // namespace

void bind_errors() { py::register_exception_translator(translate); }

}  // namespace hamjet::python
