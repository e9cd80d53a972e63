#include "earlier_results.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <vector>

namespace hamjet::cli {
namespace {

using Json = nlohmann::json;

/// A text of the summary that names a file or folder; empty if it is none or could lead elsewhere.
std::string name_in(const Json& object, const char* key) {
  if (!object.is_object() || !object.contains(key) || !object[key].is_string()) return "";
  const auto name = object[key].get<std::string>();
  const bool is_plain = name[0] != '.' && name.find_first_of(std::string("/\0", 2)) == name.npos;
  return is_plain ? name : "";
}

const Json& list_in(const Json& object, const char* key) {
  static const Json none = Json::array();
  const bool is_there = object.is_object() && object.contains(key) && object[key].is_array();
  return is_there ? object[key] : none;
}

/// What a study leaves beside its summary and figure.
std::vector<const char*> files_of_study(const std::string& study) {
  if (study.empty()) return {};
  if (study == "transfer") {
    return {"transfers.csv", "singular_times.csv", "conditions.csv", "validity.csv", "report.html"};
  }
  if (study == "validity") return {"validity.csv", "report.html"};
  if (study == "assignment") return {"assignment.csv", "costs.csv"};
  return {"trajectory.csv", "fixed_step.csv", "convergence.csv"};
}

}  // namespace

std::vector<std::filesystem::path> earlier_results(const std::filesystem::path& directory) {
  const std::filesystem::path summary_file = directory / "summary.json";
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(summary_file, ignored)) return {};
  std::ifstream file(summary_file);
  const Json summary = Json::parse(file, nullptr, false);
  std::vector<std::filesystem::path> files;
  for (const Json& run : list_in(summary, "runs")) {
    const std::string trajectory = name_in(run, "trajectory");
    if (trajectory.starts_with("trajectory_") && trajectory.ends_with(".csv")) {
      files.emplace_back(trajectory);
    }
    const std::filesystem::path folder = name_in(run, "label");
    if (folder.empty()) continue;
    files.push_back(folder / "jet.csv");
    files.push_back(folder / "nominal.csv");
    files.push_back(folder / "along_time.csv");
    for (const Json& entry : list_in(run, "exactness")) {
      const std::string kind = name_in(entry, "kind");
      if (!kind.empty()) files.push_back(folder / ("generating_function_" + kind + ".csv"));
    }
  }
  for (const char* name : files_of_study(name_in(summary, "study"))) files.emplace_back(name);
  // A comparison in the same directory has a page of the same name.
  if (std::filesystem::exists(directory / "compare.json", ignored)) {
    std::erase(files, std::filesystem::path("report.html"));
  }
  if (!files.empty()) {
    files.emplace_back("relative_hamiltonian.csv");
    files.emplace_back("figure.svg");
  }
  return files;
}

}  // namespace hamjet::cli
