#pragma once

#include <array>
#include <utility>

#include "hamjet/algebra/elementary_functions.hpp"

namespace hamjet {

/// Cosine and sine of the angle phi from a nonzero vector y0 of a plane to a series y whose
/// constant term is y0:
///
///   A = y0.y / |y0|^2 ,   B = (y0_1 y_2 - y0_2 y_1) / |y0|^2 ,
///   cos phi = A / sqrt(A^2 + B^2) ,   sin phi = B / sqrt(A^2 + B^2) .
template <class Real>
struct SectionTurn {
  Series<Real> cosine;
  Series<Real> sine;

  SectionTurn(const std::array<Real, 2>& y0, const Series<Real>& y1, const Series<Real>& y2)
      : SectionTurn(along(y0, y1, y2), across(y0, y1, y2)) {}

 private:
  SectionTurn(const Series<Real>& a, const Series<Real>& b) : cosine(a), sine(b) {
    const Series<Real> inverse = pow(square(a) + square(b), Real(-0.5));
    cosine = a * inverse;
    sine = b * inverse;
  }

  static Real square_of(const std::array<Real, 2>& y0) { return y0[0] * y0[0] + y0[1] * y0[1]; }

  static Series<Real> along(const std::array<Real, 2>& y0, const Series<Real>& y1,
                            const Series<Real>& y2) {
    Series<Real> a = (y0[0] * y1 + y0[1] * y2) / square_of(y0);
    a[0] = Real(1);
    return a;
  }

  static Series<Real> across(const std::array<Real, 2>& y0, const Series<Real>& y1,
                             const Series<Real>& y2) {
    Series<Real> b = (y0[0] * y2 - y0[1] * y1) / square_of(y0);
    b[0] = Real(0);
    return b;
  }
};

}  // namespace hamjet
