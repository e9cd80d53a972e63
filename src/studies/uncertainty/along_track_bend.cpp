#include "along_track_bend.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <cmath>

#include "../../uncertainty/track_axes.hpp"

namespace hamjet {

bool AlongTrackBend::is_large_beside(double length) const {
  constexpr double small = 0.1;
  // The comparison is written so that NaN gives a warning.
  return !(bend <= small * std::hypot(radial, length));
}

AlongTrackBend along_track_bend(const EncounterProblem& problem, const EncounterDeviation& about) {
  AlongTrackBend result;
  double radial_variance = 0;
  for (std::size_t craft = 0; craft < 2; ++craft) {
    const UncertainSpacecraft& spacecraft = problem.spacecraft[craft];
    const TrackAxes axes(spacecraft.state.data());
    const Eigen::Matrix<double, 1, 6> along = axes.along.transpose() * spacecraft.factor.topRows(3);
    const Eigen::Matrix<double, 1, 6> radial =
        axes.radial.transpose() * spacecraft.factor.topRows(3);
    const double variance = along.squaredNorm();
    const double at = along.dot(about.segment<6>(static_cast<Eigen::Index>(6 * craft)));
    // Elements bend with the orbit.
    if (!spacecraft.straight) {
      result.deviations[craft] = std::sqrt(variance);
      result.bend += (at * at + variance) / (2 * axes.distance);
    }
    radial_variance += variance_beside(radial.squaredNorm(), along.dot(radial), variance);
  }
  result.radial = std::sqrt(radial_variance);
  return result;
}

EncounterDeviation deviation_of_meeting(const LinearRelativeState& at_approach) {
  const Eigen::Matrix<double, 2, 3> plane = plane_across(at_approach);
  const Eigen::Matrix<double, 2, 12> spread = plane * at_approach.by_deviation.topRows(3);
  const Eigen::Vector2d miss = plane * at_approach.mean.head<3>();
  return spread.completeOrthogonalDecomposition().solve(-miss);
}

std::optional<std::string> along_track_warning(const AlongTrackBend& bend, double length,
                                               const std::array<std::string, 2>& names,
                                               const std::string& what, const MetricUnits& units) {
  if (!bend.is_large_beside(length)) return std::nullopt;
  const std::size_t longer = bend.deviations[1] > bend.deviations[0] ? 1 : 0;
  return fmt::format(
      "the {} is uncertain by {:.3g} m along its track, where the orbit bends {:.3g} m away from a "
      "straight line; across the track it is uncertain by {:.3g} m, and the question is about "
      "{:.3g} m. A Gaussian in positions does not describe such states, and {} is not to be "
      "trusted",
      names[longer], bend.deviations[longer] * units.length_m, bend.bend * units.length_m,
      bend.radial * units.length_m, length * units.length_m, what);
}

}  // namespace hamjet
