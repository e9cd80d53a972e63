#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamjet/algebra/truncated_power_series.hpp"
#include "hamjet/detail/algebra/eigen.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"

namespace hamjet {

/// The energy-optimal thrust by the polynomials of one order, and the misses of the deputy that
/// flies it with the full equations of motion.
struct EnergyOptimalAnswer {
  int order = 0;
  /// Deviations of the costates at the start, those of q and then those of p, canonical.
  std::vector<double> costates;
  double energy_m2_s3 = 0;  ///< the least integral of |u|^2 / 2 by the generating function
  double miss_m = 0;
  double velocity_miss_m_s = 0;
  std::string failure;  ///< if not empty, the reason why this order has no answer
};

/// The thrust that leads a deputy from its start to its end, in position and velocity, in one time
/// with the least integral of |u|^2 / 2, u being its acceleration.
struct EnergyOptimalTransfer {
  double time = 0;       ///< in canonical units
  double condition = 0;  ///< the condition of the linear part that is inverted, dx/dlambda0
  std::vector<EnergyOptimalAnswer> answers;  ///< the answers of the orders 1..N
  /// The answer of order N, corrected by flying until both misses are as small as asked for.
  std::optional<EnergyOptimalAnswer> refined;
  int refinement_flights = 0;
  /// Where flying did not correct that answer: the number of smaller deviations, all in the same
  /// proportions, from which the thrust was followed to the whole. Otherwise 0.
  int continuation_steps = 0;
  // Of the corrected answer, along its flight, in SI units:
  double energy_m2_s3 = 0;      ///< integral of |u|^2 / 2
  double change_m_s = 0;        ///< integral of |u|
  double largest_m_s2 = 0;      ///< largest |u|
  bool exceeds_thrust = false;  ///< this is more than the scene's `largest_thrust_m_s2`
  /// Its acceleration at the start and at the end, along the axes of the scene's frame.
  Eigen::Vector3d start_thrust_m_s2 = Eigen::Vector3d::Zero();
  Eigen::Vector3d end_thrust_m_s2 = Eigen::Vector3d::Zero();
  std::string failure;  ///< if not empty, the reason why there is none

  bool is_found() const { return failure.empty(); }
};

/// The thrust at a time on the way.
struct ThrustSample {
  double time = 0;  ///< in canonical units
  /// Acceleration along the axes of the scene's frame at that time.
  Eigen::Vector3d thrust_m_s2 = Eigen::Vector3d::Zero();
};

/// The law of feedback at one instant of a transfer.
struct FeedbackInstant {
  double time = 0;  ///< since the start, in canonical units
  /// The acceleration in m/s^2 along the axes of the scene's frame at that time: three polynomials
  /// in the six numbers of the deputy's relative state then, in m and m/s.
  std::vector<Series<double>> thrust;
  RelativeState state;  ///< of the deputy that flies by the law
};

/// A flight with errors of its thrust, in SI units.
struct ErroneousFlight {
  double miss_m = 0;
  double velocity_miss_m_s = 0;
  double energy_m2_s3 = 0;  ///< integral of |u|^2 / 2 of the thrust as it was carried out
  double change_m_s = 0;    ///< integral of |u| likewise
  std::string failure;      ///< if not empty, the reason why it does not arrive
};

/// Two flights under the same errors of thrust: one by the law of feedback, to which at each
/// instant a wrong state is told, and one by the thrust that was planned.
struct ErrorSample {
  ErroneousFlight closed_loop;
  ErroneousFlight open_loop;
};

/// The thrust of least energy to the scene's end at a fixed time of arrival, as a function of the
/// state and the time to go, and a flight by it: at each instant the polynomials of the highest
/// order give the costates for the state that was reached, and they are flown, with the full
/// equations of motion, until the next instant.
struct FeedbackLaw {
  std::vector<FeedbackInstant> instants;  ///< equal parts of the transfer, the first at its start
  double miss_m = 0;
  double velocity_miss_m_s = 0;
  double energy_m2_s3 = 0;           ///< integral of |u|^2 / 2 of that flight
  double change_m_s = 0;             ///< integral of |u| of that flight
  std::vector<ErrorSample> samples;  ///< under errors drawn at random, if the scene asks for them
  std::string failure;               ///< if not empty, the reason why there is none
};

/// The results of `thrust = "energy-optimal"`.
struct EnergyOptimalTransfers {
  int order = 0;                                 ///< N of the jets in states and costates
  std::vector<EnergyOptimalTransfer> transfers;  ///< one for each time, away from 0
  std::optional<std::size_t> least;   ///< the least change among those found that the scene allows
  std::vector<ThrustSample> profile;  ///< along the flight of the least, at equal times
  std::optional<FeedbackLaw> feedback;  ///< of the least, if the scene asks for it
  std::string failure;                  ///< if not empty, the reason why there is none
};

}  // namespace hamjet
