#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "hamjet/astronomy/earth_axes.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/propagation.hpp"
#include "studies/exact_flow.hpp"
#include "support/temporary_directory.hpp"

// Orbits about the real Earth against what other programs have published, and against positions of
// real satellites. None of them shares code with this one.

namespace hamjet {
namespace {

using Eigen::Vector3d;

/// Rows of the IERS's finals2000A (Bulletin A) of the days about a scene: date, modified Julian
/// date, pole, UT1 - UTC.
constexpr const char* days_of_may_2023 =
    "23 514 60078.00 I  0.052351 0.000021  0.489072 0.000012  I-0.0405224 0.0000054\n"
    "23 515 60079.00 I  0.055852 0.000021  0.490657 0.000013  I-0.0417858 0.0000054\n"
    "23 516 60080.00 I  0.059212 0.000021  0.492162 0.000013  I-0.0431008 0.0000055\n"
    "23 517 60081.00 I  0.062109 0.000021  0.493473 0.000024  I-0.0443123 0.0000053\n"
    "23 518 60082.00 I  0.064533 0.000021  0.494606 0.000024  I-0.0452763 0.0000050\n"
    "23 519 60083.00 I  0.066929 0.000021  0.495640 0.000024  I-0.0459527 0.0000049\n"
    "23 520 60084.00 I  0.069369 0.000017  0.496688 0.000015  I-0.0462785 0.0000054\n";

constexpr const char* days_of_january_2000 =
    "991228 51540.00 I  0.041223 0.000109  0.377958 0.000125  I 0.3601199 0.0000090\n"
    "991229 51541.00 I  0.042138 0.000088  0.378276 0.000111  I 0.3588150 0.0000099\n"
    "991230 51542.00 I  0.042633 0.000089  0.378370 0.000110  I 0.3575820 0.0000100\n"
    "991231 51543.00 I  0.042976 0.000090  0.378161 0.000108  I 0.3564680 0.0000093\n"
    " 0 1 1 51544.00 I  0.043301 0.000092  0.377867 0.000099  I 0.3554779 0.0000099\n"
    " 0 1 2 51545.00 I  0.043541 0.000058  0.377638 0.000073  I 0.3546013 0.0000119\n"
    " 0 1 3 51546.00 I  0.043598 0.000069  0.377408 0.000077  I 0.3538511 0.0000109\n"
    " 0 1 4 51547.00 I  0.043449 0.000071  0.377115 0.000089  I 0.3532407 0.0000115\n"
    " 0 1 5 51548.00 I  0.043220 0.000080  0.376793 0.000088  I 0.3527584 0.0000184\n";

constexpr const char* days_of_july_2010 =
    "10 723 55400.00 I  0.119491 0.000030  0.477191 0.000056  I-0.0526032 0.0000093\n"
    "10 724 55401.00 I  0.121692 0.000019  0.476334 0.000037  I-0.0518769 0.0000106\n"
    "10 725 55402.00 I  0.123778 0.000030  0.475023 0.000040  I-0.0511681 0.0000079\n"
    "10 726 55403.00 I  0.126216 0.000030  0.473590 0.000039  I-0.0505881 0.0000079\n"
    "10 727 55404.00 I  0.128828 0.000027  0.472334 0.000027  I-0.0501943 0.0000080\n"
    "10 728 55405.00 I  0.131240 0.000037  0.471305 0.000029  I-0.0499766 0.0000071\n"
    "10 729 55406.00 I  0.133349 0.000037  0.470477 0.000030  I-0.0498633 0.0000062\n";

/// Where the chief of a scene is after a time, km along the axes of GCRF.
Vector3d flown_km(const Scene& scene, double seconds) {
  const double time = seconds / scene.units.time_s;
  const std::vector<double> end =
      exact_flow(make_system(scene), scene.nominal, scene.start_time, time);
  return Vector3d(end[0], end[1], end[2]) * scene.units.length_km;
}

/// The same along the axes of EME2000, which rest in those of GCRF.
Vector3d in_eme2000(const Scene& scene, const Vector3d& place) {
  const Instant epoch{parse_epoch(scene.system.earth.value().epoch_tt).value()};
  return axes_change(EarthAxes::gcrf, EarthAxes::eme2000, epoch).rotation * place;
}

class PublishedOrbits : public ::testing::Test {
 protected:
  /// A scene in a folder of its own, with files beside it.
  Scene scene(const std::string& text) const {
    std::ofstream(folder_.path() / "scene.toml") << text;
    return io::read_scene(folder_.path() / "scene.toml");
  }
  void put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name) << text;
  }
  /// Puts the field EGM2008 to degree 120 beside the scene; returns whether it is there.
  bool put_egm2008() const {
    const std::filesystem::path field =
        std::filesystem::path(HAMJET_SOURCE_DIR) / ".." / "shared" / "gravity" / "EGM2008_120.gfc";
    if (!std::filesystem::exists(field)) return false;
    std::filesystem::copy_file(field, folder_.path() / "EGM2008.gfc");
    return true;
  }
  void copy(const std::string& name) const {
    std::filesystem::copy_file(
        std::filesystem::path(HAMJET_SOURCE_DIR) / "tests" / "studies" / "earth" / name,
        folder_.path() / name);
  }

 private:
  test::TemporaryDirectory folder_;
};

// GMAT R2026A: the field EGM96 to 2 x 2, Sun and Moon as point masses by DE440. A metre after a day
// is what ERFA's short series for the Moon (1e-4 of its position) and GMAT's precession leave.
TEST_F(PublishedOrbits, OfGmatWithSunAndMoon) {
  put("finals.txt", days_of_may_2023);
  const Scene orbit = scene(R"(
[system]
model = "earth"
gravity_degree = 2
orientation_file = "finals.txt"
[nominal]
epoch_utc = "2023-05-16T20:00:00"
position_km = [20067.08545813506, -5135.56266211274, 16693.90451233602]
velocity_km_s = [2.325052610256162, 2.345791624373619, -2.01241514184288]
[jet]
order = 1
duration_s = 259200
)");
  const Vector3d one_day(20621.71445789771, -4571.059987593672, 16189.12316886496);
  const Vector3d three_days(21655.07797171256, -3426.884794460414, 15117.08342281085);
  EXPECT_LE((flown_km(orbit, 86400) - one_day).norm(), 1e-3);
  EXPECT_LE((flown_km(orbit, 3 * 86400) - three_days).norm(), 3e-3);
}

// GMAT: the field JGM-3 to 12 x 12, no other bodies, a day from J2000 at 12:00 of TAI.
TEST_F(PublishedOrbits, OfGmatWithAFieldOfDegree12) {
  copy("jgm3_to_12.gfc");
  put("finals.txt", days_of_january_2000);
  const Scene orbit = scene(R"(
[system]
model = "earth"
gravity_file = "jgm3_to_12.gfc"
orientation_file = "finals.txt"
gravity_degree = 12
sun = false
moon = false
[nominal]
axes = "EME2000"
epoch_tai = "2000-01-01T12:00:00"
position_km = [-2436.45, -2436.45, 6891.037]
velocity_km_s = [5.088611, -5.088611, 0]
[jet]
order = 1
duration_s = 86400
)");
  const Vector3d end(-5751.935197673, 4719.330857046, 2048.776230999);
  const Vector3d flown = in_eme2000(orbit, flown_km(orbit, 86400));
  EXPECT_LE((flown - end).norm(), 1e-5) << (flown - end).transpose();
}

// GMAT R2026A: EGM96 to 36 x 36, Sun and Moon, solid tides of some decimetres. EGM96 is not at hand
// beyond degree 20, and EGM2008 stands in its place. Where the geoids of the two differ by 0.2 m,
// as EGM96 may be wrong by, so do energies by g times as much, semi-major axes by twice that and
// places along the track by 3 pi times that a revolution.
TEST_F(PublishedOrbits, OfGmatWithAnotherFieldOfDegree36) {
  if (!put_egm2008()) GTEST_SKIP() << "the field EGM2008 is not there";
  put("finals.txt", days_of_may_2023);
  const Scene orbit = scene(R"(
[system]
model = "earth"
gravity_file = "EGM2008.gfc"
gravity_degree = 36
orientation_file = "finals.txt"
[nominal]
epoch_utc = "2023-05-16T20:00:00"
a_km = 7178
e = 0.0012
i_deg = 98.6
raan_deg = 120
argp_deg = 90
ta_deg = 0
[jet]
order = 1
duration_s = 259200
)");
  const auto allowance_km = [](double days) {
    const double revolutions = days * 86400 / 6052;
    return 2 * 0.2e-3 * 3 * std::numbers::pi * revolutions;
  };
  const Vector3d one_day(3777.084863642, -6072.543008537, 755.523738073);
  const Vector3d three_days(-3985.926971827, 5497.556632700, -2386.232766708);
  EXPECT_LE((flown_km(orbit, 86400) - one_day).norm(), allowance_km(1));
  EXPECT_LE((flown_km(orbit, 3 * 86400) - three_days).norm(), allowance_km(3));
}

/// The ITRF states of GRACE A and B at the start of 27 July 2010 (GPS), of their precise orbits by
/// the University of Bern.
constexpr const char* grace_a =
    "position_km = [2046.250381, 270.772369, 6513.38404]\n"
    "velocity_km_s = [-7.239398858, -0.6729940446, 2.309389481]\n";
constexpr const char* grace_b =
    "position_km = [1828.856677, 255.622214, 6578.281838]\n"
    "velocity_km_s = [-7.312129371, -0.6693183586, 2.067191873]\n";

std::string grace_scene(const std::string& field, const char* satellite) {
  return "[system]\nmodel = \"earth\"\norientation_file = \"finals.txt\"\n" + field +
         "[nominal]\naxes = \"ITRF\"\nepoch_gps = \"2010-07-27T00:00:00\"\n" + satellite +
         "[jet]\norder = 1\nduration_s = 86400\n";
}

/// What a day of low orbit makes of other interpolations of the Earth's orientation between its
/// days, where two of the table's own errors, 1e-5 s of UT1, turn the field by a centimetre.
constexpr double interpolations_km = 1e-5;

// A program written for this comparison: normalised harmonics by their own recursion, ERFA's
// matrices, Sun and Moon, and Adams's method of order 11 in steps of 5 s.
TEST_F(PublishedOrbits, OfGraceByAnotherProgram) {
  put("finals.txt", days_of_july_2010);
  const Scene a = scene(grace_scene("gravity_degree = 20\n", grace_a));
  const Scene b = scene(grace_scene("gravity_degree = 20\n", grace_b));
  const Vector3d end_a(-4181.8121207, 5177.7966642, -1631.0696043);
  const Vector3d end_b(-4151.2038947, 5129.7626802, -1849.4335214);
  const Vector3d error_a = flown_km(a, 86400) - end_a;
  const Vector3d error_b = flown_km(b, 86400) - end_b;
  EXPECT_LE(error_a.norm(), interpolations_km) << error_a.transpose();
  EXPECT_LE((error_b - error_a).norm(), interpolations_km) << error_b.transpose();
}

// The same with EGM2008 to 70 x 70. The satellites' own distance was 5.4 m less by their orbits.
TEST_F(PublishedOrbits, OfGraceWithAFieldOfDegree70) {
  if (!put_egm2008()) GTEST_SKIP() << "the field EGM2008 is not there";
  put("finals.txt", days_of_july_2010);
  const std::string keys = "gravity_file = \"EGM2008.gfc\"\ngravity_degree = 70\n";
  const Vector3d end_a(-4181.8279150, 5177.7924903, -1631.1114912);
  const Vector3d end_b(-4151.2173804, 5129.7543882, -1849.4884010);
  const Vector3d error_a = flown_km(scene(grace_scene(keys, grace_a)), 86400) - end_a;
  const Vector3d error_b = flown_km(scene(grace_scene(keys, grace_b)), 86400) - end_b;
  EXPECT_LE(error_a.norm(), interpolations_km) << error_a.transpose();
  EXPECT_LE((error_b - error_a).norm(), interpolations_km) << error_b.transpose();
}

}  // namespace
}  // namespace hamjet
