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
  int order = 1;  ///< of the series in s, 1 to most_order
  /// Errors are measured in the units of the numbers instead of the sizes of the final state.
  bool has_unit_sizes = false;
};

inline constexpr int most_order = 6;

/// The series of the final state along a line, by extrapolation in 31 digits. Errors are measured
/// by degree: the largest difference of a component, positions in units of `position_size`, momenta
/// in units of `momentum_size`, so that they do not depend on the unit of length.
struct LineReference {
  std::string failure;  ///< not empty: the line could not be followed
  std::vector<std::vector<DoubleDouble>> coefficients;  ///< [component][degree]
  double position_size = 0;
  double momentum_size = 0;
  std::vector<double> size;         ///< of each degree: its largest coefficient
  std::vector<double> uncertainty;  ///< difference from a second run, and rounding
  /// What rounding to double precision does to the result, the largest of 16 samples: the start and
  /// the state after every step of this integrator, all coefficients, are changed by up to half a
  /// unit in the last place of the largest position or momentum of their degree.
  std::vector<double> floor;
  std::size_t floor_steps = 0;  ///< after which there was such a change
};

inline constexpr int floor_samples = 16;

/// Tolerances are relative, by degree; `seed` is of the floor's changes.
LineReference follow(const Model& model, const Line& line, std::uint64_t seed, double tolerance,
                     double second_tolerance);

}  // namespace hamjet::attack
