#include "study_checks.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "../store/json_text.hpp"
#include "../store/json_values.hpp"
#include "../text/html_text.hpp"
#include "hamjet/error.hpp"

namespace hamjet::io {

nlohmann::ordered_json checks_json(const std::vector<SelfCheck>& checks) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const SelfCheck& check : checks) {
    json.push_back({{"name", name_of(check.name)},
                    {"state", name_of(check.state)},
                    {"value", or_null(check.value)},
                    {"limit", or_null(check.limit)},
                    {"seconds", check.seconds},
                    {"text", check.text}});
  }
  return json;
}

void add_checks(StudyReport& report, const std::vector<SelfCheck>& checks) {
  std::vector<std::string> failed;
  for (const SelfCheck& check : checks) {
    if (check.state != SelfCheckState::failed) continue;
    failed.push_back(fmt::format("{}: {}", name_of(check.name), check.text));
  }
  std::string notices;
  for (const std::string& line : failed) {
    report.table += fmt::format("CHECK FAILED: {}\n", line);
    notices += fmt::format("<p class=\"problem\">Check failed: {}</p>\n", escape_html(line));
  }
  if (!failed.empty() && report.failure.empty()) {
    report.exit_code = static_cast<int>(ErrorKind::check_failed);
    report.failure = "a check failed: " + failed.front();
  }
  for (ReportFile& file : report.files) {
    constexpr std::string_view verdict = "<p class=\"verdict\">";
    const std::size_t place = file.content.find(verdict);
    if (file.path.extension() == ".html" && place != std::string::npos) {
      file.content.insert(place, notices);
    }
  }
  std::string& summary = report.files.back().content;
  auto json = nlohmann::ordered_json::parse(summary);
  json["checks"] = checks_json(checks);
  // Some studies have told of others.
  if (!json.contains("failed_checks")) json["failed_checks"] = nlohmann::ordered_json::array();
  for (const std::string& line : failed) json["failed_checks"].push_back(line);
  json.erase("exit_code");  // the last of all
  json["exit_code"] = report.exit_code;
  summary = json_text(json) + "\n";
}

}  // namespace hamjet::io
