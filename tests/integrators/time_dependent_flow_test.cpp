#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/integrators/arc_splitting.hpp"
#include "hamjet/integrators/cvode.hpp"
#include "hamjet/integrators/energy_conserving.hpp"
#include "hamjet/integrators/explicit_runge_kutta.hpp"
#include "hamjet/integrators/gauss_many.hpp"
#include "hamjet/integrators/midpoint.hpp"
#include "hamjet/integrators/newmark.hpp"
#include "hamjet/integrators/stormer_verlet.hpp"
#include "hamjet/integrators/symmetric_composition.hpp"
#include "hamjet/maps/symplecticity.hpp"
#include "integrators/taylor_flow.hpp"
#include "support/errors.hpp"
#include "support/flow.hpp"
#include "support/moving_fields.hpp"

namespace hamjet {
namespace {

using Problem = FlowProblem<double>;

/// A method with a number that says how fine its steps are, 1 or 2.
struct TimedMethod {
  std::string name;
  double tolerance;    ///< largest relative error of a degree on the flows below
  double least_ratio;  ///< of the errors with steps of which the second are half as long; 0 for
                       ///< controlled steps
  std::function<FlowJet<double>(const Problem&, int)> integrate;
};

/// Every method that takes systems with time.
std::vector<TimedMethod> methods() {
  std::vector<TimedMethod> result;
  const auto add = [&](const std::string& name, double tolerance, double ratio, auto integrate) {
    result.push_back({name, tolerance, ratio, [=](const Problem& problem, int fineness) {
                        IntegrationStatistics statistics;
                        return integrate(problem, fineness, statistics);
                      }});
  };
  add("Gauss", 1e-12, 0, [](const Problem& p, int, IntegrationStatistics& s) {
    return integrate_gauss<double>(p, test::adaptive(8, 1e-13), s);
  });
  add("Gauss with equal steps", 1e-11, 0, [](const Problem& p, int, IntegrationStatistics& s) {
    return integrate_gauss<double>(p, test::fixed_step(6, 0.1), s);
  });
  add("midpoint", 0.02, 3.6, [](const Problem& p, int n, IntegrationStatistics& s) {
    return integrate_gauss<double>(p, test::fixed_step(1, 0.02 / n), s);
  });
  add("Fehlberg", 1e-9, 0, [](const Problem& p, int, IntegrationStatistics& s) {
    ExplicitRungeKuttaSettings settings;
    settings.tolerance = 1e-12;
    return integrate_fehlberg78<double>(p, settings, s);
  });
  add("Stoermer", 0.2, 1.8, [](const Problem& p, int n, IntegrationStatistics& s) {
    StormerSettings settings;
    settings.step = 0.005 / n;
    return integrate_stormer<double>(p, settings, s);
  });
  add("velocity Verlet", 0.02, 3.6, [](const Problem& p, int n, IntegrationStatistics& s) {
    VelocityVerletSettings settings;
    settings.step = 0.02 / n;
    return integrate_velocity_verlet<double>(p, settings, s);
  });
  add("composition", 1e-10, 0, [](const Problem& p, int, IntegrationStatistics& s) {
    SymmetricCompositionSettings settings;
    settings.order = 8;
    settings.step = 0.04;
    return integrate_symmetric_composition<double>(p, settings, s);
  });
  add("Newmark", 0.02, 3.6, [](const Problem& p, int n, IntegrationStatistics& s) {
    NewmarkSettings settings;
    settings.step = 0.02 / n;
    return integrate_newmark<double>(p, settings, s);
  });
  if (cvode_available()) {
    for (const CvodeMethod method : {CvodeMethod::adams, CvodeMethod::bdf}) {
      add(method == CvodeMethod::adams ? "Adams" : "BDF", 1e-4, 0,
          [method](const Problem& p, int, IntegrationStatistics& s) {
            CvodeSettings settings;
            settings.method = method;
            settings.tolerance = 1e-10;
            return integrate_cvode(p, settings, s);
          });
    }
  }
  return result;
}

template <class Real>
double largest_error(const FlowJet<Real>& jet, const FlowJet<Extended>& exact) {
  double error = 0;
  for (int d = 0; d <= exact[0].space().order(); ++d) {
    error = test::larger(error, test::relative_error(jet, exact, d));
  }
  return error;
}

void expect_right(const test::Flow<double>& flow, const FlowJet<Extended>& exact) {
  for (const TimedMethod& method : methods()) {
    const Problem problem = test::problem_of(flow);
    const double error = largest_error(method.integrate(problem, 1), exact);
    EXPECT_LE(error, method.tolerance) << method.name;
    if (method.least_ratio == 0) continue;
    EXPECT_GE(error / largest_error(method.integrate(problem, 2), exact), method.least_ratio)
        << method.name;
  }
}

constexpr double own_frequency = 1.5;
constexpr double driving_frequency = 2.3;
constexpr double driving_force = 0.8;

DynamicalSystem driven_oscillator() {
  return make_system("driven oscillator", 1, [](auto q, auto p, const Expression& t) {
    return (square(p[0]) + own_frequency * own_frequency * square(q[0])) / 2 -
           driving_force * q[0] * cos(driving_frequency * t);
  });
}

/// q = c cos w t + a rotation of the rest, c = f / (w_0^2 - w^2).
FlowJet<Extended> exact_driven_motion(const test::Flow<double>& flow) {
  const Extended w0 = own_frequency;
  const Extended w = driving_frequency;
  const Extended c = Extended(driving_force) / (w0 * w0 - w * w);
  const Extended t0 = flow.start_time.in<Extended>();
  const Extended t1 = t0 + flow.duration;
  const Extended angle = w0 * flow.duration;
  const Extended q = flow.start[0] - c * cos(w * t0);
  const Extended p = flow.start[1] + c * w * sin(w * t0);
  const SpacePointer space = SeriesSpace::create(2, flow.order);
  FlowJet<Extended> jet(2, Series<Extended>(space));
  jet[0][0] = q * cos(angle) + p / w0 * sin(angle) + c * cos(w * t1);
  jet[1][0] = p * cos(angle) - q * w0 * sin(angle) - c * w * sin(w * t1);
  jet[0][1] = jet[1][2] = cos(angle);
  jet[0][2] = sin(angle) / w0;
  jet[1][1] = -w0 * sin(angle);
  return jet;
}

// A closed form, from a time that is not zero, forwards and backwards.
TEST(TimeDependentFlow, OfADrivenOscillatorIsItsClosedForm) {
  for (const double duration : {3.0, -2.0}) {
    const test::Flow<double> flow{driven_oscillator(), {0.4, -0.7}, duration, 2, {},
                                  ClockTime(0.7)};
    expect_right(flow, exact_driven_motion(flow));
  }
}

/// A Kepler problem whose centre moves by a(t), with the inertial force: H = p^2/2 - 1/|q - a| -
/// a''.q. The motion about the centre is Kepler's, so that deviations are those of Kepler's
/// problem. The square of the rate is exact in double.
constexpr double centre_rate = 1.75;
constexpr double centre_distance = 0.3;

DynamicalSystem moving_kepler(bool has_objects) {
  const auto centre = std::make_shared<const test::Turning>(centre_rate, 0.2, centre_distance);
  const auto field =
      std::make_shared<const test::PointMasses>(std::vector<test::PointMass>(1, {1, {0, 0, 0}}));
  return make_system("moving Kepler", 3, [&](auto q, auto p, const Expression& t) {
    std::vector<Expression> a = {centre_distance * cos(centre_rate * t + 0.2),
                                 centre_distance * sin(centre_rate * t + 0.2)};
    if (has_objects) a = time_values(centre, t);
    const std::array<Expression, 3> r = {q[0] - a[0], q[1] - a[1], q[2]};
    const Expression potential =
        has_objects ? field_value(field, r)
                    : -pow(square(r[0]) + square(r[1]) + square(r[2]), Expression(-0.5));
    const double square_of_rate = centre_rate * centre_rate;
    return test::MovingFields::kinetic(p) + potential +
           square_of_rate * (a[0] * q[0] + a[1] * q[1]);
  });
}

/// A shift of a state of Kepler's problem to that about the moving centre.
template <class Real>
void add_centre(std::vector<Real>& state, const Real& time) {
  using std::cos;
  using std::sin;
  const Real angle = Real(centre_rate) * time + Real(0.2);
  const Real size = centre_distance;
  const Real speed = size * Real(centre_rate);
  state[0] += size * cos(angle);
  state[1] += size * sin(angle);
  state[3] -= speed * sin(angle);
  state[4] += speed * cos(angle);
}

const std::vector<double> orbit_start = {1, 0.1, 0.2, -0.1, 0.9, 0.5};

template <class Real>
struct MovingOrbit {
  test::Flow<Real> flow;
  FlowJet<Extended> exact;
};

/// Integrates the flow about the moving centre, and computes the exact one from Kepler's problem,
/// which is autonomous.
template <class Real>
MovingOrbit<Real> moving_orbit(bool has_objects, double duration, int order) {
  const double start_time = -0.4;
  const test::Flow<Extended> still{
      kepler(), {orbit_start.begin(), orbit_start.end()}, Extended(duration), order, {}};
  MovingOrbit<Real> result{
      {moving_kepler(has_objects), {}, Real(duration), order, {}, ClockTime(start_time)},
      test::reference_jet(still, test::adaptive(14, 1e-24))};
  std::vector<Extended> beginning(orbit_start.begin(), orbit_start.end());
  add_centre<Extended>(beginning, Extended(start_time));
  for (const Extended& x : beginning) result.flow.start.push_back(convert<Real>(x));
  std::vector<Extended> end = test::final_state(result.exact);
  add_centre<Extended>(end, Extended(start_time) + Extended(duration));
  for (std::size_t i = 0; i < 6; ++i) result.exact[i][0] = end[i];
  return result;
}

TEST(TimeDependentFlow, AboutAMovingCentreIsKeplers) {
  for (const bool has_objects : {false, true}) {
    SCOPED_TRACE(has_objects);
    const auto orbit = moving_orbit<double>(has_objects, 2.0, 3);
    expect_right(orbit.flow, orbit.exact);
  }
}

TEST(TimeDependentFlow, AboutAMovingCentreIsKeplersInExtendedPrecision) {
  const auto orbit = moving_orbit<Extended>(true, 1.0, 2);
  EXPECT_LE(largest_error(test::run_gauss(orbit.flow, test::adaptive(10, 1e-26)), orbit.exact),
            1e-22);
}

// One more way of evaluation: orbits in lanes, each with steps, and so times, of its own.
TEST(TimeDependentFlow, InLanesIsThatOfEachAlone) {
  for (const bool has_objects : {false, true}) {
    for (int order = 0; order <= 2; ++order) {
      const auto orbit = moving_orbit<double>(has_objects, 3.0, order);
      const Problem problem = test::problem_of(orbit.flow);
      std::vector<std::vector<double>> starts;
      for (int k = 0; k < 5; ++k) {
        starts.push_back(problem.initial_state);
        starts.back()[4] *= 1 - 0.05 * k;
      }
      const auto outcomes = integrate_gauss_many(problem, starts, test::adaptive(8, 1e-12));
      for (std::size_t k = 0; k < starts.size(); ++k) {
        ASSERT_FALSE(outcomes[k].failure);
        EXPECT_FALSE(outcomes[k].was_alone);
        test::Flow<double> alone = orbit.flow;
        alone.start = starts[k];
        const auto jet = test::run_gauss(alone, test::adaptive(8, 1e-13));
        for (int d = 0; d <= order; ++d) {
          EXPECT_LE(test::relative_error(outcomes[k].jet, jet, d), 1e-10) << k << ", " << d;
        }
      }
    }
  }
}

TEST(TimeDependentFlow, InArcsIsThatOfOne) {
  const auto orbit = moving_orbit<double>(true, 6.0, 2);
  IntegrationStatistics statistics;
  ArcStatistics arcs;
  ArcSettings settings;
  settings.arcs = 3;
  const auto jet = integrate_in_arcs<double>(test::problem_of(orbit.flow), test::adaptive(8, 1e-13),
                                             settings, statistics, arcs);
  EXPECT_EQ(arcs.plan.arcs, 3u);
  EXPECT_LE(largest_error(jet, orbit.exact), 1e-11);
}

// By Taylor's method in the time, which takes the powers of the time from the objects.
TEST(TimeDependentFlow, ByPowersOfTheTimeIsKeplers) {
  for (const bool has_objects : {false, true}) {
    const std::vector<double> times = {0.3, -1.1, 2.0, 1e-3};
    std::vector<double> states;
    for (std::size_t k = 0; k < times.size(); ++k) {
      const auto orbit = moving_orbit<double>(has_objects, times[k], 1);
      states.insert(states.end(), orbit.flow.start.begin(), orbit.flow.start.end());
    }
    TaylorFlow(moving_kepler(has_objects)).advance(states, ClockTime(-0.4), times);
    for (std::size_t k = 0; k < times.size(); ++k) {
      const auto exact = moving_orbit<double>(has_objects, times[k], 1).exact;
      for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(states[6 * k + i], static_cast<double>(exact[i][0]), 1e-13) << times[k];
      }
    }
  }
}

// The same potential by objects and by ordinary operations, at every order.
TEST(TimeDependentFlow, WithObjectsIsThatOfOrdinaryOperations) {
  const test::MovingFields fields;
  for (int order = 1; order <= 6; ++order) {
    test::Flow<double> flow{fields.recorded(), {1.2, 0.1, 0.2, -0.1, 0.8, 0.4}, 1.5, order, {},
                            ClockTime(2.0)};
    const auto expected = convert_map<Extended>(test::run_gauss(flow));
    flow.system = fields.with_objects();
    EXPECT_LE(largest_error(test::run_gauss(flow), expected), 1e-12) << order;
  }
}

// The rotating field against the same in rotating axes, where the system is autonomous and Jacobi's
// integral is its energy.
TEST(TimeDependentFlow, OfARotatingFieldKeepsJacobisIntegral) {
  const test::MovingFields fields;
  const double duration = 8;
  const std::vector<double> beginning = {1.2, 0.1, 0.2, -0.1, 0.8, 0.4};
  const test::Flow<double> rotating{fields.in_rotating_axes(), beginning, duration, 3, {}};
  const auto expected = test::run_gauss(rotating);
  const DynamicalSystem system =
      with_uniform_rotation(fields.turning_body(), {{{0, 1}}, fields.rate});
  const test::Flow<double> flow{system, beginning, duration, 3, {}};
  const auto jet = test::run_gauss(flow);
  // At the beginning the axes agree, at the end they differ by the angle of the rotation.
  const Extended angle = Extended(fields.rate) * duration;
  FlowJet<Extended> turned = convert_map<Extended>(expected);
  for (const std::size_t i : {0, 3}) {
    const Series<Extended> x = turned[i];
    turned[i] = cos(angle) * x - sin(angle) * turned[i + 1];
    turned[i + 1] = sin(angle) * x + cos(angle) * turned[i + 1];
  }
  EXPECT_LE(largest_error(jet, turned), 1e-11);
  DifferentiableFunction<double> integral(*conserved_list(system));
  integral.evaluate(beginning, 0.0);
  const double at_start = integral.value(0);
  EXPECT_NEAR(at_start, test::energy(fields.in_rotating_axes(), beginning), 1e-15);
  integral.evaluate(test::final_state(jet), duration);
  EXPECT_NEAR(integral.value(0), at_start, 1e-13);
  // The energy itself is not kept.
  DifferentiableFunction<double> energy(system.hamiltonian);
  energy.evaluate(beginning, 0.0);
  const double energy_at_start = energy.value(0);
  energy.evaluate(test::final_state(jet), duration);
  EXPECT_GT(std::abs(energy.value(0) - energy_at_start), 1e-4);
}

TEST(TimeDependentFlow, IsSymplecticToRounding) {
  const test::MovingFields fields;
  const test::Flow<double> flow{fields.with_objects(), {1.2, 0.1, 0.2, -0.1, 0.8, 0.4}, 3.0, 5, {},
                                ClockTime(2.0)};
  for (const TimedMethod& method : methods()) {
    const bool is_symplectic = method.name.find("Gauss") == 0 || method.name == "midpoint" ||
                               method.name == "Stoermer" || method.name == "composition" ||
                               method.name == "velocity Verlet";
    if (!is_symplectic) continue;
    for (const auto& defect :
         symplecticity_by_degree(method.integrate(test::problem_of(flow), 1))) {
      EXPECT_LE(defect.scaled, 1e-13) << method.name << ", degree " << defect.degree;
    }
  }
}

// Shifts in time are left out of autonomous systems alone.
TEST(TimeDependentFlow, HasNoShiftInTime) {
  const auto orbit = moving_orbit<double>(true, 2.0, 2);
  Problem problem = test::problem_of(orbit.flow);
  problem.symmetry = FlowSymmetry::rotation_and_time;
  IntegrationStatistics statistics;
  const auto jet = integrate_gauss<double>(problem, test::adaptive(), statistics);
  EXPECT_EQ(statistics.left_out, FlowSymmetry::none);
  EXPECT_LE(largest_error(jet, orbit.exact), 1e-12);
}

// Steps see the waves of a field that an object declares.
TEST(TimeDependentFlow, SamplesTheWavesOfItsFields) {
  const test::MovingFields fields;
  const auto steps = [&](int waves) {
    test::Flow<double> flow{
        fields.with_objects(waves), {1.2, 0.1, 0.2, -0.1, 0.8, 0.4}, 6.0, 0, {}};
    IntegrationStatistics statistics;
    test::run_gauss(flow, test::adaptive(8, 1e-8), &statistics);
    return statistics.steps;
  };
  EXPECT_GT(steps(70), 2 * steps(0));
}

// A step of the midpoint rule takes the Hamiltonian at its middle: on q' = p, p' = t the end is q +
// p h + h^2 t_m / 2, p + h t_m.
TEST(TimeDependentFlow, TakesMidpointStepsAtTheirMiddle) {
  const DynamicalSystem system = make_system(
      "pushed", 1, [](auto q, auto p, const Expression& t) { return square(p[0]) / 2 - t * q[0]; });
  RecordedHamiltonian<double> hamiltonian(system);
  const Vector<double> z{{0.5, -0.25}};
  test::expect_error(ErrorKind::usage, "depends on the time",
                     [&] { midpoint_step<double>(hamiltonian, z, 0.5); });
  hamiltonian.set_time(2.25);
  const Vector<double> end = midpoint_step<double>(hamiltonian, z, 0.5);
  EXPECT_NEAR(end(0), 0.5 - 0.125 + 0.125 * 2.25, 1e-15);
  EXPECT_NEAR(end(1), -0.25 + 0.5 * 2.25, 1e-15);
}

TEST(TimeDependentFlow, IsRefusedByMethodsThatConserveEnergy) {
  EnergyConservingProblem<double> problem;
  problem.system = driven_oscillator();
  problem.initial_state = {0.4, -0.7};
  problem.first_step = 0.1;
  problem.duration = 1;
  test::expect_error(ErrorKind::usage, "depends on the time",
                     [&] { integrate_energy_conserving<double>(problem); });
}

// The energy that changes with the time is no failure, and a collision still is one.
TEST(TimeDependentFlow, OfACollisionIsRefused) {
  test::Flow<double> flow{moving_kepler(true), {1, 0, 0, 0, 0, 0}, 3.0, 1, {}, ClockTime(-0.4)};
  std::vector<double> beginning = {1, 0, 0, 0, 0, 0};
  add_centre(beginning, -0.4);
  flow.start = beginning;
  for (const TimedMethod& method : methods()) {
    if (method.name != "Fehlberg" && method.name != "Gauss" && method.name != "Adams") continue;
    EXPECT_THROW(method.integrate(test::problem_of(flow), 1), Error) << method.name;
  }
}

}  // namespace
}  // namespace hamjet
