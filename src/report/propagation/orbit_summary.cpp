#include "orbit_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../../dynamics/celestial_bodies.hpp"
#include "../../text/quantity_text.hpp"
#include "hamjet/detail/dynamics/spherical_harmonic_coefficients.hpp"
#include "hamjet/dynamics/mean_elements.hpp"
#include "hamjet/error.hpp"

namespace hamjet::io {
namespace {

constexpr double pi = std::numbers::pi;

/// The osculating Kepler orbit in canonical units, where mu is 1.
class KeplerOrbit {
 public:
  explicit KeplerOrbit(const std::vector<double>& x)
      : start_(std::hypot(x[0], x[1], x[2])),
        speed_(std::hypot(x[3], x[4], x[5])),
        radial_(x[0] * x[3] + x[1] * x[4] + x[2] * x[5]) {
    const double hx = x[1] * x[5] - x[2] * x[4], hy = x[2] * x[3] - x[0] * x[5],
                 hz = x[0] * x[4] - x[1] * x[3];
    momentum_ = std::hypot(hx, hy, hz);
    inclination_ = std::atan2(std::hypot(hx, hy), hz);
    const double parameter = momentum_ * momentum_;
    // e cos(ta) and e sin(ta) lose no digits on orbits that are nearly circular.
    eccentricity_ = std::hypot(parameter / start_ - 1, momentum_ * radial_ / start_);
    inverse_a_ = 2 / start_ - speed_ * speed_;
    perigee_ = parameter / (1 + eccentricity_);
  }

  double start() const { return start_; }
  double speed() const { return speed_; }
  double eccentricity() const { return eccentricity_; }
  double inclination() const { return inclination_; }
  double perigee() const { return perigee_; }
  bool is_ellipse() const { return inverse_a_ > 0 && momentum_ > 0; }
  double apogee() const { return 2 / inverse_a_ - perigee_; }
  double period() const { return 2 * pi * std::pow(inverse_a_, -1.5); }
  double speed_at_apsis(double distance) const { return momentum_ / distance; }

  /// The smallest distance on the way from the start for a time of either sign.
  double lowest(double time) const {
    if (momentum_ == 0) return 0;  // on a line, whatever falls comes to the centre
    const double rate = std::pow(std::abs(inverse_a_), 1.5), e = eccentricity_;
    const double sine = radial_ * std::sqrt(std::abs(inverse_a_)),
                 cosine = 1 - start_ * inverse_a_;  // e times those of the eccentric anomaly
    if (is_ellipse()) {
      const double first = std::atan2(sine, cosine) - sine, last = first + time * rate;
      const double turns = std::floor(std::max(first, last) / (2 * pi));
      if (2 * pi * turns >= std::min(first, last)) return perigee_;
      const double anomaly =
          root([&](double E) { return E - e * std::sin(E) - last; }, last - 1, last + 1);
      return std::min(start_, (1 - e * std::cos(anomaly)) / inverse_a_);
    }
    // On a parabola, whose time equation is not solved here, whatever comes down counts as passing
    // the perigee.
    if (!(e > 1) || inverse_a_ == 0) return radial_ * time >= 0 ? start_ : perigee_;
    const double first = sine - std::asinh(sine / e), last = first + time * rate;
    if (first * last <= 0) return perigee_;
    const double most =
        std::asinh(std::abs(last) / (e - 1));  // because e sinh F - F > (e - 1) sinh F
    const double anomaly =
        root([&](double F) { return e * std::sinh(F) - F - std::abs(last); }, 0, most);
    return std::min(start_, (1 - e * std::cosh(anomaly)) / inverse_a_);
  }

 private:
  /// The root of a growing function between the two, by halving: it is found on every orbit.
  template <class Function>
  static double root(const Function& function, double low, double high) {
    for (int i = 0; i < 100; ++i) {
      const double middle = (low + high) / 2;
      (function(middle) < 0 ? low : high) = middle;
    }
    return (low + high) / 2;
  }

  double start_;
  double speed_;
  double radial_;  ///< position times velocity
  double momentum_ = 0;
  double inclination_ = 0;
  double eccentricity_ = 0;
  double inverse_a_ = 0;
  double perigee_ = 0;
};

/// A period as people say it: in minutes, hours or days.
std::string period_text(double seconds) {
  constexpr double minute = 60, hour = 3600, day = 86400;
  if (seconds < 3 * hour) return fmt::format("{:.2f} min", seconds / minute);
  if (seconds < 3 * day) return fmt::format("{:.3f} h", seconds / hour);
  return fmt::format("{:.3f} days", seconds / day);
}

double second_zonal_of(const SystemSettings& system) {
  if (system.earth) return -std::sqrt(5.0) * system.earth->field->C(2, 0);
  return system.model == SystemModel::zonal_gravity ? system.J[2] : 0;
}

void add_mean_elements(const Scene& scene, OrbitSummary& summary) {
  const double speed_km_s = scene.units.length_km / scene.units.time_s;
  CartesianState start;
  for (std::size_t i = 0; i < 3; ++i) {
    start.position_km[i] = Extended(scene.nominal[i]) * scene.units.length_km;
    start.velocity_km_s[i] = Extended(scene.nominal[3 + i]) * speed_km_s;
  }
  const SystemSettings& system = scene.system;
  const double J2 = system.J[2];
  try {
    const OsculatingElements mean = elements_from_state(
        mean_of_osculating(start, {system.mu_km3_s2, system.radius_km, J2}), system.mu_km3_s2);
    const double a = convert<double>(mean.semi_major_axis_km);
    const double e = convert<double>(mean.eccentricity);
    summary.mean_elements = mean;
    summary.mean_anomaly_deg =
        convert<double>(mean_anomaly_of_true_deg(mean.true_anomaly_deg, mean.eccentricity));
    summary.mean_truncation =
        std::pow(1.5 * J2 * std::pow(system.radius_km / (a * (1 - e * e)), 2), 2);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
  }
}

std::string mean_elements_text(const OrbitSummary& orbit) {
  const OsculatingElements& mean = *orbit.mean_elements;
  return fmt::format(
      "  mean orbit   a {:.4f} km, e {:.7f}, i {:.5f} deg, node {:.5f} deg,\n"
      "               perigee {:.4f} deg, mean anomaly {:.4f} deg (Brouwer's first order in J2, "
      "which leaves out some {:.0e} of them)\n",
      convert<double>(mean.semi_major_axis_km), convert<double>(mean.eccentricity),
      convert<double>(mean.inclination_deg), convert<double>(mean.ascending_node_deg),
      convert<double>(mean.argument_of_perigee_deg), orbit.mean_anomaly_deg, orbit.mean_truncation);
}

}  // namespace

std::optional<OrbitSummary> orbit_summary(const Scene& scene) {
  if (!is_orbit(scene.system.model)) return std::nullopt;
  const KeplerOrbit orbit(scene.nominal);
  const CanonicalUnits& units = scene.units;
  const auto point = [&](double distance, double speed) {
    return OrbitPoint{distance * units.length_km, speed * units.length_km / units.time_s};
  };
  const auto apsis = [&](double distance) {
    return point(distance, orbit.speed_at_apsis(distance));
  };
  OrbitSummary summary;
  summary.start = point(orbit.start(), orbit.speed());
  summary.perigee = apsis(orbit.perigee());
  summary.eccentricity = orbit.eccentricity();
  summary.inclination_deg = orbit.inclination() * 180 / pi;
  if (orbit.is_ellipse()) {
    summary.apogee = apsis(orbit.apogee());
    summary.period_s = orbit.period() * units.time_s;
    summary.revolutions = std::abs(scene.duration) / orbit.period();
  }
  summary.lowest_km = orbit.lowest(scene.duration) * units.length_km;
  const double J2 = second_zonal_of(scene.system);
  if (J2 != 0) {
    const double radius_km = scene.system.radius_km;
    const double size_km =
        (orbit.is_ellipse() ? orbit.perigee() + orbit.apogee() : 2 * orbit.perigee()) / 2 *
        units.length_km;
    summary.perturbation_km = std::abs(J2) * radius_km * radius_km / size_km;
    if (!scene.system.earth) add_mean_elements(scene, summary);
  }
  if (scene.system.radius_km > 0) {
    summary.surface_km = scene.system.radius_km;
  } else if (const CelestialBody* const body = body_with_mu(scene.system.mu_km3_s2)) {
    summary.surface_km = body->equator_radius_km;
  }
  return summary;
}

std::string orbit_text(const OrbitSummary& orbit) {
  const auto height = [&](double distance_km) {
    if (!orbit.surface_km) return std::string();
    const double height_km = distance_km - *orbit.surface_km;
    return fmt::format(", {:.2f} km {} the surface", std::abs(height_km),
                       height_km < 0 ? "below" : "above");
  };
  const auto line = [&](std::string_view name, const OrbitPoint& point) {
    return fmt::format("  {:<12} {:.2f} km from the centre{}; {:.4f} km/s\n", name,
                       point.distance_km, height(point.distance_km), point.speed_km_s);
  };
  std::string text = "  orbit        ";
  if (orbit.period_s) {
    text += fmt::format("period {:.2f} s ({}), {} in the duration", *orbit.period_s,
                        period_text(*orbit.period_s),
                        counted(fmt::format("{:.6g}", *orbit.revolutions), "revolution"));
  } else {
    text += "open, without a period";
  }
  text += fmt::format("\n               eccentricity {:.6f}, inclination {:.4f} deg\n",
                      orbit.eccentricity, orbit.inclination_deg);
  if (orbit.mean_elements) text += mean_elements_text(orbit);
  text += line("start", orbit.start) + line("perigee", orbit.perigee);
  if (orbit.apogee) text += line("apogee", *orbit.apogee);
  text += "  lowest       ";
  if (!orbit.surface_km) {
    text += fmt::format("{:.2f} km from the centre within the duration", orbit.lowest_km);
  } else if (orbit.is_below_surface()) {
    text += fmt::format("goes below the surface within the duration, to {:.2f} km under it",
                        *orbit.surface_km - orbit.lowest_km);
  } else {
    text += fmt::format("stays above the surface within the duration, by {:.2f} km",
                        orbit.lowest_km - *orbit.surface_km);
  }
  if (orbit.perturbation_km) {
    text += fmt::format(
        " on the Kepler orbit of the start; J2 moves heights by several times J2 R^2/a = {:.2g} "
        "km, "
        "which only a run follows",
        *orbit.perturbation_km);
  }
  return text + "\n";
}

}  // namespace hamjet::io
