#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "hamjet/charts/deputy_flow.hpp"
#include "hamjet/formats/stored_jet.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet::cli {

/// What integrations have made wrong in a chief's flow, by which deputies are predicted: the end of
/// the chief, and what the polynomials make of a deviation. Canonical, of positions.
///
/// Errors of higher degrees than the first are left out: where the degrees decay, they are below
/// the first's or below what the missing degrees would add.
class FlowError {
 public:
  /// Nothing is known, and nothing counted.
  FlowError() = default;

  /// What two independent integrations of the linear part show (gauss_of_independent_run), as
  /// geometric means. Throws as the integrator and the coordinates.
  static FlowError measured(const Scene& scene, const ComputedProblem& problem,
                            const CoordinatesAtEnds& coordinates, const DeputyFlow& flow);
  /// What results state of their coefficients by degree, spread as evaluation_error does; nothing
  /// where they do not.
  static FlowError stated(const io::StoredJet& stored, const DeputyFlow& flow);

  /// All numbers that this object holds; the constructor below makes an equal object of them.
  std::vector<double> numbers() const;
  static FlowError of_numbers(std::span<const double> numbers);

  bool is_known() const { return is_known_; }
  /// The error of the chief's final position.
  double of_chief() const { return of_chief_; }
  /// The error of a deputy's final position relative to the chief, from its initial deviation.
  double of_deviation(const SixNumbers<double>& deviation) const;

 private:
  /// The derivatives of a position by six numbers.
  using PositionRows = Eigen::Matrix<double, 3, 6>;
  using Entry = Eigen::Matrix<double, 6, 6>;
  /// Errors of positions by the magnitudes of a flow's variables, and the derivatives of these by
  /// the numbers of a deviation.
  struct Bound {
    PositionRows rows = PositionRows::Zero();
    Entry entry = Entry::Identity();
  };

  bool is_known_ = false;
  double of_chief_ = 0;
  std::vector<PositionRows> shown_;  ///< times a deviation: the error of its end
  std::optional<Bound> bound_;
};

/// About the error of a stored chief's final position, from the error of degree 0 that the
/// results state; 0 where they do not.
double stated_chief_error(const io::StoredJet& stored);

}  // namespace hamjet::cli
