#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/charts/flow_box.hpp"
#include "hamjet/detail/algebra/matrix.hpp"
#include "hamjet/maps/flow_map.hpp"

namespace hamjet {

/// What polynomials say of one deputy at the end; canonical.
struct DeputyPrediction {
  SixNumbers<double> deviation;  ///< from the chief, (dq, dp)
  /// What the highest degree adds to the deviation, the one below it and the next, to first order
  /// where the coordinates are curved; zero below degree 1.
  std::array<SixNumbers<double>, 3> highest;
};

/// A chief's flow of one duration as a function from a deputy's initial deviation to its final one:
/// into the coordinates that polynomials are in, through these, and out of the coordinates of the
/// end. A deviation is (dq, dp) along the inertial axes, canonical.
///
/// Immutable: threads may share one.
class DeputyFlow {
 public:
  virtual ~DeputyFlow() = default;
  DeputyFlow(const DeputyFlow&) = delete;
  DeputyFlow& operator=(const DeputyFlow&) = delete;

  int order() const { return polynomials_.front().order(); }
  /// The number of the polynomials' variables.
  std::size_t variables() const { return polynomials_.front().space().variables(); }
  const std::vector<Series<double>>& polynomials() const { return polynomials_; }

  /// Predicts the final deviations of deputies, by the terms of the polynomials up to a degree; of
  /// those that have no coordinates in the start's chart, or not in the end's, they are not finite.
  /// Throws Error(usage) for a degree outside 1 to the order, and for lists of different size.
  void predict(std::span<const SixNumbers<double>> initial, int degree,
               std::span<DeputyPrediction> predictions) const;
  /// The same of one.
  DeputyPrediction predict(const SixNumbers<double>& initial, int degree) const;

  /// The chief's state at the end, from which deviations are counted.
  const SixNumbers<double>& chief_end() const { return chief_end_; }

  /// The derivative of the polynomials' variables by the initial deviation at the chief, variables
  /// x 6.
  const Matrix<double>& entry_derivative() const { return entry_derivative_; }
  /// The derivative of the final deviation by the polynomials' values at the chief, 6 x values.
  const Matrix<double>& exit_derivative() const { return exit_derivative_; }

 protected:
  /// Polynomials of the values, in one space.
  DeputyFlow(std::vector<Series<double>> polynomials, const SixNumbers<double>& chief_end);

  /// The derivatives at the ends, by the constructor of each flow: they are asked for at every
  /// prediction.
  void set_derivatives(Matrix<double> entry, Matrix<double> exit);

  /// The most variables, and the most values.
  static constexpr std::size_t widest = 8;

  /// How many deputies are carried into and out of the coordinates at once.
  static constexpr std::size_t block = 8;

  /// Carries a block of deputies, or fewer, into the variables and out of the values, with work
  /// space of its own.
  class Passage {
   public:
    virtual ~Passage() = default;
    /// The variables of deviations, `variables` numbers each, and in `carried` what goes by beside
    /// the polynomials.
    virtual void enter(std::span<const SixNumbers<double>> deviations, std::span<double> variables,
                       std::span<SixNumbers<double>> carried) = 0;
    /// The final deviations of the polynomials' values, of so many numbers each.
    virtual void leave(std::span<const SixNumbers<double>> carried, std::span<const double> values,
                       std::span<SixNumbers<double>> deviations) = 0;
  };
  virtual std::unique_ptr<Passage> passage() const = 0;

 private:
  friend class DeputyPredictor;

  std::vector<Series<double>> polynomials_;
  SixNumbers<double> chief_end_;
  Matrix<double> entry_derivative_;
  Matrix<double> exit_derivative_;
  std::vector<MapEvaluator> evaluators_;  ///< by degree, from 1
};

/// Predicts by one flow, again and again, with work space that is kept: for single deputies, whose
/// predictions take no longer than to make it. Each thread needs one; the flow must outlive it.
class DeputyPredictor {
 public:
  explicit DeputyPredictor(const DeputyFlow& flow) : flow_(flow), passage_(flow.passage()) {}

  const DeputyFlow& flow() const { return flow_; }
  /// As DeputyFlow::predict.
  void predict(std::span<const SixNumbers<double>> initial, int degree,
               std::span<DeputyPrediction> predictions) {
    predict(initial, std::span(&degree, 1), predictions);
  }
  DeputyPrediction predict(const SixNumbers<double>& initial, int degree);
  /// By several degrees: the deputies enter the coordinates once. The predictions of the first
  /// degree stand first, of all deputies, then those of the second.
  void predict(std::span<const SixNumbers<double>> initial, std::span<const int> degrees,
               std::span<DeputyPrediction> predictions);

  /// The polynomials' variables of one deputy.
  std::vector<double> variables(const SixNumbers<double>& initial);
  /// The final deviation of one deputy for which the polynomials have these values.
  SixNumbers<double> leave(const SixNumbers<double>& initial, std::span<const double> values);
  /// Deputies that are predicted at once; of more the first so many are done first.
  static constexpr std::size_t most_at_once = 4096;  // few enough to stay in the cache
  /// The final deviations by one, two and three degrees less (by no degrees below 1), out of the
  /// coordinates of the end, of some deputies of the last call of predict, by their numbers in it.
  /// Precondition: it had no more than most_at_once and one degree.
  void predict_lower(std::span<const std::size_t> deputies,
                     std::span<std::array<SixNumbers<double>, 3>> lower);

  /// Seconds that the polynomials of all predictions took, without the ways into their variables
  /// and out of their values.
  double polynomial_seconds() const { return polynomial_seconds_; }
  /// Multiply-adds of the same.
  double multiply_adds() const { return multiply_adds_; }

 private:
  const DeputyFlow& flow_;
  std::unique_ptr<DeputyFlow::Passage> passage_;
  std::size_t count_ = 0;  ///< of the deputies that are at work
  std::vector<SixNumbers<double>> carried_;
  std::vector<double> points_;
  std::array<std::vector<double>, 4> results_;  ///< the values, and the shares of the highest
  double polynomial_seconds_ = 0;
  double multiply_adds_ = 0;
};

/// The flow by the jet in positions and momenta themselves. Throws Error(usage) unless it has six
/// components in six variables; so does charted_deputy_flow.
std::unique_ptr<DeputyFlow> cartesian_deputy_flow(const FlowMap<double>& jet);

/// The flow between the coordinates of two charts, at the start's state and at the end's, by a map
/// of their deviations (see in_charts).
std::unique_ptr<DeputyFlow> charted_deputy_flow(const CanonicalChart<double>& start,
                                                const SixNumbers<double>& start_state,
                                                const CanonicalChart<double>& end,
                                                const SixNumbers<double>& end_state,
                                                const FlowMap<double>& map);

/// The flow by a flow-box map of a zonal field.
std::unique_ptr<DeputyFlow> flow_box_deputy_flow(const ZonalGravity& field,
                                                 const FlowBoxMap<double>& map);

}  // namespace hamjet
