#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <fstream>
#include <string>

#include "scene_samples.hpp"
#include "support/temporary_directory.hpp"

// Messages of scenes about the real Earth, in axes that turn and in other time systems. Expected:
// one state along GCRF and ITRF, the latter by a program of its own with ERFA's
// celestial-to-intermediate matrix, polar axes and rotation angle at UT1 = UTC.

namespace hamjet::io {
namespace {

const std::string state_in_gcrf =
    "position_km = [4400.1, 3300.2, 5000.3]\nvelocity_km_s = [-4.5, 5.5001, 0.5]\n";

/// The covariance of the message: position variances of 1, 4 and 9 m^2, velocities' of 1 mm^2/s^2.
constexpr const char* covariance_rows =
    "COV_REF_FRAME = {}\n"
    "CX_X = 1e-6\nCY_X = 0\nCY_Y = 4e-6\nCZ_X = 0\nCZ_Y = 0\nCZ_Z = 9e-6\n"
    "CX_DOT_X = 0\nCX_DOT_Y = 0\nCX_DOT_Z = 0\nCX_DOT_X_DOT = 1e-12\n"
    "CY_DOT_X = 0\nCY_DOT_Y = 0\nCY_DOT_Z = 0\nCY_DOT_X_DOT = 0\nCY_DOT_Y_DOT = 1e-12\n"
    "CZ_DOT_X = 0\nCZ_DOT_Y = 0\nCZ_DOT_Z = 0\nCZ_DOT_X_DOT = 0\nCZ_DOT_Y_DOT = 0\n"
    "CZ_DOT_Z_DOT = 1e-12\n";

/// The same state along ITRF, 18 s later by the clocks of GPS, which are ahead of UTC by that.
std::string itrf_message(const std::string& epoch = "2023-05-16T06:00:18",
                         const std::string& frame = "ITRF2014") {
  return "CCSDS_OPM_VERS = 2.0\nCREATION_DATE = 2023-05-16T00:00:00\nORIGINATOR = TEST\n"
         "OBJECT_NAME = ONE\nOBJECT_ID = 2023-001A\nCENTER_NAME = EARTH\nREF_FRAME = " +
         frame + "\nTIME_SYSTEM = GPS\nEPOCH = " + epoch +
         "\nX = 1555.9289475412529\nY = 5266.0466912165959\nZ = 5010.293154709603\n"
         "X_DOT = -6.508832819162566\nY_DOT = 1.618512997206280\nZ_DOT = 0.490040468411414\n" +
         fmt::format(covariance_rows, frame);
}

std::string earth_scene_of(const std::string& nominal, const std::string& more = "") {
  return "[system]\nmodel = \"earth\"\ngravity_degree = 2\n[nominal]\n" + nominal +
         "[jet]\norder = 1\nduration_s = 600\n" + more;
}

Scene scene_with_message(const std::string& message, const std::string& text) {
  const test::TemporaryDirectory directory;
  std::ofstream(directory.path() / "one.opm") << message;
  return parse_scene(text, (directory.path() / "file.toml").string());
}

const std::string start_utc = "epoch_utc = \"2023-05-16T06:00:00\"\n";

TEST(EarthMessages, ANominalInTheEarthsOwnAxes) {
  const Scene keys = parse_scene(earth_scene_of(start_utc + state_in_gcrf), "file.toml");
  const Scene file = scene_with_message(itrf_message(), earth_scene_of("opm_file = \"one.opm\"\n"));
  EXPECT_EQ(file.system.earth->epoch_tt, keys.system.earth->epoch_tt);
  EXPECT_EQ(file.system.earth->axes, "ITRF2014");
  EXPECT_EQ(file.ephemeris->reference_frame, "GCRF");
  EXPECT_EQ(file.ephemeris->object_name, "ONE");
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(file.nominal[i], keys.nominal[i], 1e-14) << i;
}

TEST(EarthMessages, KeysInTheEarthsOwnAxes) {
  const Scene keys = parse_scene(earth_scene_of(start_utc + state_in_gcrf), "file.toml");
  const Scene itrf = parse_scene(
      earth_scene_of(start_utc +
                     "axes = \"ITRF\"\nposition_km = [1555.9289475412529, 5266.0466912165959, "
                     "5010.293154709603]\nvelocity_km_s = [-6.508832819162566, "
                     "1.618512997206280, 0.490040468411414]\n"),
      "file.toml");
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(itrf.nominal[i], keys.nominal[i], 1e-14) << i;
}

TEST(EarthMessages, ADeputyInOtherAxesAndAnotherTimeSystem) {
  const std::string chief =
      start_utc + "position_km = [4400, 3300, 5000]\nvelocity_km_s = [-4.5, 5.5, 0.5]\n";
  const Scene keys = parse_scene(earth_scene_of(chief, "[deputy]\n" + state_in_gcrf), "file.toml");
  const Scene file = scene_with_message(
      itrf_message(), earth_scene_of(chief, "[deputy]\nopm_file = \"one.opm\"\n"));
  const auto &expected = keys.deputy->start, &found = file.deputy->start;
  EXPECT_NEAR((found.position_m - expected.position_m).norm(), 0, 1e-7);
  EXPECT_NEAR((found.velocity_m_s - expected.velocity_m_s).norm(), 0, 1e-10);
  expect_error(
      [&] {
        scene_with_message(itrf_message("2023-05-16T06:00:17"),
                           earth_scene_of(chief, "[deputy]\nopm_file = \"one.opm\"\n"));
      },
      ErrorKind::scene, {"deputy.opm_file: a state of another moment than the chief's"}, chief);
}

// A change of axes is a rotation and a shear, so that it changes neither the position's principal
// variances nor the volume.
TEST(EarthMessages, ACovarianceInTheEarthsOwnAxes) {
  const Scene scene = scene_with_message(
      itrf_message(),
      earth_scene_of("opm_file = \"one.opm\"\n", "[uncertainty]\nfile = \"one.opm\"\n"));
  EXPECT_EQ(scene.uncertainty->chief->frame, RelativeFrame::inertial);
  const Eigen::Matrix<double, 6, 6> matrix = scene.uncertainty->chief->covariance.matrix();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> position(matrix.topLeftCorner<3, 3>());
  EXPECT_NEAR(position.eigenvalues()[0], 1, 1e-12);
  EXPECT_NEAR(position.eigenvalues()[1], 4, 1e-12);
  EXPECT_NEAR(position.eigenvalues()[2], 9, 1e-12);
  EXPECT_NEAR(matrix.determinant() / 36e-18, 1, 1e-9);
  // The velocities that the rotation of 7.3e-5 rad/s makes of some metres.
  EXPECT_GT(std::abs(matrix(0, 4)), 1e-5);
}

TEST(EarthMessages, ACovarianceOfAnotherMomentIsRefused) {
  const std::string file = "[uncertainty]\nfile = \"one.opm\"\n";
  EXPECT_NO_THROW(
      scene_with_message(itrf_message(), earth_scene_of(start_utc + state_in_gcrf, file)));
  expect_error(
      [&] {
        scene_with_message(itrf_message("2023-05-16T06:00:00"),
                           earth_scene_of(start_utc + state_in_gcrf, file));
      },
      ErrorKind::scene, {"uncertainty.file", "no covariance of the chief's moment"}, file);
}

}  // namespace
}  // namespace hamjet::io
