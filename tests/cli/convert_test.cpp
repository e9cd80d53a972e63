#include <sys/stat.h>

#include "command_test.hpp"
#include "formats/hdf5/hdf5_jets.hpp"

// `hamjet convert`, and what other commands say of files of jets.

namespace hamjet::test {
namespace {

class ConvertTest : public CommandTest {
 protected:
  void SetUp() override { succeed({"run", "quick.toml", "-q", "-o", "results"}); }

  /// The endings of this build.
  static std::vector<std::string> endings() {
    std::vector<std::string> all = {".dace", ".csv"};
    if (io::hdf5_available()) all.emplace_back(".h5");
    return all;
  }
};

TEST_F(ConvertTest, ThereAndBack) {
  const std::string midpoint = content(directory_ / "results" / "midpoint" / "jet.csv");
  for (const std::string& ending : endings()) {
    const std::string file = "results/other" + ending;
    EXPECT_EQ(succeed({"convert", "results", file, "--run", "midpoint"}).out, "");
    // A file of coefficients does not name the run that they belong to.
    succeed({"convert", file, "back.csv", "--run", "midpoint"});
    EXPECT_EQ(content(directory_ / "back.csv"), midpoint) << ending;
    const std::string one = "100,-200,300,0.1,0,0.2";
    EXPECT_EQ(succeed({"eval", file, "--run", "midpoint", "-q", "--deviation", one}).out,
              succeed({"eval", "results", "--run", "midpoint", "-q", "--deviation", one}).out);
  }
}

// A jet in other coordinates of each end says so, loses rounding alone on the way there and back,
// stays symplectic, and predicts what the same polynomials do where they are integrated.
TEST_F(ConvertTest, BetweenCoordinates) {
  if (!io::hdf5_available()) GTEST_SKIP();
  const std::vector<std::string> ends = {"--coordinates", "nodal", "--end-coordinates", "poincare"};
  const std::vector<std::string> row = {"--deviation=100,-200,300,0.1,0,0.2", "--json", "-q"};
  const auto with = [](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const auto evaluated = [&](const std::vector<std::string>& words) {
    return Json::parse(succeed(with(words, row)).out);
  };
  const std::string said = succeed(with({"convert", "results", "chart.h5"}, ends)).out;
  EXPECT_EQ(said.find("from cartesian to nodal to poincare coordinates"), 0U) << said;
  std::istringstream lines(said.substr(said.find("degree  ")));
  std::string heads;
  std::getline(lines, heads);
  int degree = 0;
  int last = 0;
  for (double lost = 0, defect = 0; lines >> degree >> lost >> defect; last = degree) {
    // The bound is the rounding to double precision times the factor by which the charts'
    // coefficients of the degree amplify it.
    EXPECT_LT(lost, 1e-13) << said;
    EXPECT_LT(defect, 1e-13) << said;
  }
  EXPECT_EQ(last, 2);
  const Json stored = evaluated({"eval", "chart.h5"});
  EXPECT_EQ(stored["coordinates"], "nodal");
  EXPECT_EQ(stored["end_coordinates"], "poincare");
  const Json& work = stored["evaluation"];
  EXPECT_GT(work["chart_seconds"].get<double>(), 0);
  EXPECT_LE(work["chart_seconds"].get<double>(), work["seconds"].get<double>());
  const Json integrated = evaluated(with_overrides(
      {"eval", "quick.toml"}, {"jet.coordinates=nodal", "jet.end_coordinates=poincare"}));
  const Json plain = evaluated({"eval", "results"});
  for (const char* const name : {"R_m", "T_m", "N_m"}) {
    const double found = stored["rows"][0][name];
    EXPECT_NEAR(found, integrated["rows"][0][name].get<double>(),
                1e-7);  // rounding of 7000 km in 7 digits
    EXPECT_NE(found, plain["rows"][0][name].get<double>());
  }
  EXPECT_NEAR(stored["rows"][0]["rounding_m"].get<double>(),
              integrated["rows"][0]["rounding_m"].get<double>(),
              1e-3 * integrated["rows"][0]["rounding_m"].get<double>());
  succeed({"convert", "chart.h5", "back.h5", "--coordinates", "cartesian"});
  const Json back = evaluated({"eval", "back.h5"});
  EXPECT_EQ(back["coordinates"], "cartesian");
  for (const char* const name : {"R_m", "T_m", "N_m"}) {
    EXPECT_NEAR(back["rows"][0][name].get<double>(), plain["rows"][0][name].get<double>(), 1e-9);
  }
  // Copied as it is, it keeps its coordinates; others than .h5 have no place for them.
  succeed({"convert", "chart.h5", "copy.h5"});
  EXPECT_EQ(evaluated({"eval", "copy.h5"})["rows"], stored["rows"]);
  expect_error({"convert", "chart.h5", "chart.csv"}, 2, {".csv", "nodal to poincare", ".h5"});
  expect_error({"convert", "results", "box.h5", "--coordinates", "flow-box"}, 2,
               {"--coordinates flow-box", "results", "--scene"});
  expect_error({"convert", "results", "box.h5", "--scene", "quick.toml"}, 2, {"--scene"});
  expect_error({"convert", "results", "box.h5", "--coordinates", "flow-box", "--end-coordinates",
                "nodal", "--scene", "quick.toml"},
               2, {"flow-box to nodal", "both ends"});
  expect_error({"convert", "results", "auto.h5", "--coordinates", "auto"}, 2,
               {"--coordinates auto"});
  expect_error({"transfer", "quick.toml", "--jet", "chart.h5"}, 2,
               {"chart.h5", "nodal to poincare coordinates", "--coordinates cartesian"});
}

// A flow box that is composed of a jet predicts what the integrated one does, and is the jet again;
// a jet in a chart gives the same one. In another field it is refused.
TEST_F(ConvertTest, AJetToAFlowBox) {
  if (!io::hdf5_available()) GTEST_SKIP();
  const std::string orbit =
      "[system]\nmodel = \"zonal-gravity\"\nmu_km3_s2 = 398600.4415\nradius_km = 6378.1363\n"
      "J2 = 1.0826e-3\n[nominal]\na_km = 7000\ne = 0.01\ni_deg = 50\nraan_deg = 0\n"
      "argp_deg = 20\nta_deg = 10\n[jet]\nduration_orbits = 1.3\norder = 2\n"
      "[[integrator]]\nlabel = \"gauss\"\nmethod = \"gauss\"\nstages = 8\ntolerance = 1e-13\n";
  write("orbit.toml", orbit);
  succeed({"run", "orbit.toml", "-q", "-o", "jets"});
  const auto row_of = [&](const std::vector<std::string>& words) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--deviation=100,-200,300,0.1,0,0.2", "--json", "-q"});
    return Json::parse(succeed(all).out)["rows"][0];
  };
  const std::vector<std::string> to = {"--coordinates", "flow-box", "--scene", "orbit.toml"};
  const auto converted = [&](const std::string& from, const std::string& file) {
    std::vector<std::string> words = {"convert", from, file};
    words.insert(words.end(), to.begin(), to.end());
    return succeed(words).out;
  };
  const std::string said = converted("jets", "box.h5");
  EXPECT_EQ(said.find("from cartesian to flow-box coordinates"), 0U) << said;
  std::istringstream lines(said.substr(said.find("degree  ")));
  std::string heads;
  std::getline(lines, heads);
  int degree = 0;
  for (double lost = 0, defect = 0; lines >> degree >> lost >> defect;) {
    EXPECT_LT(lost, 2e-12) << said;  // rounding of the way back, as in FlowBoxMapOfJet
  }
  EXPECT_EQ(degree, 2) << said;
  succeed({"convert", "jets", "chart.h5", "--coordinates", "spherical"});
  converted("chart.h5", "again.h5");
  succeed({"convert", "box.h5", "back.h5", "--coordinates", "cartesian"});
  const Json integrated =
      row_of(with_overrides({"eval", "orbit.toml"}, {"jet.coordinates=flow-box"}));
  const Json box = row_of({"eval", "box.h5"});
  const Json again = row_of({"eval", "again.h5"});
  const Json plain = row_of({"eval", "jets"});
  const Json back = row_of({"eval", "back.h5"});
  for (const char* const name : {"R_m", "T_m", "N_m"}) {
    const double found = box[name];
    // The bound is some 1e-13 of 7000 km for the integrations, plus the charts' rounding.
    EXPECT_NEAR(found, integrated[name].get<double>(), 1e-5);
    EXPECT_NEAR(found, again[name].get<double>(), 1e-6);
    EXPECT_NEAR(back[name].get<double>(), plain[name].get<double>(), 1e-7);
    EXPECT_NE(found, plain[name].get<double>());
  }
  write("other.toml", changed(orbit, "J2 = 1.0826e-3", "J2 = 1.0e-3"));
  expect_error(
      {"convert", "jets", "wrong.h5", "--coordinates", "flow-box", "--scene", "other.toml"}, 2,
      {"--scene", "flies to another place", "another field"});
  EXPECT_FALSE(std::filesystem::exists(directory_ / "wrong.h5"));
}

TEST_F(ConvertTest, ExtendedPrecisionInTheTextOfDace) {
  succeed({"run", "quick.toml", "-q", "-o", "extended", "--set", "precision=extended", "--set",
           "integrator.midpoint=null"});
  const CommandResult result = hamjet({"convert", "extended", "jet.dace"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("17 digits"), std::string::npos) << result.err;
  EXPECT_NE(content(directory_ / "jet.dace").find("rounded"), std::string::npos);
}

// A kick and a drift: q + 2 p + p^2 and p, about q = 0.5 and p = 0.25.
TEST_F(ConvertTest, AJetFromElsewhere) {
  const std::string rule(48, '-');
  const std::string head = "     I  COEFFICIENT              ORDER EXPONENTS\n";
  write("map.dace", "[[[ 2 vector\n" + head +
                        "     1    1.2500000000000000e+00   0   0  0\n"
                        "     2    1.0000000000000000e+00   1   1  0\n"
                        "     3    2.0000000000000000e+00   1   0  1\n"
                        "     4    1.0000000000000000e+00   2   0  2\n" +
                        rule + "\n" + head +
                        "     1    2.5000000000000000e-01   0   0  0\n"
                        "     2    1.0000000000000000e+00   1   0  1\n" +
                        rule + "\n]]]\n");
  const std::vector<std::string> told = {"--model=own", "--length-unit-km=7000",
                                         "--time-unit-s=1000", "--duration-canonical=2",
                                         "--nominal-initial=0.5,0.25"};
  const auto converting = [&](const std::string& to, std::vector<std::string> options) {
    std::vector<std::string> arguments = {"convert", "map.dace", to};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
  };
  succeed(converting("map.csv", told));
  EXPECT_NE(content(directory_ / "map.csv").find("q,0,1,2\n"), std::string::npos);
  EXPECT_NE(content(directory_ / "map.csv").find("p,0,2,0\n"), std::string::npos);
  if (io::hdf5_available()) {
    succeed(converting("map.h5", told));
    // q + 2 p + p^2 moves by 0.2 + 0.01 for a deviation of 0.1 in p.
    const std::string out =
        succeed({"eval", "map.h5", "-q", "--frame", "canonical", "--deviation", "0,0.1"}).out;
    EXPECT_NE(out.find("0.21"), std::string::npos) << out;
  }
  expect_error(converting("a.csv", {}), 5, {"no summary.json", "--length-unit-km"});
  expect_error(converting("a.csv", {told[0], told[3]}), 2,
               {"map.dace", "needs length_unit_km, time_unit_s, nominal_initial",
                "--length-unit-km, --time-unit-s, --nominal-initial"});
  const auto expect_wrong = [&](std::size_t i, const std::string& option, int code,
                                const std::vector<std::string>& words) {
    auto options = told;
    options[i] = option;
    expect_error(converting("a.csv", options), code, words);
  };
  expect_wrong(0, "--model=kelper", 2, {"model: got \"kelper\"", "did you mean kepler?"});
  expect_wrong(0, "--model=kepler", 2, {"nominal_initial: got 2 numbers, must be 6"});
  expect_wrong(1, "--length-unit-km=0", 2, {"length_unit_km: got 0, must be above 0"});
  expect_wrong(2, "--time-unit-s=nan", 2, {"time_unit_s: got nan, must be finite"});
  expect_wrong(4, "--nominal-initial=0.5,x", 2, {"--nominal-initial", "\"x\""});
  expect_wrong(4, "--nominal-initial=0.5,0,0,0", 5,
               {"map.dace: has 2 polynomials in 2 variables, must have 4 in 4"});
  auto options = told;
  options.push_back("--run=gauss8");
  expect_error(converting("a.csv", options), 2, {"has no runs", "gauss8"});
  expect_error({"convert", "results", "a.csv", told[0]}, 2, {"results", ".dace alone"});
}

TEST_F(ConvertTest, Mistakes) {
  expect_error({"convert"}, 2, {"from"});
  expect_error({"convert", "results"}, 2, {"to"});
  expect_error({"convert", "", "a.csv"}, 2, {"from: empty"});
  expect_error({"convert", "results", ""}, 2, {"must end in .h5, .dace or .csv"});
  expect_error({"convert", "results", "a.txt"}, 2, {"a.txt", "must end in .h5, .dace or .csv"});
  expect_error({"convert", "results", "a.csv", "--run", ""}, 2, {"--run: empty"});
  expect_error({"convert", "results", "a.csv", "--run", "gaus8"}, 2, {"did you mean gauss8?"});
  expect_error({"convert", "results/gauss8/jet.csv", "results/gauss8/jet.csv"}, 2, {"same file"});
  expect_error({"convert", "results", "results/gauss8/jet.csv"}, 2, {"would be replaced"});
  for (const char* file : {"results/gauss8/nominal.csv", "results/summary.json"}) {
    const std::string one = "100,-200,300,0.1,0,0.2";
    expect_error({"eval", "results", "--deviation", one, "-o", file}, 2, {"would be replaced"});
  }
  expect_error({"convert", "results", "results/gauss8/nominal.csv"}, 2, {"would be replaced"});
  expect_error({"convert", "results/summary.json", "a.csv"}, 5,
               {"summary.json: is neither a results directory"});
  expect_error({"convert", "absent", "a.csv"}, 5, {"absent/summary.json", "No such file"});
  expect_error({"convert", "absent.h5", "a.csv"}, 5, {"absent.h5: cannot be read: No such file"});
  expect_error({"convert", "results", "quick.toml/a.csv"}, 5, {"quick.toml"});
  write("far.csv", content(directory_ / "results" / "gauss8" / "jet.csv"));
  expect_error({"convert", "far.csv", "a.csv"}, 5, {"far.csv: no summary.json beside it"});
  ASSERT_EQ(::mkfifo((directory_ / "pipe.csv").c_str(), 0600), 0);
  expect_error({"convert", "pipe.csv", "a.csv"}, 5, {"pipe.csv", "not a regular file"});
  if (!io::hdf5_available()) {
    expect_error({"convert", "results", "a.h5"}, 2, {"-DHAMJET_HDF5=ON"});
    expect_error({"eval", "far.h5", "--deviation", "0"}, 5, {"far.h5"});
  }
}

// Files with names that results also have, outside of results, are the user's own.
TEST_F(ConvertTest, FilesOfTheirOwn) {
  for (int times = 0; times < 2; ++times) succeed({"convert", "results", "jet.csv"});
  if (!io::hdf5_available()) return;
  for (int times = 0; times < 2; ++times) succeed({"convert", "results", "jets.h5"});
  // The file is read in the folder in which it lies.
  succeed({"convert", "jets.h5", "again.h5"});
  EXPECT_EQ(content(directory_ / "again.h5"), content(directory_ / "jets.h5"));
}

TEST_F(ConvertTest, DamagedFiles) {
  for (const std::string& ending : endings()) {
    const std::string name = "results/cut" + ending;
    succeed({"convert", "results", name});
    const std::string good = content(directory_ / name);
    for (const std::size_t length : {std::size_t{0}, std::size_t{100}, good.size() / 2}) {
      write(name, good.substr(0, length));
      expect_error({"eval", name, "--run", "gauss8", "--deviation", "0,0,0,0,0,0"}, 5,
                   {"cut" + ending + ":"});
    }
  }
  // A file of the results themselves, changed in a place that still reads well.
  const std::string csv = "results/gauss8/jet.csv";
  write(csv, changed(content(directory_ / csv), "x,1,0,0,0,0,0,", "x,1,0,0,0,0,0,-"));
  expect_error({"convert", csv, "a.csv"}, 5, {"jet.csv", "CRC-32"});
}

}  // namespace
}  // namespace hamjet::test
