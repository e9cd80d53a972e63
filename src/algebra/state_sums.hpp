#pragma once

#include <cstddef>
#include <vector>

namespace hamjet {

/// The sum, number by number, of a state and a deviation from it, or of two deviations.
inline std::vector<double> state_sum(std::vector<double> state,
                                     const std::vector<double>& deviation) {
  for (std::size_t i = 0; i < state.size(); ++i) state[i] += deviation[i];
  return state;
}

/// The deviation of the first state from the second.
inline std::vector<double> state_difference(std::vector<double> state,
                                            const std::vector<double>& from) {
  for (std::size_t i = 0; i < state.size(); ++i) state[i] -= from[i];
  return state;
}

}  // namespace hamjet
