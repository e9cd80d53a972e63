#include "relative_rows.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <string>
#include <vector>

#include "../text/quantity_text.hpp"
#include "arithmetic_scope.hpp"
#include "arrays.hpp"
#include "evaluation.hpp"
#include "hamjet/error.hpp"
#include "hamjet/maps/truncation_estimate.hpp"
#include "interruptible.hpp"

namespace hamjet::python {
namespace {

namespace py = pybind11;

void warn_if_not_inside(const std::vector<unsigned char>& support, bool is_strict) {
  const auto inside = static_cast<unsigned char>(TruncationEstimate::Support::inside);
  const auto count = std::count_if(support.begin(), support.end(),
                                   [&](unsigned char mark) { return mark != inside; });
  if (count == 0) return;
  const std::string text = fmt::format(
      "evaluate_relative: {} of {} not inside the polynomial's reach; see their support", count,
      counted(support.size(), "row"));
  if (is_strict) throw Error(ErrorKind::numerical, text);
  if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), 1) != 0) throw py::error_already_set();
}

}  // namespace

template <class Source>
py::object relative_states(const io::StoredJet& chief, const Source& source,
                           const py::object& states, const RelativeCoordinates& coordinates,
                           bool is_strict) {
  constexpr std::size_t columns = 6;
  const auto column_names = [&] { return initial_columns(chief, coordinates); };
  const py::array_t<double> rows = rows_of(states, columns, column_names, "states");
  const bool is_one = rows.ndim() == 1;
  const auto count = is_one ? 1 : static_cast<std::size_t>(rows.shape(0));
  std::vector<double> results(columns * count);
  std::vector<double> miss(count);
  std::vector<unsigned char> support(count);
  {
    const double* data = rows.data();
    const py::gil_scoped_release no_gil;
    const ArithmeticScope arithmetic;
    SignalCheck check;
    evaluate_relative(source, coordinates, data, count,
                      {results.data(), miss.data(), support.data()}, [&] { check(); });
  }
  warn_if_not_inside(support, is_strict);
  return py::module_::import("hamjet.relative_states")
      .attr("_relative_states")(array_of(std::move(results), {size_of(count), size_of(columns)}),
                                array_of(std::move(miss)), array_of(std::move(support)),
                                py::tuple(py::cast(final_columns(chief, coordinates))));
}

template py::object relative_states(const io::StoredJet&, const io::StoredJet&, const py::object&,
                                    const RelativeCoordinates&, bool);
template py::object relative_states(const io::StoredJet&, const cli::EvaluatedScene&,
                                    const py::object&, const RelativeCoordinates&, bool);

}  // namespace hamjet::python
