#include "forces_text.hpp"

#include <fmt/format.h>

namespace hamjet::io {
namespace {

std::string power_of_ten(double value) { return fmt::format("{:.1e}", value); }

/// One line of a residual by degree.
template <class Text>
std::string by_degree(const std::string& what, std::size_t degrees, const Text& text) {
  std::string line = fmt::format("{}:", what);
  for (std::size_t d = 0; d < degrees; ++d) line += fmt::format("{} {}", d > 0 ? "," : "", text(d));
  return line + "\n";
}

}  // namespace

std::string forces_lines(const PropagationResult& result, const RunResult& run) {
  if (result.problem.system->is_hamiltonian || run.symplecticity.empty()) return "";
  const std::string& label = run.settings.label;
  const std::size_t degrees = run.symplecticity.size();
  std::string text = by_degree(
      fmt::format("{}: defect of the brackets by degree, of the forces (the integration's part)",
                  label),
      degrees, [&](std::size_t d) {
        const double measured = run.symplecticity[d].scaled;
        if (run.integration_defects.empty()) {
          return fmt::format("{} (not estimated)", power_of_ten(measured));
        }
        const double integration = run.integration_defects[d];
        return integration < measured
                   ? fmt::format("{} ({})", power_of_ten(measured), power_of_ten(integration))
                   : "below " + power_of_ten(integration);
      });
  for (const KindResult& kind : run.kinds) {
    if (!kind.failure.empty()) continue;
    text += by_degree(fmt::format("{}: {} exactness by degree, of the forces (of the integration)",
                                  label, kind.requested),
                      kind.by_degree.size(), [&](std::size_t d) {
                        const ExactnessEntry& entry = kind.by_degree[d];
                        if (!entry.forces) return std::string("not computed");
                        return fmt::format("{} ({})", power_of_ten(entry.forces->absolute),
                                           power_of_ten(*entry.integration));
                      });
  }
  return text;
}

}  // namespace hamjet::io
