#include <cmath>
#include <map>
#include <regex>

#include "../command_test.hpp"
#include "support/magnitude.hpp"

// Figures that data/paper/README.md and the comments of the paper's scenes state are those of the
// scenes as shipped, in the digits stated. Figures of round-off, which differ between processors,
// are left out.

namespace hamjet::test {
namespace {

class PaperFigures : public CommandTest {
 protected:
  PaperFigures() { options_.limit = std::chrono::seconds(300); }  // sanitizers make it slow

  static std::string data(const std::string& file) {
    return std::string(HAMJET_SOURCE_DIR) + "/data/" + file;
  }

  Json run(const std::string& scene, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"run", data("scenes/paper/" + scene + ".toml"), "-o",
                                          "out", "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    succeed(arguments);
    return read_json(directory_ / "out/summary.json");
  }

  /// The number that follows `words` in a text, as it is written there.
  static std::string stated(const std::string& text, const std::string& words) {
    const std::size_t place = text.find(words);
    std::smatch number;
    const std::string rest =
        place == std::string::npos ? "" : text.substr(place + words.size(), 20);
    if (!std::regex_search(rest, number, std::regex("^[0-9]+\\.[0-9]+(e-?[0-9]+)?"))) {
      ADD_FAILURE() << "no number after '" << words << "'";
      return "0.0";
    }
    EXPECT_EQ(text.find(words, place + 1), std::string::npos) << "twice: " << words;
    return number.str();
  }

  /// The number after `words` is `measured`, rounded to its digits.
  static void expect_stated(const std::string& text, const std::string& words, double measured) {
    const std::string number = stated(text, words);
    const std::size_t exponent = std::min(number.find('e'), number.size());
    const std::string half_unit =
        "0." + std::string(exponent - number.find('.') - 1, '0') + "5" + number.substr(exponent);
    EXPECT_NEAR(measured, std::stod(number), std::stod(half_unit)) << words;
  }

  const std::string page_ = content(data("paper/README.md"));
};

TEST_F(PaperFigures, OfTheEnergyConservingMidpointMethod) {
  const Json summary = run("energy-midpoint-kepler");
  const std::string scene = content(data("scenes/paper/energy-midpoint-kepler.toml"));
  expect_stated(scene, "from perigee to apogee by a factor of ",
                summary["largest_step_canonical"].get<double>() /
                    summary["smallest_step_canonical"].get<double>());
  expect_stated(page_, "the midpoint rule with the same mean step has ",
                summary["fixed_step"]["largest_energy_error"]);
}

TEST_F(PaperFigures, OfTheStopsOfTheEnergyConservingMethods) {
  const Json eccentric = run("energy-midpoint-stops-eccentric")["stop"];
  expect_stated(page_, "e = 0.85 at t = ", eccentric["time_canonical"]);
  const std::string at = "e = 0.85 at t = " + stated(page_, "e = 0.85 at t = ");
  expect_stated(page_, at + " (predicted ", eccentric["predicted_time_canonical"]);
  const Json well = run("energy-midpoint-stops-double-well")["stop"];
  expect_stated(page_, "double well at ", well["time_canonical"]);
  const std::string in_well = "double well at " + stated(page_, "double well at ");
  expect_stated(page_, in_well + " (", well["predicted_time_canonical"]);
  const Json stormer = run("energy-stormer-stops-kepler")["stop"];
  expect_stated(page_, "stops before apogee: e = 0.3 at t = ", stormer["time_canonical"]);
}

TEST_F(PaperFigures, OfStormerAndNewmark) {
  // The nominal does not depend on the order, nor does the defect of degree 0, the largest; Gauss
  // with 8 stages stands for the reference, which takes most of the time.
  const Json summary = run("stormer-verlet", {"--set", "jet.order=1", "--set", "reference=null"});
  std::map<std::string, Json> runs;
  for (const Json& entry : summary["runs"]) runs[entry["label"]] = entry;
  const Json& exact = runs.at("gauss8")["nominal_final"];
  double error = 0;
  double largest = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double reference = exact[i];
    const double value = runs.at("stormer")["nominal_final"][i];
    error = larger(error, std::abs(value - reference));
    largest = std::max(largest, std::abs(reference));
  }
  expect_stated(page_, "over 10 pi, at an error of the nominal of ", error / largest);
  expect_stated(page_, "in (q, p) a defect of ",
                runs.at("newmark")["symplecticity_by_degree"][0]["scaled"]);
}

TEST_F(PaperFigures, OfTheDoubleWell) {
  const Json runs = run("double-well")["runs"];
  ASSERT_EQ(runs.size(), 2U);
  expect_stated(page_, "tau = 0.1: error ", runs[0]["largest_energy_error"]);
  EXPECT_EQ(runs[0]["crosses_barrier"], true);
  expect_stated(page_, "tau = 0.2: ", runs[1]["largest_energy_error"]);
  EXPECT_EQ(runs[1]["crosses_barrier"], false);
}

}  // namespace
}  // namespace hamjet::test
