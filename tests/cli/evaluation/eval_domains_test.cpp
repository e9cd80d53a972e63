#include <algorithm>
#include <cmath>
#include <string>

#include "eval_command_test.hpp"
#include "support/text.hpp"

// `hamjet eval` of a scene whose table [eval] asks for domains. Expected: on a circle of Kepler's
// problem a deputy at the same distance and speed stays on the circle, at the same angle.

namespace hamjet::test {
namespace {

constexpr double radius_m = 7e6;
const std::string small_tolerance = "[eval]\ntolerance_m = 0.01\n";

class EvalDomains : public EvalTest {
 protected:
  /// Deputies ahead and behind on the chief's circle, by these angles.
  static std::string deputies() {
    std::string rows = "R_m,T_m,N_m,vR_m_s,vT_m_s,vN_m_s\n";
    for (int k = -8; k <= 8; ++k) {
      const double angle = 0.01 * k;
      rows += std::to_string(radius_m * (std::cos(angle) - 1)) + "," +
              std::to_string(radius_m * std::sin(angle)) + ",0,0,0,0\n";
    }
    return rows;
  }
};

TEST_F(EvalDomains, EachDeputyIsRightWithPolynomialsOfItsOwnPart) {
  write("far.toml", circular_scene + small_tolerance);
  write("one.toml", circular_scene);
  write("in.csv", deputies());
  const Json json = eval_json({"far.toml", "--deviations", "in.csv"});
  const Json& domains = json["domains"];
  EXPECT_GT(domains["count"].get<int>(), 2);
  EXPECT_EQ(domains["is_limited"], false);
  EXPECT_EQ(domains["not_right"], 0);
  EXPECT_EQ(domains["first"].size(), domains["count"].get<std::size_t>());
  EXPECT_EQ(json["outside"], 0);
  double worst_of_one = 0;
  const Json one = eval_json({"one.toml", "--deviations", "in.csv"});
  EXPECT_TRUE(one["domains"].is_null());
  for (std::size_t k = 0; k < json["rows"].size(); ++k) {
    const double angle = 0.01 * (static_cast<double>(k) - 8);
    const auto miss = [&](const Json& row) {
      return std::hypot(row["R_m"].get<double>() - radius_m * (std::cos(angle) - 1),
                        row["T_m"].get<double>() - radius_m * std::sin(angle));
    };
    EXPECT_LT(miss(json["rows"][k]), 0.01) << k;
    worst_of_one = std::max(worst_of_one, miss(one["rows"][k]));
  }
  EXPECT_GT(worst_of_one, 10);
}

TEST_F(EvalDomains, LimitIsToldAndMarked) {
  write("far.toml", circular_scene + small_tolerance + "most_domains = 2\n");
  write("in.csv", deputies());
  const CommandResult outcome = hamjet({"eval", "far.toml", "--deviations", "in.csv"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("2 domains"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("a larger eval.most_domains may do"), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.out.find(",outside\n"), std::string::npos);
  expect_error({"eval", "far.toml", "--deviations", "in.csv", "--degree", "1"}, 2,
               {"degree 1: has no estimate by which deputies could be split"});
  expect_error({"eval", "far.toml", "--deviations", "in.csv", "--set", "jet.order=1"}, 3,
               {"far.toml", "eval: no estimate of the miss to split deputies by"});
}

// Results have polynomials about the chief alone. Expected: what the scene marks with one domain.
TEST_F(EvalDomains, StoredResultsMarkWhatIsNotRight) {
  store("stored", circular_scene + small_tolerance);
  write("one.toml", circular_scene + small_tolerance + "most_domains = 1\n");
  write("in.csv", deputies());
  const Json stored = eval_json({"stored", "--deviations", "in.csv"});
  const Json one = eval_json({"one.toml", "--deviations", "in.csv"});
  EXPECT_GT(stored["outside"].get<int>(), 2);
  EXPECT_LT(stored["outside"].get<int>(), 17);
  EXPECT_EQ(stored["outside"], one["outside"]);
  EXPECT_TRUE(stored["domains"].is_null());
  const CommandResult outcome = hamjet({"eval", "stored", "--deviations", "in.csv"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("not right to 10 mm"), std::string::npos) << outcome.err;
  store("free", circular_scene);
  EXPECT_EQ(eval_json({"free", "--deviations", "in.csv"})["outside"], 0);
}

}  // namespace
}  // namespace hamjet::test
