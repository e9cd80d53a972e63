#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "flow_error.hpp"
#include "hamjet/charts/deputy_flow.hpp"
#include "hamjet/charts/jet_coordinates.hpp"
#include "hamjet/detail/studies/self_checks.hpp"
#include "hamjet/formats/stored_jet.hpp"
#include "jet_evaluation.hpp"
#include "processors.hpp"

namespace hamjet::cli {

/// A flow to one degree more than another; null if there is none.
struct FurtherFlow {
  std::shared_ptr<const DeputyFlow> flow;
  std::vector<double> stored_end;  ///< see EvaluatedScene
};

/// A scene's polynomials in its coordinates over its duration, integrated when asked for.
struct EvaluatedScene {
  /// The chief, as the results of a run have it; without coefficients.
  io::StoredJet chief;
  CanonicalFactors told;          ///< see told_factors
  ChosenCoordinates coordinates;  ///< not automatic
  std::shared_ptr<const DeputyFlow> flow;
  /// The flow to one degree more, from which the estimate knows what the highest degree leaves out;
  /// only for orders 2 to 4 in curved coordinates, and not for a stored jet.
  FurtherFlow further;
  /// The chief's final state as a jet is stored with it. Of flow boxes the section at the end goes
  /// through it, and deviations are counted from what it is in the section's chart and back.
  std::vector<double> stored_end;
  /// The rounding of a deputy's final position: a flight's floor and what a prediction rounds.
  double rounding_m = 0;
  /// The final state of the orbit about which deputies are expanded, less the chief's: it starts
  /// with the chief and has the coefficients of the scene's deputy.
  SixNumbers<double> companion{};
  FlowError error;     ///< of the integration
  double seconds = 0;  ///< duration of the integration; 0 for a stored jet
  /// Of the chief's flight; none of a stored jet, which has its own.
  std::vector<SelfCheck> checks;
  /// The scene of the polynomials where its table [eval] asks for domains; else null.
  std::shared_ptr<const Scene> split_scene = {};
};

/// Integrates the polynomials of a scene about an orbit in all six variables. Where the scene has a
/// deputy that air or light moves otherwise than its chief, they are of spacecraft like it. Throws
/// Error(scene) for others, and as the integrator.
EvaluatedScene evaluated_scene(const Scene& scene);

/// The same polynomials about an orbit that starts at a deviation from the chief's, of which
/// deviations at the end are told from the chief. Precondition: there is a split_scene. Throws as
/// the integrator and the coordinates.
EvaluatedScene evaluated_about(const EvaluatedScene& scene, const SixNumbers<double>& deviation);

/// Sets the chief's final state, where deputies are expanded about another orbit.
void set_chief_end(EvaluatedScene& scene, std::vector<double> end);

/// A stored jet of an orbit in all six variables as such polynomials.
EvaluatedScene evaluated_jet(const io::StoredJet& stored);

/// The polynomials as a jet is stored, of which evaluated_jet makes the same flow to every digit.
io::StoredJet stored_polynomials(const EvaluatedScene& scene);

/// What JetEvaluation does, for polynomials in any coordinates.
class DeputyEvaluation {
 public:
  /// Points that are evaluated at once, on all threads together.
  static constexpr std::size_t most_points = 16384;

  /// No digit depends on the number of threads.
  DeputyEvaluation(const EvaluatedScene& scene, int degree,
                   std::size_t threads = usable_processors())
      : scene_(scene),
        momentum_unit_(std::ldexp(1.0, scene.chief.momentum_exponent())),
        degree_(degree),
        threads_(threads) {}

  /// Adds a canonical deviation of six numbers.
  void add(const std::vector<double>& deviation);
  /// Hands each added point's final deviation (canonical) and estimate of the miss to `take`, in
  /// order, and starts anew.
  void run(const std::function<void(const std::vector<double>&, const MissEstimate&)>& take);

  std::size_t pending() const { return pending_.size(); }
  /// By how much the chief's final position may be wrong, canonical.
  double chief_error() const;
  /// Seconds of all predictions so far, the coordinates at both ends included, and the lower
  /// degrees that the estimate needs.
  double seconds() const { return seconds_; }
  /// Of these, what the coordinates at both ends take: the share that they have in the threads'
  /// own time.
  double chart_seconds() const;
  /// Multiply-adds of all polynomials so far, with those of the lower degrees.
  double multiply_adds() const;

 private:
  /// A thread's own: what it predicts with, where it writes, and the time it has worked.
  struct Worker {
    DeputyPredictor predictor;
    std::optional<DeputyPredictor> further;  ///< see further_flow
    std::vector<DeputyPrediction> predictions;
    std::vector<MissEstimate> estimates;
    double seconds = 0;
  };
  /// Adds a worker's predictions of these deputies, no more than DeputyPredictor::most_at_once.
  void predict(std::span<const SixNumbers<double>> initial, Worker& worker) const;

  /// The estimate for polynomials in positions and momenta, whose degrees add up: see
  /// estimate_truncation.
  MissEstimate estimate(const DeputyPrediction& prediction) const;
  /// The size of a final position of the first degree, if the parts that the numbers of the
  /// deviation make did not cancel.
  double uncancelled(const SixNumbers<double>& initial) const;
  /// Adds what flights and integrations are wrong by. In curved coordinates a deputy is told about
  /// the chief's end, so that it comes too late or too early as the chief does, at a speed of its
  /// own.
  void add_errors(const SixNumbers<double>& initial, const SixNumbers<double>& found,
                  MissEstimate& told) const;
  /// Whether what the two highest degrees add to a deviation is small and near enough for the
  /// derivatives at the chief to tell, to some percent; else the lower degrees go through the
  /// curved ends themselves.
  bool is_nearly_straight(const SixNumbers<double>& initial, const DeputyPrediction& found) const;
  /// In other coordinates, of deviations at the start and, by the highest degree N and by one to
  /// three less, at the end. Where there are predictions by degree N + 1, `next`, it is what they
  /// change, with what the same decay adds. Else, c_k being what degree k changes, it is
  ///
  ///   max( c_N q, c_(N-1) q^2 ) ,
  ///
  /// q the decay of c_(N-2) to c_N, at least 0.02 and at most 1, or 2 where c_N is above c_(N-1).
  /// Order 2 has no such decay: it states twice c_2 times the largest of its share of the
  /// deviation, the deviation's share of the chief's distance, and the error of its coefficients;
  /// order 1 is unknown. Outside where c_N is more than a tenth of the deviation; where changes do
  /// not fall, and of order 2, where it is more than 1e-4 of it.
  MissEstimate curved_estimate(const SixNumbers<double>& initial, const SixNumbers<double>& found,
                               const std::array<SixNumbers<double>, 3>& lower,
                               const DeputyPrediction* next) const;
  /// The flow that predicts by one degree more in curved coordinates; null where there is none.
  const DeputyFlow* further_flow() const;

  const EvaluatedScene& scene_;
  double momentum_unit_;
  int degree_;
  std::size_t threads_;
  std::vector<Worker> workers_;
  std::vector<SixNumbers<double>> pending_;
  double seconds_ = 0;
};

}  // namespace hamjet::cli
