#pragma once

#include <optional>
#include <string>
#include <vector>

#include "../../text/time_axis.hpp"
#include "hamjet/studies/transfer.hpp"

// What page, plots, files and the terminal's table derive from a transfer study, so that all say
// the same.

namespace hamjet::io {

/// The answer that stands for a point: the refined one, else that of the highest order; none where
/// there is neither.
const TransferAnswer* shown_answer(const TransferPoint& point);
/// The name of the answer that shown_answer gives: "refined" or "order 4".
std::string answer_name(const TransferPoint& point);
/// The answer of one order, none where it failed.
const TransferAnswer* answer_of_order(const TransferPoint& point, int order);

/// Everything that failed at a point, in one line; empty if nothing did.
std::string failure_text(const TransferPoint& point);

/// Counts of a study's points by their outcome.
struct TransferCounts {
  std::size_t times = 0;
  std::size_t compared = 0;  ///< may be the least: away, and within the tolerance or corrected
  std::size_t answered = 0;
  std::size_t near_singular = 0;
  std::size_t beyond_tolerance = 0;       ///< among all
  std::size_t beyond_tolerance_away = 0;  ///< among those that are not near a singularity
  std::size_t corrected_away = 0;  ///< those of beyond_tolerance_away that refinement set right
  std::size_t unanswered_away = 0;
  std::size_t refined = 0;
  std::size_t refinement_failed = 0;
  std::size_t refinement_failed_away = 0;
  std::size_t over_impulse = 0;  ///< proved, but with an impulse larger than the scene allows
  std::size_t kept_out = 0;      ///< proved, of allowed impulses, but through the ellipsoid
  std::size_t below_surface =
      0;  ///< proved, allowed and outside of the ellipsoid, but below the surface
};
TransferCounts count_points(const TransferResult& result);

/// A part of the times in words, such as "nearer to a singularity than the margin".
struct TransferOutcome {
  std::size_t count = 0;
  std::string text;
};
/// The outcomes that some times have, first those that are compared; each time has one of them.
std::vector<TransferOutcome> transfer_outcomes(const TransferResult& result);

/// Misses away from singularities, metres.
struct MissStatistics {
  std::string answer;  ///< "order 1" .. "order N", "refined"
  std::size_t count = 0;
  double median_m = 0;
  double largest_m = 0;
};
/// The misses of each order, then of the refinement if the scene asks for it; those without a miss
/// are left out.
std::vector<MissStatistics> miss_statistics(const TransferResult& result);

/// The point with the largest velocity change among answers that are not near a singularity.
std::optional<std::size_t> costliest_point(const TransferResult& result);

/// The largest Hamilton-Jacobi residual with its rounding floor in words; empty where none was
/// computed.
std::string hamilton_jacobi_text(const TransferResult& result);
/// The largest Hamilton-Jacobi residual.
std::optional<double> largest_hamilton_jacobi_residual(const TransferResult& result);

/// The first that a reader sees: the least velocity change, its transfer time, and the misses.
std::string transfer_verdict(const TransferResult& result);

/// Why the exit code is not 0, one line; empty if it is 0.
std::string transfer_failure(const TransferResult& result);

/// A miss, or "less than" the rounding floor under which flying cannot tell.
std::string miss_text(double miss_m, double flight_floor_m);

/// A singular time in seconds with the digits that its resolution leaves, at most so many decimals;
/// for a double one also that it is, and how close a pair that looks like it may be.
std::string singular_time_text(const SingularTime& singular, double unit_s, int most_decimals);

/// A canonical time of a study in seconds.
inline double seconds(const TransferResult& result, double time) {
  return time * result.scene.units.time_s;
}

/// A time for people: "5432 s (90.5 min)".
std::string time_text(double seconds);

/// A velocity to four digits: "12.34 m/s".
std::string velocity_text(double metres_per_second);

}  // namespace hamjet::io
