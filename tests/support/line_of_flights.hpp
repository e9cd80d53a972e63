#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/algebra/truncated_power_series.hpp"

// The Taylor coefficients of a flow along a line of starts, by differences of flights that share no
// code with the library: equations of motion written by hand, extrapolated steps.

namespace hamjet::test {

using Numbers = std::vector<Extended>;

/// The state after a time, by Gragg's, Bulirsch's and Stoer's extrapolation: midpoint rules of 2,
/// 4,
/// ..., 20 substeps in each of `steps` steps. `field(z, t)` is the derivative. Source: E. Hairer,
/// S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I, section II.9.
template <class Field>
Numbers extrapolated_flight(const Field& field, Numbers z, Extended start, Extended duration,
                            int steps) {
  constexpr int rows = 10;
  const Extended step = duration / steps;
  const auto moved = [](const Numbers& a, Extended h, const Numbers& slope) {
    Numbers result = a;
    for (std::size_t i = 0; i < a.size(); ++i) result[i] += h * slope[i];
    return result;
  };
  for (int k = 0; k < steps; ++k) {
    const Extended t = start + k * step;
    std::vector<Numbers> table(rows);
    for (int j = 1; j <= rows; ++j) {
      const Extended h = step / (2 * j);
      Numbers before = z;
      Numbers now = moved(z, h, field(z, t));
      for (int i = 1; i < 2 * j; ++i) {
        Numbers next = moved(before, 2 * h, field(now, t + i * h));
        before = std::move(now);
        now = std::move(next);
      }
      table[static_cast<std::size_t>(j - 1)] = now;
      for (int i = j - 1; i >= 1; --i) {
        const Extended weight = Extended(i) * i / (j * j - i * i);
        Numbers& coarse = table[static_cast<std::size_t>(i - 1)];
        const Numbers& fine = table[static_cast<std::size_t>(i)];
        for (std::size_t c = 0; c < z.size(); ++c) {
          coarse[c] = fine[c] + weight * (fine[c] - coarse[c]);
        }
      }
    }
    z = table[0];
  }
  return z;
}

/// The coefficients of degrees 0 to 3 of f(s), by component, from the polynomial through seven
/// points at multiples of h.
template <class Function>
std::vector<Numbers> coefficients_by_differences(const Function& f, Extended h) {
  constexpr int reach = 3;
  constexpr int points = 2 * reach + 1;
  // Newton's divided differences, then the powers of s by Horner's scheme.
  std::vector<Numbers> values;
  Numbers nodes;
  for (int k = 0; k < points; ++k) {
    nodes.push_back((k % 2 == 0 ? -(k / 2) : (k + 1) / 2) * h);
    values.push_back(f(nodes.back()));
  }
  const std::size_t size = values[0].size();
  for (int level = 1; level < points; ++level) {
    for (int k = points - 1; k >= level; --k) {
      for (std::size_t c = 0; c < size; ++c) {
        values[k][c] = (values[k][c] - values[k - 1][c]) / (nodes[k] - nodes[k - level]);
      }
    }
  }
  std::vector<Numbers> powers(points, Numbers(size, 0));
  for (int k = points - 1; k >= 0; --k) {
    for (int d = points - 1; d >= 0; --d) {
      for (std::size_t c = 0; c < size; ++c) {
        powers[d][c] = (d > 0 ? powers[d - 1][c] : values[k][c]) - nodes[k] * powers[d][c];
      }
    }
  }
  powers.resize(4);
  return powers;
}

/// The coefficients of degrees 0 to 3 of a series along a direction of its variables.
template <class T>
Numbers along_direction(const Series<T>& series, std::span<const double> direction) {
  const SeriesSpace& space = series.space();
  Numbers result(4, 0);
  for (std::size_t k = 0; k < space.first(4); ++k) {
    Extended term(series[k]);
    int degree = 0;
    for (std::size_t v = 0; v < direction.size(); ++v) {
      const int e = space.exponents(k)[v];
      degree += e;
      for (int i = 0; i < e; ++i) term *= direction[v];
    }
    result[static_cast<std::size_t>(degree)] += term;
  }
  return result;
}

/// The largest difference of the first components of a jet along a direction from coefficients by
/// differences, relative to the largest coefficient of the degree, in degrees 1 to 3.
template <class T>
double largest_difference(const std::vector<Series<T>>& jet, std::span<const double> direction,
                          const std::vector<Numbers>& right, std::size_t components) {
  Extended worst = 0;
  for (std::size_t degree = 1; degree <= 3; ++degree) {
    Extended size = 0;
    Extended apart = 0;
    for (std::size_t c = 0; c < components; ++c) {
      const Extended found = along_direction(jet[c], direction)[degree];
      size = std::max(size, Extended(abs(right[degree][c])));
      apart = std::max(apart, Extended(abs(found - right[degree][c])));
    }
    worst = std::max(worst, Extended(apart / size));
  }
  return static_cast<double>(worst);
}

}  // namespace hamjet::test
