#include "studies/periodic/periodic_study.hpp"

#include <gtest/gtest.h>

#include <array>
#include <boost/math/special_functions/ellint_1.hpp>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "hamjet/error.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "support/errors.hpp"

// Periodic orbits against closed forms and published numbers.

namespace hamjet {
namespace {

const std::string closed_pendulum = R"T(schema = 1
title = "pendulum"
system = { model = "own", coordinates = ["theta"], momenta = ["L"], hamiltonian = "L^2/2 - cos(theta)" }
nominal = { coordinates = [1.5], momenta = [0] }
jet = { order = 1, duration_canonical = 7 }
)T";

/// Uncoupled: the motion in x and the oscillation across it do not know each other.
std::string two_oscillators(const std::string& periodic) {
  return R"(schema = 1
title = "two oscillators"
[system]
model = "own"
coordinates = ["x", "y"]
momenta = ["px", "py"]
parameters = { w = 0.7, k = 0.5 }
hamiltonian = "(px^2 + py^2)/2 + x^2/2 + k*x^4/4 + w^2*y^2/2"
[nominal]
coordinates = [0.5, 0]
momenta = [0, 0]
[jet]
order = 1
duration_canonical = 6
)" + periodic;
}

PeriodicStudy closed_study(const std::string& text) {
  return study_periodic(io::parse_scene(text, "file.toml"));
}

double pendulum_period(double amplitude) {
  return 4 * boost::math::ellint_1(std::sin(amplitude / 2));
}

/// The period of x'' = -x - k x^3: 4 K(m)/sqrt(1 + k a^2) with m = k a^2/(2 (1 + k a^2)).
double duffing_period(double amplitude, double k) {
  const double s = 1 + k * amplitude * amplitude;
  return 4 * boost::math::ellint_1(std::sqrt(k * amplitude * amplitude / (2 * s))) / std::sqrt(s);
}

TEST(PeriodicStudy, AFamilyOfPendulumsHasThePeriodsOfEllipticIntegrals) {
  const PeriodicStudy study = closed_study(
      closed_pendulum + "[periodic]\nhold = \"theta\"\nfamily = { along = \"theta\", to = 3 }\n");
  EXPECT_EQ(study.family.end, "");
  EXPECT_GE(study.family.members.size(), 15U);
  EXPECT_NEAR(study.family.members.front().along, 1.5, 1e-12);
  EXPECT_NEAR(study.family.members.back().along, 3, 1e-12);
  for (const FamilyMember& member : study.family.members) {
    // At the start the flow's direction is that of L, so that theta is the amplitude.
    EXPECT_NEAR(member.orbit.start()[1], 0, 1e-12);
    EXPECT_NEAR(member.orbit.nodes.period, pendulum_period(member.along), 1e-11) << member.along;
    EXPECT_NEAR(member.orbit.energy, -std::cos(member.along), 1e-12);
    EXPECT_LT(member.orbit.closing, 1e-10);
    EXPECT_LT(member.orbit.monodromy.trivial_defect, 1e-8);
    EXPECT_EQ(member.mark, "");
  }
}

TEST(PeriodicStudy, TheIndexOfATransverseOscillationIsACosine) {
  for (const char* const arcs : {"1", "7"}) {
    const PeriodicStudy study = closed_study(
        two_oscillators(std::string("[periodic]\nhold = \"x\"\narcs = ") + arcs + "\n"));
    const PeriodicOrbit& orbit = study.family.members.at(0).orbit;
    const double period = duffing_period(0.5, 0.5);
    EXPECT_NEAR(orbit.nodes.period, period, 1e-11);
    ASSERT_EQ(orbit.monodromy.indices.size(), 1U);
    EXPECT_NEAR(orbit.monodromy.indices[0].real(), std::cos(0.7 * period), 1e-11);
    EXPECT_NEAR(std::abs(orbit.monodromy.multipliers[0]), 1, 1e-11);
    EXPECT_TRUE(orbit.monodromy.is_stable());
  }
}

TEST(PeriodicStudy, AFamilyAlongAParameterHoldsTheRest) {
  const PeriodicStudy study = closed_study(
      two_oscillators("[periodic]\nhold = \"x\"\nfamily = { along = \"parameters.k\", to = 2 }\n"));
  EXPECT_EQ(study.family.end, "");
  EXPECT_NEAR(study.family.members.front().along, 0.5, 1e-12);
  EXPECT_NEAR(study.family.members.back().along, 2, 1e-10);
  for (const FamilyMember& member : study.family.members) {
    EXPECT_NEAR(member.orbit.start()[0], 0.5, 1e-10);
    const double period = duffing_period(0.5, member.orbit.nodes.parameter);
    EXPECT_NEAR(member.orbit.nodes.period, period, 1e-9) << member.along;
    EXPECT_NEAR(member.orbit.monodromy.indices.at(0).real(), std::cos(0.7 * period), 1e-9);
  }
}

/// The index of the orbit of Henon and Heiles on its axis, by RK4 in long double: the motion across
/// is x'' = -(1 + 2 y) x beside y'' = -y + y^2, and the index half the trace of its turn.
long double index_across_the_axis(long double y, long double vy, long double period) {
  using Row = std::array<long double, 6>;
  const auto slope = [](const Row& s) {
    const long double k = -(1 + 2 * s[0]);
    return Row{s[1], -s[0] + s[0] * s[0], s[3], k * s[2], s[5], k * s[4]};
  };
  Row s{y, vy, 1, 0, 0, 1};
  constexpr int steps = 4000;
  const long double h = period / steps;
  for (int n = 0; n < steps; ++n) {
    const auto moved = [&](const Row& f, long double part) {
      Row result = s;
      for (std::size_t i = 0; i < s.size(); ++i) result[i] += part * h * f[i];
      return result;
    };
    const Row f1 = slope(s);
    const Row f2 = slope(moved(f1, 0.5L));
    const Row f3 = slope(moved(f2, 0.5L));
    const Row f4 = slope(moved(f3, 1));
    for (std::size_t i = 0; i < s.size(); ++i) {
      s[i] += h / 6 * (f1[i] + 2 * f2[i] + 2 * f3[i] + f4[i]);
    }
  }
  return (s[2] + s[5]) / 2;
}

// The straight orbit loses its stability where its index passes -1, at 0.8117 of the energy of the
// saddle, 1/6.
TEST(PeriodicStudy, TheStraightOrbitOfHenonAndHeilesHasItsIndexAndItsBifurcation) {
  const std::filesystem::path own = std::filesystem::path(HAMJET_SOURCE_DIR) / "data/scenes/own";
  const PeriodicStudy study = study_periodic(
      io::read_scene(own / "henon-heiles.toml",
                     {{"periodic", "{family = {along = \"energy\", to = 0.14, step = 0.002}}"}}));
  EXPECT_EQ(study.family.end, "");
  int marks = 0;
  double before = 0;
  for (const FamilyMember& member : study.family.members) {
    const Vector<double>& start = member.orbit.start();
    const auto index =
        static_cast<double>(index_across_the_axis(start[1], start[3], member.orbit.nodes.period));
    EXPECT_NEAR(member.orbit.monodromy.indices.at(0).real(), index, 1e-9) << member.along;
    EXPECT_EQ(member.orbit.monodromy.is_stable(), std::abs(index) < 1) << member.along;
    if (before > -1 && index < -1) {
      ++marks;
      const std::string head = "index 1 passes -1 near ";
      ASSERT_EQ(member.mark.find(head), 0U) << member.mark;
      EXPECT_NEAR(6 * std::stod(member.mark.substr(head.size())), 0.8117, 3e-4);
    } else {
      EXPECT_EQ(member.mark, "") << member.along;
    }
    before = index;
  }
  EXPECT_EQ(marks, 1);
}

/// The period of a particle that gyrates in the equator of a dipole. With u = 1/rho - 1/rho^2 =
/// s sin(a), s^2 = 2E, it is the integral of da/(du/drho) over a turn of a, which the sum over
/// equal parts gives to all digits.
double gyration_period(double energy) {
  constexpr int parts = 4000;
  double sum = 0;
  for (int k = 0; k < parts; ++k) {
    const double u = std::sqrt(2 * energy) * std::sin(2 * std::numbers::pi * k / parts);
    const double w = (1 + std::sqrt(1 - 4 * u)) / 2;  // 1/rho
    sum += 1 / (w * w * (2 * w - 1));
  }
  return sum * 2 * std::numbers::pi / parts;
}

TEST(PeriodicStudy, AParticleGyratesInTheEquatorOfADipole) {
  const std::filesystem::path own = std::filesystem::path(HAMJET_SOURCE_DIR) / "data/scenes/own";
  const PeriodicStudy study = study_periodic(io::read_scene(own / "magnetic-dipole.toml"));
  EXPECT_EQ(study.family.end, "");
  EXPECT_GE(study.family.members.size(), 15U);
  EXPECT_NEAR(study.family.members.back().along, 0.025, 1e-13);
  for (const FamilyMember& member : study.family.members) {
    EXPECT_NEAR(member.orbit.nodes.period, gyration_period(member.along), 1e-9) << member.along;
  }
}

TEST(PeriodicStudy, AShorterPeriodIsFoundWhereTheGuessIsTwoTurns) {
  const PeriodicStudy study =
      closed_study(closed_pendulum + "[periodic]\nhold = \"theta\"\nperiod_canonical = 14.5\n");
  EXPECT_NEAR(study.family.members.at(0).orbit.nodes.period, pendulum_period(1.5), 1e-11);
}

TEST(PeriodicStudy, SaysThatThereIsNoOrbit) {
  const auto refused = [](const std::string& text, const std::vector<std::string>& words) {
    test::expect_error([&] { closed_study(text); }, ErrorKind::numerical, words, text);
  };
  const auto with_text = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  refused(with_text(closed_pendulum, "- cos(theta)", "+ theta") + "[periodic]\n",
          {"periodic: no orbit"});
  refused(with_text(closed_pendulum, "[1.5]", "[0]") + "[periodic]\n",
          {"periodic: ", "equilibrium"});
}

// A family that cannot be followed to its end has its members, and says why it ends.
TEST(PeriodicStudy, AFamilyThatEndsBeforeItsEndSaysSo) {
  const PeriodicStudy few = closed_study(
      closed_pendulum +
      "[periodic]\nhold = \"theta\"\nfamily = { along = \"theta\", to = 3, members = 4 }\n");
  EXPECT_EQ(few.family.members.size(), 4U);
  EXPECT_NE(few.family.end.find("4 members do not reach 3"), std::string::npos) << few.family.end;
  EXPECT_FALSE(few.family.is_failure);
  // At theta = pi the period has no end.
  const PeriodicStudy beyond =
      closed_study(closed_pendulum +
                   "[periodic]\nhold = \"theta\"\nfamily = { along = \"energy\", to = 1.5 }\n");
  EXPECT_NE(beyond.family.end, "");
  EXPECT_GT(beyond.family.members.size(), 4U);
}

}  // namespace
}  // namespace hamjet
