#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hamjet/formats/conjunction_data_message.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "support/temporary_directory.hpp"

// What a CDM says of its objects' mass, areas and coefficients, and the rows of the covariance of
// these.

namespace hamjet::io::conjunction_spacecraft_tests {
namespace {

const std::string chief = "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 1, 7.4]\n";

/// A CDM about that chief and a second object 10 m behind, whose areas and mass are told alone.
ConjunctionDataMessage message() {
  ConjunctionDataMessage message;
  message.creation_date = message.tca = parse_epoch("2026-03-01T06:00:00").value();
  message.originator = message.message_id = "TEST";
  for (ConjunctionObject& object : message.objects) {
    object.object_designator = object.international_designator = object.catalog_name = "NONE";
    object.object_name = &object == &message.objects[0] ? "ONE" : "TWO";
    object.ephemeris_name = "NONE";
    object.reference_frame = "GCRF";
    object.position_km = {7000, 0, 0};
    object.velocity_km_s = {0, 1, 7.4};
    for (std::size_t i = 0; i < 6; ++i) object.covariance[i][i] = i < 3 ? 100 : 1e-4;
  }
  ConjunctionSpacecraft& first = message.objects[0].spacecraft;
  first.drag_m2_kg = 0.02;
  first.radiation_m2_kg = 0.03;
  first.drag_covariance = {1e-4, -2e-3, 0, 0, 0, 0, 1e-6};
  first.radiation_covariance = {0, 0, 0, 0, 0, 0, 1e-7, 4e-6};
  ConjunctionSpacecraft& second = message.objects[1].spacecraft;
  second.mass_kg = 4;
  second.visible_area_m2 = 0.03;
  second.radiation_area_m2 = 0.04;
  return message;
}

class ConjunctionSpacecraftScenes : public ::testing::Test {
 protected:
  void SetUp() override { test::put(folder_.path() / "pair.cdm", cdm_text(message())); }

  Scene scene(const std::string& system, const std::string& more) const {
    return parse_scene("[system]\nmodel = \"earth\"\ngravity_degree = 2\n" + system +
                           "[nominal]\nepoch_utc = \"2026-03-01T06:00:00\"\n" + chief +
                           "[jet]\nduration_s = 600\n" + more,
                       (folder_.path() / "scene.toml").string());
  }

  test::TemporaryDirectory folder_;
};

const std::string air = "atmosphere = \"harris-priester\"\n";
const std::string both = air + "radiation = true\nshadow = \"none\"\n";

TEST(ConjunctionSpacecraft, IsReadAsItIsWritten) {
  const ConjunctionDataMessage read = read_cdm("pair.cdm", cdm_text(message()));
  EXPECT_TRUE(read.doubts.empty());
  const ConjunctionSpacecraft& first = read.objects[0].spacecraft;
  EXPECT_EQ(first.drag_m2_kg, 0.02);
  EXPECT_EQ(first.drag_covariance, message().objects[0].spacecraft.drag_covariance);
  EXPECT_EQ(first.radiation_covariance, message().objects[0].spacecraft.radiation_covariance);
  EXPECT_FALSE(first.mass_kg);
  const ConjunctionSpacecraft& second = read.objects[1].spacecraft;
  EXPECT_EQ(second.mass_kg, 4);
  EXPECT_EQ(second.visible_area_m2, 0.03);
  EXPECT_FALSE(second.drag_covariance);
}

TEST_F(ConjunctionSpacecraftScenes, CoefficientsAndTheirCovariancesAreTaken) {
  const Scene read = scene(both,
                           "[deputy]\nposition_m = [0, 1, 0]\n[uncertainty]\nfile = \"pair.cdm\"\n"
                           "[uncertainty.deputy]\nfile = \"pair.cdm\"\n");
  EXPECT_EQ(read.system.earth->drag_m2_kg, 0.02);
  EXPECT_EQ(read.system.earth->radiation_m2_kg, 0.03);
  // The usual 2.2 and 1.3; an area of the whole stands for that across the motion.
  EXPECT_NEAR(read.deputy->drag_m2_kg.value(), 2.2 * 0.03 / 4, 1e-15);
  EXPECT_NEAR(read.deputy->radiation_m2_kg.value(), 1.3 * 0.04 / 4, 1e-15);
  const StateUncertainty& known = *read.uncertainty->chief;
  ASSERT_EQ(known.parameters.size(), 2U);
  EXPECT_EQ(known.parameters[0].name, "drag_m2_kg");
  EXPECT_NEAR(known.parameters[0].deviation, 1e-3, 1e-15);
  const Matrix<double> joint = known.joint_matrix();
  EXPECT_EQ(joint(6, 1), -2e-3);
  EXPECT_EQ(joint(7, 6), 1e-7);
  EXPECT_NEAR(joint(7, 7), 4e-6, 1e-20);
  EXPECT_TRUE(read.uncertainty->deputy->parameters.empty());
}

TEST_F(ConjunctionSpacecraftScenes, RowsOfForcesThatAreNotThereAreLeftOut) {
  const std::string uncertainty = "[uncertainty]\nfile = \"pair.cdm\"\n";
  EXPECT_TRUE(scene("", uncertainty).uncertainty->chief->parameters.empty());
  const Scene in_air = scene(air, "[spacecraft]\ndrag_m2_kg = 0.025\n" + uncertainty);
  ASSERT_EQ(in_air.uncertainty->chief->parameters.size(), 1U);
  EXPECT_EQ(in_air.system.earth->drag_m2_kg, 0.025);
  bool is_warned = false;
  for (const std::string& warning : in_air.warnings) {
    is_warned = is_warned || warning.find("CD_AREA_OVER_MASS of OBJECT1") != warning.npos;
  }
  EXPECT_TRUE(is_warned);
}

}  // namespace
}  // namespace hamjet::io::conjunction_spacecraft_tests
