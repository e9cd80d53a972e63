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

/// The members of `domains` in the output of `hamjet eval --json`.
py::object domains_of(const std::optional<cli::EvalDomains>& domains) {
  if (!domains) return py::none();
  py::dict splits;
  for (std::size_t i = 0; i < domains->splits.size(); ++i) {
    splits[py::str(std::string(cli::EvalDomains::coordinates[i]))] = domains->splits[i];
  }
  const std::vector<cli::EvalDomain>& first = domains->domains;
  std::vector<double> centres;
  std::vector<double> half_widths;
  std::vector<double> misses;
  for (const cli::EvalDomain& domain : first) {
    centres.insert(centres.end(), domain.centre.begin(), domain.centre.end());
    half_widths.insert(half_widths.end(), domain.half_widths.begin(), domain.half_widths.end());
    misses.push_back(domain.miss_m);
  }
  py::dict result;
  result["tolerance_m"] = domains->tolerance_m;
  result["count"] = domains->count;
  result["is_limited"] = domains->is_limited;
  result["not_right"] = domains->not_right;
  result["maps"] = domains->maps;
  result["splits"] = splits;
  result["centres"] = array_of(std::move(centres), {size_of(first.size()), size_of(6)});
  result["half_widths"] = array_of(std::move(half_widths), {size_of(first.size()), size_of(6)});
  result["miss_m"] = array_of(std::move(misses));
  return result;
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
  std::optional<cli::EvalDomains> domains;
  {
    const double* data = rows.data();
    const py::gil_scoped_release no_gil;
    const ArithmeticScope arithmetic;
    SignalCheck check;
    evaluate_relative(source, coordinates, data, count,
                      {results.data(), miss.data(), support.data(), &domains}, [&] { check(); });
  }
  warn_if_not_inside(support, is_strict);
  return py::module_::import("hamjet.relative_states")
      .attr("_relative_states")(array_of(std::move(results), {size_of(count), size_of(columns)}),
                                array_of(std::move(miss)), array_of(std::move(support)),
                                py::tuple(py::cast(final_columns(chief, coordinates))),
                                domains_of(domains));
}

template py::object relative_states(const io::StoredJet&, const io::StoredJet&, const py::object&,
                                    const RelativeCoordinates&, bool);
template py::object relative_states(const io::StoredJet&, const cli::EvaluatedScene&,
                                    const py::object&, const RelativeCoordinates&, bool);

}  // namespace hamjet::python
