#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "../../src/report/formation/feedback_errors_view.hpp"
#include "transfer_samples.hpp"

namespace hamjet::io {
namespace {

// The law as a function in C, compiled by the C compiler of the machine without a warning, is the
// polynomial, written here by hand.
TEST(FeedbackInC, IsThePolynomial) {
  if (std::system("command -v cc >/dev/null 2>&1") != 0) GTEST_SKIP() << "no C compiler";
  TransferResult result;
  result.scene.units.time_s = 2;
  result.scene.transfer.emplace();
  const SpacePointer space = SeriesSpace::create(6, 3);
  result.thrust.emplace();
  result.thrust->transfers.resize(1);
  result.thrust->transfers.front().time = 5;
  result.thrust->least = 0;
  FeedbackLaw& law = result.thrust->feedback.emplace();
  // 7 + 2 z vx^2 - 3 y, with a factor for each instant and axis.
  const auto polynomial = [](double factor, const double* x, const double* v) {
    return factor * (7 + 2 * x[2] * v[0] * v[0] - 3 * x[1]);
  };
  const auto factor_of = [](int instant, int axis) { return 1 + instant + 10 * axis; };
  for (int k = 0; k < 2; ++k) {
    FeedbackInstant& instant = law.instants.emplace_back();
    instant.time = 2.5 * k;
    for (int axis = 0; axis < 3; ++axis) {
      Series<double> thrust(space, 7.0 * factor_of(k, axis));
      const std::vector<std::uint8_t> cubic = {0, 0, 1, 2, 0, 0};
      thrust[space->index(cubic)] = 2.0 * factor_of(k, axis);
      thrust[space->linear_index(1)] = -3.0 * factor_of(k, axis);
      instant.thrust.push_back(std::move(thrust));
    }
  }
  const auto folder = std::filesystem::path(testing::TempDir()) / "hamjet-feedback-c";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "feedback.c") << feedback_c_text(result);
  const std::string object = (folder / "feedback.so").string();
  const std::string command = "cc -std=c99 -pedantic -Wall -Wextra -Werror -shared -fPIC -o '" +
                              object + "' '" + (folder / "feedback.c").string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  void* library = dlopen(object.c_str(), RTLD_NOW);
  ASSERT_NE(library, nullptr) << dlerror();
  using Thrust = int(int, const double*, const double*, double*);
  auto* thrust = reinterpret_cast<Thrust*>(dlsym(library, "hamjet_thrust"));
  const auto* times = static_cast<const double*>(dlsym(library, "hamjet_time_s"));
  ASSERT_TRUE(thrust != nullptr && times != nullptr);
  EXPECT_EQ(times[1], 5);
  EXPECT_EQ(times[2], 10);
  const double position[3] = {1.5, -2, 0.25}, velocity[3] = {4, 8, 16};
  double told[3];
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(thrust(k, position, velocity, told), 0);
    for (int axis = 0; axis < 3; ++axis) {
      // All of it is exact in binary64.
      EXPECT_EQ(told[axis], polynomial(factor_of(k, axis), position, velocity));
    }
  }
  EXPECT_EQ(thrust(2, position, velocity, told), -1);
  EXPECT_EQ(thrust(-1, position, velocity, told), -1);
  dlclose(library);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace hamjet::io
