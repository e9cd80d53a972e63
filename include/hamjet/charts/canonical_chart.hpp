#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/algebra/truncated_power_series.hpp"

namespace hamjet {

/// Canonical coordinates of a body in three dimensions about a central mass. CanonicalChart defines
/// each of them and the order of its positions and momenta.
enum class ChartName { cartesian, spherical, cylindrical, poincare, nodal };

/// The name of a chart in scenes, options and files.
std::string_view name_of(ChartName chart);
/// The chart of a name; no value if no chart has that name.
std::optional<ChartName> chart_of(std::string_view name);
/// All charts, in the order of their enumerators.
inline constexpr std::array<ChartName, 5> all_charts = {ChartName::cartesian, ChartName::spherical,
                                                        ChartName::cylindrical, ChartName::poincare,
                                                        ChartName::nodal};

/// An orbit counts as an ellipse if its energy at the state concerned is below this fraction of
/// -mu/r. Nearer to zero energy, the periods of neighbouring orbits differ too much.
inline constexpr double least_binding = 0.004;

/// Six numbers: positions (q_1, q_2, q_3) and their momenta (p_1, p_2, p_3), of a state in inertial
/// axes or in a chart.
template <class T>
using SixNumbers = std::array<T, 6>;

/// A canonical chart about one state of a body of unit mass (the chief's): an invertible symplectic
/// map between its inertial positions and velocities (x, y, z, v_x, v_y, v_z), with z along the
/// axis of the field, and the chart's coordinates. Both directions are closed formulas, apart from
/// Kepler's equation.
///
///   cartesian    the inertial positions and velocities themselves
///   spherical    alpha, r, beta; p_alpha, p_r, p_beta: in axes with x along the chief's position
///                and z along its angular momentum, the angle along the orbit, the distance and the
///                angle out of the plane, and their momenta
///   cylindrical  phi, rho, z; L_z, p_rho, p_z: about the field's axis
///   poincare     from Delaunay's elements (l, g, h; L, G, H)
///                  l + g + h, -sqrt(2 (L - G)) sin(g + h), -sqrt(2 (G - H)) sin h ;
///                  L,          sqrt(2 (L - G)) cos(g + h),  sqrt(2 (G - H)) cos h ,
///                in the axes of the field, turned by half a turn about x where the chief goes the
///                other way about the axis
///   nodal        from Delaunay's elements in the axes of the field
///                  l + g,      h,  -sqrt(2 (L - G)) sin g ;
///                  L,          H,   sqrt(2 (L - G)) cos g
///
/// The first position is the angle that defines a section across the flow (see FlowSection). In the
/// nodal chart the second position is the node, on which a field of zonal harmonics does not
/// depend.
///
/// Spherical coordinates exist off the line through the poles of the chief's plane, cylindrical
/// ones off the field's axis, Poincaré's elements for ellipses, and nodal elements for ellipses
/// outside the equatorial plane.
///
/// Real is double or Extended; coordinates may be numbers or series in it.
///
/// Source: H. Goldstein, C. Poole and J. Safko, Classical Mechanics, 3rd ed., section 9.1 and 10.8
/// (Delaunay's elements); Poincaré's elements as in A. Morbidelli, Modern Celestial Mechanics
/// (2002), section 1.9; ellipses from them by the equinoctial formulas of R. A. Broucke and P. J.
/// Cefola, Celestial Mechanics 5 (1972) 303.
template <class Real>
class CanonicalChart {
 public:
  /// The chart about a state, `mu` being the gravitational parameter of the central body. Throws
  /// Error(numerical) where the chart does not exist at the state or is close to not existing
  /// (angles concerned below a hundredth of their range; an ellipse bound less than least_binding).
  CanonicalChart(ChartName name, const SixNumbers<Real>& chief, const Real& mu);

  ChartName name() const noexcept { return name_; }
  /// Whether the coordinates are elements of an ellipse.
  bool is_of_elements() const noexcept {
    return name_ == ChartName::poincare || name_ == ChartName::nodal;
  }

  /// The coordinates of an inertial state, with angles reduced by whole turns. The numbers are not
  /// finite where the state has no coordinates in this chart.
  SixNumbers<Real> coordinates(const SixNumbers<Real>& state) const;
  SixNumbers<Series<Real>> coordinates(const SixNumbers<Series<Real>>& state) const;

  /// The inertial state of coordinates.
  SixNumbers<Real> state(const SixNumbers<Real>& coordinates) const;
  SixNumbers<Series<Real>> state(const SixNumbers<Series<Real>>& coordinates) const;

  /// Whether a coordinate is an angle, which is known up to whole turns.
  bool is_angle(std::size_t place) const;

 private:
  template <class T>
  SixNumbers<T> to_chart(const SixNumbers<T>& state) const;
  template <class T>
  SixNumbers<T> from_chart(const SixNumbers<T>& coordinates) const;

  ChartName name_;
  Real mu_;
  std::array<std::array<Real, 3>, 3> axes_;  ///< rows: the axes in which the chart is written
};

/// The angle reduced by whole turns to [-pi, pi).
template <class Real>
Real within_half_a_turn(const Real& angle);

}  // namespace hamjet
