#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "hamjet/formats/stored_jet.hpp"
#include "hamjet/maps/map_evaluator.hpp"
#include "hamjet/maps/truncation_estimate.hpp"

namespace hamjet::cli {

/// By how much an evaluated position may be wrong, in metres.
struct MissEstimate {
  TruncationEstimate::Support support = TruncationEstimate::Support::unknown;
  double truncation_m = 0;  ///< what the missing degrees would add; infinite unless inside
  /// Rounding of coefficients and evaluation, and the coefficients' errors where the jet states
  /// them: see evaluation_error.
  double rounding_m = 0;
  /// Errors of the integration of the chief and of the polynomials, as far as they are known and
  /// not counted above, and what the first turn the axes by.
  double integration_m = 0;

  bool is_inside() const { return support == TruncationEstimate::Support::inside; }
  double miss_m() const { return truncation_m + rounding_m + integration_m; }
};

/// Evaluates the deviations from a stored jet's nominal, a few thousand at a time, and measures the
/// time that this takes.
class JetEvaluation {
 public:
  /// Points that are evaluated at once, few enough to stay in the cache.
  static constexpr std::size_t most_points = 4096;

  /// Evaluates up to `degree`, or the whole jet without one. Below the jet's order, all degrees
  /// that are stored above tell what is left out, and the last of them how the jet goes on.
  JetEvaluation(const io::StoredJet& stored, std::optional<int> degree);

  /// Adds the values of the jet's variables at one point; at most `most_points` before `run`.
  void add(const std::vector<double>& variables);
  /// Hands each added point's final deviation of the components (canonical) and estimate of the
  /// miss to `take`, in order, and starts anew.
  void run(const std::function<void(const std::vector<double>&, const MissEstimate&)>& take);

  std::size_t pending() const { return pending_.size() / evaluator_.variables(); }
  /// By how much the chief's final position may be wrong, canonical; 0 where the jet says nothing.
  double chief_error() const { return chief_error_; }
  std::size_t points() const { return points_; }
  /// Seconds of all evaluations so far, without conversions, input and output.
  double seconds() const { return seconds_; }
  const MapEvaluator& evaluator() const { return evaluator_; }

 private:
  JetEvaluation(const io::StoredJet& stored, const std::vector<Series<double>>& map, int degree);
  DegreeShares shares(std::size_t point) const;
  MissEstimate estimate(std::size_t point) const;

  MapEvaluator evaluator_;
  std::optional<MapEvaluator> whole_;  ///< up to the jet's order, where the first stops below it
  MapEvaluator error_;                 ///< see evaluation_error
  std::size_t positions_;              ///< how many components are positions, the first ones
  double momentum_unit_;  ///< the unit that makes momenta alike to positions, see DegreeShares
  double length_m_;
  double chief_error_;
  std::vector<double> pending_;  ///< point after point
  std::size_t points_ = 0;
  double seconds_ = 0;
  // Structures of arrays, see MapEvaluator.
  std::vector<double> variables_;
  std::vector<double> values_;
  std::vector<double> whole_values_;
  std::vector<double> last_;  ///< of the highest degree evaluated by either
  std::vector<double> last_but_one_;
  std::vector<double> magnitudes_;  ///< magnitudes of the variables
  std::vector<double> errors_;
};

}  // namespace hamjet::cli
