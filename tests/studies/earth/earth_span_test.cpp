#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/transfer.hpp"
#include "support/errors.hpp"

// The span for which the Earth's axes, Sun and Moon are known has all that a study flies. Expected:
// sums of the scene's own numbers.

namespace hamjet {
namespace {

Scene scene_of(double duration_s, const std::string& more) {
  return io::parse_scene(fmt::format(R"(
[system]
model = "earth"
gravity_degree = 2
sun = false
moon = false
[nominal]
epoch_utc = "2026-03-01T06:00:00"
height_km = 514
i_deg = 97.5
raan_deg = 30
u_deg = 0
[deputy]
position_m = [100, -2000, 300]
[jet]
order = 2
duration_s = {}
{})",
                                     duration_s, more),
                         "span.toml");
}

void expect_span(const Scene& scene, double first_s, double last_s) {
  EXPECT_NEAR(scene.system.earth->first_s, first_s, 1e-9 * 864000);
  EXPECT_NEAR(scene.system.earth->last_s, last_s, 1e-9 * 864000);
}

constexpr const char* coasting_transfer =
    "[transfer]\ntimes_s = [1200, 2000]\nend = { position_m = [0, -100, 0] }\nlongest_coast_s = "
    "45000\n";

TEST(EarthSpan, HasWhatTheJetFlies) {
  expect_span(scene_of(3000, ""), 0, 3000);
  expect_span(scene_of(-3000, ""), -3000, 0);
}

TEST(EarthSpan, HasTheWaitOfATransfer) {
  expect_span(scene_of(3000, coasting_transfer), 0, 47000);
  expect_span(scene_of(-3000,
                       "[transfer]\ntimes_s = [-1200, -2000]\nend = { position_m = [0, -100, 0] "
                       "}\nlongest_coast_s = 45000\n"),
              -47000, 0);
}

TEST(EarthSpan, HasTheTimesOfEveryTable) {
  // Without a wait the transfer is over before the jet.
  expect_span(
      scene_of(3000, "[transfer]\ntimes_s = [1200, 2000]\nend = { position_m = [0, -100, 0] }\n"),
      0, 3000);
  expect_span(scene_of(3000, "[validity]\ntimes_s = [1000, 3000]\n"), 0, 3000);
}

// A wait of half a day is twice as long as the margin that functions of time have beyond their
// span.
TEST(EarthSpan, ATransferThatWaitsIsFlown) {
  const TransferResult result = study_transfer(scene_of(3000, coasting_transfer));
  ASSERT_TRUE(result.coasting && result.coasting->plan) << result.coasting->failure;
  EXPECT_EQ(exit_code(result), 0);
  const double total = result.coasting->plan->total_change_m_s();
  ASSERT_TRUE(result.best_point());
  EXPECT_LE(total, result.points[*result.best_point()].best().total_change_m_s() * (1 + 1e-6));
}

// The scene of a date near the last known one is read without the wait alone.
TEST(EarthSpan, AWaitBeyondTheKnownDatesIsRefused) {
  const std::string late = R"(
[system]
model = "earth"
gravity_degree = 2
[nominal]
epoch_utc = "2099-12-31T20:00:00"
height_km = 514
i_deg = 97.5
raan_deg = 30
u_deg = 0
[deputy]
position_m = [100, -2000, 300]
[jet]
order = 1
duration_s = 3000
)";
  EXPECT_NO_THROW(io::parse_scene(late, "late.toml"));
  test::expect_error(ErrorKind::scene, "flights that leave the dates",
                     [&] { io::parse_scene(late + coasting_transfer, "late.toml"); });
}

}  // namespace
}  // namespace hamjet
