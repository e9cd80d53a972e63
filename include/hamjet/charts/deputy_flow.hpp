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

/// The prediction of polynomials for one deputy at the end of the flow, in canonical units.
struct DeputyPrediction {
  SixNumbers<double> deviation;  ///< final deviation (dq, dp) from the chief
  /// What the highest degree, the one below it and the one below that add to the deviation; to
  /// first order where the coordinates are curved, and zero below degree 1.
  std::array<SixNumbers<double>, 3> highest;
};

/// The flow over one duration as a function from a deputy's initial deviation from the chief to its
/// final one. The deviation is converted into the coordinates of the polynomials at the start, the
/// polynomials are evaluated, and the result is converted back from the coordinates of the end. A
/// deviation is (dq, dp) along the inertial axes, in canonical units.
///
/// A flow is immutable: threads may share one.
class DeputyFlow {
 public:
  virtual ~DeputyFlow() = default;
  DeputyFlow(const DeputyFlow&) = delete;
  DeputyFlow& operator=(const DeputyFlow&) = delete;

  int order() const { return polynomials_.front().order(); }
  /// The number of the polynomials' variables.
  std::size_t variables() const { return polynomials_.front().space().variables(); }
  const std::vector<Series<double>>& polynomials() const { return polynomials_; }

  /// Predicts the final deviations of deputies by the terms of the polynomials up to a degree. The
  /// numbers are not finite for a deputy that has no coordinates in the chart of the start or of
  /// the end. Throws Error(usage) for a degree outside 1 to the order, and for lists of different
  /// size.
  void predict(std::span<const SixNumbers<double>> initial, int degree,
               std::span<DeputyPrediction> predictions) const;
  /// Predicts the final deviation of one deputy.
  DeputyPrediction predict(const SixNumbers<double>& initial, int degree) const;

  /// The chief's state at the end, from which deviations are counted.
  const SixNumbers<double>& chief_end() const { return chief_end_; }

  /// The derivative, at the chief, of the polynomials' variables by the initial deviation,
  /// variables x 6.
  const Matrix<double>& entry_derivative() const { return entry_derivative_; }
  /// The derivative, at the chief, of the final deviation by the polynomials' values, 6 x values.
  const Matrix<double>& exit_derivative() const { return exit_derivative_; }

 protected:
  /// Takes the polynomials of the values, which share one space.
  DeputyFlow(std::vector<Series<double>> polynomials, const SixNumbers<double>& chief_end);

  /// Sets the derivatives at the ends. The constructor of each flow calls this once, for every
  /// prediction reads them.
  void set_derivatives(Matrix<double> entry, Matrix<double> exit);

  /// The largest number of variables, and of values.
  static constexpr std::size_t widest = 8;

  /// The number of deputies that are carried into and out of the coordinates at once.
  static constexpr std::size_t block = 8;

  /// Carries a block of deputies, or fewer, into the variables and out of the values. Each passage
  /// has work space of its own.
  class Passage {
   public:
    virtual ~Passage() = default;
    /// The variables of deviations, `variables` numbers each. What bypasses the polynomials is
    /// written to `carried`.
    virtual void enter(std::span<const SixNumbers<double>> deviations, std::span<double> variables,
                       std::span<SixNumbers<double>> carried) = 0;
    /// The final deviations that belong to values of the polynomials, given as this many numbers
    /// for each deputy.
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

/// Predicts by one flow again and again and keeps its work space, which would take as long to make
/// as the prediction of a single deputy. Each thread needs a predictor of its own; the flow must
/// outlive it.
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
  /// Predicts by several degrees, for which the deputies enter the coordinates once. The
  /// predictions of all deputies by the first degree stand first, then those by the second degree.
  void predict(std::span<const SixNumbers<double>> initial, std::span<const int> degrees,
               std::span<DeputyPrediction> predictions);

  /// The polynomials' variables of one deputy.
  std::vector<double> variables(const SixNumbers<double>& initial);
  /// The final deviation of one deputy for which the polynomials have these values.
  SixNumbers<double> leave(const SixNumbers<double>& initial, std::span<const double> values);
  /// The number of deputies that are predicted at once; longer lists are predicted in blocks of
  /// this size.
  static constexpr std::size_t most_at_once = 4096;  // few enough for a block to stay in the cache
  /// The final deviations by one, two and three degrees less (but not below degree 1), for some
  /// deputies of the last call of predict, which are given by their indices in that call.
  /// Precondition: that call had no more than most_at_once deputies and one degree.
  void predict_lower(std::span<const std::size_t> deputies,
                     std::span<std::array<SixNumbers<double>, 3>> lower);

  /// Seconds that the polynomials of all predictions took, without the conversions into their
  /// variables and out of their values.
  double polynomial_seconds() const { return polynomial_seconds_; }
  /// Multiply-adds of the polynomials of all predictions.
  double multiply_adds() const { return multiply_adds_; }

 private:
  const DeputyFlow& flow_;
  std::unique_ptr<DeputyFlow::Passage> passage_;
  std::size_t count_ = 0;  ///< number of deputies of the current call
  std::vector<SixNumbers<double>> carried_;
  std::vector<double> points_;
  /// The values, and the shares of the three highest degrees.
  std::array<std::vector<double>, 4> results_;
  double polynomial_seconds_ = 0;
  double multiply_adds_ = 0;
};

/// The flow by the jet in positions and momenta themselves. A jet that is expanded in parameters
/// too serves deputies whose parameters differ from the chief's by `parameters`. This function and
/// charted_deputy_flow throw Error(usage) unless the jet has six components in six variables, and
/// here a variable for each parameter.
std::unique_ptr<DeputyFlow> cartesian_deputy_flow(const FlowMap<double>& jet,
                                                  std::span<const double> parameters = {});

/// The flow by a map between the coordinates of two charts, one at the start's state and one at the
/// end's (see in_charts).
std::unique_ptr<DeputyFlow> charted_deputy_flow(const CanonicalChart<double>& start,
                                                const SixNumbers<double>& start_state,
                                                const CanonicalChart<double>& end,
                                                const SixNumbers<double>& end_state,
                                                const FlowMap<double>& map);

/// The flow by a flow-box map of a zonal field.
std::unique_ptr<DeputyFlow> flow_box_deputy_flow(const ZonalGravity& field,
                                                 const FlowBoxMap<double>& map);

}  // namespace hamjet
