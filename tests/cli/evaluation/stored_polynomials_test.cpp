#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "../command_test.hpp"
#include "formats/hdf5/hdf5_jets.hpp"

// Polynomials in a scene's coordinates, which `hamjet run` stores beside its jets.

namespace hamjet::test {
namespace {

class StoredPolynomials : public CommandTest {
 protected:
  void SetUp() override {
    write("far.toml",
          "title = \"two far apart\"\n[system]\nmodel = \"zonal-gravity\"\nmu_km3_s2 = "
          "398600.4415\nradius_km = 6378.1363\n"
          "J2 = 1.0826267e-3\nJ3 = -2.53e-6\n[nominal]\n"
          "a_km = 7086\ne = 0.01\ni_deg = 98\nraan_deg = 10\nargp_deg = 20\n"
          "ta_deg = 30\n[jet]\norder = 3\nduration_orbits = 1.3\n"
          "[[integrator]]\nmethod = \"gauss\"\ntolerance = 1e-12\n");
  }

  CommandResult run_in(const std::string& coordinates, const std::string& folder) {
    return succeed({"run", "far.toml", "-o", folder, "--set", "jet.coordinates=" + coordinates});
  }

  Json rows(std::vector<std::string> words) {
    for (const char* word : {"--deviation=30000,-70000,20000,1,-20,5", "--json", "-q"}) {
      words.emplace_back(word);
    }
    return Json::parse(succeed(words).out);
  }

  std::string label() { return read_json(directory_ / "boxes/summary.json")["runs"][0]["label"]; }
};

// What is read is what is integrated: the digits of every coefficient come back, and with them all
// of the prediction, from the results as from the file that a conversion writes.
TEST_F(StoredPolynomials, OfFlowBoxesPredictAsIntegratedOnes) {
  const std::string said = run_in("flow-box", "boxes").out;
  EXPECT_NE(in_one_line(said).find("polynomials in flow-box coordinates too, in 4 variables"),
            std::string::npos)
      << said;
  succeed({"run", "far.toml", "-o", "plain", "-q"});
  EXPECT_EQ(content(directory_ / "boxes" / label() / "jet.csv"),
            content(directory_ / "plain" / label() / "jet.csv"));
  const Json summary = read_json(directory_ / "boxes/summary.json")["runs"][0]["polynomials"];
  EXPECT_EQ(summary["section"], "nodal");
  // Poisson brackets of the exact flow vanish; the integration is right to 1e-12. Relative to the
  // bracket's own terms the error is of that size, times the factor by which these terms cancel.
  for (const Json& defect : summary["symplecticity_by_degree"]) {
    EXPECT_LT(defect["scaled"].get<double>(), 1e-10) << summary;
  }
  // Errors by degree are printed too, and the largest of them is named.
  double largest = 0;
  for (const Json& error : summary["error_estimate_by_degree"]) {
    largest = std::max(largest, error["relative"].get<double>());
  }
  EXPECT_EQ(summary["error_estimate_by_degree"].size(), 4U);
  EXPECT_LT(largest, 1e-9) << summary;
  EXPECT_NE(in_one_line(said).find(fmt::format("error estimate {:.1e}", largest)),
            std::string::npos)
      << said;
  const Json integrated = rows({"eval", "far.toml", "--set", "jet.coordinates=flow-box"});
  const Json stored = rows({"eval", "boxes"});
  EXPECT_EQ(stored["coordinates"], "flow-box");
  const auto expect_same = [&](const Json& found) {
    for (const char* const name : {"R_m", "T_m", "N_m"}) {
      EXPECT_EQ(found["rows"][0][name], integrated["rows"][0][name]) << name;
    }
  };
  expect_same(stored);
  // The Cartesian jet of the same order is kilometres away there, so that it was not read.
  EXPECT_GT(std::abs(rows({"eval", "plain"})["rows"][0]["T_m"].get<double>() -
                     stored["rows"][0]["T_m"].get<double>()),
            100);
  if (!io::hdf5_available()) return;
  succeed({"convert", "boxes", "box.h5", "--coordinates", "flow-box"});
  expect_same(rows({"eval", "box.h5"}));
  EXPECT_EQ(io::read_jets_hdf5("box.h5", content(directory_ / "box.h5")).error_by_degree.size(),
            4U);
  succeed({"convert", "box.h5", "again.h5"});
  EXPECT_EQ(content(directory_ / "again.h5"), content(directory_ / "box.h5"));
  expect_error({"convert", "box.h5", "box.csv"}, 2, {".csv", "flow-box", ".h5"});
  expect_error({"transfer", "far.toml", "--jet", "box.h5"}, 2, {"flow-box coordinates"});
}

// On Kepler's ellipses the flow of these coordinates is linear, so that all else is error, whose
// own relative errors and defects are no answer; estimated or not.
TEST_F(StoredPolynomials, OfKeplersEllipsesSayThatHighDegreesAreErrorsAlone) {
  write("kepler.toml",
        "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\na_km = 9000\ne = 0.6\n"
        "i_deg = 50\nraan_deg = 0\nargp_deg = 20\nta_deg = 30\n[jet]\norder = 3\nduration_orbits = "
        "1.3\n"
        "coordinates = \"flow-box\"\n[[integrator]]\nmethod = \"gauss\"\ntolerance = 1e-12\n");
  for (const std::string estimate : {"true", "false"}) {
    const std::string said = in_one_line(succeed({"run", "kepler.toml", "-o", estimate, "--set",
                                                  "checks.error-estimate=" + estimate})
                                             .out);
    EXPECT_NE(said.find("; without degree 2, 3, errors alone, of at most "), std::string::npos)
        << said;
    const Json summary =
        read_json(directory_ / estimate / "summary.json")["runs"][0]["polynomials"];
    EXPECT_EQ(summary["degrees_of_errors_alone"], Json({2, 3}));
    const std::string words = "symplecticity in them ";
    const std::size_t place = said.find(words);
    ASSERT_NE(place, std::string::npos) << said;
    EXPECT_LT(std::stod(said.substr(place + words.size())), 1e-9) << said;
    const std::string estimated = "error estimate ";
    const std::size_t error = said.find(estimated, place);
    EXPECT_EQ(error != std::string::npos, estimate == "true") << said;
    if (error != std::string::npos) {
      EXPECT_LT(std::stod(said.substr(error + estimated.size())), 1e-9) << said;
    }
  }
  run_in("flow-box", "boxes");
  EXPECT_EQ(read_json(directory_ /
                      "boxes/summary.json")["runs"][0]["polynomials"]["degrees_of_errors_alone"],
            Json::array());
}

// In positions and momenta a flow box is the jet that is integrated there, to the errors of both
// integrations, which are 1e-12 of the largest coefficient, grown by as much as a degree has terms.
TEST_F(StoredPolynomials, OfFlowBoxesBecomeJets) {
  if (!io::hdf5_available()) GTEST_SKIP();
  run_in("flow-box", "boxes");
  succeed({"convert", "boxes", "box.h5", "--coordinates", "flow-box"});
  const std::string said =
      succeed({"convert", "box.h5", "jet.h5", "--coordinates", "cartesian"}).out;
  EXPECT_NE(said.find("no way back"), std::string::npos) << said;
  const Json jet = rows({"eval", "jet.h5"})["rows"][0];
  const Json plain = rows({"eval", "boxes/" + label() + "/jet.csv"})["rows"][0];
  for (const char* const name : {"R_m", "T_m", "N_m"}) {
    // The bound is 1e-12 of 7000 km, amplified by the shear of a revolution along the orbit to a
    // hundred times as much.
    EXPECT_NEAR(jet[name].get<double>(), plain[name].get<double>(), 1e-3) << name;
  }
}

TEST_F(StoredPolynomials, OfChartsPredictAsIntegratedOnes) {
  EXPECT_NE(in_one_line(run_in("spherical", "boxes").out)
                .find("error not estimated: they are composed of the run's jet"),
            std::string::npos);
  const Json stored = rows({"eval", "boxes"});
  EXPECT_EQ(stored["coordinates"], "spherical");
  const Json integrated = rows({"eval", "far.toml", "--set", "jet.coordinates=spherical"});
  for (const char* const name : {"R_m", "T_m", "N_m"}) {
    // The bound is the rounding of 7000 km times its growth along the flight.
    EXPECT_NEAR(stored["rows"][0][name].get<double>(), integrated["rows"][0][name].get<double>(),
                1e-6);
  }
}

// The row of the duration comes from the polynomials, whatever times precede it.
TEST_F(StoredPolynomials, AreThoseOfTheLastTime) {
  for (const char* const coordinates : {"flow-box", "spherical"}) {
    SCOPED_TRACE(coordinates);
    const std::string folder = std::string("timed-") + coordinates;
    succeed({"run", "far.toml", "-o", folder, "-q", "--set",
             std::string("jet.coordinates=") + coordinates, "--set", "jet.times_orbits=[0.4,0.9]"});
    const Json alone = rows({"eval", folder})["rows"][0];
    const Json all = rows({"eval", folder, "--time", "all"});
    ASSERT_EQ(all["rows"].size(), 3U);
    EXPECT_EQ(all["coordinates"], coordinates);
    Json last = all["rows"][2];
    const std::string duration = last["time_s"].dump();
    last.erase("time_s");
    EXPECT_EQ(last, alone);
    Json named = rows({"eval", folder, "--time", duration})["rows"][0];
    named.erase("time_s");
    EXPECT_EQ(named, alone);
    // Before the duration there are only jets in positions and momenta, as the output says.
    const std::string plain = std::string("plain-") + coordinates;
    succeed({"run", "far.toml", "-o", plain, "-q", "--set", "jet.times_orbits=[0.4,0.9]"});
    const Json before = rows({"eval", plain, "--time", "all"});
    EXPECT_EQ(all["rows"][0], before["rows"][0]);
    EXPECT_NE(before["rows"][2]["T_m"], alone["T_m"]);
    EXPECT_NE(in_one_line(hamjet({"eval", folder, "--time", "all", "--deviation=1,0,0,0,0,0"}).err)
                  .find(fmt::format("{} coordinates are of the end alone", coordinates)),
              std::string::npos);
  }
}

// Threads share the deputies, which may be odd to the last one, in whole blocks or not; a deputy's
// digits are its own.
TEST_F(StoredPolynomials, PredictTheSameOnAnyNumberOfThreads) {
  std::string deviations = "R_m,T_m,N_m,vR_m_s,vT_m_s,vN_m_s\n";
  for (int k = 0; k < 1003; ++k) {
    deviations += fmt::format("{},{},{},0.5,{},1\n", 40 * k - 20000, 17 * k, 300 - k, 0.01 * k);
  }
  write("many.csv", deviations);
  for (const std::string coordinates : {"flow-box", "poincare"}) {
    const auto with = [&](const std::string& threads) {
      succeed({"eval", "far.toml", "--set", "jet.coordinates=" + coordinates, "--deviations",
               "many.csv", "--threads", threads, "-o", threads + ".csv", "-q"});
      return content(directory_ / (threads + ".csv"));
    };
    const std::string alone = with("1");
    EXPECT_EQ(std::count(alone.begin(), alone.end(), '\n'), 1004);
    for (const char* const threads : {"2", "3", "16"}) EXPECT_EQ(with(threads), alone) << threads;
  }
  expect_error({"eval", "far.toml", "--deviation=1,0,0,0,0,0", "--threads", "0"}, 2, {"--threads"});
}

// The changes of two degrees vanish there, so that they have no ratio; the floor of a flight
// remains.
TEST_F(StoredPolynomials, TellAMissOfSmallDeviations) {
  for (const char* const coordinates : {"flow-box", "poincare", "cylindrical"}) {
    for (const char* const order : {"2", "3", "6"}) {
      const Json row = Json::parse(
          succeed({"eval", "far.toml", "--set", std::string("jet.coordinates=") + coordinates,
                   "--set", std::string("jet.order=") + order, "--deviation=1,0,0,0,0.001,0",
                   "--json", "-q", "--strict"})
              .out)["rows"][0];
      SCOPED_TRACE(row.dump());
      ASSERT_TRUE(row["miss_estimate_m"].is_number());
      EXPECT_GT(row["miss_estimate_m"].get<double>(), 0);
      EXPECT_LT(row["miss_estimate_m"].get<double>(), 1e-3);
    }
  }
}

// A field with one more harmonic changes the chief's energy hardly at all, but it takes the chief
// elsewhere.
TEST_F(StoredPolynomials, OfAnotherGravityFieldAreNotMade) {
  if (!io::hdf5_available()) GTEST_SKIP();
  succeed({"run", "far.toml", "-o", "plain", "-q"});
  std::string other = content(directory_ / "far.toml");
  other.replace(other.find("J3 ="), 4, "J6 = 5e-7\nJ3 =");
  write("other.toml", other);
  expect_error({"convert", "plain", "box.h5", "--coordinates", "flow-box", "--scene", "other.toml"},
               2, {"--scene: in its gravity field the jet's chief flies to another place"});
  succeed({"convert", "plain", "box.h5", "--coordinates", "flow-box", "--scene", "far.toml"});
}

// The output names a part that a run cannot write, and a method that cannot integrate a part fails
// that part alone.
TEST_F(StoredPolynomials, AreRefusedWithTheReason) {
  const CommandResult automatic =
      hamjet({"run", "far.toml", "-o", "auto", "--set", "jet.coordinates=auto"});
  EXPECT_EQ(automatic.exit_code, 0) << automatic.err;
  EXPECT_NE(in_one_line(automatic.err).find("auto coordinates are not used: which reach"),
            std::string::npos)
      << automatic.err;
  const CommandResult other =
      hamjet({"run", "far.toml", "-o", "other", "--set", "jet.coordinates=flow-box", "--set",
              "integrator.0.method=fehlberg78"});
  EXPECT_EQ(other.exit_code, 4) << other.err;
  EXPECT_NE(in_one_line(other.out).find("flow-box is integrated by Gauss methods"),
            std::string::npos)
      << other.out << other.err;
  const CommandResult compared = hamjet({"check", "far.toml", "--set", "jet.coordinates=flow-box"});
  EXPECT_NE(in_one_line(compared.out).find("coordinates flow-box; hamjet run writes polynomials"),
            std::string::npos)
      << compared.out;
}

// A centre alone has no radius, and Kepler's flow in sections is a closed form: a deputy of another
// period is, at the end, where its own ellipse has taken it (for small differences along the orbit,
// -3 pi da a revolution from the place at which both were).
TEST_F(StoredPolynomials, OfACentreAloneAreReadAgain) {
  write("far.toml",
        "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\na_km = 7000\ne = 0\n"
        "i_deg = 50\nraan_deg = 0\nargp_deg = 0\nta_deg = 0\n[jet]\norder = 2\n"
        "duration_orbits = 1\n");
  run_in("flow-box", "boxes");
  const auto of_another_period = [&](const std::string& file) {
    const Json rows = Json::parse(succeed({"eval", file, "--frame", "relative-elements", "--to",
                                           "RTN", "--deviation=10,0,0,0,0,0", "--json", "-q"})
                                      .out)["rows"];
    return rows[0]["T_m"].get<double>();
  };
  EXPECT_NEAR(of_another_period("boxes"), -30 * std::numbers::pi, 1e-3);
  if (io::hdf5_available()) {
    succeed({"convert", "boxes", "box.h5", "--coordinates", "flow-box"});
    EXPECT_EQ(of_another_period("box.h5"), of_another_period("boxes"));
  }
  // Harmonics without a radius do not define a field.
  std::string summary = content(directory_ / "boxes/summary.json");
  const std::string radius = "\"radius_canonical\": 0.0";
  const std::size_t harmonics = summary.find("\"J\": [", summary.find(radius));
  ASSERT_NE(harmonics, std::string::npos);
  summary.replace(summary.find("0.0", harmonics), 3, "0.1");
  write("boxes/summary.json", summary);
  expect_error({"eval", "boxes", "--deviation=1,0,0,0,0,0"}, 5,
               {"radius_canonical", "must be positive, or 0"});
}

// A damaged description of the sections is refused before anything is made of it.
TEST_F(StoredPolynomials, OfAnotherFieldAreRefused) {
  run_in("flow-box", "boxes");
  const std::filesystem::path file = directory_ / "boxes" / label() / "polynomials.csv";
  std::string text = content(file);
  text.replace(text.rfind('1'), 1, "7");
  write("boxes/" + label() + "/polynomials.csv", text);
  expect_error({"eval", "boxes", "--deviation=1,0,0,0,0,0"}, 5, {"polynomials.csv"});
}

}  // namespace
}  // namespace hamjet::test
