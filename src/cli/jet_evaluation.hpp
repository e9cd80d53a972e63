#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "hamjet/io/stored_jet.hpp"
#include "hamjet/maps/map_evaluator.hpp"
#include "hamjet/maps/truncation_estimate.hpp"

namespace hamjet::cli {

/// Evaluates the deviations from a stored jet's nominal, a few thousand at a time, and measures the
/// time that this takes.
class JetEvaluation {
 public:
  /// So many points at once: they stay in the cache.
  static constexpr std::size_t most_points = 4096;

  JetEvaluation(const io::StoredJet& stored, std::optional<int> degree);

  /// The values of the jet's variables of one more point. At most `most_points` until `run`.
  void add(const std::vector<double>& variables);
  /// Hands final deviation of the components (canonical) and estimate of the miss (metres) of each
  /// point that was added to `take`, in order, and starts anew.
  void run(const std::function<void(const std::vector<double>&, const TruncationEstimate&)>& take);

  std::size_t pending() const { return pending_.size(); }
  std::size_t points() const { return points_; }
  /// Of all evaluations so far, conversions, input and output excluded.
  double seconds() const { return seconds_; }
  const MapEvaluator& evaluator() const { return evaluator_; }

 private:
  DegreeShares shares(std::size_t point) const;

  MapEvaluator evaluator_;
  std::size_t positions_;  ///< so many components are positions, the first
  double length_m_;
  std::vector<std::vector<double>> pending_;
  std::size_t points_ = 0;
  double seconds_ = 0;
  // Structures of arrays, see MapEvaluator.
  std::vector<double> variables_;
  std::vector<double> values_;
  std::vector<double> last_;
  std::vector<double> last_but_one_;
};

}  // namespace hamjet::cli
