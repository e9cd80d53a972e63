// Everything that a scene of a file gets, for a Hamiltonian of one's own: reference, self-checks,
// error estimate, generating function and exactness, and a comparison with its report.

#include <cmath>
#include <cstdio>
#include <hamjet/hamjet.hpp>
#include <span>

namespace {

/// Hénon and Heiles, Astronomical Journal 69 (1964) 73.
struct HenonHeiles {
  template <class T>
  T operator()(std::span<const T> q, std::span<const T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + q[0] * q[0] + q[1] * q[1]) / T(2) + q[0] * q[0] * q[1] -
           q[1] * q[1] * q[1] / T(3);
  }
};

}  // namespace

int main() {
  hamjet::Scene scene = hamjet::make_scene(hamjet::make_system("henon-heiles", 2, HenonHeiles{}),
                                           {0.1, 0.2, 0.25, 0}, 20, 4);
  scene.integrators = {
      {.label = "gauss8", .stages = 8, .tolerance = 1e-12},
      {.label = "fehlberg78", .method = hamjet::IntegrationMethod::fehlberg78, .tolerance = 1e-12}};
  scene.kinds = {"F1"};
  scene.separation = 1e-3;
  scene.reference = hamjet::ReferenceSettings{};
  const auto propagation = hamjet::propagate(scene);
  std::printf("%s\n", hamjet::io::summary_table(propagation).c_str());
  scene.comparison.tolerances = {1e-4, 1e-8, 1e-12};
  hamjet::ComparisonResult comparison;
  hamjet::compare(scene, {}, comparison);
  hamjet::io::OutputDirectory output("out/henon-heiles");
  hamjet::io::write_report(
      hamjet::io::make_report(comparison, {"report", "", "", "", "gnuplot"}, {}), output);
  return hamjet::exit_code(propagation);
}
