#include <cmath>

#include "command_test.hpp"

// Scenes that write their own system, as a user of the command sees them.

namespace hamjet::test {
namespace {

class OwnSystem : public CommandTest {
 protected:
  /// A pendulum from 1 radian at rest, over 1.2 units of time.
  static std::string pendulum(const std::string& more = "") {
    return "system = { model = \"own\", coordinates = [\"theta\"], momenta = [\"L\"], hamiltonian "
           "= "
           "\"L^2/2 - cos(theta)\" }\nnominal = { coordinates = [1], momenta = [0] }\n"
           "jet = { order = 4, duration_canonical = 1.2 }\n" +
           more;
  }
  static constexpr const char* hop =
      "transfer = { times_canonical = [1.2], start = { position_m = [0.01] }, "
      "end = { position_m = [0.02] } }\n";
};

// The stored jet is that which the scene's own transfer computes, so that the answers are the same.
TEST_F(OwnSystem, TakesAStoredJet) {
  write("pendulum.toml", pendulum(hop));
  succeed({"run", "pendulum.toml", "-q", "-o", "jets"});
  succeed({"transfer", "pendulum.toml", "-q", "-o", "stored", "--jet", "jets"});
  succeed({"transfer", "pendulum.toml", "-q", "-o", "computed"});
  const Json stored = read_json(directory_ / "stored/summary.json")["best"];
  const Json computed = read_json(directory_ / "computed/summary.json")["best"];
  const double least = computed["total_change_m_s"].get<double>();
  EXPECT_GT(least, 0);
  EXPECT_NEAR(stored["total_change_m_s"].get<double>(), least, 1e-10 * least);
}

TEST_F(OwnSystem, SaysWhatItsUnitsAre) {
  const std::string said = "m and s are the system's own units";
  write("pendulum.toml",
        pendulum(std::string(hop) + "validity = { tolerance_m = 1e-3, count = 1 }"));
  for (const char* const command : {"run", "transfer", "validity"}) {
    const std::string out = in_one_line(succeed({command, "pendulum.toml", "-o", "out"}).out);
    const std::size_t first = out.find(said);
    ASSERT_NE(first, std::string::npos) << out;
    EXPECT_EQ(out.find(said, first + 1), std::string::npos) << out;
    const std::string with_units = in_one_line(
        succeed({command, "pendulum.toml", "-o", "out", "--set", "units={length_km=2, time_s=3}"})
            .out);
    EXPECT_EQ(with_units.find(said), std::string::npos) << with_units;
  }
}

// A mass of 10 kg, a length of 2 km and a time of 3 s make momenta of 20000/3 kg m/s and energies
// of 10 (2000/3)^2 J.
TEST_F(OwnSystem, TellsWhatMomentaAndEnergiesAre) {
  write("pendulum.toml", pendulum());
  const std::vector<std::string> command = {
      "run", "pendulum.toml", "-o", "out", "--set", "units={length_km=2, time_s=3, mass_kg=10}"};
  const std::string out = in_one_line(succeed(command).out);
  EXPECT_NE(
      out.find("a mass of 1 is 10 kg, a momentum of 1 6666.67 kg m/s (of a length), an energy "
               "of 1 4.44444e+06 J"),
      std::string::npos)
      << out;
  const Json units = read_json(directory_ / "out/summary.json")["units"];
  EXPECT_EQ(units["mass_kg"], 10);
  EXPECT_DOUBLE_EQ(units["momentum_kg_m_s"].get<double>(), 20000.0 / 3);
  EXPECT_DOUBLE_EQ(units["energy_J"].get<double>(), 4e7 / 9);
  const CommandResult orbit =
      hamjet({"run", HAMJET_SOURCE_DIR "/data/scenes/molniya.toml", "--set", "units.mass_kg=10"});
  EXPECT_EQ(orbit.exit_code, 3);
  EXPECT_NE(orbit.err.find("units.mass_kg"), std::string::npos) << orbit.err;
}

// x = (cos t + sin t + exp(-t)) / 2 from 1; its derivative by the start is below the least of
// binary64 from t = 745 on, and its error is none.
TEST_F(OwnSystem, DiesOutBelowTheLeastNumber) {
  for (const char* const field : {"-(x - cos(t))", "-20*(x - cos(t)) - sin(t)"}) {
    write("decay.toml", std::string("schema = 1\n[system]\nmodel = \"own\"\nstates = [\"x\"]\n"
                                    "vector_field = { x = \"") +
                            field +
                            "\" }\n[nominal]\nstates = [1]\n[jet]\norder = 2\n"
                            "duration_canonical = 1000\n");
    succeed({"run", "decay.toml", "-o", "out", "-q"});
    const Table nominal = read_table(directory_ / "out/gauss8/nominal.csv");
    const std::size_t last = nominal.rows.size() - 1;
    const double t = nominal.number(last, "time_canonical");
    const double right =
        field[1] == '(' ? (std::cos(t) + std::sin(t) + std::exp(-t)) / 2 : std::cos(t);
    EXPECT_NEAR(nominal.number(last, "x"), right, 1e-10) << field;
  }
}

// Verlet's method has no q' = p here, and is left out of the usual methods.
TEST_F(OwnSystem, IsComparedByTheMethodsThatServeIt) {
  write("rotating.toml",
        "schema = 1\n[system]\nmodel = \"own\"\ncoordinates = [\"x\", \"y\"]\n"
        "momenta = [\"px\", \"py\"]\n"
        "hamiltonian = \"(px^2 + py^2)/2 + y*px - x*py - 1/sqrt(x^2 + y^2)\"\n"
        "[nominal]\ncoordinates = [1, 0]\nmomenta = [0, 1.1]\n[jet]\norder = 1\n"
        "duration_canonical = 1\n[formation]\nseparation_m = 0.001\n[compare]\nstages = [2]\n"
        "steps_canonical = [0.1]\ntolerances = [1e-6]\nrepeats = 1\ntime_budget_s = 5\n");
  succeed({"compare", "rotating.toml", "-o", "out", "-q"});
  const Json runs = read_json(directory_ / "out/compare.json")["runs"];
  EXPECT_GE(runs.size(), 3U);
  for (const Json& run : runs) EXPECT_NE(run["settings"]["method"], "velocity-verlet");
}

// What the command advises is a table that the scene can have.
TEST_F(OwnSystem, IsAdvisedOfATransferOfItsCoordinates) {
  write("pendulum.toml", pendulum());
  const CommandResult refused = hamjet({"transfer", "pendulum.toml"});
  EXPECT_EQ(refused.exit_code, 3);
  const std::string head = "the smallest is ";
  const std::size_t at = refused.err.find(head);
  ASSERT_NE(at, std::string::npos) << refused.err;
  write("advised.toml", pendulum(refused.err.substr(at + head.size())));
  succeed({"transfer", "advised.toml", "-q", "-o", "out"});
}

// The option that was written is named, and not the key that it sets.
TEST_F(OwnSystem, HasNoCoordinatesOfOrbits) {
  write("pendulum.toml", pendulum("validity = { tolerance_m = 1e-3, count = 1 }"));
  expect_error({"validity", "pendulum.toml", "--coordinates", "nodal"}, 3,
               {"hamjet: --coordinates: the model own has no key coordinates"});
}

// Drag is no Hamiltonian force: that its brackets miss is no finding, and is said to be none.
TEST_F(OwnSystem, AndDragSayWhatIsNotSymplectic) {
  const std::string drag =
      content(std::filesystem::path(HAMJET_SOURCE_DIR) / "data/scenes/earth/drag.toml");
  write("drag.toml", drag);
  const std::string said = "a force such as drag acts, is not Hamiltonian";
  const std::string short_run = "jet.duration_s=600";
  std::string out = in_one_line(
      succeed({"run", "drag.toml", "-o", "out", "--set", short_run, "--set", "jet.order=2"}).out);
  EXPECT_NE(out.find(said), std::string::npos) << out;
  write("pendulum.toml", pendulum());
  out = in_one_line(succeed({"run", "pendulum.toml", "-o", "out"}).out);
  EXPECT_EQ(out.find(said), std::string::npos) << out;
}

}  // namespace
}  // namespace hamjet::test
