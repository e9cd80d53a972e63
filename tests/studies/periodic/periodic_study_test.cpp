#include "studies/periodic/periodic_study.hpp"

#include <gtest/gtest.h>

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

const std::string pendulum = R"(schema = 1
title = "pendulum"
system = { model = "own", coordinates = ["theta"], momenta = ["L"], hamiltonian = "L^2/2 - cos(theta)"
}
nominal = { coordinates = [1.5], momenta = [0] }
jet = { order = 1, duration_canonical = 7 }
)";

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

PeriodicStudy studied(const std::string& text) {
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
  const PeriodicStudy study =
      studied(pendulum + "[periodic]\nhold = \"theta\"\nfamily = { along = \"theta\", to = 3 }\n");
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
    const PeriodicStudy study =
        studied(two_oscillators(std::string("[periodic]\nhold = \"x\"\narcs = ") + arcs + "\n"));
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
  const PeriodicStudy study = studied(
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

// M. Brack, Bifurcation cascades and self-similarity of periodic orbits with analytical scaling
// constants, Foundations of Physics 31 (2001) 209: the straight-line orbit first loses its
// stability at 0.8117 of the saddle's energy, 1/6.
TEST(PeriodicStudy, TheStraightOrbitOfHenonAndHeilesBifurcatesWherePublished) {
  const std::filesystem::path own = std::filesystem::path(HAMJET_SOURCE_DIR) / "data/scenes/own";
  const PeriodicStudy study = study_periodic(
      io::read_scene(own / "henon-heiles.toml",
                     {{"periodic", "{family = {along = \"energy\", to = 0.14, step = 0.002}}"}}));
  EXPECT_EQ(study.family.end, "");
  std::string marks;
  for (const FamilyMember& member : study.family.members) marks += member.mark;
  const std::string head = "index 1 passes +1 near ";
  const auto place = marks.find(head);
  ASSERT_NE(place, std::string::npos) << marks;
  EXPECT_NEAR(6 * std::stod(marks.substr(place + head.size())), 0.8117, 3e-4);
  EXPECT_TRUE(study.family.members.front().orbit.monodromy.is_stable());
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
      studied(pendulum + "[periodic]\nhold = \"theta\"\nperiod_canonical = 14.5\n");
  EXPECT_NEAR(study.family.members.at(0).orbit.nodes.period, pendulum_period(1.5), 1e-11);
}

TEST(PeriodicStudy, SaysThatThereIsNoOrbit) {
  const auto refused = [](const std::string& text, const std::vector<std::string>& words) {
    test::expect_error([&] { studied(text); }, ErrorKind::numerical, words, text);
  };
  const auto changed = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  refused(changed(pendulum, "- cos(theta)", "+ theta") + "[periodic]\n", {"periodic: no orbit"});
  refused(changed(pendulum, "[1.5]", "[0]") + "[periodic]\n", {"periodic: ", "equilibrium"});
}

// A family that cannot be followed to its end has its members, and says why it ends.
TEST(PeriodicStudy, AFamilyThatEndsBeforeItsEndSaysSo) {
  const PeriodicStudy few = studied(
      pendulum +
      "[periodic]\nhold = \"theta\"\nfamily = { along = \"theta\", to = 3, members = 4 }\n");
  EXPECT_EQ(few.family.members.size(), 4U);
  EXPECT_NE(few.family.end.find("4 members do not reach 3"), std::string::npos) << few.family.end;
  EXPECT_FALSE(few.family.is_failure);
  // At theta = pi the period has no end.
  const PeriodicStudy beyond = studied(
      pendulum + "[periodic]\nhold = \"theta\"\nfamily = { along = \"energy\", to = 1.5 }\n");
  EXPECT_NE(beyond.family.end, "");
  EXPECT_GT(beyond.family.members.size(), 4U);
}

}  // namespace
}  // namespace hamjet
