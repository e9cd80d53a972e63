#include "hamjet/formats/stored_jet.hpp"

#include <algorithm>
#include <cmath>

#include "fuzz_target.hpp"
#include "hamjet/version.hpp"

// Target: a stored jet. The input is summary.json, a line `%%%%`, and jet.csv; a first line
// `label=...` asks for that run. `@version@` stands for the version of the program.

namespace hamjet::fuzz {
namespace {

struct StoredFiles {
  std::optional<std::string> label;
  std::string summary;
  std::string coefficients;
};

StoredFiles split(std::string_view text) {
  constexpr std::string_view label = "label=";
  constexpr std::string_view separator = "\n%%%%\n";
  constexpr std::string_view placeholder = "@version@";
  StoredFiles files;
  if (text.starts_with(label)) {
    const std::string_view line = text.substr(0, text.find('\n'));
    files.label = line.substr(label.size());
    text.remove_prefix(std::min(line.size() + 1, text.size()));
  }
  const std::size_t end = text.find(separator);
  files.summary = text.substr(0, end);
  if (end != std::string_view::npos) files.coefficients = text.substr(end + separator.size());
  const std::size_t place = files.summary.find(placeholder);
  if (place != std::string::npos) {
    files.summary.replace(place, placeholder.size(), version);
  }
  return files;
}

void check(const io::StoredJet& stored) {
  const std::size_t dimension = stored.variable_names().size();
  require(stored.nominal_initial.size() == dimension && stored.nominal_final.size() == dimension,
          "dimension of the nominal");
  require_finite(stored.nominal_initial, "nominal_initial");
  require_finite(stored.nominal_final, "nominal_final");
  require_finite({stored.duration, stored.units.length_km, stored.units.time_s}, "units");
  require_ascending(stored.components, dimension, "components");
  require_ascending(stored.variables, dimension, "variables");
  require(stored.jet.size() == stored.components.size(), "components of the jet");
  for (const auto& series : stored.jet) {
    require(series.space().variables() == stored.variables.size(), "variables of the jet");
    require(series.order() == stored.order() && series.order() >= 1, "order of the jet");
    for (const Extended& coefficient : series.coefficients()) {
      require(isfinite(coefficient), "a coefficient that is not finite");
    }
  }
}

}  // namespace
}  // namespace hamjet::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hamjet;
  const fuzz::StoredFiles files = fuzz::split({reinterpret_cast<const char*>(data), size});
  const std::filesystem::path directory = "results";
  const auto read = [&](const std::filesystem::path& file) {
    if (file == directory / "summary.json") return files.summary;
    const auto folder = file.lexically_normal().lexically_relative(directory).parent_path();
    fuzz::require(file.filename() == "jet.csv" && !folder.empty() && folder != "." &&
                      folder != ".." && !folder.has_parent_path(),
                  "a file that is not in a folder of the results: " + file.string());
    return files.coefficients;
  };
  fuzz::is_read(
      [&] { fuzz::check(io::read_stored_jet(directory, files.label, read)); },
      {{ErrorKind::input_output, ErrorKind::usage}, {"results/", "no run has the label"}});
  return 0;
}
