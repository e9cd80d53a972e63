#include <fmt/format.h>

#include <string>

#include "../command_test.hpp"
#include "hamjet/formats/conjunction_data_message.hpp"
#include "support/reference_data.hpp"

// `hamjet uncertainty` of a conjunction data message in place of a scene.

namespace hamjet::test {
namespace {

class ConjunctionMessage : public CommandTest {
 protected:
  /// A published conjunction as a message.
  static io::ConjunctionDataMessage message_of_case(int number) {
    for (const auto& data : read_reference_file("cara_conjunctions.json")) {
      if (data["case"] != number) continue;
      io::ConjunctionDataMessage message;
      message.creation_date = message.tca = parse_epoch(data["tca_utc"].get<std::string>()).value();
      message.originator = "TEST";
      message.message_id = fmt::format("CASE-{}", number);
      for (std::size_t k = 0; k < 2; ++k) {
        io::ConjunctionObject& object = message.objects[k];
        const auto& given = data["objects"][k];
        object.object_designator = object.international_designator = fmt::format("2000-00{}A", k);
        object.catalog_name = "NONE";
        object.object_name = k == 0 ? "ALPHA" : "BETA";
        object.reference_frame = "EME2000";
        for (std::size_t i = 0; i < 3; ++i) {
          object.position_km[i] = given["position_km"][i];
          object.velocity_km_s[i] = given["velocity_km_s"][i];
        }
        for (std::size_t i = 0; i < 6; ++i) {
          for (std::size_t j = 0; j <= i; ++j) {
            object.covariance[i][j] = object.covariance[j][i] = given["covariance_rtn"][i][j];
          }
        }
      }
      return message;
    }
    throw std::runtime_error("no such conjunction");
  }
};

TEST_F(ConjunctionMessage, HasItsProbabilityByOneCommand) {
  write("encounter.cdm", io::cdm_text(message_of_case(29)));
  const std::string out =
      in_one_line(succeed({"uncertainty", "encounter.cdm", "--radius_m", "8", "--set",
                           "uncertainty.collision.samples=20000", "-o", "out"})
                      .out);
  EXPECT_NE(out.find("ALPHA and BETA, closest approach"), std::string::npos) << out;
  EXPECT_NE(out.find("The start of the deputy is taken as Gaussian in elements"), std::string::npos)
      << out;
  const Json collision = read_json(directory_ / "out/summary.json")["collision"];
  // The published probability, of which the formula for short encounters gives a hundredth.
  EXPECT_NEAR(collision["probability"].get<double>(), 3.42e-5, 0.1 * 3.42e-5);
  EXPECT_EQ(collision["gaussian_in"][1], "elements");
  EXPECT_LT(collision["window_s"][0], 0);
  EXPECT_TRUE(std::filesystem::exists(directory_ / "out/encounter.cdm"));
}

TEST_F(ConjunctionMessage, IsRefusedForWhatItLacks) {
  io::ConjunctionDataMessage message = message_of_case(29);
  write("encounter.cdm", io::cdm_text(message));
  expect_error({"uncertainty", "encounter.cdm"}, 3,
               {"encounter.cdm: uncertainty.collision.radius_m: missing", "--radius_m 15"});
  message.objects[1].reference_frame = "ITRF";
  write("turning.cdm", io::cdm_text(message));
  expect_error({"uncertainty", "turning.cdm", "--radius_m", "8"}, 3,
               {"REF_FRAME", "rotate with the Earth", "GCRF or EME2000"});
  message.objects[1].reference_frame = "GCRF";
  write("both.cdm", io::cdm_text(message));
  expect_error({"uncertainty", "both.cdm", "--radius_m", "8"}, 3,
               {"REF_FRAME", "not the same of both objects"});
  message.objects[1].reference_frame = "EME2000";
  for (io::ConjunctionObject& object : message.objects) object.covariance = {};
  write("exact.cdm", io::cdm_text(message));
  expect_error({"uncertainty", "exact.cdm", "--radius_m", "8"}, 3, {"CR_R", "no covariance"});
}

}  // namespace
}  // namespace hamjet::test
