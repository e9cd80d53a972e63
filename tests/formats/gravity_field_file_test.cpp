#include "hamjet/formats/gravity_field_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "../scene/scene_samples.hpp"
#include "hamjet/algebra/extended.hpp"
#include "hamjet/error.hpp"
#include "support/temporary_directory.hpp"

namespace hamjet::io {
namespace {

const std::filesystem::path egm96 =
    std::filesystem::path(HAMJET_SOURCE_DIR) / "data/gravity/EGM96-zonals.gfc";

/// In the layout of the models of GFZ Potsdam: Fortran's exponents without a leading zero, prose
/// before the header, blank lines. Values of EIGEN-5C, degree 5 to 8; C(2,0) to C(4,0) drift.
const char* const eigen = R"(THE COMBINED GRAVITY FIELD MODEL EIGEN-5C
radius is a word of this prose

begin_of_head ==========
product_type                  gravity_field
modelname                     EIGEN-5C
earth_gravity_constant        0.3986004415E+15
radius                        0.6378136460D+07
max_degree                    8
errors                        calibrated
tide_system                   zero_tide

key    L    M         C                  S           sigma C    sigma S
end_of_head ==========
gfc    0    0 0.100000000000D+01 0.000000000000D+00 0.0000D+00 0.0000D+00
gfct   2    0 -.484165270522D-03 0.000000000000D+00 0.2709D-10 0.0000D+00 20041001
dot    2    0 0.116275500000D-10 0.000000000000D+00 0.0000D+00 0.0000D+00
gfc    5    0 0.686821280969D-07 0.000000000000D+00 0.1926D-11 0.0000D+00
gfc    5    1 -.629246679647D-07 -.943678575162D-07 0.2457D-11 0.2505D-11
gfc    6    0 -.149953593856d-06 0.000000000000D+00 0.1398D-11 0.0000D+00
)";

std::string changed_field(const std::string& from, const std::string& to) {
  return changed(eigen, from, to);
}

/// The field read with J5 and J6 asked for must be refused with these words, on one line.
void expect_field_refused(const std::string& text, const std::vector<std::string>& words,
                          const ZonalChoice& choice = {0, {5, 6}}) {
  SCOPED_TRACE(words.front());
  try {
    parse_gravity_field("field.gfc", text, choice);
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_EQ(error.kind(), ErrorKind::input_output) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    EXPECT_TRUE(what.starts_with("field.gfc:")) << what;
    for (const std::string& word : words) {
      EXPECT_NE(what.find(word), std::string::npos) << what << "\nlacks: " << word;
    }
  }
}

TEST(GravityFieldFile, ConvertsTheNormalisationAndTheUnits) {
  const GravityField field = parse_gravity_field("field.gfc", eigen, {0, {5, 6}});
  EXPECT_EQ(field.model_name, "EIGEN-5C");
  EXPECT_EQ(field.tide_system, "zero_tide");
  EXPECT_EQ(field.mu_km3_s2, 398600.4415);
  EXPECT_EQ(field.radius_km, 6378.13646);
  EXPECT_EQ(field.max_degree, 8);
  // J_n = -sqrt(2n + 1) C_n0, rounded once.
  EXPECT_EQ(field.J[5],
            static_cast<double>(Extended(-sqrt(Extended(11)) * Extended("0.686821280969e-07"))));
  EXPECT_EQ(field.J[6],
            static_cast<double>(Extended(sqrt(Extended(13)) * Extended("0.149953593856e-06"))));
  for (const int n : {2, 3, 4, 7, 8, 20}) EXPECT_EQ(field.J[n], 0) << n;
  const std::string raw = changed_field("errors ", "norm unnormalized\nerrors ");
  EXPECT_EQ(parse_gravity_field("field.gfc", raw, {0, {6}}).J[6], 0.149953593856e-6);
}

TEST(GravityFieldFile, TakesHeadersOfOtherKinds) {
  const auto read = [](const std::string& text) {
    return parse_gravity_field("field.gfc", text, {0, {5}});
  };
  // The constant of another body has a shorter name, and a series has a product_name. Lines may end
  // as on Windows, and standard deviations may be absent or of both kinds.
  EXPECT_EQ(read(changed_field("earth_gravity_constant", "gravity_constant")).mu_km3_s2,
            398600.4415);
  EXPECT_EQ(read(changed_field("modelname", "product_name")).model_name, "EIGEN-5C");
  EXPECT_EQ(read(changed_field("modelname", "comment")).model_name, "");
  EXPECT_EQ(read(changed_field("tide_system", "comment")).tide_system, "unknown");
  EXPECT_EQ(read(changed_field("gfc    0    0 0.1", "gfc    0    0 +0.1")).max_degree, 8);
  std::string windows = eigen;
  for (std::size_t end = windows.find('\n'); end != windows.npos;
       end = windows.find('\n', end + 2)) {
    windows.insert(end, 1, '\r');
  }
  EXPECT_EQ(read(windows).J[5], read(eigen).J[5]);
  for (const char* columns : {"", " 0 0 0 0"}) {
    EXPECT_EQ(read(changed_field(" 0.1926D-11 0.0000D+00", columns)).J[5], read(eigen).J[5]);
  }
}

TEST(GravityFieldFile, RefusesWhatVariesWithoutAnEpochOnlyWhereItIsAskedFor) {
  expect_field_refused(eigen, {"field.gfc:16: gfct: C(2,0) varies with time", "key gravity_epoch"},
                       {2});
  for (const char* record : {"trnd 6 0 1e-11 0 0 0", "dot 6 0 1e-11 0", "asin 6 0 1e-11 0 0 0 1.0",
                             "acos 6 0 1e-11 0 0 0 0 0 0.5"}) {
    const std::string text = std::string(eigen) + record + "\n";
    const std::string key = std::string(record).substr(0, std::string(record).find(' '));
    expect_field_refused(text, {fmt::format("field.gfc:21: {}: C(6,0) varies with time", key)});
    EXPECT_NO_THROW(parse_gravity_field("field.gfc", text, {0, {5}}));
  }
}

// An exponent that no integer holds. Fuzzing found that it made Boost's reader overflow.
TEST(GravityFieldFile, RefusesAnExponentWithoutEnd) {
  expect_field_refused(
      changed_field("0.686821280969D-07", "0.00d000000000020000000000000000000000"),
      {"field.gfc:18: C(5,0): must be a finite number"});
  // Leading zeros of an exponent, and no digit before the point, are Fortran's.
  const auto plain = parse_gravity_field("field.gfc", eigen, {0, {5}});
  for (const char* same : {".686821280969D-07", "0.686821280969D-0000007"}) {
    const std::string text = changed_field("0.686821280969D-07", same);
    EXPECT_EQ(parse_gravity_field("field.gfc", text, {0, {5}}).J[5], plain.J[5]);
  }
}

TEST(GravityFieldFile, RefusesAMassThatIsNotThatOfTheGravityConstant) {
  const std::string whole = eigen;
  EXPECT_NO_THROW(parse_gravity_field("field.gfc", whole + "gfc 1 0 0.0 0.0 0 0\n", {0, {5}}));
  expect_field_refused(whole + "gfct 0 0 0.9999 0 0 0 20041001\n", {"C(0,0): must be 1"});
  expect_field_refused(whole + "gfc 1 0 1.5 0.0 0 0\n", {":21: C(1,0): out of range"});
}

TEST(GravityFieldFile, RefusesWhatIsDamagedByFileAndLine) {
  const std::string whole = eigen;
  expect_field_refused("", {"field.gfc:1: the header has no end_of_head"});
  expect_field_refused(whole.substr(0, whole.find("end_of_head")),
                       {":13: the header has no end_of_head"});
  expect_field_refused(changed_field("earth_gravity", "gravity_gravity"),
                       {":14: the header has no earth_g"});
  expect_field_refused(changed_field("radius   ", "ratius   "), {"the header has no radius"});
  expect_field_refused(changed_field("max_degree", "maxdegree"), {"the header has no max_degree"});
  expect_field_refused(changed_field("0.6378136460D+07", ""), {":8: radius: has no value"});
  expect_field_refused(changed_field("0.6378136460D+07", "0"),
                       {":8: radius: must be a positive number"});
  expect_field_refused(changed_field("0.3986004415E+15", "GM"),
                       {":7: earth_gravity_constant: ", "\"GM\""});
  expect_field_refused(changed_field("0.3986004415E+15", "-1"),
                       {"must be a positive number, got \"-1\""});
  // In kilometres it would be subnormal, with fewer digits than the file has.
  expect_field_refused(changed_field("0.3986004415E+15", "1E-305"),
                       {"must be a positive number, got \"1E-305\""});
  expect_field_refused(changed_field("8\n", "eight\n"),
                       {":9: max_degree: must be a natural number"});
  expect_field_refused(changed_field("errors", "radius 1\nerrors"),
                       {":10: radius: is there twice, first in line 8"});
  expect_field_refused(changed_field("gravity_field", "geoid"),
                       {":5: product_type: must be gravity_field"});
  expect_field_refused(changed_field("errors", "norm schmidt\nerrors"),
                       {":10: norm: must be fully_normalized or unnormalized, got \"schmidt\""});
  expect_field_refused(changed_field("gfc    5    0", "gfx    5    0"),
                       {":18: unknown key \"gfx\""});
  expect_field_refused(changed_field(" 0.1926D-11 0.0000D+00", " 0.1926D-11"),
                       {":18: gfc: has 6 columns, must have 5"});
  expect_field_refused(changed_field("dot    2    0 0.116275500000D-10", "dot    2 "),
                       {":17: dot: degree and order"});
  expect_field_refused(changed_field("gfc    5    0", "gfc    5.0  0"),
                       {":18: gfc: degree and order"});
  expect_field_refused(changed_field("gfc    5    0", "gfc   -5    0"),
                       {":18: gfc: degree and order"});
  expect_field_refused(changed_field("gfc    5    1", "gfc    5    6"),
                       {":19: ", "\"5\" and \"6\""});
  expect_field_refused(changed_field("gfc    5    0", "gfc    9    0"),
                       {":18: ", "max_degree of 8"});
  expect_field_refused(changed_field("0.686821280969D-07", "0.6868x1280969D-07"),
                       {":18: C(5,0): must be a finite number, got \"0.6868x1280969D-07\""});
  for (const char* number : {"nan", "inf", "1D400", "1D-400", "--1", "1D", "0x1p-3", "1,5"}) {
    expect_field_refused(changed_field("0.686821280969D-07", number),
                         {":18: C(5,0): must be a finite"});
  }
  expect_field_refused(changed_field("0.686821280969D-07", "0.686821280969"),
                       {":18: C(5,0): out of range", "J5 = -2.27793", "from -1 to 1"});
  expect_field_refused(changed_field("0.100000000000D+01", "0.398600441500D+15"),
                       {":15: C(0,0): must be 1, got"});
  expect_field_refused(whole + "gfc 6 0 -.149953593856D-06 0 0 0\n",
                       {":21: C(6,0) is there twice, first in line 20"});
  expect_field_refused(whole.substr(0, whole.find("gfc    6")),
                       {":19: the file ends without C(6,0)", "max_degree is 8"});
  expect_field_refused(eigen, {"the file ends without C(7,0)"}, {0, {7}});
}

// A file that is cut off anywhere is refused or, if the cut is after the last requested record,
// gives the same field.
TEST(GravityFieldFile, CutOffAnywhere) {
  const std::string whole = eigen;
  const GravityField field = parse_gravity_field("field.gfc", whole, {0, {5}});
  for (std::size_t size = 0; size < whole.size(); ++size) {
    try {
      const GravityField cut = parse_gravity_field("field.gfc", whole.substr(0, size), {0, {5}});
      EXPECT_EQ(cut.J[5], field.J[5]) << size;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input_output) << size;
    }
  }
}

// The coefficients are compared with the digits of the same model in molniya.toml and other scenes.
TEST(GravityFieldFile, TheShippedExcerptHasTheZonalsOfEGM96) {
  const GravityField field = read_gravity_field(egm96, {20});
  EXPECT_EQ(field.model_name, "EGM96");
  EXPECT_EQ(field.tide_system, "tide_free");
  EXPECT_EQ(field.mu_km3_s2, 398600.4415);
  EXPECT_EQ(field.radius_km, 6378.1363);
  const Scene molniya =
      read_scene(std::filesystem::path(HAMJET_SOURCE_DIR) / "data/scenes/molniya.toml");
  EXPECT_EQ(fmt::format("{:.14e}", field.J[2]), fmt::format("{:.14e}", molniya.system.J[2]));
  EXPECT_EQ(fmt::format("{:.14e}", field.J[3]), fmt::format("{:.14e}", molniya.system.J[3]));
  // sqrt(9) and sqrt(25) are whole: three and five times the digits of the file.
  EXPECT_EQ(field.J[4], -1.619621591367e-6);
  EXPECT_EQ(field.J[12], -1.886263182790e-7);
  for (int n = 2; n <= 20; ++n) EXPECT_NE(field.J[n], 0) << n;
}

TEST(GravityFieldFile, RefusesFilesThatAreNone) {
  test::TemporaryDirectory directory;
  for (const auto& [file, words] : std::vector<std::pair<std::filesystem::path, std::string>>{
           {directory.path(), "it is a directory, not a regular file"},
           {directory.path() / "none.gfc", "No such file"},
           {"/dev/zero", "it is a device, not a regular file"}}) {
    try {
      read_gravity_field(file, {2});
      ADD_FAILURE() << file;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input_output);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
}

class SceneWithGravityFile : public testing::Test {
 protected:
  SceneWithGravityFile() {
    std::ofstream(directory_.path() / "field.gfc") << eigen;
    file_ = (directory_.path() / "scene.toml").string();
  }

  /// Reads the sample with its field replaced by these lines, as if it stood beside field.gfc.
  Scene read(const std::string& lines, const std::vector<Override>& overrides = {}) const {
    return parse_scene(
        changed(orbit, "mu_km3_s2 = 398600.4415\nradius_km = 6378\nJ2 = 1e-3\n", lines), file_,
        overrides);
  }

  void expect_error(const std::string& lines, const std::vector<std::string>& words,
                    ErrorKind kind = ErrorKind::scene) const {
    test::expect_error([&] { read(lines); }, kind, words, lines);
  }

  test::TemporaryDirectory directory_;
  std::string file_;
};

TEST_F(SceneWithGravityFile, TakesTheFieldFromTheFileBesideIt) {
  const Scene scene = read("gravity_file = \"field.gfc\"\nzonals = [5, 6]\n");
  const GravityField field = parse_gravity_field("field.gfc", eigen, {0, {5, 6}});
  EXPECT_EQ(scene.system.mu_km3_s2, field.mu_km3_s2);
  EXPECT_EQ(scene.system.radius_km, field.radius_km);
  EXPECT_EQ(scene.system.J[5], field.J[5]);
  EXPECT_EQ(scene.system.J[6], field.J[6]);
  EXPECT_EQ(scene.system.J.highest_present(), 6);
  ASSERT_TRUE(scene.system.gravity_file.has_value());
  EXPECT_EQ(scene.system.gravity_file->file, "field.gfc");
  EXPECT_EQ(scene.system.gravity_file->model_name, "EIGEN-5C");
  EXPECT_EQ(scene.system.gravity_file->tide_system, "zero_tide");
  // The file may have an absolute name, or be given by an override, which is relative to the scene
  // too.
  EXPECT_EQ(read(fmt::format("gravity_file = '{}'\nhighest_zonal = 20\n", egm96.string()))
                .system.J.highest_present(),
            20);
  EXPECT_EQ(
      read("gravity_file = \"none.gfc\"\nzonals = [6]\n", {{"system.gravity_file", "field.gfc"}})
          .system.J[6],
      field.J[6]);
}

TEST_F(SceneWithGravityFile, OneFieldNotTwo) {
  const std::string file = "gravity_file = \"field.gfc\"\n";
  const std::string zonals = "zonals = [5, 6]\n";
  for (const char* line : {"mu_km3_s2 = 398600.4415", "radius_km = 6378", "J6 = 0", "J20 = 1e-9"}) {
    const std::string key = std::string(line).substr(0, std::string(line).find(' '));
    expect_error(file + zonals + line + "\n", {"scene.toml:7:", "system." + key + ": given twice"});
  }
  expect_error(file, {"missing, got none of a choice", "highest_zonal, zonals"});
  expect_error(file + zonals + "highest_zonal = 6\n", {"more than one key of a choice"});
  expect_error("mu_km3_s2 = 1\nhighest_zonal = 6\n", {"highest_zonal: without a gravity_file"});
  expect_error("mu_km3_s2 = 1\nzonals = [6]\n", {"zonals: without a gravity_file"});
}

TEST_F(SceneWithGravityFile, KeysAreChecked) {
  const std::string file = "gravity_file = \"field.gfc\"\n";
  expect_error(file + "highest_zonal = 1\n", {"highest_zonal: out of range, got 1", "2 to 20"});
  expect_error(file + "highest_zonal = 21\n", {"out of range, got 21"});
  expect_error(file + "highest_zonal = 6.0\n", {"highest_zonal: wrong type"});
  expect_error(file + "zonals = [1, 6]\n", {"zonals.0: out of range, got 1"});
  expect_error(file + "zonals = []\n", {"zonals: empty"});
  expect_error(file + "zonals = [6, 5]\n", {"zonals.1: out of order, got 5 after 6"});
  expect_error(file + "zonals = [5, 5]\n", {"zonals.1: out of order"});
  expect_error("gravity_file = 3\nzonals = [5]\n", {"gravity_file: wrong type"});
  expect_error("gravity_file = \"\"\nzonals = [5]\n", {"gravity_file: no path"});
  // An error in the file names the file and its line.
  expect_error("gravity_file = \"none.gfc\"\nzonals = [5]\n",
               {":5:16: system.gravity_file: ", "none.gfc cannot be read"},
               ErrorKind::input_output);
  expect_error("mu_km3_s2 = 1\ngravity_epoch = \"2005-01-01T00:00:00\"\n",
               {"gravity_epoch: without a gravity_file"});
  expect_error("mu_km3_s2 = 1\nleave_out_C10 = true\n", {"leave_out_C10: without a gravity_file"});
}

}  // namespace
}  // namespace hamjet::io
