#include <charconv>
#include <map>

#include "command_test.hpp"

// The walk of a new user: the commands on the front page and in data/examples/two-satellites are
// run, and print what the pages say. Words are the same. Numbers agree to a hundredth; lengths
// below a millimetre and bare numbers below a hundredth, which rounding makes in part, to a factor
// of three.

namespace hamjet::test {
namespace {

const std::string pages_root = HAMJET_SOURCE_DIR;

/// A command on a page and what the page says that it prints.
struct Shown {
  std::string command;
  std::string output;
};

/// The blocks of a page that begin with a command behind a dollar sign.
std::vector<Shown> shown_on(const std::string& page) {
  std::vector<Shown> all;
  std::istringstream lines(content(pages_root + "/" + page));
  bool is_in_block = false;
  bool is_first = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      is_in_block = !is_in_block;
      is_first = is_in_block;
    } else if (is_first && line.starts_with("$ ")) {
      all.push_back({line.substr(2), ""});
      is_first = false;
    } else if (is_first) {
      is_in_block = is_first = false;  // a block of another kind, of which the end is passed over
      while (std::getline(lines, line) && !line.starts_with("```")) continue;
    } else if (is_in_block) {
      all.back().output += line + '\n';
    }
  }
  return all;
}

/// Words, between blanks and commas.
std::vector<std::string> words_of(std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// A number at the beginning of a word, behind a sign that it is a bound, and what follows it.
struct Number {
  double value = 0;
  std::string rest;
};
std::optional<Number> number_in(const std::string& word) {
  const std::size_t begin = word.find_first_not_of("<>([");
  if (begin == std::string::npos) return std::nullopt;
  Number number;
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data() + begin, end, number.value);
  if (error != std::errc()) return std::nullopt;
  number.rest = std::string(rest, end);
  return number;
}

/// The metres in a unit of length, which a full stop may follow.
std::optional<double> metres_in(std::string unit) {
  while (!unit.empty() && std::string_view(".,;:").find(unit.back()) != std::string_view::npos) {
    unit.pop_back();
  }
  static const std::map<std::string, double> units = {{"km", 1e3},  {"m", 1},     {"mm", 1e-3},
                                                      {"μm", 1e-6}, {"nm", 1e-9}, {"pm", 1e-12}};
  const auto found = units.find(unit);
  return found != units.end() ? std::optional(found->second) : std::nullopt;
}

/// Whether two words say the same; `next` are those behind them, which may be units.
bool agree(const std::string& first, const std::string& second, const std::string& next_first,
           const std::string& next_second) {
  const auto a = number_in(first);
  const auto b = number_in(second);
  if (!a || !b) {
    return first == second || (metres_in(first).has_value() && metres_in(second).has_value());
  }
  if (a->rest != b->rest) return false;
  const auto unit_a = metres_in(next_first);
  const auto unit_b = metres_in(next_second);
  if (unit_a.has_value() != unit_b.has_value()) return false;
  const double x = a->value * unit_a.value_or(1);
  const double y = b->value * unit_b.value_or(1);
  const double size = std::max(std::abs(x), std::abs(y));
  if (size < (unit_a ? 1e-3 : 1e-2)) return std::min(std::abs(x), std::abs(y)) >= size / 3;
  return std::abs(x - y) <= 0.01 * size;
}

class Walk : public CommandTest {
 protected:
  void expect_page(const std::string& page, std::size_t count) const {
    const std::vector<Shown> all = shown_on(page);
    EXPECT_EQ(all.size(), count) << page;
    for (const Shown& shown : all) {
      SCOPED_TRACE(page + ": " + shown.command);
      std::istringstream command(shown.command);
      std::vector<std::string> arguments;
      for (std::string argument; command >> argument;) arguments.push_back(argument);
      ASSERT_FALSE(arguments.empty());
      EXPECT_EQ(arguments[0], "build/hamjet");
      arguments.erase(arguments.begin());
      const std::vector<std::string> expected = words_of(shown.output);
      const CommandResult result = hamjet(arguments);
      EXPECT_EQ(result.exit_code, 0) << result.err;
      const std::vector<std::string> found = words_of(result.out);
      ASSERT_EQ(found.size(), expected.size());
      const auto behind = [](const std::vector<std::string>& words, std::size_t i) {
        return i + 1 < words.size() ? words[i + 1] : std::string();
      };
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_TRUE(agree(found[i], expected[i], behind(found, i), behind(expected, i)))
            << "printed " << found[i] << ", on the page " << expected[i];
      }
    }
  }

  /// The commands name files as from the clone.
  void SetUp() override {
    std::filesystem::create_directory_symlink(pages_root + "/data", directory_ / "data");
    options_.limit = std::chrono::seconds(600);  // sanitizers make it slow
  }
};

TEST_F(Walk, WordsAreComparedAsThePagesSay) {
  EXPECT_TRUE(agree("1.00", "1.009", "h", "h"));
  EXPECT_FALSE(agree("1.00", "1.02", "h", "h"));
  EXPECT_TRUE(agree("999", "1.00", "m", "km;"));
  EXPECT_FALSE(agree("999", "999", "m", "km"));
  EXPECT_TRUE(agree("10", "29", "nm", "nm"));
  EXPECT_FALSE(agree("10", "31", "nm", "nm"));
  EXPECT_TRUE(agree("0.002", "0.005", "inside", "inside"));
  EXPECT_FALSE(agree("deputy", "chief", "", ""));
}

TEST_F(Walk, TheFrontPageSaysWhatIsPrinted) { expect_page("README.md", 1); }

TEST_F(Walk, ThePageOfTheTwoSatellitesSaysWhatIsPrinted) {
  expect_page("data/examples/two-satellites/README.md", 5);
}

// The front page shows the scene itself.
TEST_F(Walk, TheSceneOnTheFrontPageIsTheShippedOne) {
  std::istringstream lines(
      content(pages_root + "/data/examples/two-satellites/two-satellites.toml"));
  std::string scene;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("#")) scene += line + '\n';
  }
  EXPECT_NE(content(pages_root + "/README.md").find("```toml\n" + scene + "```"),
            std::string::npos);
}

// The picture is the program's own: figure.svg of the transfer.
TEST_F(Walk, ThePictureIsThatOfTheTransfer) {
  const std::string scene = pages_root + "/data/examples/two-satellites/two-satellites.toml";
  succeed({"transfer", scene, "-q"});
  const std::filesystem::path figure = directory_ / "out/two-satellites-transfer/figure.svg";
  if (!std::filesystem::exists(figure)) GTEST_SKIP() << "gnuplot could not draw";
  const auto title = [](const std::string& svg) {
    const std::size_t begin = svg.find("aria-label=\"");
    return svg.substr(begin, svg.find('"', begin + 12) - begin);
  };
  const std::string shipped = content(pages_root + "/data/examples/two-satellites/rendezvous.svg");
  EXPECT_EQ(title(shipped), title(content(figure)));
  EXPECT_NE(content(pages_root + "/README.md").find("data/examples/two-satellites/rendezvous.svg"),
            std::string::npos);
}

// The deputy of the scene, through the jet that run has stored, goes to where motion has it.
TEST_F(Walk, EvalTakesTheDeputyOfTheScene) {
  const std::string scene = pages_root + "/data/examples/two-satellites/two-satellites.toml";
  succeed({"run", scene, "-q"});
  succeed({"motion", scene, "-q"});
  const Table evaluated =
      parse_table(succeed({"eval", "out/two-satellites", "--deputy", scene, "-q"}).out);
  const Json end = read_json(directory_ / "out/two-satellites-motion/summary.json")["end"];
  ASSERT_EQ(evaluated.rows.size(), 1U);
  // motion says where the flown deputy is, and how far the polynomial of order 4 is from there.
  const Table motion = parse_table(content(directory_ / "out/two-satellites-motion/motion.csv"));
  const double error_m = std::stod(motion.rows.back().back());
  EXPECT_LT(error_m, 1e-3);
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double gap_m = std::stod(evaluated.rows[0][i]) - end["position_m"][i].get<double>();
    square += gap_m * gap_m;
    EXPECT_NEAR(std::stod(evaluated.rows[0][i + 3]), end["velocity_m_s"][i].get<double>(), 1e-6);
  }
  EXPECT_NEAR(std::sqrt(square), error_m, 1e-5);
  expect_error({"eval", "out/two-satellites", "--deputy", scene, "--deviation", "0,0,0,0,0,0"}, 2,
               {"--deviation, --deviations and --deputy: must not be given together"});
  write("other.toml", changed(content(scene), "a_km = 6892.9", "a_km = 6893"));
  expect_error({"eval", "out/two-satellites", "--deputy", "other.toml"}, 3,
               {"other.toml: nominal: another orbit than that of the jet gauss8"});
  write("alone.toml", changed(content(scene), "\ndeputy = ", "\n# deputy = "));
  expect_error({"eval", "out/two-satellites", "--deputy", "alone.toml"}, 3, {"transfer.start"});
}

}  // namespace
}  // namespace hamjet::test
