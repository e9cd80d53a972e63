#pragma once

#include <array>
#include <cstddef>
#include <mutex>
#include <vector>

#include "gauss_tableau.hpp"
#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/algebra/pack.hpp"

namespace hamjet {

/// The coefficients of a Gauss method as packs over the stages, in the numbers of an integration,
/// with the residues of rounding to these numbers. Lanes beyond the last stage repeat the first
/// stage where they stand for places, so that all lanes are finite, and are zero in weights.
template <class Real, int Lanes>
struct StageCoefficients {
  using P = Pack<Real, Lanes>;

  /// A coefficient and its rounding residue.
  struct Rounded {
    P value{Real(0)};
    P lost{Real(0)};
  };

  Rounded weights;
  Rounded nodes;
  Rounded position_weights;      ///< b_i (1 - c_i)
  std::vector<Rounded> matrix;   ///< columns of A
  std::vector<Rounded> squared;  ///< columns of A^2
  std::vector<P> modes;          ///< weights of the Legendre modes, by degree
  P lagrange;
  P start;
  P end;  ///< values at 1 of Lagrange's polynomials; the nodes are symmetric

  /// The coefficients, converted once for each number of stages, because the conversion takes as
  /// long as some steps.
  static const StageCoefficients& of(const GaussTableau& tableau) {
    static std::array<std::once_flag, Lanes + 1> is_converted;
    static std::array<StageCoefficients, Lanes + 1> converted;
    std::call_once(is_converted[tableau.stages],
                   [&] { converted[tableau.stages] = convert_tableau(tableau); });
    return converted[tableau.stages];
  }

 private:
  template <class Function>
  static Rounded pack_of(std::size_t stages, Function f, bool repeats) {
    Rounded result;
    for (std::size_t i = 0; i < Lanes; ++i) {
      if (i >= stages && !repeats) break;
      const Extended exact = f(i < stages ? i : 0);
      const Real rounded = convert<Real>(exact);
      result.value.set_lane(static_cast<int>(i), rounded);
      result.lost.set_lane(static_cast<int>(i), convert<Real>(Extended(exact - Extended(rounded))));
    }
    return result;
  }

  static StageCoefficients convert_tableau(const GaussTableau& tableau) {
    const std::size_t s = tableau.stages;
    const auto list = [](const std::vector<Extended>& values, std::size_t from = 0,
                         std::size_t by = 1) {
      return [&values, from, by](std::size_t i) { return values[from + by * i]; };
    };
    StageCoefficients result;
    result.weights = pack_of(s, list(tableau.weights), false);
    result.nodes = pack_of(s, list(tableau.nodes), true);
    result.position_weights = pack_of(
        s, [&](std::size_t i) { return Extended(tableau.weights[i] * (1 - tableau.nodes[i])); },
        false);
    for (std::size_t j = 0; j < s; ++j) {
      result.matrix.push_back(pack_of(s, list(tableau.matrix, j, s), true));
      result.squared.push_back(pack_of(s, list(tableau.squared, j, s), true));
      result.modes.push_back(pack_of(s, list(tableau.modes, j * s), false).value);
    }
    result.lagrange = pack_of(s, list(tableau.lagrange), false).value;
    result.start = pack_of(s, list(tableau.start), false).value;
    result.end = pack_of(
                     s, [&](std::size_t i) { return tableau.start[s - 1 - i]; }, false)
                     .value;
    return result;
  }
};

}  // namespace hamjet
