#pragma once

#include <array>
#include <span>
#include <string_view>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"

namespace hamjet {

/// The six numbers in which the whole state of a deputy can be given, relative to the chief.
enum class DeputyForm {
  rtn_rotating,       ///< position and velocity along RTN, derivatives seen from the rotating axes
  rtn_inertial,       ///< position and velocity along RTN, differences of inertial velocities
  inertial,           ///< differences of position and velocity along inertial axes
  curvilinear,        ///< lengths along the chief's orbit and its sphere, and their derivatives
  relative_elements,  ///< relative orbital elements after D'Amico
  element_differences,  ///< differences of a, theta, i, e cos w, e sin w and the node
};

/// The name of a form in scenes and options; both RTN forms have the name "RTN".
std::string_view name_of(DeputyForm form);

/// Whether a form is a nonlinear function of the deviation; such a form has keys of its own in
/// scenes.
constexpr bool is_nonlinear(DeputyForm form) { return form >= DeputyForm::curvilinear; }

/// The forms that are nonlinear functions of the deviation.
inline constexpr std::array<DeputyForm, 3> nonlinear_forms = {
    DeputyForm::curvilinear, DeputyForm::relative_elements, DeputyForm::element_differences};

/// One of the six numbers of a form: its name in scenes and columns, with its unit.
struct DeputyComponent {
  std::string_view name;
  std::string_view help;
};

/// The components of a form, in their order.
const std::array<DeputyComponent, 6>& components_of(DeputyForm form);

/// Converts between canonical deviations (dq, dp) from the chief and a form, exactly: both
/// directions are closed formulas, apart from Kepler's equation, and they are inverse to each other
/// up to the rounding of the results. All intermediate results are in extended precision, because
/// the relative elements of a deputy near the chief are small differences of large numbers.
///
/// curvilinear: with the distance r of the chief and r_d of the deputy, dr = r_d - r, arc = r times
/// the angle in the chief's plane, along the motion, to the deputy's projection, cross = r times
/// the deputy's angle out of that plane, and the time derivatives of these three. The plane is that
/// of the chief's osculating orbit and is held fixed; in it the chief turns at the rate |r x
/// v|/r^2. Source: H. Bruijn, E. Gill and J. How, "Comparative analysis of Cartesian and
/// curvilinear Clohessy-Wiltshire equations", Journal of Aerospace Engineering, Sciences and
/// Applications 3 (2011); M. Willis, K. Alfriend and S. D'Amico, arXiv 1909.02146.
///
/// relative_elements: in metres, the chief's a times
///
///   da/a, (u_d - u) + (node_d - node) cos i, d(e cos w), d(e sin w), di, (node_d - node) sin i ,
///
/// with u = w + M. Source: S. D'Amico, Autonomous Formation Flying in Low Earth Orbit, thesis, TU
/// Delft (2010), eq. 2.2.
///
/// element_differences: da in metres, differences of the true argument of latitude and the
/// inclination in degrees, of q1 = e cos w and q2 = e sin w, and of the node in degrees. Source:
/// D.-W. Gim and K. T. Alfriend, "State transition matrix of relative motion for the perturbed
/// noncircular reference orbit", Journal of Guidance, Control, and Dynamics 26 (2003).
///
/// All elements are osculating elements about a centre with gravitational parameter mu.
class DeputyCoordinates {
 public:
  /// `chief` is the inertial state (q, p), 6 canonical numbers, and `mu` canonical. Throws
  /// Error(numerical) where the chief's orbit lacks what the form needs (a plane; for elements, an
  /// ellipse outside the equatorial plane), and Error(usage) for other sizes.
  DeputyCoordinates(std::span<const double> chief, const MetricUnits& units, double mu,
                    DeputyForm form);

  /// The canonical deviation of a deputy from its 6 numbers. Throws Error(numerical) for elements
  /// that do not describe an ellipse or differ from the chief's by more than half a turn, and for
  /// curvilinear coordinates of a deputy that is in the centre or behind it.
  std::array<double, 6> deviation(std::span<const double> coordinates) const;

  /// The coordinates of a canonical deviation. Throws Error(numerical) where the deputy's orbit
  /// lacks what the form needs.
  std::array<double, 6> coordinates(std::span<const double> deviation) const;

 private:
  using Numbers = std::array<Extended, 6>;

  Numbers deputy_from_curvilinear(const Numbers& coordinates) const;
  Numbers curvilinear_of(const Numbers& deputy) const;
  Numbers deputy_from_elements(const Numbers& coordinates) const;
  Numbers elements_of(const Numbers& deputy) const;

  DeputyForm form_;
  MetricUnits units_;
  Extended mu_;
  Numbers chief_;
  ChiefFrame frame_;
};

}  // namespace hamjet
