#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "energy_optimal_flights.hpp"
#include "hamjet/scene/scene_reader.hpp"

// Flights by a law of feedback, and as planned, under errors drawn at random, beside the linear
// theory of Clohessy and Wiltshire written by hand.

namespace hamjet::thrusted {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix63 = Eigen::Matrix<double, 6, 3>;

/// Motion relative to a circle along R, T, N in time units of 1 / n, after Clohessy and Wiltshire
/// (1960): x'' = 3 x + 2 y', y'' = -2 x', z'' = -z.
Matrix6 transition(double t) {
  const double s = std::sin(t), c = std::cos(t);
  Matrix6 phi;
  phi << 4 - 3 * c, 0, 0, s, 2 * (1 - c), 0,              //
      6 * (s - t), 1, 0, -2 * (1 - c), 4 * s - 3 * t, 0,  //
      0, 0, c, 0, 0, s,                                   //
      3 * s, 0, 0, c, 2 * s, 0,                           //
      -6 * (1 - c), 0, 0, -2 * s, 4 * c - 3, 0,           //
      0, 0, -s, 0, 0, c;
  return phi;
}

Matrix63 driven(double t) { return transition(t).rightCols<3>(); }

template <class Result, class Function>
Result integral(double from, double to, const Function& f) {
  Result sum = Result::Zero();
  using Rule = boost::math::quadrature::gauss<double, 20>;
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
    for (const double sign : {-1.0, 1.0}) {
      const double t = (from + to) / 2 + sign * Rule::abscissa()[i] * (to - from) / 2;
      sum += Rule::weights()[i] * (to - from) / 2 * f(t);
    }
  }
  return sum;
}

/// Second moments of a linear deviation from the plan at the end, and of the cost.
struct Expected {
  Matrix6 closed = Matrix6::Zero();
  Matrix6 open = Matrix6::Zero();
  double energy = 0;         ///< of the plan
  double closed_energy = 0;  ///< the mean of the closed loop's
};

/// The theory for lengths in m and times in 1 / n.
Expected linear_theory(const Vector6& start, const Vector6& end, double duration, int instants,
                       const Vector6& navigation, double magnitude, double direction) {
  Expected expected;
  const double h = duration / instants;
  const auto gramian = [&](double from, double to) {
    return integral<Matrix6>(from, to, [&](double t) -> Matrix6 {
      return driven(duration - t) * driven(duration - t).transpose();
    });
  };
  const Vector6 multiplier = gramian(0, duration).inverse() * (transition(duration) * start - end);
  const auto plan = [&](double t) -> Eigen::Vector3d {
    return -driven(duration - t).transpose() * multiplier;
  };
  const auto energy_between = [&](double from, double to) {
    using One = Eigen::Matrix<double, 1, 1>;
    return integral<One>(from, to, [&](double t) { return One(plan(t).squaredNorm() / 2); })(0);
  };
  expected.energy = energy_between(0, duration);
  expected.closed_energy = expected.energy;
  const Matrix6 noise = navigation.cwiseAbs2().asDiagonal();
  for (int k = 0; k < instants; ++k) {
    const double from = k * h, to = (k + 1) * h;
    const Matrix6 gain = gramian(from, duration).inverse() * transition(duration - from);
    // The law of an instant commands u = -(Phi B)^T gain x until the next one.
    const Matrix6 pushed = integral<Matrix6>(from, to, [&](double t) -> Matrix6 {
      return driven(to - t) * driven(duration - t).transpose();
    });
    expected.closed_energy +=
        (gain.transpose() * gramian(from, to) * gain * (expected.closed + noise)).trace() / 2;
    // A thrust that is turned lacks direction^2 of its size on average, along itself. To make up
    // for that later costs lambda_v . (direction^2 u) = direction^2 |u|^2 in each time.
    if (k + 1 < instants) {
      expected.closed_energy += direction * direction * energy_between(from, to) * 2;
    }
    const Matrix6 corrected = pushed * gain;
    const Matrix6 kept = transition(h) - corrected;
    Matrix6 made = Matrix6::Zero();
    const Vector6 stretched =
        integral<Vector6>(from, to, [&](double t) -> Vector6 { return driven(to - t) * plan(t); });
    made += magnitude * magnitude * stretched * stretched.transpose();
    for (Eigen::Index i = 0; i < 3; ++i) {
      // An error of direction stays the same along inertial axes.
      const Vector6 turned = integral<Vector6>(from, to, [&](double t) -> Vector6 {
        const double angle = -(t - from);
        Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
        axis = {std::cos(angle) * axis[0] - std::sin(angle) * axis[1],
                std::sin(angle) * axis[0] + std::cos(angle) * axis[1], axis[2]};
        return driven(to - t) * axis.cross(plan(t));
      });
      made += direction * direction * turned * turned.transpose();
    }
    expected.closed = (kept * expected.closed * kept.transpose() +
                       corrected * noise * corrected.transpose() + made)
                          .eval();
    expected.open = (transition(h) * expected.open * transition(h).transpose() + made).eval();
  }
  expected.closed_energy *= 1 + magnitude * magnitude;
  return expected;
}

Scene circle_with_errors() {
  Scene scene = kepler_chief(0, 7000, std::sqrt(std::pow(7000, 3) / 398600.4418), 1);
  TransferSettings settings;
  settings.start.position_m = {30, -600, 200};
  settings.start.velocity_m_s = {0.02, 0.01, -0.05};
  settings.end.position_m = {0, -50, 0};
  settings.times = {4.0};
  settings.thrust = TransferThrust::energy_optimal;
  settings.thrust_order = 2;
  settings.refined_miss_m = 1e-5;
  settings.feedback = 6;
  settings.errors.emplace();
  scene.transfer = settings;
  return scene;
}

const FeedbackLaw& law_of(const TransferResult& result) { return *result.thrust->feedback; }

/// The mean of a number of the samples' flights, and four times its standard error by their own
/// scatter.
template <class Value>
std::pair<double, double> mean_and_allowance(const std::vector<ErrorSample>& samples,
                                             const Value& value) {
  double sum = 0, squares = 0;
  const auto count = static_cast<double>(samples.size());
  for (const ErrorSample& sample : samples) sum += value(sample);
  const double mean = sum / count;
  for (const ErrorSample& sample : samples) squares += std::pow(value(sample) - mean, 2);
  return {mean, 4 * std::sqrt(squares / (count - 1) / count)};
}

TEST(ErroneousFlights, WithoutErrorsBothLoopsAreTheFlightsThatThereWere) {
  Scene scene = circle_with_errors();
  scene.transfer->errors->samples = 2;
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.thrust && result.thrust->feedback) << result.thrust->failure;
  const FeedbackLaw& law = law_of(result);
  const EnergyOptimalTransfer& plan = result.thrust->transfers.front();
  ASSERT_EQ(law.failure, "");
  ASSERT_EQ(law.samples.size(), 2u);
  for (const ErrorSample& sample : law.samples) {
    // What rounding grows to over these flights of 7000 km.
    EXPECT_NEAR(sample.closed_loop.miss_m, law.miss_m, 1e-6);
    EXPECT_NEAR(sample.open_loop.miss_m, plan.refined->miss_m, 1e-6);
    for (const ErroneousFlight* flight : {&sample.closed_loop, &sample.open_loop}) {
      EXPECT_EQ(flight->failure, "");
      EXPECT_LT(flight->miss_m, 1e-3);
      EXPECT_LT(flight->velocity_miss_m_s, 1e-6);
    }
    EXPECT_NEAR(sample.closed_loop.energy_m2_s3, law.energy_m2_s3, 1e-10 * law.energy_m2_s3);
    EXPECT_NEAR(sample.open_loop.energy_m2_s3, plan.energy_m2_s3, 1e-10 * plan.energy_m2_s3);
    EXPECT_NEAR(sample.closed_loop.change_m_s, law.change_m_s, 1e-10 * law.change_m_s);
    EXPECT_NEAR(sample.open_loop.change_m_s, plan.change_m_s, 1e-8 * plan.change_m_s);
  }
}

// The edges of the Earth's shadow are times at which no step passes over the change of the light,
// in the plan as in the flights by it: both end where the answer was corrected to.
TEST(ErroneousFlights, ThroughAShadowThePlanIsFlownToRounding) {
  const std::string text = R"(
system = { model = "earth", gravity_degree = 2, radiation = true }
spacecraft = { radiation_m2_kg = 0.05 }
nominal = { epoch_utc = "2026-03-01T06:00:00", height_km = 400, i_deg = 97.5, raan_deg = 30, u_deg = 0 }
jet = { order = 1, duration_s = 7200 }
transfer = { times_s = 7200, thrust = "energy-optimal", thrust_order = 2, feedback = 3, errors = { samples = 10 }, start = { position_m = [0, -5000, 1000] }, end = { position_m = [0, -100, 0] } }
)";
  const TransferResult result = study_transfer(io::parse_scene(text, "shadow.toml"));
  ASSERT_TRUE(result.thrust && result.thrust->feedback) << result.thrust->failure;
  const ErroneousFlight& open = law_of(result).samples.front().open_loop;
  EXPECT_NEAR(open.miss_m, result.thrust->transfers.front().refined->miss_m, 1e-6);
}

/// Errors that are small beside the plan make deviations that are linear in them: the mean of the
/// squared misses is the trace of the covariance that gain and noise make, and the mean cost that
/// of the plan plus what corrections take. What is left out, products of two errors (1 %), is less
/// than the scatter of so many samples.
void expect_linear_theory(int count) {
  Scene scene = circle_with_errors();
  ThrustErrorSettings& errors = *scene.transfer->errors;
  errors.navigation.position_m = {1, 2, 0.5};
  errors.navigation.velocity_m_s = {1e-3, 5e-4, 2e-3};
  errors.magnitude = 0.02;
  errors.direction_deg = 1.5;
  errors.samples = count;
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.thrust && result.thrust->feedback) << result.thrust->failure;
  const std::vector<ErrorSample>& samples = law_of(result).samples;
  ASSERT_EQ(samples.size(), static_cast<std::size_t>(count));

  const double second = scene.units.time_s;
  const auto six = [&](const RelativeState& state) {
    Vector6 x;
    x << state.position_m, state.velocity_m_s * second;
    return x;
  };
  const Expected expected = linear_theory(
      six(scene.transfer->start), six(scene.transfer->end), 4, scene.transfer->feedback,
      six(errors.navigation), errors.magnitude, errors.direction_deg * std::numbers::pi / 180);
  // Misses in velocity are those of inertial velocities: v + (-y, x, 0).
  Matrix6 inertial = Matrix6::Identity();
  inertial(3, 1) = -1;
  inertial(4, 0) = 1;
  for (const bool is_closed : {true, false}) {
    const auto flight = [&](const ErrorSample& sample) -> const ErroneousFlight& {
      return is_closed ? sample.closed_loop : sample.open_loop;
    };
    const Matrix6 covariance =
        inertial * (is_closed ? expected.closed : expected.open) * inertial.transpose();
    const double place = covariance.topLeftCorner<3, 3>().trace();
    const double velocity = covariance.bottomRightCorner<3, 3>().trace() / (second * second);
    const auto [squares, allowed] = mean_and_allowance(
        samples, [&](const ErrorSample& one) { return std::pow(flight(one).miss_m, 2); });
    EXPECT_LT(allowed, 8 * place / std::sqrt(count));
    EXPECT_NEAR(squares, place, allowed) << (is_closed ? "closed" : "open");
    const auto [rates, allowed_rates] = mean_and_allowance(samples, [&](const ErrorSample& one) {
      return std::pow(flight(one).velocity_miss_m_s, 2);
    });
    EXPECT_NEAR(rates, velocity, allowed_rates) << (is_closed ? "closed" : "open");
    const double energy =
        (is_closed ? expected.closed_energy
                   : expected.energy * (1 + errors.magnitude * errors.magnitude)) /
        std::pow(second, 3);
    const auto [cost, allowed_cost] = mean_and_allowance(
        samples, [&](const ErrorSample& one) { return flight(one).energy_m2_s3; });
    EXPECT_NEAR(cost, energy, allowed_cost) << (is_closed ? "closed" : "open");
  }
}

TEST(ErroneousFlights, ScatterAsTheLinearTheoryOfACircle) { expect_linear_theory(100); }
TEST(ErroneousFlightsAtLength, ScatterAsTheLinearTheoryOfACircle) { expect_linear_theory(1000); }

}  // namespace
}  // namespace hamjet::thrusted
