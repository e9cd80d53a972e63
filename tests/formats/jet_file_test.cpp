#include "hamjet/formats/jet_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <fstream>
#include <functional>
#include <iterator>
#include <thread>

#include "../scene/scene_samples.hpp"
#include "formats/dace_text.hpp"
#include "formats/hdf5/hdf5_jets.hpp"
#include "hamjet/report/results.hpp"
#include "jet_samples.hpp"
#include "support/temporary_directory.hpp"

// A jet comes back bit by bit from HDF5, DACE's text and CSV; damaged files are refused. What h5py
// makes of jets.h5, and the damage that h5py can do, are in jets_hdf5_test.py.

namespace hamjet::io {
namespace {

const std::string cubic_kepler =
    changed(planar_kepler, "order = 2", "order = 3") + "[generating_function]\nkinds = [\"F1\"]\n";

/// The same number with the same sign, zero included.
bool same(const Extended& a, const Extended& b) { return a == b && !signbit(a) == !signbit(b); }

class JetFileTest : public ::testing::Test {
 protected:
  PropagationResult store(const std::vector<Override>& overrides = {}) {
    Scene scene = parse_scene(text_, "scene.toml", overrides);
    scene.start_time = start_time_;
    scene.output.formats = {"dace"};
    if (hdf5_available()) scene.output.formats.emplace_back("hdf5");
    PropagationResult result = propagate(scene);
    // Zeros of different signs are distinguished.
    for (RunResult& run : result.runs) {
      if (run.failure.empty()) run.jet[0][5] = -Extended(0);
    }
    OutputDirectory output(directory_);
    write_results(result, "", output);
    return result;
  }

  static void expect_same(const StoredJet& stored, const StoredJet& right) {
    EXPECT_EQ(stored.scene, right.scene);
    EXPECT_EQ(stored.label, right.label);
    EXPECT_EQ(stored.model, right.model);
    EXPECT_EQ(stored.precision, right.precision);
    EXPECT_EQ(stored.units.length_km, right.units.length_km);
    EXPECT_EQ(stored.units.time_s, right.units.time_s);
    EXPECT_EQ(stored.duration, right.duration);
    EXPECT_TRUE(stored.start_time == right.start_time);
    EXPECT_EQ(stored.is_autonomous, right.is_autonomous);
    EXPECT_EQ(stored.nominal_initial, right.nominal_initial);
    EXPECT_EQ(stored.nominal_final, right.nominal_final);
    EXPECT_EQ(stored.components, right.components);
    EXPECT_EQ(stored.variables, right.variables);
    EXPECT_EQ(stored.own_names, right.own_names);
    EXPECT_EQ(stored.parameters, right.parameters);
    expect_same(stored.jet, right.jet);
  }

  static void expect_same(const FlowJet<Extended>& jet, const FlowJet<Extended>& right) {
    ASSERT_EQ(jet.size(), right.size());
    for (std::size_t c = 0; c < jet.size(); ++c) {
      ASSERT_EQ(jet[c].size(), right[c].size());
      for (std::size_t k = 0; k < jet[c].size(); ++k) {
        ASSERT_TRUE(same(jet[c][k], right[c][k])) << c << " " << k;
      }
    }
  }

  /// Every file of every run gives back the computed results.
  void expect_round_trips(const std::vector<Override>& overrides, bool with_dace = true) {
    const PropagationResult result = store(overrides);
    for (const RunResult& run : result.runs) {
      const std::string& label = run.settings.label;
      const StoredJet right = read_stored_jet(directory_, label);
      expect_same(right.jet, run.jet);
      expect_same(read_jet_file(directory_, label), right);
      expect_same(read_jet_file(directory_ / label / "jet.csv"), right);
      if (with_dace) expect_same(read_jet_file(directory_ / label / "jet.dace"), right);
      if (hdf5_available()) expect_same(read_jet_file(directory_ / "jets.h5", label), right);
      for (const OutputFormat* format : output_formats()) {
        if (format->of_jet == nullptr || !format->is_built()) continue;
        if (format == &dace_format && !with_dace) continue;
        const auto file = directory_ / ("copy" + std::string(format->ending));
        test::put(file, jet_file_content(right, *format));
        expect_same(read_jet_file(file, label), right);
      }
    }
  }

  void expect_refused(const std::filesystem::path& file, const std::vector<std::string>& words,
                      ErrorKind kind = ErrorKind::input_output,
                      const std::optional<std::string>& label = {}) {
    expect_error([&] { read_jet_file(file, label); }, kind, words, words[0]);
  }

  std::string text_ = cubic_kepler;
  ClockTime start_time_ = ClockTime::epoch();
  const test::TemporaryDirectory temporary_;
  const std::filesystem::path directory_ = temporary_.path() / "results";
};

TEST_F(JetFileTest, ComesBackBitByBit) {
  expect_round_trips({});
  EXPECT_EQ(std::filesystem::exists(directory_ / "jets.h5"), hdf5_available());
}

// A jet from another time than the epoch says so in every file; 0.1 is no binary fraction.
TEST_F(JetFileTest, KnowsWhenItStarts) {
  EXPECT_TRUE(read_jet_file((store(), directory_)).start_time == ClockTime::epoch());
  start_time_ = ClockTime(-0.1);
  expect_round_trips({});
  EXPECT_TRUE(read_jet_file(directory_).start_time == start_time_);
}

TEST_F(JetFileTest, SaysThatItsForcesDependOnTheTime) {
  store();
  StoredJet jet = read_jet_file(directory_);
  EXPECT_TRUE(jet.is_autonomous);
  if (!hdf5_available()) return;
  jet.is_autonomous = false;
  test::put(directory_ / "copy.h5", jet_file_content(jet, hdf5_format));
  EXPECT_FALSE(read_jet_file(directory_ / "copy.h5").is_autonomous);
}

TEST_F(JetFileTest, FewerComponentsAndVariables) {
  expect_round_trips({{"jet.variables", "[\"x\", \"y\", \"px\", \"py\"]"}});
  expect_round_trips({{"jet.variables", "[\"x\", \"pz\"]"}, {"generating_function", "null"}});
}

// States that end with parameters, one and two of them: an even number of numbers is no reason to
// take the last for a momentum.
TEST_F(JetFileTest, StatesThatEndWithParameters) {
  text_ = R"(schema = 1
[system]
model = "own"
coordinates = ["q"]
momenta = ["p"]
parameters = { k = 2, b = 0.5 }
hamiltonian = "p^2/2 + k*q^2/2 + b*q^4/4"
[nominal]
coordinates = [1]
momenta = [0.25]
[jet]
order = 2
duration_canonical = 0.7
)";
  expect_round_trips({{"jet.variables", "[\"q\", \"p\", \"b\"]"}});
  expect_round_trips({{"jet.variables", "[\"q\", \"b\", \"k\"]"}});
  const StoredJet jet = read_jet_file(directory_);
  EXPECT_EQ(jet.own_names, (std::vector<std::string>{"q", "p", "b", "k"}));
  EXPECT_EQ(jet.parameters, 2U);
  EXPECT_EQ(jet.degrees_of_freedom(), 1U);
  EXPECT_EQ(jet.nominal_initial, (std::vector<double>{1, 0.25, 0.5, 2}));
  // The same polynomials as a file from elsewhere, which says nothing of the state.
  text_ = cubic_kepler;
  StoredJet plain = jet;
  plain.variables = plain.components;
  plain.jet.clear();
  const SpacePointer space = SeriesSpace::create(4, 1);
  for (std::size_t i = 0; i < 4; ++i) {
    plain.jet.push_back(Series<Extended>::variable(space, i, Extended(jet.nominal_initial[i])));
  }
  const auto file = temporary_.path() / "elsewhere.dace";
  test::put(file, jet_file_content(plain, dace_format));
  JetDescription foreign{"own", 1, 1, 0.7, jet.nominal_initial, {{"b", "k"}}};
  const StoredJet read = read_jet_file(file, {}, foreign);
  EXPECT_EQ(read.parameters, 2U);
  EXPECT_EQ(read.own_names, jet.own_names);
  foreign.state_parameters = {{"p", "k"}};
  expect_error([&] { read_jet_file(file, {}, foreign); }, ErrorKind::usage,
               {"state_parameters", "each once, other than q, p"}, "names");
  foreign.model = "kepler";
  expect_error([&] { read_jet_file(file, {}, foreign); }, ErrorKind::usage, {"nominal_initial"},
               "model");
}

TEST_F(JetFileTest, ExtendedPrecision) {
  expect_round_trips({{"precision", "\"extended\""}}, false);
  // DACE's text has the nearest doubles, and the file says that it has.
  const StoredJet right = read_stored_jet(directory_);
  const StoredJet rounded = read_jet_file(directory_ / "gauss8" / "jet.dace");
  EXPECT_EQ(rounded.precision, Precision::double_precision);
  for (std::size_t c = 0; c < right.jet.size(); ++c) {
    for (std::size_t k = 0; k < right.jet[c].size(); ++k) {
      ASSERT_TRUE(same(rounded.jet[c][k], Extended(static_cast<double>(right.jet[c][k]))));
    }
  }
  EXPECT_NE(test::content(directory_ / "gauss8" / "jet.dace").find("rounded to double precision\n"),
            std::string::npos);
}

TEST_F(JetFileTest, Refusals) {
  store();
  const auto dace = directory_ / "gauss8" / "jet.dace";
  const std::string good = test::content(dace);
  test::put(dace, changed(good, "# order", "# Order"));
  expect_refused(dace, {"jet.dace", "was changed after it was written", "CRC-32"});
  test::put(dace, good.substr(0, good.size() / 2));
  expect_refused(dace, {"jet.dace:"});
  test::put(directory_ / "copy.dace", changed(good, "[[[ 6", "[[[ 7"));
  expect_refused(directory_ / "copy.dace", {"copy.dace:", "head of a polynomial"});
  const std::size_t last = good.rfind("     I");
  test::put(directory_ / "copy.dace", changed(good.substr(0, last) + "]]]\n", "[[[ 6", "[[[ 5"));
  expect_refused(directory_ / "copy.dace", {"copy.dace: has 5 polynomials, must have 6"});
  // A changed first coefficient differs from the nominal's final state.
  const std::size_t first = good.find("     1  ") + 10;
  test::put(directory_ / "copy.dace", std::string(good).replace(first, 3, "9.9"));
  expect_refused(directory_ / "copy.dace", {"nominal_final: the x is not that of"});
  test::put(temporary_.path() / "far.dace", good);
  expect_refused(temporary_.path() / "far.dace", {"far.dace: no summary.json beside it"});
  test::put(directory_ / "jet.txt", good);
  expect_refused(directory_ / "jet.txt", {"jet.txt: is neither a results directory"});
  expect_refused(directory_ / "absent", {"absent"});
}

TEST_F(JetFileTest, WithoutHdf5) {
  if (hdf5_available()) GTEST_SKIP() << "this build has HDF5";
  test::put(temporary_.path() / "jets.h5", "");
  expect_refused(temporary_.path() / "jets.h5", {"-DHAMJET_HDF5=ON"}, ErrorKind::usage);
  store();
  const StoredJet stored = read_stored_jet(directory_);
  expect_error([&] { jet_file_content(stored, hdf5_format); }, ErrorKind::usage,
               {"-DHAMJET_HDF5=ON"}, "write");
}

class JetHdf5Test : public JetFileTest {
 protected:
  void SetUp() override {
    if (!hdf5_available()) GTEST_SKIP() << "built without HDF5";
  }
};

TEST_F(JetHdf5Test, TheSameBytesAtAnotherTime) {
  const PropagationResult result = store();
  const std::string bytes = test::content(directory_ / "jets.h5");
  // HDF5 stores times in whole seconds.
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  EXPECT_EQ(jets_hdf5(result), bytes);
}

TEST_F(JetHdf5Test, NoRunOfThatLabel) {
  store();
  expect_refused(directory_ / "jets.h5", {"no run has the label midpiont", "mean midpoint?"},
                 ErrorKind::usage, "midpiont");
  EXPECT_EQ(read_jet_file(directory_ / "jets.h5").label, "gauss8");
}

TEST_F(JetHdf5Test, RunsThatFailed) {
  // A fall into the centre, which no integrator can follow to its end.
  const PropagationResult result = store({{"nominal.velocity_km_s", "[0, 0, 0]"},
                                          {"jet.duration_canonical", "3"},
                                          {"generating_function", "null"}});
  const auto failed = [](const RunResult& run) { return !run.failure.empty(); };
  ASSERT_TRUE(failed(result.runs[0]));
  expect_refused(directory_ / "jets.h5", {"jets.h5: gauss8/error: the run has no result"},
                 ErrorKind::input_output, "gauss8");
  if (std::all_of(result.runs.begin(), result.runs.end(), failed)) {
    expect_refused(directory_ / "jets.h5", {"jets.h5: runs: no run has a result"});
  }
}

TEST_F(JetHdf5Test, CutAnywhere) {
  store();
  const auto file = directory_ / "jets.h5";
  const std::string good = test::content(file);
  for (std::size_t length = 0; length < good.size(); length += 1 + length / 9) {
    test::put(file, good.substr(0, length));
    expect_refused(file, {"jets.h5: "});
  }
  test::put(file, good.substr(0, good.size() - 1));
  expect_refused(file, {"jets.h5: was cut or changed"});
  // A longer file may be another program's addition, because the jet has its own checksum.
  const StoredJet longer = read_jets_hdf5("jets.h5", good + "\n");
  EXPECT_EQ(longer.notes.size(), 1U);
  expect_same(longer, read_jets_hdf5("jets.h5", good));
}

TEST_F(JetHdf5Test, AnyBitTurned) {
  store();
  const auto file = directory_ / "jets.h5";
  const std::string good = test::content(file);
  const StoredJet right = read_jets_hdf5("jets.h5", good);
  const std::string written = fmt::format("bytes {}\n", good.size() - 512);
  const std::size_t size_place = good.find(written) + std::string("bytes ").size();
  for (std::size_t place = 0; place < good.size(); place += 1 + place / 40) {
    std::string bad = good;
    bad[place] = static_cast<char>(bad[place] ^ (1 << (place % 8)));
    const bool is_in_size = place >= size_place && place - size_place + 7 < written.size();
    std::size_t told = 0;
    if (is_in_size && std::from_chars(&bad[size_place], &bad[512], told).ptr[0] == '\n' &&
        told < good.size() - 512) {
      // A size that is too small indicates additions, and the jet is compared with its own
      // checksum.
      const StoredJet read = read_jets_hdf5("jets.h5", bad);
      EXPECT_EQ(read.notes.size(), 1U) << place;
      expect_same(read, right);
      continue;
    }
    expect_error([&] { read_jets_hdf5("jets.h5", bad); }, ErrorKind::input_output, {"jets.h5: "},
                 std::to_string(place));
  }
}

// Without hamjet's block only HDF5 itself can notice that the file was cut.
TEST_F(JetHdf5Test, CutWithoutTheBlock) {
  store();
  const std::string image = test::content(directory_ / "jets.h5").substr(512);
  EXPECT_EQ(read_jets_hdf5("jets.h5", image).label, "gauss8");
  for (const std::size_t length :
       {std::size_t{8}, std::size_t{40}, std::size_t{200}, image.size() / 2, image.size() - 1}) {
    expect_error([&] { read_jets_hdf5("jets.h5", image.substr(0, length)); },
                 ErrorKind::input_output, {"jets.h5: HDF5 cannot open it", "left open"},
                 std::to_string(length));
  }
}

}  // namespace
}  // namespace hamjet::io
