#include <cmath>

#include "maps/legendre_transformation.hpp"
#include "properties/random_flows.hpp"
#include "support/map.hpp"

// Identities that hold for every Hamiltonian flow, coefficient by coefficient, and need no
// reference; they are tested on random flows. Differences are compared with the sum of the
// magnitudes of the terms that cancel.

namespace hamjet {
namespace {

/// The steps are so short that order 16 leaves only round-off: at most 250 steps, each with some
/// units of 1e-16. A wrong coefficient leaves 1e-3 or more.
constexpr double bound = 1e-12;
const GaussSettings short_steps = test::fixed_step(8, 0.02);

/// A function of the state as a series about a point, without its constant.
template <class Function>
Series<double> about(const std::vector<double>& point, const SpacePointer& space,
                     const Function& function) {
  std::vector<Series<double>> z;
  for (std::size_t i = 0; i < point.size(); ++i) {
    z.push_back(Series<double>::variable(space, i, point[i]));
  }
  Series<double> result = function(z);
  result[0] = 0;
  return result;
}

/// f(Phi(z)) = f(z), both as series about their points.
template <class Function>
double change_along(const FlowJet<double>& jet, const std::vector<double>& start,
                    const Function& function) {
  const SpacePointer& space = jet[0].space_pointer();
  const std::vector<Series<double>> at_end = {about(test::final_state(jet), space, function)};
  const std::vector<Series<double>> at_start = {about(start, space, function)};
  const auto deviations = without_constants(jet);
  return test::largest_ratio(
      test::composed(at_end, deviations), at_start,
      test::composed(test::magnitudes(at_end), test::magnitudes(deviations)));
}

auto hamiltonian_of(const DynamicalSystem& system) {
  return [&system](const std::vector<Series<double>>& z) {
    return evaluate_on_series<double>(system.hamiltonian, z)[0];
  };
}

TEST(FlowIdentities, EnergyOfRandomSystems) {
  test::expect_property(
      [] {
        const auto flow = test::random_flow<double>(4);
        const auto jet = test::run_gauss(flow, short_steps);
        RC_ASSERT(change_along(jet, flow.start, hamiltonian_of(flow.system)) <= bound);
      },
      150);
}

// About the axis of symmetry of J2 and J3 the angular momentum is conserved too.
TEST(FlowIdentities, EnergyAndAngularMomentumOfOrbits) {
  test::expect_property(
      [] {
        const auto orbit = test::random_orbit();
        const auto flow = orbit.flow(3);
        const auto jet = test::run_gauss(flow, short_steps);
        RC_ASSERT(change_along(jet, flow.start, hamiltonian_of(flow.system)) <= bound);
        const auto axial = [](const std::vector<Series<double>>& z) {
          return z[0] * z[4] - z[1] * z[3];
        };
        RC_ASSERT(change_along(jet, flow.start, axial) <= bound);
      },
      60);
}

/// Phi_(s+t) = Phi_t o Phi_s.
void check_composition(const test::Flow<double>& flow, double part) {
  const double s = part * flow.duration;
  const auto whole = test::run_gauss(flow, short_steps);
  const auto first = test::jet_from(flow, flow.start, s, short_steps);
  const auto second =
      test::jet_from(flow, test::final_state(first), flow.duration - s, short_steps);
  const auto outer = without_constants(second);
  const auto inner = without_constants(first);
  RC_ASSERT(test::largest_ratio(test::composed(outer, inner), without_constants(whole),
                                test::composed(test::magnitudes(outer), test::magnitudes(inner))) <=
            bound);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    RC_ASSERT(std::abs(whole[i][0] - second[i][0]) <= bound);
  }
}

TEST(FlowIdentities, CompositionOfRandomSystems) {
  test::expect_property(
      [] {
        const auto flow = test::random_flow<double>(4);
        check_composition(flow, *test::number(0.1, 0.9).as("part"));
      },
      100);
}

TEST(FlowIdentities, CompositionOfOrbits) {
  test::expect_property(
      [] {
        const auto orbit = test::random_orbit();
        check_composition(orbit.flow(3), *test::number(0.1, 0.9).as("part"));
      },
      30);
}

// The flow backwards is the inverse, and so is the inverted series.
TEST(FlowIdentities, Inverse) {
  test::expect_property(
      [] {
        const auto flow = test::random_flow<double>(4);
        const auto there = test::run_gauss(flow, short_steps);
        const auto back =
            test::jet_from(flow, test::final_state(there), -flow.duration, short_steps);
        const auto identity = test::identity_map<double>(there[0].space_pointer());
        const auto map = without_constants(there);
        const auto reverse = without_constants(back);
        RC_ASSERT(test::largest_ratio(
                      test::composed(reverse, map), identity,
                      test::composed(test::magnitudes(reverse), test::magnitudes(map))) <= bound);
        const auto inverted = inverse(map);
        RC_ASSERT(test::largest_ratio(
                      test::composed(inverted, map), identity,
                      test::composed(test::magnitudes(inverted), test::magnitudes(map))) <= bound);
      },
      100);
}

// All kinds of generating function belong to one map: the Legendre transformation of one kind
// equals the other kind formed from the jet. (Any symplectic map will do, so that the steps are
// coarse.) The test is in extended precision, because a kind is as accurate as the condition of its
// inversion allows; if the condition is too large, the case is left out.
TEST(FlowIdentities, KindsOfGeneratingFunction) {
  constexpr double worst_condition = 1e3;
  test::expect_property(
      [] {
        const auto flow = test::random_flow<Extended>(2);
        const std::size_t n = flow.system.degrees_of_freedom;
        const auto jet = test::run_gauss(flow, test::fixed_step(2, 0.05));
        const auto map = without_constants(jet);
        std::vector<PartialInversion<Extended>> inversions;
        for (const char* kind : {"F1", "F2", "F3", "F4"}) {
          const std::vector<Series<Extended>>& span = map;
          const Matrix<Extended> block = inverted_block(span, parse_kind(kind, n));
          const double size = static_cast<double>(block.cwiseAbs().maxCoeff());
          if (size < 1e-2 || condition_number(block) > worst_condition) continue;
          inversions.push_back(test::inverted_jet(map, kind));
        }
        RC_PRE(inversions.size() >= 2);
        // The transformation goes there and back between the first kind and each other kind.
        const auto require_same = [](const auto& from, const auto& to) {
          const auto direct = generating_function(one_form(to));
          const auto other =
              legendre_transformation(generating_function(one_form(from)), from.kind, to.kind);
          const double scale = test::largest_coefficient(direct);
          RC_ASSERT(test::largest_coefficient(direct - other) <= 1e-20 * scale);
        };
        for (std::size_t i = 1; i < inversions.size(); ++i) {
          require_same(inversions[0], inversions[i]);
          require_same(inversions[i], inversions[0]);
        }
      },
      60);
}

// A linear system's flow is linear: exact zeros.
TEST(FlowIdentities, LinearSystems) {
  test::expect_property(
      [] {
        const auto n = *test::whole_number(1, 3).as("degrees of freedom");
        test::RandomNumbers random(
            static_cast<unsigned>(*test::whole_number(0, 1 << 30).as("seed of the matrix")));
        const auto matrix = test::random_symmetric<double>(2 * n, random);
        test::Flow<double> flow{test::quadratic_system(matrix), {}, 0, 4, {}};
        for (int i = 0; i < 2 * n; ++i) flow.start.push_back(random.uniform(-1, 1));
        flow.duration = *test::number(0.1, 3).as("duration");
        const auto jet = test::run_gauss(flow, short_steps);
        for (const auto& component : jet) {
          for (int degree = 2; degree <= 4; ++degree) {
            RC_ASSERT(test::largest_of_degree(component, degree) == 0.0);
          }
        }
        // The jet's linear part is the exponential of J S t.
        const Matrix<double> exact = test::hamiltonian_exponential<double>(matrix * flow.duration);
        const Matrix<double> linear = linear_part(jet);
        RC_ASSERT(test::largest_entry(linear - exact) <= 1e-12 * test::largest_entry(exact));
      },
      60);
}

}  // namespace
}  // namespace hamjet
