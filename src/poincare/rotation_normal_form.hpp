#pragma once

#include <array>
#include <optional>
#include <vector>

#include "nodal_flight.hpp"

namespace hamjet {

/// Birkhoff's normal form of the first return about a stable frozen orbit, with the energy and H as
/// parameters, to the order of the return's series.
///
/// In the variables (u_0, X, u_H, Y) the linear return is a turn of w = X + i Y; a near identity
/// takes out all terms but those that every turn leaves,
///
///   w' = w nu(|w|^2; u_0, u_H) ,
///
/// so that |w| stays and w turns by arg nu. Orbits of the pericentre are circles of radius |w|,
/// about the frozen orbit of (u_0, u_H), and means over their angle are the terms of equal powers
/// of w and its conjugate.
///
/// Source: C. L. Siegel and J. K. Moser, Lectures on Celestial Mechanics, section 23; N. Weisskopf,
/// R. Armellin and M. Berz, Celest. Mech. Dyn. Astron. 132:14 (2020).
class RotationNormalForm {
 public:
  /// Of a frozen orbit's return. Throws Error(numerical) where the orbit is unstable to first
  /// order, or where a divisor of the order or below is smaller than what the series resolve.
  explicit RotationNormalForm(const NodalFlight<double>& flight);

  /// A circle of the normal form.
  struct Circle {
    double radius = 0;    ///< |w|
    double energy = 0;    ///< u_0
    double momentum = 0;  ///< u_H
  };

  /// The mean turn of the pericentre's pair a revolution, in parts of a whole turn.
  double rotation_number(const Circle& circle) const;
  /// Means over the angle of the return's time and of the node's advance.
  double mean_period(const Circle& circle) const { return value(period_, circle); }
  double mean_node(const Circle& circle) const { return value(node_, circle); }
  /// The area in (q, p) that the circle encloses, over 2 pi.
  double action(const Circle& circle) const { return value(action_, circle); }

  /// (q, p) less the frozen orbit's at an angle on the circle.
  std::array<double, 2> pair(const Circle& circle, double angle) const;
  /// The circle, of the frozen orbit's own energy and H, and the angle on it, of (q, p) less the
  /// frozen orbit's; none where the transformation has no inverse.
  struct Place {
    Circle circle;
    double angle = 0;
  };
  std::optional<Place> place_of(const std::array<double, 2>& pair) const;
  /// The angle on a circle after a number of returns.
  double angle_after(const Circle& circle, double angle, double returns) const;

  /// The smallest of |1 - exp(2 pi i k rho)| over the divisors that occur: what is lost of the
  /// series' digits is about its inverse at each degree.
  double smallest_divisor() const { return smallest_divisor_; }

 private:
  double value(const Series<double>& series, const Circle& circle) const;
  Series<double> mean(const Series<double>& series) const;

  SpacePointer space_;
  std::vector<Series<double>> transformation_;  ///< (u_0, X, u_H, Y) to (u_0, q, u_H, p)
  double linear_turn_ = 0;
  Series<double> turn_cosine_;  ///< nu, its real part; of equal powers
  Series<double> turn_sine_;
  Series<double> period_;
  Series<double> node_;
  Series<double> action_;
  double smallest_divisor_ = 2;
};

}  // namespace hamjet
