#include "command_run.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace hamjet::attack {
namespace {

/// The exit code, or -1.
int run_program(const std::string& program, const std::filesystem::path& folder) {
  const pid_t child = ::fork();
  if (child == 0) {
    const std::string scene = folder / "attack.toml", output = folder / "out";
    ::execl(program.c_str(), program.c_str(), "run", "--quiet", "-o", output.c_str(), scene.c_str(),
            nullptr);
    ::_exit(126);
  }
  int status = 0;
  if (child < 0 || ::waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
  return WEXITSTATUS(status);
}

/// The last column of all lines after the first one, in their order.
std::vector<double> coefficients_of(const std::filesystem::path& csv) {
  std::vector<double> result;
  std::ifstream file(csv);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    result.push_back(std::strtod(line.c_str() + line.rfind(',') + 1, nullptr));
  }
  return result;
}

CommandRun read_results(const std::filesystem::path& folder, int code,
                        const AttackedRun& attacked) {
  if (code != attacked.exit_code) {
    return {fmt::format("the command ends with {}, the library with {}", code, attacked.exit_code),
            {}};
  }
  const std::vector<double> read = coefficients_of(folder / "out/run/jet.csv");
  CommandRun result{{}, attacked.run().jet};
  std::size_t next = 0, expected = 0;
  for (auto& series : result.jet) {
    expected += series.coefficients().size();
    for (auto& x : series.coefficients()) x = next < read.size() ? read[next++] : NAN;
  }
  if (read.size() != expected) {
    result.difference =
        fmt::format("jet.csv has {} coefficients, the jet {}", read.size(), expected);
  }
  return result;
}

}  // namespace

CommandRun run_command(const std::string& program, const std::string& toml,
                       const AttackedRun& attacked) {
  std::string name = (std::filesystem::temp_directory_path() / "attack-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) {
    return {"there is no folder for the command's results", {}};
  }
  const std::filesystem::path folder(name);
  std::ofstream(folder / "attack.toml") << toml;
  CommandRun result = read_results(folder, run_program(program, folder), attacked);
  std::filesystem::remove_all(folder);
  return result;
}

}  // namespace hamjet::attack
