#include <fmt/format.h>

#include <map>
#include <ostream>
#include <string_view>

#include "evaluation/eval_command_test.hpp"

// What studies tell in metres and seconds is the same text, whatever unit of length a scene asks
// for: that of a scene which asks for none.

namespace hamjet::test {
namespace {

constexpr const char* chief = R"([system]
model = "zonal-gravity"
mu_km3_s2 = 398600.4415
radius_km = 6378.1363
J2 = 1.0826e-3
[nominal]
a_km = 12000
e = 0.3
i_deg = 63
raan_deg = 20
argp_deg = 40
ta_deg = 30
[jet]
order = 2
duration_orbits = 0.6
)";

struct StudyCase {
  std::string name;
  std::string command;
  std::string tables;
  std::vector<std::string> arguments = {};
};

/// Prints the name of a case in messages and lists of tests.
void PrintTo(const StudyCase& study, std::ostream* out) { *out << study.name; }

const std::vector<StudyCase> all_cases = {
    {"Motion", "motion", "[deputy]\nposition_m = [10, -2000, 30]\nvelocity_m_s = [0.1, 0, 0.2]\n"},
    {"Validity", "validity", "[validity]\ntolerance_m = 1\ncount = 1\nsamples = 10\n"},
    {"ValidityOfFlowBoxes",
     "validity",
     "[validity]\ntolerance_m = 1\ncount = 1\nsamples = 10\n",
     {"--set", "jet.coordinates=\"flow-box\""}},
    {"Transfer", "transfer",
     "[transfer]\ntimes_s = [1500, 4000]\n[transfer.start]\nposition_m = [0, -2000, 0]\n"
     "[transfer.end]\nposition_m = [0, 100, 30]\n"},
    {"Assign", "assign",
     "[transfer]\ntimes_s = [3000, 4000]\n[[assignment.deputy]]\nposition_m = [0, 100, 0]\n"
     "[[assignment.deputy]]\nposition_m = [0, -100, 0]\n[[assignment.slot]]\n"
     "position_m = [0, 0, 50]\n[[assignment.slot]]\nposition_m = [0, 0, -50]\n"},
    {"Uncertainty", "uncertainty",
     "[deputy]\nposition_m = [0, 500, 0]\n[uncertainty]\nposition_m = [100, 100, 100]\n"
     "velocity_m_s = [0.1, 0.1, 0.1]\nsamples = 40\n[uncertainty.deputy]\n"
     "position_m = [1, 1, 1]\n"},
    {"Collision", "uncertainty",
     "[deputy]\nposition_m = [0, 100, 10]\n[uncertainty]\nposition_m = [30, 30, 30]\n"
     "samples = 20\n[uncertainty.collision]\nradius_m = 20\nsamples = 1000\n"},
    {"Safety", "uncertainty",
     "[deputy]\nposition_m = [0, 100, 10]\n[uncertainty]\nposition_m = [1, 1, 1]\nsamples = 20\n"
     "[uncertainty.safety]\nkeep_apart_m = 20\nkeep_out_m = [5, 5, 5]\nsamples = 1000\n"},
    {"Event", "poincare",
     "[event]\nsurface = \"distance\"\ndistance_km = 12000\namplitudes_m = [100, 1000]\n"},
    {"FrozenOrbit", "poincare", ""},
    {"Bounded", "bounded", "[bounded]\nsizes_km = [2]\nrevolutions = 10\n"},
    {"Box", "bounded",
     "[bounded]\nsizes_km = [2]\nrevolutions = 10\n[bounded.box]\nhalf_widths_m = [400, 800, 400]\n"
     "days = 0.5\n"},
    {"Eval", "eval", "", {"--deviation", "10,-2000,30,0.1,-0.2,0.3"}},
    {"EvalOfFlowBoxes",
     "eval",
     "",
     {"--deviation", "10,-20000,30,0.1,-0.2,0.3", "--set", "jet.coordinates=\"flow-box\""}}};

/// Numbers that are told in canonical units, times of computation, and the sum over the file.
bool depends_on_units(std::string_view key) {
  return key.find("canonical") != std::string_view::npos || key == "units" || key == "seconds" ||
         key == "crc32" || key == "files" || key == "evaluation";
}

Json without_units(const Json& json) {
  if (!json.is_structured()) return json;
  Json kept = json.is_array() ? Json::array() : Json::object();
  for (const auto& entry : json.items()) {
    if (json.is_array()) {
      kept.push_back(without_units(entry.value()));
    } else if (!depends_on_units(entry.key())) {
      kept[entry.key()] = without_units(entry.value());
    }
  }
  return kept;
}

std::string without_units(const std::string& csv) {
  const Table table = parse_table(csv);
  std::string text;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (depends_on_units(table.columns[c])) continue;
    text += table.columns[c] + ":";
    for (const auto& row : table.rows) text += row.at(c) + ",";
    text += "\n";
  }
  return text;
}

class UnitsOfStudies : public EvalTest, public ::testing::WithParamInterface<StudyCase> {
 protected:
  /// Pictures are drawn of the same numbers, and take longer than these.
  UnitsOfStudies() { options_.environment.emplace_back("PATH", "/none"); }

  /// What a study tells with these tables, by file.
  std::map<std::string, std::string> told(const std::string& units) const {
    const StudyCase& study = GetParam();
    write("scene.toml", chief + study.tables + units);
    std::vector<std::string> arguments = {study.command, "scene.toml"};
    arguments.insert(arguments.end(), study.arguments.begin(), study.arguments.end());
    std::map<std::string, std::string> texts;
    if (study.command == "eval") {
      arguments.insert(arguments.end(), {"--json", "-q"});
      texts["result"] = without_units(Json::parse(succeed(arguments).out)).dump(1);
      return texts;
    }
    arguments.insert(arguments.end(), {"-o", "out"});
    const CommandResult result = hamjet(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    texts["terminal"] = result.out;
    for (const auto& entry : std::filesystem::directory_iterator(directory_ / "out")) {
      const std::string name = entry.path().filename().string();
      if (name == "summary.json") texts[name] = without_units(read_json(entry.path())).dump(1);
      // The map's coefficients are canonical.
      if (entry.path().extension() != ".csv" || name == "event-map.csv") continue;
      texts[name] = without_units(content(entry.path()));
    }
    return texts;
  }
};

TEST_P(UnitsOfStudies, ChangeNoDigit) {
  const auto usual = told("");
  for (const char* length_km : {"0.001", "1", "6378.1363", "149597870.7"}) {
    SCOPED_TRACE(length_km);
    EXPECT_EQ(told(fmt::format("[units]\nlength_km = {}\n", length_km)), usual);
  }
}

INSTANTIATE_TEST_SUITE_P(AllStudies, UnitsOfStudies, ::testing::ValuesIn(all_cases),
                         [](const auto& study) { return study.param.name; });

}  // namespace
}  // namespace hamjet::test
