#include "store/json_text.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "support/temporary_directory.hpp"

// One rule applies to all numbers and texts of JSON, whatever their source.

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

TEST(JsonText, NamesWhatIsNotFinite) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Json value = {{"a", infinity},
                      {"b", {1.5, -infinity, {{"c", std::numeric_limits<double>::quiet_NaN()}}}},
                      {"none", nullptr},
                      {"count", 3}};
  EXPECT_EQ(json_text(value, -1),
            R"({"a":"inf","b":[1.5,"-inf",{"c":"nan"}],"none":null,"count":3})");
}

TEST(JsonText, KeepsNumbersToTheLastBit) {
  for (const double x : {0.1, -0.0, 1e300, 5e-324, 1.0 / 3}) {
    EXPECT_EQ(Json::parse(json_text(Json(x))).get<double>(), x);
  }
}

// The escapes are those of RFC 8259, so that every reader finds the original characters.
TEST(JsonText, EscapesWhatDrivesATerminal) {
  const std::string text = "a\x1b[31m\n\u202eb\u009b\x7f\U000e0041\u00e9\u4e2d";
  const std::string json = json_text(Json(text));
  EXPECT_EQ(json, "\"a\\u001b[31m\\n\\u202eb\\u009b\\u007f\\udb40\\udc41\u00e9\u4e2d\"");
  EXPECT_EQ(Json::parse(json), text);
}

// Code that writes JSON without it would have rules of its own.
TEST(JsonText, WritesAllThatUsersRead) {
  namespace fs = std::filesystem;
  std::size_t files = 0;
  for (const char* layer : {"app", "cli", "report", "sweep"}) {
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(HAMJET_SOURCE_DIR) / "src" / layer)) {
      if (entry.path().extension() != ".cpp") continue;
      ++files;
      const std::string name = entry.path().filename().string();
      // The first of these writes a string of TOML, the second a manifest that only sweeps read.
      if (name == "init_command.cpp" || name == "sweep_manifest.cpp") continue;
      EXPECT_EQ(test::content(entry.path()).find(".dump("), std::string::npos) << entry.path();
    }
  }
  EXPECT_GT(files, 50U);
}

}  // namespace
}  // namespace hamjet::io
