#include <cmath>

#include "../../src/studies/integration.hpp"
#include "properties/random_flows.hpp"

// Symmetries that a method shares with the flow to the last bit, for round-off is symmetric too:
// signs change no rounding, and neither do powers of two.

namespace hamjet {
namespace {

constexpr std::size_t z = 2, pz = 5;

IntegratorSettings with_steps(IntegrationMethod method, double step, int order = 2) {
  IntegratorSettings settings;
  settings.method = method;
  settings.order = order;
  settings.stages = 3;
  settings.step_canonical = step;
  return settings;
}

/// What is tested for each of them: fixed steps, for those that a tolerance chooses are compared
/// with numbers that a scaling changes.
std::vector<IntegratorSettings> methods(double step) {
  return {with_steps(IntegrationMethod::velocity_verlet, step),
          with_steps(IntegrationMethod::velocity_verlet, step, 6),
          with_steps(IntegrationMethod::stormer, step),
          with_steps(IntegrationMethod::fehlberg78, step),
          with_steps(IntegrationMethod::gauss, step)};
}

FlowJet<double> run(const test::Flow<double>& flow, const IntegratorSettings& settings) {
  IntegrationStatistics statistics;
  return integrate<double>(test::problem_of(flow), settings, statistics, {});
}

/// -1 for an odd sum of the exponents in these variables.
double parity(std::span<const std::uint8_t> exponents, std::initializer_list<std::size_t> odd) {
  int sum = 0;
  for (const std::size_t variable : odd) sum += exponents[variable];
  return sum % 2 == 0 ? 1 : -1;
}

bool is_one_of(std::size_t i, std::initializer_list<std::size_t> odd) {
  return std::find(odd.begin(), odd.end(), i) != odd.end();
}

/// Requires jet = S image S bit by bit, where S changes the sign of the variables `odd`.
void require_reflected(const FlowJet<double>& jet, const FlowJet<double>& image,
                       std::initializer_list<std::size_t> odd) {
  for (std::size_t i = 0; i < jet.size(); ++i) {
    for (std::size_t k = 0; k < jet[i].size(); ++k) {
      const double sign =
          parity(jet[i].space().exponents(k), odd) * (is_one_of(i, odd) ? -1.0 : 1.0);
      RC_ASSERT(jet[i][k] == sign * image[i][k]);
    }
  }
}

// North and south exchanged, the odd zonal coefficients change their sign.
TEST(Symmetries, MirrorAtTheEquator) {
  test::expect_property(
      [] {
        const auto orbit = test::random_orbit();
        auto image = orbit;
        for (const int n : {3, 5}) image.field.J[n] = -orbit.field.J[n];
        image.start[z] = -orbit.start[z];
        image.start[pz] = -orbit.start[pz];
        for (const IntegratorSettings& settings : methods(0.1)) {
          require_reflected(run(orbit.flow(3), settings), run(image.flow(3), settings), {z, pz});
        }
      },
      25);
}

// Phi_(-t) R = R Phi_t with R the change of sign of the momenta.
TEST(Symmetries, MirrorOfTime) {
  test::expect_property(
      [] {
        const auto orbit = test::random_orbit();
        auto image = orbit;
        for (std::size_t i = 3; i < 6; ++i) image.start[i] = -orbit.start[i];
        image.duration = -orbit.duration;
        for (const IntegratorSettings& settings : methods(0.1)) {
          require_reflected(run(orbit.flow(3), settings), run(image.flow(3), settings), {3, 4, 5});
        }
      },
      25);
}

// Lengths times 4^k and times times 8^k leave mu = length^3 / time^2 as it is.
TEST(Symmetries, PowersOfTwo) {
  test::expect_property(
      [] {
        const auto orbit = test::random_orbit();
        const int k = *test::whole_number(-15, 15).as("k");
        const double length = std::ldexp(1, 2 * k);
        const double time = std::ldexp(1, 3 * k);
        const auto unit = [&](std::size_t i) { return i < 3 ? length : length / time; };
        auto image = orbit;
        image.field.radius = orbit.field.radius * length;
        for (std::size_t i = 0; i < 6; ++i) image.start[i] = orbit.start[i] * unit(i);
        image.duration = orbit.duration * time;
        const auto settings = methods(0.1);
        const auto scaled = methods(0.1 * time);
        for (std::size_t m = 0; m < settings.size(); ++m) {
          const auto jet = run(orbit.flow(3), settings[m]);
          const auto other = run(image.flow(3), scaled[m]);
          for (std::size_t i = 0; i < 6; ++i) {
            for (std::size_t c = 0; c < jet[i].size(); ++c) {
              double scale = unit(i);
              const auto exponents = jet[i].space().exponents(c);
              for (std::size_t v = 0; v < 6; ++v) {
                for (int e = 0; e < exponents[v]; ++e) scale /= unit(v);
              }
              RC_ASSERT(other[i][c] == scale * jet[i][c]);
            }
          }
        }
      },
      25);
}

// A coefficient does not depend on how many degrees above it are computed. (Steps that a tolerance
// chooses are shorter for higher orders.)
TEST(Symmetries, LowerOrdersAreCutOffHigherOnes) {
  test::expect_property(
      [] {
        const auto orbit = test::random_orbit();
        const int high = *test::whole_number(2, 5).as("order");
        const int low = *test::whole_number(1, 4).as("lower order");
        RC_PRE(low < high);
        for (const IntegratorSettings& one : methods(0.25)) {
          const auto long_jet = run(orbit.flow(high), one);
          const auto short_jet = run(orbit.flow(low), one);
          for (std::size_t i = 0; i < 6; ++i) {
            for (std::size_t k = 0; k < short_jet[i].size(); ++k) {
              RC_ASSERT(short_jet[i][k] == long_jet[i][k]);
            }
          }
        }
      },
      25);
}

}  // namespace
}  // namespace hamjet
