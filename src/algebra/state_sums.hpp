#pragma once

#include <cstddef>
#include <vector>

namespace hamjet {

/// A state and a deviation from it, or two deviations, number by number.
inline std::vector<double> state_sum(std::vector<double> state,
                                     const std::vector<double>& deviation) {
  for (std::size_t i = 0; i < state.size(); ++i) state[i] += deviation[i];
  return state;
}

/// The deviation of a state from another.
inline std::vector<double> state_difference(std::vector<double> state,
                                            const std::vector<double>& from) {
  for (std::size_t i = 0; i < state.size(); ++i) state[i] -= from[i];
  return state;
}

}  // namespace hamjet
