#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "collision_study.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/detail/studies/self_checks.hpp"
#include "hamjet/studies/scene.hpp"
#include "hamjet/uncertainty/polynomial_moments.hpp"
#include "safety_study.hpp"

namespace hamjet {

/// Moments of states that were flown, with the standard deviations that they scatter by, of a
/// sample of this size, to first order in 1/sqrt(count) and with the sample's own moments up to the
/// eighth: with z = (y - mean)/s, g the skewness and b the kurtosis,
///
///   mean s/sqrt(n);  s: s sqrt(b - 1)/(2 sqrt(n));  g: that of z^3 - 3 z - 3/2 g (z^2 - 1);
///   b: that of z^4 - 4 g z - 2 b (z^2 - 1)
///
/// (the influence functions of the moments).
struct FlownMoments {
  Cumulants cumulants;
  int count = 0;
  Vector<double> mean_error;
  Vector<double> deviation_error;
  Vector<double> skewness_error;
  Vector<double> kurtosis_error;
};
/// The moments of flown states, which are columns of six numbers.
FlownMoments flown_moments(const Matrix<double>& states);

/// A part of the deviations of a start that has polynomials about a centre of its own.
struct UncertaintyDomain {
  Vector<double> centre;  ///< from the start's mean, m and m/s along the frame of the results
  double share = 0;       ///< of all deviations, by their distribution
  double error_m = 0;     ///< estimate of the largest error of a coordinate of the position
};

/// What the deviations of a spacecraft were split into.
struct UncertaintyDomains {
  std::string spacecraft;
  std::vector<UncertaintyDomain> domains;
  std::size_t maps = 0;  ///< that were integrated, those of domains that were split too
  bool is_right = true;  ///< whether all estimates are within the tolerance
  double error_m = 0;    ///< the largest estimate
  /// How far the quadrature is from one of fewer nodes, as UncertainState::through_doubt.
  double doubt = 0;
};

/// The distribution of one spacecraft's state at one time, or of the difference of two. All
/// distributions of states are of deviations from the chief's nominal, metres and metres a second
/// along the frame's axes at the time, six or those of told_components; by the orders 1..N.
struct UncertainState {
  std::string name;  ///< "chief", "deputy" or "relative", the deputy less the chief
  std::vector<Cumulants>
      cartesian;  ///< moments by the polynomials of positions and velocities, exact for these
  /// By the polynomials in the scene's other coordinates, by quadrature; empty without such, or
  /// where some node of the quadrature has no place in them.
  std::vector<Cumulants> through;
  /// How far the quadrature is from one of fewer nodes, over the orders: relative, of standard
  /// deviations, and absolute, of skewness and kurtosis.
  double through_doubt = 0;
  /// By the polynomials of positions and velocities of the scene's domains; empty without such.
  std::vector<Cumulants> split;
  /// Moments of the scene's other coordinates themselves, exact for their polynomials; empty if the
  /// scene has no other coordinates.
  std::vector<Cumulants> charted;
  std::optional<FlownMoments> flown;
  Matrix<double> flown_states;  ///< columns of components; none without flights
};

struct UncertaintyAt {
  double time = 0;                           ///< canonical
  std::array<std::string, 6> charted_names;  ///< names of these coordinates
  std::vector<UncertainState> states;
};

/// The distributions of the states at the last time in other coordinates: those of the chart, less
/// the chief's, canonical and exact for their polynomials.
struct MomentsInCoordinates {
  JetCoordinates coordinates = JetCoordinates::cartesian;
  std::array<std::string, 6> components;         ///< names of the coordinates
  std::vector<std::string> states;               ///< names of the states, as in UncertaintyAt
  std::vector<std::vector<Cumulants>> by_order;  ///< moments of each state, by the orders 1..N
  std::string refusal;  ///< if not empty, the reason why there are no moments
};

/// What one uncertain parameter alone does to the states at the last time, linearly.
struct ParameterEffect {
  std::string spacecraft;  ///< whose parameter it is: "chief", "deputy", or "all"
  std::string parameter;
  double deviation = 0;  ///< standard deviation of the parameter, in its own unit
  struct Along {
    std::string state;          ///< as UncertainState::name
    Vector<double> deviations;  ///< six, in the frame of the results
  };
  std::vector<Along> along;
};

struct UncertaintyResult {
  Scene scene;  ///< with `uncertainty`
  std::string integrator;
  ChosenCoordinates coordinates;  ///< those of the end; not automatic
  /// Why starts are Gaussian in elements where the scene leaves the choice open, as sentences.
  std::vector<std::string> start_notes;
  std::vector<UncertaintyAt> points;
  std::vector<UncertaintyDomains> domains;  ///< of each uncertain spacecraft, if the scene asks
  std::vector<ParameterEffect> parameter_effects;    ///< of every uncertain parameter
  std::vector<MomentsInCoordinates> in_coordinates;  ///< as `uncertainty.coordinates` asks
  std::optional<CollisionResult> collision;          ///< if the scene asks for it
  std::optional<SafetyResult> safety;                ///< likewise
  std::vector<SelfCheck> checks;                     ///< checks of the flights of chief and deputy
  double propagation_seconds = 0;
  double moments_seconds = 0;
  double flight_seconds = 0;
};

/// How far moments are from others, in the worst component.
struct MomentsDifference {
  double deviation = 0;  ///< difference of the standard deviations, relative to the first ones
  double skewness = 0;
  double kurtosis = 0;
};
MomentsDifference difference_of(const Cumulants& one, const Cumulants& other);

/// How far the distribution is from the Gaussian one of the linear theory: the divergence, and by
/// how much a probability may be wrong.
double divergence_from_linear(const std::vector<Cumulants>& by_order);

/// The moments of the scene's states at its times, and what the scene asks for of collisions and
/// passive safety, by so many threads. Throws as study_validity, study_collision and study_safety.
UncertaintyResult study_uncertainty(const Scene& scene, const ProgressCallback& progress = {},
                                    std::size_t threads = 1);

}  // namespace hamjet
