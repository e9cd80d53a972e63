#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "hamjet/charts/deputy_flow.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// The canonical deviations, as columns, for unit coordinates of an ellipsoid whose semi-axes are
/// along a frame's axes: three of position, and three of the same ellipsoid times a velocity. In a
/// rotating frame the deviations of position contain a velocity too. `law` is that of velocities
/// along coordinates.
Matrix6 ellipsoid_axes(std::span<const double> chief, RelativeFrame frame,
                       std::span<const double> semi_axes, double velocity,
                       const VelocityLaw& law = {});

/// The unit coordinates, of position and of velocity, in whose direction the Hamiltonian grows most
/// at the chief.
Vector6 direction_of_energy(const DynamicalSystem& system, std::span<const double> chief,
                            const Matrix6& axes);

/// Random unit coordinates, of position and of velocity.
Vector6 random_coordinates(std::mt19937_64& generator);
/// The direction along the first coordinates of so many, of which both halves are unit vectors.
Vector6 in_told_directions(Vector6 direction, std::size_t told);

/// The first of some directions that are far from each other, from which ascents may start.
std::vector<Vector6> far_apart(const std::vector<Vector6>& directions);

/// Deputies of one chief, flown to one time with the full equations, and their predictions by
/// polynomials. A deputy is given by its coordinates along the columns of `axes`.
///
/// The polynomials may be given twice: with the degrees that foretell what an order neglects, and
/// as others make them, without these and by steps of their own. Where a degree is rounding they
/// differ by more than any tolerance, and what is told is the worse of both.
class FlownDeputies {
 public:
  /// All arguments must outlive this object; `before_flight` is called before each flight. `again`
  /// is the same flow once more, or null.
  FlownDeputies(const ComputedProblem& problem, const Matrix6& axes, double time,
                const DeputyFlow& flow, const DeputyFlow* again,
                std::function<void()> before_flight)
      : problem_(problem),
        axes_(axes),
        time_(time),
        predictor_(flow),
        before_flight_(std::move(before_flight)) {
    if (again != nullptr) again_.emplace(*again);
  }

  /// The canonical deviation (dq, dp) of a deputy at the start.
  SixNumbers<double> deviation(const Vector6& coordinates) const;
  /// The difference, in canonical units, between the polynomials of an order and the flown state;
  /// not finite if the deputy cannot be flown or has no place in the coordinates.
  Vector6 error(const Vector6& coordinates, int order);
  /// The distance in position of this difference; infinite if it is not finite.
  double miss(const Vector6& coordinates, int order);
  /// The derivative of the miss by the coordinates: of the flight by its linear flow, which costs
  /// little more than the flight, and of the worse polynomials by differences over `step` to both
  /// sides.
  /// Not finite if the deputy cannot be flown or has no place in the coordinates.
  Vector6 gradient(const Vector6& coordinates, int order, double step);

  struct Worst {
    Vector6 direction;  ///< coordinates divided by the separation
    double miss = 0;
  };
  /// Puts the largest misses first.
  static void sort_by_miss(std::vector<Worst>& deputies);
  /// Ascent of the miss from a deputy, within the ellipsoids of position and velocity of a
  /// separation, by steps along the gradient that are brought back to the ellipsoids.
  Worst worst_from(const Worst& start, int order, double separation);
  /// Whether the flow has degrees above an order, which foretell what it misses.
  bool foretells(int order) const { return predictor_.flow().order() > order; }
  /// Puts the directions first whose deputies at a separation are foretold to miss most.
  void sort_by_foretold_miss(std::vector<Vector6>& directions, int order, double separation);
  /// Ascent of the foretold miss from a direction.
  Vector6 foretold_worst_from(const Vector6& start, int order, double separation);

  DeputyPredictor& predictor() { return predictor_; }

 private:
  /// The state of a deputy at the start.
  std::vector<double> state(const SixNumbers<double>& deviation) const;
  /// What the flow's degrees above an order add to the final positions of deputies.
  std::vector<Eigen::Vector3d> foretold_errors(std::span<const SixNumbers<double>> starts,
                                               int order);
  /// The difference between polynomials and a flown state.
  static Vector6 error_of(DeputyPredictor& predictor, std::span<const double> flown,
                          const SixNumbers<double>& start, int order);
  /// The polynomials that miss a flown state by more.
  DeputyPredictor& worse_of(std::span<const double> flown, const SixNumbers<double>& start,
                            int order);

  const ComputedProblem& problem_;
  const Matrix6& axes_;
  double time_;
  DeputyPredictor predictor_;
  std::optional<DeputyPredictor> again_;
  std::function<void()> before_flight_;
};

}  // namespace hamjet
