#include "evaluation.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <optional>

#include "arithmetic_scope.hpp"
#include "hamjet/error.hpp"
#include "interruptible.hpp"
#include "refusal.hpp"
#include "row_evaluation.hpp"

namespace hamjet::python {
namespace {

using Array = py::array_t<double, py::array::c_style | py::array::forcecast |
                                      py::detail::npy_api::NPY_ARRAY_ALIGNED_>;

std::string shape_text(const py::array& array) {
  return py::str(py::tuple(array.attr("shape"))).cast<std::string>();
}

/// Whether two arrays share memory without being the same numbers in the same places.
bool overlaps_otherwise(const py::array& a, const py::array& b) {
  const auto a_begin = reinterpret_cast<std::uintptr_t>(a.data());
  const auto b_begin = reinterpret_cast<std::uintptr_t>(b.data());
  const auto a_end = a_begin + static_cast<std::uintptr_t>(a.nbytes());
  const auto b_end = b_begin + static_cast<std::uintptr_t>(b.nbytes());
  const bool is_same = a_begin == b_begin && a_end == b_end;
  return !is_same && a_begin < b_end && b_begin < a_end;
}

/// Whether masked elements are among the points, where NumPy would give the numbers below the mask.
bool has_masked(const py::handle& points) {
  if (PyFloat_CheckExact(points.ptr()) != 0 || PyLong_CheckExact(points.ptr()) != 0 ||
      Py_TYPE(points.ptr()) == py::detail::npy_api::get().PyArray_Type_) {
    return false;
  }
  if (PyList_Check(points.ptr()) != 0 || PyTuple_Check(points.ptr()) != 0) {
    return std::any_of(points.begin(), points.end(), has_masked);
  }
  return py::hasattr(points, "_mask") &&
         py::module_::import("numpy.ma").attr("is_masked")(points).cast<bool>();
}

/// The labels by which the numbers of a row are told apart: a data frame's names of columns, or the
/// index of one row of it. No value for what goes by position: a method of this name, such as a
/// list's index, is no label.
std::optional<py::list> labels_of(const py::handle& points) {
  if (Py_TYPE(points.ptr()) == py::detail::npy_api::get().PyArray_Type_ ||
      PyList_Check(points.ptr()) != 0 || PyTuple_Check(points.ptr()) != 0) {
    return std::nullopt;
  }
  for (const char* name : {"columns", "index"}) {
    const py::object labels = py::getattr(points, name, py::none());
    if (!labels.is_none() && PyCallable_Check(labels.ptr()) == 0) return py::list(labels);
  }
  return std::nullopt;
}

/// Whether rows within a list have labels, which NumPy would leave aside.
bool has_labelled_rows(const py::handle& points) {
  const bool is_list = PyList_Check(points.ptr()) != 0 || PyTuple_Check(points.ptr()) != 0;
  return is_list && std::any_of(points.begin(), points.end(), [](const py::handle& row) {
           return PyFloat_CheckExact(row.ptr()) == 0 && labels_of(row).has_value();
         });
}

/// The columns in the order of their names.
py::object in_order(const py::object& points, const py::list& labels,
                    const std::vector<std::string>& names, const std::string& what) {
  const py::list wanted = py::cast(names);
  const bool are_same =
      labels.size() == names.size() &&
      std::all_of(wanted.begin(), wanted.end(), [&](const py::handle& name) {
        return std::any_of(labels.begin(), labels.end(), [&](const py::handle& label) {
          return PyUnicode_Check(label.ptr()) != 0 && label.equal(name);
        });
      });
  if (!are_same) {
    constexpr std::size_t most_shown = 20;
    std::vector<std::string> shown;
    for (std::size_t i = 0; i < std::min(labels.size(), most_shown); ++i) {
      shown.push_back(py::repr(labels[i]).cast<std::string>());
    }
    refuse(
        fmt::format("{}: the columns must be {}, in any order, got {}{}; an array without names "
                    "is taken by position",
                    what, fmt::join(names, ", "), fmt::join(shown, ", "),
                    labels.size() > most_shown ? ", ..." : ""));
  }
  return points[wanted];
}

py::array_t<double> target(const py::object& out, const std::vector<py::ssize_t>& shape,
                           const py::array& points) {
  if (out.is_none()) return py::array_t<double>(shape);
  const bool is_right =
      py::isinstance<Array>(out) && py::cast<py::array>(out).writeable() && !has_masked(out);
  const py::array given = py::isinstance<py::array>(out) ? py::cast<py::array>(out) : py::array();
  if (!is_right || std::vector<py::ssize_t>(given.shape(), given.shape() + given.ndim()) != shape) {
    refuse(fmt::format("out: must be a writable float64 array in C order of shape ({})",
                       fmt::join(shape, ", ")));
  }
  if (overlaps_otherwise(given, points)) {
    refuse("out: shares memory with the points; only the points themselves may be replaced");
  }
  return py::reinterpret_borrow<py::array_t<double>>(out);
}

}  // namespace

py::array_t<double> rows_of(const py::object& points, std::size_t columns, const ColumnNames& names,
                            const std::string& what) {
  if (const auto labels = labels_of(points)) {
    const py::object ordered = in_order(points, *labels, names(), what);
    return rows_of(py::module_::import("numpy").attr("asarray")(ordered), columns, names, what);
  }
  const py::array given = py::array::ensure(points);
  if (!given) {
    PyErr_Clear();
    refuse(fmt::format("{}: must be an array of numbers", what));
  }
  if (std::string("fiu").find(given.dtype().kind()) == std::string::npos ||
      given.dtype().itemsize() > 8) {
    refuse(fmt::format("{}: must be real numbers of at most 64 bits, got {}", what,
                       py::str(given.dtype()).cast<std::string>()));
  }
  const bool has_rows = given.ndim() == 1 || given.ndim() == 2;
  if (!has_rows || given.shape(given.ndim() - 1) != size_of(columns)) {
    refuse(fmt::format("{}: must have the shape (N, {}) or ({},), got {}", what, columns, columns,
                       shape_text(given)));
  }
  // Labels come after the shape, for a list within itself has no shape.
  if (has_labelled_rows(points)) {
    refuse(fmt::format("{}: a list of rows with labels, must be a data frame or an array", what));
  }
  if (has_masked(points)) {
    refuse(fmt::format("{}: has masked elements, must be numbers throughout", what));
  }
  return Array::ensure(given);
}

py::object evaluate_array(const MapEvaluator& map, const py::object& points,
                          const ColumnNames& names, const py::object& out,
                          const std::string& what) {
  const py::array_t<double> rows = rows_of(points, map.variables(), names, what);
  const bool is_one = rows.ndim() == 1;
  const auto count = is_one ? 1 : static_cast<std::size_t>(rows.shape(0));
  std::vector<py::ssize_t> shape;
  if (!is_one) shape.push_back(size_of(count));
  shape.push_back(size_of(map.components()));
  py::array_t<double> values = target(out, shape, rows);
  // Another array over the same numbers may not be row by row the same.
  if (values.data() == rows.data() && map.components() != map.variables()) {
    refuse("out: shares memory with the points, of which it has another number of columns");
  }
  double* const result = values.mutable_data();
  std::size_t not_finite = 0;
  {
    const py::gil_scoped_release no_gil;
    const ArithmeticScope arithmetic;
    SignalCheck check;
    not_finite = evaluate_rows(map, rows.data(), count, result, [&] { check(); });
  }
  warn_if_not_finite(not_finite, what);
  return values;
}

void warn_if_not_finite(std::size_t count, const std::string& what) {
  if (count == 0) return;
  const std::string text = fmt::format(
      "{} of the values are not finite: {} that are not, or too large for binary64", count, what);
  if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), 1) != 0) throw py::error_already_set();
}

}  // namespace hamjet::python
