#include "kept_tolerance.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "error_promise.hpp"

namespace hamjet {

std::vector<KeptTolerance> kept_tolerance(const Scene& scene, const RunResult& run) {
  const auto& errors = run.error_by_degree ? run.error_by_degree : run.error_estimate.by_degree;
  if (!run.failure.empty() || !run.settings.tolerance || !errors) return {};
  const PromisedErrors promised = promised_errors(scene, run);
  std::vector<KeptTolerance> result;
  for (std::size_t d = 0; d < std::min(errors->size(), promised.total.size()); ++d) {
    // If shorter steps did not reduce the error, it is rounding, however large it is.
    const bool is_rounding =
        (*errors)[d] <= promised.total[d] || d < run.statistics.rounding_by_degree.size();
    result.push_back({promised.of_tolerance, (*errors)[d], promised.rounding[d], is_rounding});
  }
  return result;
}

std::size_t degrees_kept(const std::vector<KeptTolerance>& by_degree) {
  const auto first = std::find_if(by_degree.begin(), by_degree.end(),
                                  [](const KeptTolerance& one) { return !one.is_kept(); });
  return static_cast<std::size_t>(first - by_degree.begin());
}

std::string tolerance_warning(const Scene& scene, const RunResult& run) {
  const std::vector<KeptTolerance> by_degree = kept_tolerance(scene, run);
  const std::size_t kept = degrees_kept(by_degree);
  if (kept == by_degree.size()) return "";
  std::size_t worst = kept;
  for (std::size_t d = kept; d < by_degree.size(); ++d) {
    if (!(by_degree[d].error <= by_degree[worst].error)) worst = d;
  }
  const KeptTolerance& one = by_degree[worst];
  // An estimate may be too high by this factor. Only a tolerance that is surely not kept is worth a
  // warning; the table and summary.json have the estimate in any case.
  constexpr double surely = 10;
  if (!run.error_by_degree && one.error <= surely * one.asked) return "";
  const std::string keeping = kept == 0   ? "degree 0 does not keep it"
                              : kept == 1 ? "degree 0 alone keeps it"
                                          : fmt::format("degrees 0 to {} keep it", kept - 1);
  const std::string reason =
      one.is_rounding
          ? fmt::format(
                "rounding, which alone makes about {:.1e} of it; {}a lower order is needed",
                one.rounding,
                scene.precision == Precision::extended ? "" : "precision = \"extended\" or ")
          : std::string("the steps, which no trial made short enough");
  return fmt::format(
      "a tolerance of {:.2g} allows errors of {:.1e} here; {}, degree {} has {:.1e}; what keeps it "
      "from it is {}",
      *run.settings.tolerance, one.asked, keeping, worst, one.error, reason);
}

}  // namespace hamjet
