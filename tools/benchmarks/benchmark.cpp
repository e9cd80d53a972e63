#include <fmt/format.h>

#include <string>

#include "cases.hpp"

/// Without arguments all benchmarks; otherwise those named: products, evaluation, inversion,
/// integrators, orders, savings, zonals, own, fields, arcs, many.
int main(int argc, char** argv) {
  using namespace hamjet::benchmarks;
  const auto wanted = [&](const std::string& name) {
    if (argc == 1) return true;
    for (int i = 1; i < argc; ++i) {
      if (name == argv[i]) return true;
    }
    return false;
  };
  fmt::print(
      "single thread but for arcs; medians of interleaved repeats: compare ratios within one "
      "table\n");
  if (wanted("products")) benchmark_products();
  if (wanted("evaluation")) benchmark_evaluation();
  if (wanted("inversion")) benchmark_inversion();
  if (wanted("integrators")) benchmark_integrators();
  if (wanted("orders")) benchmark_orders();
  if (wanted("savings")) benchmark_savings();
  if (wanted("zonals")) benchmark_zonals();
  if (wanted("own")) benchmark_own();
  if (wanted("fields")) {
    benchmark_fields();
    benchmark_earth_maps();
  }
  if (wanted("arcs")) benchmark_arcs();
  if (wanted("many")) benchmark_many();
}
