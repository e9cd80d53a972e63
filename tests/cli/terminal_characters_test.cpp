#include "command_test.hpp"

// Titles and names of files come from others: none of them may clear the screen, set the title of
// the terminal or turn the order of what follows.

namespace hamjet::test {
namespace {

/// Clears the screen, breaks the line, turns the order, and begins a control sequence of C1.
const std::string hostile = "a\x1b[2J\nb\u202ec\u009b31md\x7f";
const std::string shown = "a\\x1b[2J\\x0ab\\xe2\\x80\\xaec\\xc2\\x9b31md\\x7f";

class TerminalCharacters : public CommandTest {
 protected:
  TerminalCharacters() {
    std::string title;
    for (const char c : hostile)
      title += c == '\x1b'   ? "\\u001b"
               : c == '\n'   ? "\\n"
               : c == '\x7f' ? "\\u007f"
                             : std::string(1, c);
    std::string scene = quick_scene();
    const std::size_t begin = scene.find("title = ");
    scene.replace(begin, scene.find('\n', begin) - begin, "title = \"" + title + "\"");
    write("hostile.toml", scene);
    write("named\x1b]0;x\x07\u202e.toml", scene);
  }

  static void expect_harmless(const CommandResult& result) {
    for (const std::string& text : {result.out, result.err}) {
      for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        EXPECT_TRUE(c == '\n' || (byte >= 0x20 && byte != 0x7f)) << text;
      }
      for (const char* sequence : {"\u202e", "\u009b"}) {
        EXPECT_EQ(text.find(sequence), std::string::npos) << text;
      }
      if (::testing::Test::HasFailure()) return;
    }
  }
};

TEST_F(TerminalCharacters, OfTitlesAreShownAsEscapes) {
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"check", "hostile.toml"},
        {"run", "hostile.toml"},
        {"run", "hostile.toml", "--verbose"},
        {"motion", "hostile.toml", "--set", "deputy={position_m=[0, 100, 0]}"},
        {"validity", "hostile.toml", "--set", "validity={count=1, samples=2}"}}) {
    SCOPED_TRACE(::testing::PrintToString(command));
    const CommandResult result = hamjet(command);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find(shown), std::string::npos) << result.out;
    expect_harmless(result);
  }
  const std::string json = succeed({"run", "hostile.toml", "--json", "-q"}).out;
  expect_harmless({0, 0, false, 0, json, ""});
  EXPECT_EQ(Json::parse(json)["title"], shown);
}

TEST_F(TerminalCharacters, OfNamesOfFilesAreShownAsEscapes) {
  const std::string name = "named\x1b]0;x\x07\u202e.toml";
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"check", name},
        {"run", name, "-o", "out\x1b[2J"},
        {"run", name + "2"},
        {"run", "quick.toml", "--set", "\x1b[2J\u202e=1"},
        {"run", "quick.toml", "--\x1b[2J"},
        {"\x1b[2J\u202e"},
        {"init", "leo", "-o", "\x1b[2J"},
        {"eval", "out\x1b[2J", "--deviation", "1,2,3,0,0,0"},
        {"eval", "out\x1b[2J", "--deviations", name},
        {"convert", "out\x1b[2J", "x\u202e.h6"},
        {"list", "\x1b[2J"}}) {
    SCOPED_TRACE(::testing::PrintToString(command));
    expect_harmless(hamjet(command));
  }
}

}  // namespace
}  // namespace hamjet::test
