#include "command_test.hpp"

// The memory that high orders take. The bounds are the program's promises; the tests measure the
// largest resident size of the whole process.

namespace hamjet::test {
namespace {

class Memory : public CommandTest {
 protected:
  /// The paper's orbit in all 6 variables over its full time, by gauss8 alone, without reference.
  CommandResult run_paper_orbit(int order, const std::string& kinds) {
    options_.limit = std::chrono::seconds(600);
    return succeed(
        {"run", std::string(HAMJET_SOURCE_DIR) + "/data/scenes/paper/earth-orbit.toml", "-q",
         "--set", "jet.order=" + std::to_string(order), "--set", "reference=null", "--set",
         "generating_function=" + kinds, "--set",
         "integrator=[{label=\"gauss8\", method=\"gauss\", stages=8, tolerance=1e-13}]"});
  }

#if defined(__SANITIZE_ADDRESS__)
  void expect_peak_below(long /*bytes*/, int /*order*/, const std::string& /*kinds*/) {
    GTEST_SKIP() << "the address sanitizer takes memory of its own";
  }
#else
  void expect_peak_below(long bytes, int order, const std::string& kinds) {
    const CommandResult result = run_paper_orbit(order, kinds);
    EXPECT_LT(result.peak_resident_bytes, bytes) << "order " << order << ", " << kinds;
    // The computed jet has at least this size: 6 components of C(6 + order, 6) numbers.
    double coefficients = 6;
    for (int k = 1; k <= 6; ++k) coefficients *= static_cast<double>(order + k) / k;
    EXPECT_GT(static_cast<double>(result.peak_resident_bytes), 8 * coefficients);
    const Json summary = read_json(directory_ / "out/earth-orbit/summary.json");
    EXPECT_EQ(summary["order"], order);
    EXPECT_EQ(summary["variables"].size(), 6U);
  }
#endif
};

// A table of deviations of any length goes through the memory of a few thousand rows: 3.1 GB of ten
// million would be 310 bytes a row.
TEST_F(Memory, DoesNotGrowWithTheRowsOfATable) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the address sanitizer takes memory of its own";
#else
  succeed({"run", "quick.toml", "-q", "-o", "results"});
  const auto peak = [&](int rows, const std::vector<std::string>& more) {
    std::string text = "R_m,T_m,N_m,vR_m_s,vT_m_s,vN_m_s\n";
    for (int i = 0; i < rows; ++i) text += "1.5,2.5,3.5,0.01,0.02,0.03\n";
    write("start.csv", text);
    std::vector<std::string> arguments = {"eval", "results", "--deviations", "start.csv", "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const CommandResult result = succeed(arguments);
    if (more.empty()) {
      EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), rows + 1);
    }
    return result.peak_resident_bytes;
  };
  // The first megabytes of the printed output are kept in memory.
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"-o", "end.csv"}, {"--json"}, {}}) {
    const long growth = peak(160'000, more) - peak(60'000, more);
    EXPECT_LT(growth, 15'000'000) << ::testing::PrintToString(more);
  }
  const Table table = read_table(directory_ / "end.csv");
  EXPECT_EQ(table.rows.size(), 60'000U);
  EXPECT_EQ(table.rows.front(), table.rows.back());
#endif
}

// Samples take six numbers of eight bytes each at least, of ten million 480 MB.
TEST_F(Memory, OfSamplesIsKnownBeforeTheyAreFlown) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the address sanitizer reserves more than any limit";
#else
  write("many.toml", "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n" + orbit_elements +
                         "[jet]\norder = 1\nduration_s = 60\n[uncertainty]\n"
                         "position_m = [1, 1, 1]\nsamples = 10000000\n");
  const Json told = Json::parse(succeed({"check", "many.toml", "--json"}).out);
  EXPECT_GT(told["uncertainty_memory_bytes"].get<double>(), 480e6);
  options_.address_space = 200'000'000;
  expect_error({"uncertainty", "many.toml"}, 6,
               {"uncertainty.samples: 10000000 at", "MB are free; fewer samples"});
#endif
}

TEST_F(Memory, Order8IntegrationAlone) { expect_peak_below(200'000'000, 8, "null"); }
TEST_F(Memory, Order8WithF1) { expect_peak_below(200'000'000, 8, "{kinds=[\"F1\"]}"); }
TEST_F(Memory, Order10IntegrationAlone) { expect_peak_below(1'000'000'000, 10, "null"); }

}  // namespace
}  // namespace hamjet::test
