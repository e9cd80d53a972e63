#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "hamjet/report/relative_motion_report.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/transfer.hpp"
#include "hamjet/studies/validity.hpp"
#include "studies/formation/charts/free_coordinates.hpp"
#include "support/errors.hpp"

// Transfers and reach of systems with one or two coordinates.

namespace hamjet {
namespace {

std::string own_scene(const std::string& names, const std::string& momenta,
                      const std::string& hamiltonian, const std::string& nominal,
                      const std::string& more) {
  return "schema = 1\n[system]\nmodel = \"own\"\ncoordinates = [" + names + "]\nmomenta = [" +
         momenta + "]\nhamiltonian = \"" + hamiltonian + "\"\n[nominal]\n" + nominal +
         "\n[jet]\norder = 3\nduration_canonical = 10\n" + more;
}

const std::string oscillator_transfer =
    "[transfer]\ntimes_s = [1, 2, 4, 10]\nstart = { position_m = [1], velocity_m_s = [0.3] }\n"
    "end = { position_m = [0.5] }\n";

Scene oscillator(const std::string& more = oscillator_transfer) {
  return io::parse_scene(own_scene("\"theta\"", "\"L\"", "L^2/2 + theta^2/2",
                                   "coordinates = [0.2]\nmomenta = [0]", more),
                         "oscillator.toml");
}

std::vector<double> singular(const TransferResult& result, const std::string& kind) {
  std::vector<double> times;
  for (const SingularTime& one : result.singular_times) {
    if (told_kind(one.kind, result.scene.system) == kind) times.push_back(one.time);
  }
  return times;
}

// q = q0 cos t + p0 sin t and p = p0 cos t - q0 sin t: F1 is ((q^2 + q0^2) cos t - 2 q q0) / (2
// sin t) but for the sign, which does not exist at n pi; F2 does not where cos t = 0.
TEST(FewCoordinates, TheHarmonicOscillator) {
  const TransferResult result = study_transfer(oscillator());
  ASSERT_EQ(result.points.size(), 4U);
  for (const TransferPoint& point : result.points) {
    ASSERT_TRUE(point.has_answer()) << point.time;
    const double c = std::cos(point.time), s = std::sin(point.time);
    const double p0 = (0.5 - c) / s;
    const Eigen::Vector3d start(p0 - 0.3, 0, 0), end(-(p0 * c - s), 0, 0);
    EXPECT_LT((point.best().start_change_m_s - start).norm(), 1e-12 * start.norm());
    EXPECT_LT((point.best().end_change_m_s - end).norm(), 1e-12 * (1 + end.norm()));
    EXPECT_LT(point.best().miss_m, 1e-13);
  }
  EXPECT_EQ(result.conditions.kinds.size(), 4U);
  const std::vector<double> f1 = singular(result, "q-q");
  ASSERT_EQ(f1.size(), 3U);
  EXPECT_EQ(result.position_singularities().size(), 3U);
  const std::vector<double> f2 = singular(result, "q-p");
  ASSERT_EQ(f2.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto n = static_cast<double>(k);
    EXPECT_NEAR(f1[k], (n + 1) * std::numbers::pi, 1e-12);
    EXPECT_NEAR(f2[k], (n + 0.5) * std::numbers::pi, 1e-12);
  }
}

// A jet that was computed earlier gives the oscillator's closed form above, at its own time, and
// the jet of another oscillator is refused. q' = q + t p of the coordinates beside is in no answer.
TEST(FewCoordinates, AnEarlierJet) {
  const Scene scene = oscillator();
  const double t = 2.5, c = std::cos(t), s = std::sin(t);
  const SpacePointer space = SeriesSpace::create(2, 3);
  EarlierJet earlier{"earlier", t, {Series<double>(space), Series<double>(space)}};
  const auto turn = [&](double x, double p, std::size_t i, double of_x, double of_p) {
    earlier.jet[i][0] = of_x * x + of_p * p;
    earlier.jet[i][space->linear_index(0)] = of_x;
    earlier.jet[i][space->linear_index(1)] = of_p;
  };
  turn(0.2, 0, 0, c, s);
  turn(0.2, 0, 1, -s, c);
  const TransferResult result = study_transfer(scene, {}, &earlier);
  ASSERT_EQ(result.points.size(), 1U);
  EXPECT_EQ(result.points[0].time, t);
  ASSERT_TRUE(result.points[0].has_answer());
  const double p0 = (0.5 - c) / s;
  const Eigen::Vector3d start(p0 - 0.3, 0, 0), end(-(p0 * c - s), 0, 0);
  EXPECT_LT((result.points[0].best().start_change_m_s - start).norm(), 1e-12);
  EXPECT_LT((result.points[0].best().end_change_m_s - end).norm(), 1e-12);
  EXPECT_LT(result.points[0].best().miss_m, 1e-13);
  earlier.jet[0][0] += 0.01;
  test::expect_error([&] { study_transfer(scene, {}, &earlier); }, ErrorKind::scene,
                     {"the earlier jet earlier is not of this scene"}, "another chief");
}

// Two frequencies, 1 and 2: F1 does not exist where either is at a multiple of pi.
TEST(FewCoordinates, TwoOscillators) {
  const Scene scene = io::parse_scene(
      own_scene("\"x\", \"y\"", "\"u\", \"v\"", "(u^2 + v^2 + x^2 + 4*y^2)/2",
                "coordinates = [0, 0]\nmomenta = [0, 0]",
                "[transfer]\ntimes_s = [1, 5]\nkind = \"qq-qq\"\n"
                "start = { position_m = [1, -1] }\nend = { position_m = [0.5, 2] }\n"),
      "two.toml");
  const TransferResult result = study_transfer(scene);
  for (const TransferPoint& point : result.points) {
    ASSERT_TRUE(point.has_answer());
    const double t = point.time;
    EXPECT_NEAR(point.best().start_change_m_s[0], (0.5 - std::cos(t)) / std::sin(t), 1e-12);
    EXPECT_NEAR(point.best().start_change_m_s[1], 2 * (2 + std::cos(2 * t)) / std::sin(2 * t),
                1e-11);
    EXPECT_EQ(point.best().start_change_m_s[2], 0);
  }
  EXPECT_EQ(result.conditions.kinds.size(), 16U);
  const std::vector<double> f1 = singular(result, "qq-qq");
  ASSERT_EQ(f1.size(), 3U);  // to 5: pi/2, pi (both), 3 pi/2
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(f1[k], static_cast<double>(k + 1) * std::numbers::pi / 2, 1e-10);
  }
}

// Tables have the scene's names, and no more columns than it has coordinates.
TEST(FewCoordinates, TablesNameTheCoordinates) {
  const TransferResult result = study_transfer(oscillator());
  const io::StudyReport report = io::transfer_report(result, fly_relative(result, 0), {});
  std::string csv, json, page;
  for (const io::ReportFile& file : report.files) {
    if (file.path == "transfers.csv") csv = file.content;
    if (file.path == "summary.json") json = file.content;
    if (file.path == "report.html") page = file.content;
  }
  const std::string head = csv.substr(0, csv.find('\n'));
  EXPECT_NE(head.find("start_change_theta_m_s,end_change_theta_m_s,total"), std::string::npos)
      << head;
  EXPECT_EQ(head.find("_x_"), std::string::npos) << head;
  EXPECT_NE(csv.find(",q-q,"), std::string::npos) << csv;
  EXPECT_NE(json.find("\"axes\": [\n    \"theta\"\n  ]"), std::string::npos);
  EXPECT_NE(page.find("first theta (m/s)"), std::string::npos);
  EXPECT_NE(page.find("theta against the time"), std::string::npos);
}

// The reach is that of the same system with further coordinates that the scene writes itself, and
// whose semi-axes are as good as none.
TEST(FewCoordinates, TheReachIsThatOfTheWrittenOutSystem) {
  const Scene one = io::parse_scene(
      own_scene("\"x\"", "\"p\"", "p^2/2 - cos(x)", "coordinates = [0.5]\nmomenta = [0]",
                "[validity]\ntolerance_m = 1e-3\ntimes_s = 3\n"),
      "one.toml");
  const Scene three = io::parse_scene(
      own_scene("\"x\", \"y\", \"z\"", "\"p\", \"py\", \"pz\"", "(p^2 + py^2 + pz^2)/2 - cos(x)",
                "coordinates = [0.5, 0, 0]\nmomenta = [0, 0, 0]",
                "[validity]\ntolerance_m = 1e-3\ntimes_s = 3\nsemi_axes = [1, 1e-9, 1e-9]\n"),
      "three.toml");
  const ValidityResult few = study_validity(one), all = study_validity(three);
  for (std::size_t n = 0; n < 3; ++n) {
    const double written = all.points[0].entries[n].proved_m;
    EXPECT_GT(written, 0);
    EXPECT_NEAR(few.points[0].entries[n].proved_m, written, 0.06 * written) << n;
  }
  ASSERT_TRUE(few.points[0].entries[1].limit);
  EXPECT_EQ(few.points[0].entries[1].limit->end_coordinate, "x");
}

TEST(FewCoordinates, MistakesAreNamed) {
  const auto refused = [](const std::string& more, const std::vector<std::string>& words) {
    test::expect_error([&] { oscillator(more); }, ErrorKind::scene, words, more);
  };
  refused(
      "[transfer]\ntimes_s = 1\nstart = { position_m = [1, 0, 0] }\n"
      "end = { position_m = [0] }\n",
      {"transfer.start.position_m: wrong length", "must be an array of 1 finite number"});
  refused(
      "[transfer]\ntimes_s = 1\nkind = \"qqq-qqq\"\nstart = { position_m = [1] }\n"
      "end = { position_m = [0] }\n",
      {"transfer.kind: unknown kind", "or 1 letter q or p", "as in q-p"});
  refused("[validity]\ncount = 1\nsemi_axes = [1, 1]\n",
          {"validity.semi_axes: wrong length", "must be an array of 1 finite number"});
}

// A deputy about a chief that rests at the origin is as wrong as its own rounding: the linear flow
// of oscillators in such units is a rotation.
TEST(FewCoordinates, TheFloorAtAnOriginIsThatOfDeputies) {
  const Scene scene = io::parse_scene(
      own_scene("\"x\"", "\"p\"", "p^2/2 + x^2/2 + x^4", "coordinates = [0]\nmomenta = [0]",
                "[validity]\ntolerance_m = 1e-3\ntimes_s = 2\n"),
      "zero.toml");
  const ValidityResult result = study_validity(scene);
  const double furthest = result.points[0].entries.back().proved_m;
  // Free coordinates of the studies make 2 (2 + t^2) of the square of the flow's norm.
  const double norm = std::sqrt(2 + 2 * (2 + 4.0));
  EXPECT_GT(furthest, 0);
  EXPECT_NEAR(result.flight_floor_m, 0x1p-52 * norm * furthest, 1e-3 * result.flight_floor_m);
}

}  // namespace
}  // namespace hamjet
