#include <fmt/format.h>

#include <iterator>

#include "../../formats/results_names.hpp"
#include "../../formats/stored_coefficients.hpp"
#include "hamjet/report/results.hpp"

namespace hamjet::io {
std::string jet_csv(const PropagationResult& result, const RunResult& run) {
  return coefficients_csv(variable_names(result.scene.system), result.problem.components,
                          result.scene.variables, result.scene.precision, run.jet);
}

std::string generating_function_csv(const PropagationResult& result, const KindResult& kind) {
  fmt::memory_buffer out;
  const auto write = std::back_inserter(out);
  for (const std::string& name : generating_function_variables(result, kind.kind)) {
    fmt::format_to(write, "e_{},", name);
  }
  fmt::format_to(write, "coefficient\n");
  const Series<Extended>& s = *kind.generating_function;
  for (std::size_t k = s.space().first(2); k < s.size(); ++k) {
    for (const auto e : s.space().exponents(k)) fmt::format_to(write, "{},", e);
    fmt::format_to(write, "{}\n", coefficient_digits(s[k], result.scene.precision));
  }
  return fmt::to_string(out);
}

std::string nominal_csv(const PropagationResult& result, const RunResult& run) {
  fmt::memory_buffer out;
  const auto write = std::back_inserter(out);
  fmt::format_to(write, "time_canonical,time_s");
  for (const auto name : variable_names(result.scene.system)) {
    fmt::format_to(write, ",{}", name);
  }
  fmt::format_to(write, ",energy_error\n");
  for (const NominalPoint& point : run.nominal) {
    fmt::format_to(write, "{:.17g},{:.17g}", point.time, point.time * result.scene.units.time_s);
    for (const double x : point.state) fmt::format_to(write, ",{:.17g}", x);
    fmt::format_to(write, ",{:.6g}\n", point.energy_error);
  }
  return fmt::to_string(out);
}

std::string along_time_csv(const PropagationResult& result, const RunResult& run) {
  fmt::memory_buffer out;
  const auto write = std::back_inserter(out);
  fmt::format_to(write, "time_canonical,time_s,exactness_degree_0_scaled,condition,energy_error\n");
  const double unit = result.scene.units.time_s;
  auto singular = run.along_time->singular_times.begin();
  const auto end = run.along_time->singular_times.end();
  for (const RunAlongTime::Point& point : run.along_time->points) {
    for (; singular != end && std::abs(*singular) <= std::abs(point.time); ++singular) {
      fmt::format_to(write, "{:.17g},{:.17g},singular,,\n", *singular, *singular * unit);
    }
    fmt::format_to(write, "{:.17g},{:.17g},", point.time, point.time * unit);
    if (point.exactness) fmt::format_to(write, "{:.6g}", *point.exactness);
    fmt::format_to(write, ",");
    if (std::isfinite(point.condition) && point.condition > 0) {
      fmt::format_to(write, "{:.6g}", point.condition);
    }
    fmt::format_to(write, ",{:.6g}\n", point.energy_error);
  }
  return fmt::to_string(out);
}

std::string relative_hamiltonian_csv(const PropagationResult& result) {
  const auto names = variable_names(result.scene.system);
  fmt::memory_buffer out;
  const auto write = std::back_inserter(out);
  fmt::format_to(write, "time_canonical");
  for (const std::size_t c : result.problem.components) fmt::format_to(write, ",e_{}", names[c]);
  fmt::format_to(write, ",coefficient\n");
  for (const RelativeHamiltonianResult& entry : result.relative_hamiltonians) {
    const SeriesSpace& space = entry.hamiltonian.space();
    for (std::size_t k = space.first(2); k < space.size(); ++k) {
      fmt::format_to(write, "{:.17g}", entry.time);
      for (const auto e : space.exponents(k)) fmt::format_to(write, ",{}", e);
      fmt::format_to(write, ",{}\n",
                     coefficient_digits(entry.hamiltonian[k], result.scene.precision));
    }
  }
  return fmt::to_string(out);
}

}  // namespace hamjet::io
