#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "hamjet/algebra/extended.hpp"

namespace hamjet {

/// Functions of one variable by their values at nodes: polynomials of degree 7 between neighbouring
/// nodes that have the value and the first three derivatives in common. In Extended they are three
/// times continuously differentiable to its own rounding; in double the same polynomials are
/// evaluated, whose coefficients were rounded. Derivatives at a node are those of the polynomial
/// through the nodes around it. A function f is met to f^(8) h^8 / 1.0e7, with h between nodes, and
/// to what the derivatives are wrong by.
class PiecewiseHermite {
 public:
  static constexpr int degree = 7;
  template <class Real>
  using Coefficients = std::array<Real, degree + 1>;

  /// `values[c][i]` is that of component c at `nodes[i]`, which ascend. Derivatives at a node come
  /// from up to `reach` nodes on either side, or as many nearest ones at the ends. `scale` is that
  /// of the times of `expand`: the variable is `scale` times them. Needs at least two nodes.
  PiecewiseHermite(std::vector<double> nodes, const std::vector<std::vector<double>>& values,
                   std::size_t reach, const Extended& scale);

  std::size_t components() const { return components_; }
  double first() const { return nodes_.front(); }
  double last() const { return nodes_.back(); }

  /// Sets the Taylor coefficients of all components about a time, out[c][k]. Beyond the ends the
  /// outermost polynomials go on. Of a lower degree `most` the rest of the array is not set.
  void expand(double t, int most, Coefficients<double>* out) const;
  void expand(const Extended& t, int most, Coefficients<Extended>* out) const;

 private:
  std::size_t piece_at(double variable) const;

  std::vector<double> nodes_;
  std::size_t components_;
  Extended scale_;
  double scale_high_;
  double pieces_per_variable_;
  /// Coefficients in the part of a piece, from 0 to 1: those of a component side by side, then the
  /// next component's, then the next piece's.
  std::vector<double> pieces_;
  std::vector<Extended> exact_pieces_;
};

}  // namespace hamjet
