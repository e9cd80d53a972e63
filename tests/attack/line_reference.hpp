#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "force_models.hpp"

namespace hamjet::attack {

/// A line of initial states z0 + s d, followed over a duration; all numbers are exact.
struct Line {
  std::vector<double> start;      ///< z0 = (q, p)
  std::vector<double> direction;  ///< d
  double duration = 0;
  int order = 1;  ///< order of the series in s, from 1 to most_order
  /// Errors are measured in the units of the numbers instead of in the sizes of the final state.
  bool has_unit_sizes = false;
};

inline constexpr int most_order = 6;

/// The series of the final state along a line, by extrapolation in 31 digits. Errors are measured
/// by degree: the largest difference of a component, positions in units of `position_size`, momenta
/// in units of `momentum_size`, so that they do not depend on the unit of length.
struct LineReference {
  std::string failure;  ///< the reason why the line could not be followed; empty if it was followed
  std::vector<std::vector<DoubleDouble>> coefficients;  ///< [component][degree]
  double position_size = 0;
  double momentum_size = 0;
  std::vector<double> size;         ///< size of each degree: its largest coefficient
  std::vector<double> uncertainty;  ///< difference from a second run, plus rounding
  /// The effect of rounding to double precision on the result, the largest of 16 samples. In each
  /// sample all coefficients of the start and of the state after every step of this integrator are
  /// changed by up to half a unit in the last place of the largest position or momentum of their
  /// degree.
  std::vector<double> floor;
  std::size_t floor_steps = 0;  ///< number of steps after which there was a change
};

inline constexpr int floor_samples = 16;

/// Tolerances are relative for each degree; `seed` is the seed of the floor's changes.
LineReference follow(const Model& model, const Line& line, std::uint64_t seed, double tolerance,
                     double second_tolerance);

}  // namespace hamjet::attack
