#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/algebra/pack.hpp"
#include "hamjet/detail/dynamics/local_field.hpp"

namespace hamjet {

/// Takes points side by side in packs: eight, or one where there is no more or the numbers have no
/// vectors. `inputs` are arrays of `count` numbers each. `expand` gets a pack of each input and
/// sets `size` packs of outputs, whose lanes go to out[k * count + lane].
template <class Real, std::size_t Inputs, class Expand>
void for_points_in_packs(std::size_t count, const std::array<const Real*, Inputs>& inputs,
                         std::size_t size, Real* out, const Expand& expand) {
  const auto take = [&]<int Lanes>(std::integral_constant<int, Lanes>, std::size_t first) {
    using P = Pack<Real, Lanes>;
    static thread_local std::vector<P> outputs;
    outputs.resize(size);
    // Lanes without a point repeat the last one.
    const std::size_t last = std::min(count - first, static_cast<std::size_t>(Lanes)) - 1;
    std::array<P, Inputs> packs;
    for (std::size_t i = 0; i < Inputs; ++i) {
      for (std::size_t lane = 0; lane < Lanes; ++lane) {
        packs[i].set_lane(static_cast<int>(lane), inputs[i][first + std::min(lane, last)]);
      }
    }
    expand(packs, outputs.data());
    for (std::size_t k = 0; k < size; ++k) {
      Real* const target = out + k * count + first;
      if constexpr (std::experimental::is_simd_v<typename P::Vector>) {
        // The eight stages of a step fill a pack, and are stored as vectors.
        if (last + 1 == Lanes) {
          for (std::size_t i = 0; i < P::parts; ++i) {
            outputs[k].part[i].copy_to(target + i * P::width, std::experimental::element_aligned);
          }
          continue;
        }
      }
      for (std::size_t lane = 0; lane <= last; ++lane) {
        target[lane] = outputs[k].lane(static_cast<int>(lane));
      }
    }
  };
  constexpr int most = std::is_same_v<Real, Extended> ? 1 : 8;
  std::size_t first = 0;
  while (first < count) {
    if (most == 1 || count == 1) {
      take(std::integral_constant<int, 1>(), first);
      first += 1;
    } else {
      take(std::integral_constant<int, most>(), first);
      first += static_cast<std::size_t>(most);
    }
  }
}

}  // namespace hamjet
