#pragma once

#include <functional>
#include <vector>

#include "hamjet/detail/dynamics/time_function.hpp"

namespace hamjet {

/// The fraction of the Sun's disc that is seen along a path, as a function of the time: between
/// edges at given times a polynomial in the time, before the first and after the last edge the
/// outermost ones. At an edge the function is that of the later side.
class Sunlight final : public TimeFunction {
 public:
  /// A polynomial in (t - middle) / half.
  struct Piece {
    double middle = 0;
    double half = 1;
    std::vector<double> coefficients;

    bool is_constant() const { return coefficients.size() == 1; }
  };
  static Piece constant(double fraction) { return {0, 1, {fraction}}; }
  /// The polynomial of degree 16 through a function at the extrema of Chebyshev's polynomial on the
  /// interval. Where discs begin to overlap, the fraction falls with the power 3/2 of the time:
  /// on a passage straight across, from edge to edge, the polynomial departs by up to 6e-5 of the
  /// disc, and its mean by 5e-9 of it.
  static Piece interpolated(const std::function<double(double)>& fraction, double from, double to);

  /// One piece for all times.
  explicit Sunlight(Piece piece) : pieces_({std::move(piece)}) {}

  /// Ends the last piece at a time, later than all edges, at which another one begins.
  void append(double edge, Piece piece);
  /// Begins the first piece at a time, earlier than all edges, at which another one ends.
  void prepend(double edge, Piece piece);
  Piece& first() { return pieces_.front(); }
  Piece& last() { return pieces_.back(); }
  const std::vector<Piece>& pieces() const { return pieces_; }
  /// Ascending; piece i ends and piece i + 1 begins at edge i.
  const std::vector<double>& edges() const { return edges_; }

  std::size_t components() const override { return 1; }
  void expand(double t, int degree, double* out) const override { expand_as(t, degree, out); }
  void expand(const Extended& t, int degree, Extended* out) const override {
    expand_as(t, degree, out);
  }

 private:
  template <class Real>
  void expand_as(const Real& t, int degree, Real* out) const;

  std::vector<double> edges_;
  std::vector<Piece> pieces_;
};

}  // namespace hamjet
