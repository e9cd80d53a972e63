#pragma once

#include <pybind11/numpy.h>

#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace hamjet::python {

namespace py = pybind11;

/// What arrays of numbers hold where there is no number.
constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A read-only array over numbers that `owner` keeps alive; no copy.
template <class Number>
py::array_t<Number> view(const Number* numbers, std::vector<py::ssize_t> shape,
                         const py::object& owner) {
  py::array_t<Number> array(std::move(shape), numbers, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// A read-only array that owns the numbers; no copy. An empty shape stands for one dimension.
template <class Number>
py::array_t<Number> array_of(std::vector<Number> numbers, std::vector<py::ssize_t> shape = {}) {
  if (shape.empty()) shape = {static_cast<py::ssize_t>(numbers.size())};
  auto owned = std::make_unique<std::vector<Number>>(std::move(numbers));
  const Number* data = owned->data();
  const py::capsule owner(owned.get(),
                          [](void* v) { delete static_cast<std::vector<Number>*>(v); });
  owned.release();
  return view(data, std::move(shape), owner);
}

/// A read-only array of truth values; a copy, because std::vector<bool> keeps single bits.
inline py::object flags(const std::vector<bool>& values, std::vector<py::ssize_t> shape = {}) {
  std::vector<unsigned char> bytes(values.begin(), values.end());
  return array_of(std::move(bytes), std::move(shape)).attr("view")("bool");
}

inline py::ssize_t size_of(std::size_t size) { return static_cast<py::ssize_t>(size); }

}  // namespace hamjet::python
