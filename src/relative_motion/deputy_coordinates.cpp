#include "hamjet/relative_motion/deputy_coordinates.hpp"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <string>
#include <vector>

#include "extended_vectors.hpp"
#include "hamjet/error.hpp"
#include "quasi_nonsingular_elements.hpp"

namespace hamjet {
namespace {

using Numbers = std::array<Extended, 6>;

ExtendedVector scaled(const ExtendedVector& a, const Extended& factor) {
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}

ExtendedVector part(const Numbers& state, std::size_t first) {
  return {state[first], state[first + 1], state[first + 2]};
}

/// The axes R, T, N of a state in extended precision, and the rates at which these axes and the
/// distance change on the osculating orbit.
struct OrbitAxes {
  explicit OrbitAxes(const Numbers& state) {
    const ExtendedVector r = part(state, 0), v = part(state, 3), h = cross(r, v);
    distance = sqrt(dot(r, r));
    const Extended momentum = sqrt(dot(h, h));
    axes[0] = scaled(r, 1 / distance);
    axes[2] = scaled(h, 1 / momentum);
    axes[1] = cross(axes[2], axes[0]);
    radial_speed = dot(r, v) / distance;
    rate = momentum / (distance * distance);
  }

  ExtendedVector along(const ExtendedVector& inertial) const {
    return {dot(axes[0], inertial), dot(axes[1], inertial), dot(axes[2], inertial)};
  }
  ExtendedVector from(const ExtendedVector& components) const {
    ExtendedVector sum = {0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < 3; ++i) sum[i] += components[k] * axes[k][i];
    }
    return sum;
  }

  std::array<ExtendedVector, 3> axes;
  Extended distance, radial_speed, rate;
};

Extended degree() { return boost::math::constants::pi<Extended>() / 180; }

/// The frame of a form that is linear in the deviation. For the other forms it is not used, and any
/// frame that always exists serves.
RelativeFrame linear_frame(DeputyForm form) {
  switch (form) {
    case DeputyForm::rtn_rotating:
    case DeputyForm::curvilinear:
      return RelativeFrame::rtn_rotating;
    case DeputyForm::rtn_inertial:
      return RelativeFrame::rtn_inertial;
    default:
      return RelativeFrame::inertial;
  }
}

constexpr std::array<DeputyComponent, 6> rtn_components = {{
    {"R_m", "radial, from the centre"},
    {"T_m", "transverse, along the motion"},
    {"N_m", "normal to the orbit"},
    {"vR_m_s", "radial velocity"},
    {"vT_m_s", "transverse velocity"},
    {"vN_m_s", "normal velocity"},
}};

constexpr std::array<DeputyComponent, 6> inertial_components = {{
    {"x_m", "along the inertial x axis"},
    {"y_m", "along the inertial y axis"},
    {"z_m", "along the inertial z axis, north"},
    {"vx_m_s", "velocity along the x axis"},
    {"vy_m_s", "velocity along the y axis"},
    {"vz_m_s", "velocity along the z axis"},
}};

constexpr std::array<DeputyComponent, 6> curvilinear_components = {{
    {"radial_m", "curvilinear: distance from the centre, less the chief's"},
    {"arc_m", "curvilinear: arc of the chief's radius along the motion, in the chief's plane"},
    {"cross_m", "curvilinear: arc of the chief's radius out of the chief's plane"},
    {"radial_rate_m_s", "curvilinear: derivative of radial_m by time"},
    {"arc_rate_m_s", "curvilinear: derivative of arc_m by time"},
    {"cross_rate_m_s", "curvilinear: derivative of cross_m by time"},
}};

constexpr std::array<DeputyComponent, 6> relative_element_components = {{
    {"a_da_m", "relative-elements: difference of the semi-major axes"},
    {"a_dlambda_m", "relative-elements: a times the relative mean longitude"},
    {"a_dex_m", "relative-elements: a times the difference of e cos w"},
    {"a_dey_m", "relative-elements: a times the difference of e sin w"},
    {"a_dix_m", "relative-elements: a times the difference of the inclinations"},
    {"a_diy_m", "relative-elements: a sin i times the difference of the nodes"},
}};

constexpr std::array<DeputyComponent, 6> element_difference_components = {{
    {"da_m", "element-differences: difference of the semi-major axes"},
    {"dtheta_deg", "element-differences: difference of the true arguments of latitude"},
    {"di_deg", "element-differences: difference of the inclinations"},
    {"dq1", "element-differences: difference of e cos w"},
    {"dq2", "element-differences: difference of e sin w"},
    {"draan_deg", "element-differences: difference of the nodes"},
}};

void require_six(std::span<const double> numbers, const char* what) {
  if (numbers.size() < 6) {
    throw Error(ErrorKind::usage, std::string("deputy coordinates: the ") + what +
                                      " must begin with 6 numbers, (q, p) of an orbit");
  }
}

Numbers as_extended(std::span<const double> numbers, const char* what) {
  require_six(numbers, what);
  Numbers result;
  for (std::size_t i = 0; i < 6; ++i) result[i] = numbers[i];
  return result;
}

}  // namespace

std::string_view name_of(DeputyForm form) {
  switch (form) {
    case DeputyForm::inertial:
      return "inertial";
    case DeputyForm::curvilinear:
      return "curvilinear";
    case DeputyForm::relative_elements:
      return "relative-elements";
    case DeputyForm::element_differences:
      return "element-differences";
    default:
      return "RTN";
  }
}

const std::array<DeputyComponent, 6>& components_of(DeputyForm form) {
  switch (form) {
    case DeputyForm::inertial:
      return inertial_components;
    case DeputyForm::curvilinear:
      return curvilinear_components;
    case DeputyForm::relative_elements:
      return relative_element_components;
    case DeputyForm::element_differences:
      return element_difference_components;
    default:
      return rtn_components;
  }
}

DeputyCoordinates::DeputyCoordinates(std::span<const double> chief, const MetricUnits& units,
                                     double mu, DeputyForm form)
    : form_(form),
      units_(units),
      mu_(mu),
      chief_(as_extended(chief, "chief")),
      frame_(chief, units, linear_frame(form)) {
  if (is_nonlinear(form) && form != DeputyForm::curvilinear) {
    quasi_nonsingular_elements(chief_, mu_, "chief");
  }
}

std::array<double, 6> DeputyCoordinates::deviation(std::span<const double> coordinates) const {
  require_six(coordinates, "coordinates");
  std::array<double, 6> result{};
  if (!is_nonlinear(form_)) {
    const auto& c = coordinates;
    const std::vector<double> found = frame_.deviation({{c[0], c[1], c[2]}, {c[3], c[4], c[5]}});
    std::copy(found.begin(), found.end(), result.begin());
    return result;
  }
  const Numbers given = as_extended(coordinates, "coordinates");
  const Numbers deputy = form_ == DeputyForm::curvilinear ? deputy_from_curvilinear(given)
                                                          : deputy_from_elements(given);
  for (std::size_t i = 0; i < 6; ++i) result[i] = convert<double>(Extended(deputy[i] - chief_[i]));
  return result;
}

std::array<double, 6> DeputyCoordinates::coordinates(std::span<const double> deviation) const {
  if (!is_nonlinear(form_)) {
    const RelativeState state = frame_.relative(deviation);
    const auto& [r, v] = state;
    return {r[0], r[1], r[2], v[0], v[1], v[2]};
  }
  Numbers deputy = as_extended(deviation, "deviation");
  for (std::size_t i = 0; i < 6; ++i) deputy[i] += chief_[i];
  const Numbers found =
      form_ == DeputyForm::curvilinear ? curvilinear_of(deputy) : elements_of(deputy);
  std::array<double, 6> result{};
  for (std::size_t i = 0; i < 6; ++i) result[i] = convert<double>(found[i]);
  return result;
}

Numbers DeputyCoordinates::deputy_from_curvilinear(const Numbers& coordinates) const {
  const OrbitAxes chief(chief_);
  const Extended& r = chief.distance;
  const Extended length = units_.length_m, speed = units_.velocity_m_s();
  const Extended distance = r + coordinates[0] / length;
  const Extended turn = coordinates[1] / length / r, rise = coordinates[2] / length / r;
  const Extended half_turn = boost::math::constants::pi<Extended>();
  if (!(distance > 0) || !(abs(rise) < half_turn / 2) || !(abs(turn) <= half_turn)) {
    throw Error(ErrorKind::numerical,
                "curvilinear coordinates: the deputy must be above the centre, at most half a turn "
                "from its chief and less than a quarter turn out of the chief's plane");
  }
  const Extended radial_speed = chief.radial_speed + coordinates[3] / speed;
  const Extended turn_rate = chief.rate + (coordinates[4] / speed - chief.radial_speed * turn) / r;
  const Extended rise_rate = (coordinates[5] / speed - chief.radial_speed * rise) / r;
  const Extended cos_turn = cos(turn), sin_turn = sin(turn);
  const Extended cos_rise = cos(rise), sin_rise = sin(rise);
  const ExtendedVector up = {cos_rise * cos_turn, cos_rise * sin_turn, sin_rise};
  const ExtendedVector along = {-sin_turn, cos_turn, 0};
  const ExtendedVector out = {-sin_rise * cos_turn, -sin_rise * sin_turn, cos_rise};
  ExtendedVector velocity;
  for (std::size_t k = 0; k < 3; ++k) {
    velocity[k] = radial_speed * up[k] + distance * cos_rise * turn_rate * along[k] +
                  distance * rise_rate * out[k];
  }
  const ExtendedVector q = chief.from(scaled(up, distance)), p = chief.from(velocity);
  return {q[0], q[1], q[2], p[0], p[1], p[2]};
}

Numbers DeputyCoordinates::curvilinear_of(const Numbers& deputy) const {
  const OrbitAxes chief(chief_);
  const Extended& r = chief.distance;
  const ExtendedVector place = chief.along(part(deputy, 0)),
                       velocity = chief.along(part(deputy, 3));
  const Extended in_plane = place[0] * place[0] + place[1] * place[1];
  if (!(in_plane > 0)) {
    throw Error(ErrorKind::numerical,
                "curvilinear coordinates: the deputy is in the centre, or on the axis of the "
                "chief's orbit");
  }
  const Extended distance = sqrt(dot(place, place));
  const Extended turn = atan2(place[1], place[0]), rise = atan2(place[2], Extended(sqrt(in_plane)));
  const Extended radial_speed = dot(place, velocity) / distance;
  const Extended turn_rate =
      (place[0] * velocity[1] - place[1] * velocity[0]) / in_plane - chief.rate;
  const Extended rise_rate = (velocity[2] - radial_speed * place[2] / distance) / sqrt(in_plane);
  const Extended length = units_.length_m, speed = units_.velocity_m_s();
  return {(distance - r) * length,
          r * turn * length,
          r * rise * length,
          (radial_speed - chief.radial_speed) * speed,
          (chief.radial_speed * turn + r * turn_rate) * speed,
          (chief.radial_speed * rise + r * rise_rate) * speed};
}

Numbers DeputyCoordinates::deputy_from_elements(const Numbers& given) const {
  const QuasiNonsingularElements chief = quasi_nonsingular_elements(chief_, mu_, "chief");
  QuasiNonsingularElements deputy = chief;
  const Extended length = units_.length_m;
  const bool is_relative = form_ == DeputyForm::relative_elements;
  const Extended size = chief.semi_major_axis * length;
  const Extended node =
      is_relative ? Extended(given[5] / size / sin(chief.inclination)) : given[5] * degree();
  const Extended along = is_relative ? Extended(given[1] / size) : given[1] * degree();
  // Beyond half a turn the same place has another angle, with fewer turns, so that the given number
  // would not come back.
  const Extended half_turn = boost::math::constants::pi<Extended>();
  if (!(abs(node) <= half_turn) || !(abs(along) <= half_turn)) {
    throw Error(ErrorKind::numerical,
                "relative elements: the deputy's node or place is more than half a turn from its "
                "chief's; near the equatorial plane a small distance turns the node far");
  }
  deputy.semi_major_axis += given[0] / length;
  deputy.ascending_node += node;
  if (is_relative) {
    deputy.mean_argument_of_latitude += along - node * cos(chief.inclination);
    deputy.eccentricity_x += given[2] / size;
    deputy.eccentricity_y += given[3] / size;
    deputy.inclination += given[4] / size;
  } else {
    deputy.inclination += given[2] * degree();
    deputy.eccentricity_x += given[3];
    deputy.eccentricity_y += given[4];
    deputy.true_argument_of_latitude += along;
    deputy.mean_argument_of_latitude = mean_argument_of_latitude(deputy);
  }
  // An inclination outside 0 to 180 degrees would be turned into one inside, with the opposite node
  // in place of the given one.
  if (!(sin(deputy.inclination) > 0)) {
    throw Error(ErrorKind::numerical,
                "relative elements: the deputy's inclination must be between 0 and 180 deg");
  }
  return state_from_elements(deputy, mu_);
}

Numbers DeputyCoordinates::elements_of(const Numbers& state) const {
  const QuasiNonsingularElements chief = quasi_nonsingular_elements(chief_, mu_, "chief");
  const QuasiNonsingularElements deputy = quasi_nonsingular_elements(state, mu_, "deputy");
  const Extended length = units_.length_m;
  const Extended node = within_half_turn(deputy.ascending_node - chief.ascending_node);
  const Extended inclination = deputy.inclination - chief.inclination;
  const Extended x = deputy.eccentricity_x - chief.eccentricity_x;
  const Extended y = deputy.eccentricity_y - chief.eccentricity_y;
  const Extended axis = (deputy.semi_major_axis - chief.semi_major_axis) * length;
  if (form_ == DeputyForm::element_differences) {
    const Extended theta =
        within_half_turn(deputy.true_argument_of_latitude - chief.true_argument_of_latitude);
    return {axis, theta / degree(), inclination / degree(), x, y, node / degree()};
  }
  const Extended size = chief.semi_major_axis * length;
  const Extended mean =
      within_half_turn(deputy.mean_argument_of_latitude - chief.mean_argument_of_latitude);
  return {axis,
          size * (mean + node * cos(chief.inclination)),
          size * x,
          size * y,
          size * inclination,
          size * node * sin(chief.inclination)};
}

}  // namespace hamjet
