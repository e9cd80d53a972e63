#pragma once

#include <cstddef>
#include <vector>

#include "../gauss/stage_coefficients.hpp"

namespace hamjet {

/// The coefficients of a Gauss method as plain numbers, for orbits as lanes. They are those of
/// StageCoefficients, by stage; matrices are stored by rows.
struct LaneCoefficients {
  std::size_t stages = 0;
  std::vector<double> nodes, lost_nodes;
  std::vector<double> weights, lost_weights;
  std::vector<double> position_weights, lost_position_weights;  ///< b_i (1 - c_i)
  std::vector<double> coupling, lost_coupling;  ///< A, or A^2 for a second-order system
  std::vector<double> lagrange;
  std::vector<double> start;
  std::vector<std::vector<double>> modes;  ///< by degree

  LaneCoefficients(const GaussTableau& tableau, bool is_second_order) : stages(tableau.stages) {
    constexpr int most_stages = 16;
    const auto& packed = StageCoefficients<double, most_stages>::of(tableau);
    const auto numbers = [&](const Pack<double, most_stages>& pack) {
      std::vector<double> result;
      for (std::size_t i = 0; i < stages; ++i) result.push_back(pack.lane(static_cast<int>(i)));
      return result;
    };
    nodes = numbers(packed.nodes.value);
    lost_nodes = numbers(packed.nodes.lost);
    weights = numbers(packed.weights.value);
    lost_weights = numbers(packed.weights.lost);
    position_weights = numbers(packed.position_weights.value);
    lost_position_weights = numbers(packed.position_weights.lost);
    lagrange = numbers(packed.lagrange);
    start = numbers(packed.start);
    for (const auto& mode : packed.modes) modes.push_back(numbers(mode));
    const auto& columns = is_second_order ? packed.squared : packed.matrix;
    for (std::size_t i = 0; i < stages; ++i) {
      for (std::size_t j = 0; j < stages; ++j) {
        coupling.push_back(columns[j].value.lane(static_cast<int>(i)));
        lost_coupling.push_back(columns[j].lost.lane(static_cast<int>(i)));
      }
    }
  }
};

}  // namespace hamjet
