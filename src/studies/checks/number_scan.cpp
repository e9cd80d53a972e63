#include "number_scan.hpp"

#include <cmath>

namespace hamjet {
namespace {

class Scanner {
 public:
  explicit Scanner(Precision precision) : precision_(precision) {}

  void add(bool is_finite, const std::string& place) {
    ++result_.numbers;
    if (is_finite) return;
    if (result_.not_finite++ == 0) result_.first = place;
  }
  void add(double x, const std::string& place) { add(std::isfinite(x), place); }
  void add(const std::optional<double>& x, const std::string& place) {
    if (x) add(*x, place);
  }
  /// A number may be finite in extended precision although its stored copy is not.
  void add(const Series<Extended>& series, const std::string& place) {
    for (const Extended& x : series.coefficients()) {
      add(precision_ == Precision::extended ? bool(isfinite(x))
                                            : std::isfinite(static_cast<double>(x)),
          place);
    }
  }
  void add(const ExactnessResidual& residual, const std::string& place) {
    add(residual.absolute, place);
    add(residual.scaled, place);
    add(residual.at_formation_scale, place);
  }

  const NumberScan& result() const { return result_; }

 private:
  Precision precision_;
  NumberScan result_;
};

}  // namespace

NumberScan scan_numbers(const Scene& scene, const RunResult& run) {
  Scanner scanner(scene.precision);
  for (const auto& component : run.jet) scanner.add(component, "the jet");
  for (const double x : run.nominal_final) scanner.add(x, "the nominal");
  for (const NominalPoint& point : run.nominal) {
    for (const double x : point.state) scanner.add(x, "the nominal");
    scanner.add(point.energy_error, "the energy along the nominal");
  }
  scanner.add(run.energy_error, "the energy along the nominal");
  for (const SymplecticityDefect& entry : run.symplecticity) {
    scanner.add(entry.absolute, "the symplecticity by degree");
    scanner.add(entry.scaled, "the symplecticity by degree");
  }
  if (run.error_estimate.by_degree) {
    for (const double x : *run.error_estimate.by_degree) scanner.add(x, "the error estimate");
  }
  if (run.error_by_degree) {
    for (const double x : *run.error_by_degree) scanner.add(x, "the error by degree");
  }
  if (run.position_error_m) scanner.add(*run.position_error_m, "the position error");
  for (const KindResult& kind : run.kinds) {
    if (!kind.failure.empty()) continue;
    scanner.add(kind.condition, "the condition of " + kind.requested);
    for (const ExactnessEntry& entry : kind.by_degree) {
      scanner.add(entry.residual, "the exactness of " + kind.requested);
      if (entry.floor) scanner.add(*entry.floor, "the floor of " + kind.requested);
    }
    if (kind.generating_function) {
      scanner.add(*kind.generating_function, "the generating function " + kind.requested);
    }
  }
  return scanner.result();
}

}  // namespace hamjet
