#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "../dynamics/celestial_bodies.hpp"
#include "../text/quantity_text.hpp"
#include "../text/scene_message.hpp"
#include "scene_sections.hpp"
#include "starts/scene_elements.hpp"

namespace hamjet::io {
namespace {

/// A start, or a semi-major axis, that is farther than this from the centre, in radii, is beyond
/// the reach of its gravity (Jupiter's sphere of influence is 743 of its radii, the Earth's 235). A
/// start in km that was meant in metres is above it too: 1000 radii, less the flattening.
constexpr double farthest_start = 950;

/// No body about which orbits are flown is as prolate: J2 of planets and moons is positive.
constexpr double least_J2 = -1e-5;

/// Saturn is the most oblate of these bodies, with a J2 of 0.0163.
constexpr double greatest_J2 = 0.02;

/// A speed in m/s is a thousand times the number in km/s, and on an orbit at least 707 times the
/// speed of escape. No comet passes the Sun at a tenth of the speed allowed here.
constexpr double greatest_speed_of_escape = 100;

/// If the gravitational parameter differs by more than this fraction from that of the body whose
/// radius is given, it is not just another model of that body.
constexpr double other_mu = 0.1;

/// The reference radius of the J_n is that of the equator, up to this difference between models.
constexpr double radius_tolerance = 0.05;

const CelestialBody* body_with_radius(double radius_km) {
  const auto bodies = celestial_bodies();
  const auto found = std::find_if(bodies.begin(), bodies.end(), [&](const CelestialBody& body) {
    return std::abs(radius_km / body.equator_radius_km - 1) <= radius_tolerance;
  });
  return found != bodies.end() ? &*found : nullptr;
}

class LikelySlips {
 public:
  LikelySlips(const TableReader& root, const Scene& scene)
      : root_(root),
        system_(root.table("system")),
        nominal_(root.table("nominal")),
        scene_(scene) {}

  std::vector<std::string> find() {
    if (!is_orbit(scene_.system.model)) return {};
    const double mu = scene_.system.mu_km3_s2;
    body_ = body_with_mu(mu);
    if (body_ == nullptr) {
      body_ = body_with_mu(1e-9 * mu);
      if (body_ != nullptr) {
        add(system_, "mu_km3_s2",
            fmt::format("{:g} is the mu of {} in m^3/s^2; in km^3/s^2 it is {:.10g}", mu,
                        body_->name, 1e-9 * mu));
      }
    }
    check_radius();
    check_mu_beside_radius();
    check_J2();
    check_distance();
    check_speed();
    check_centre();
    check_origin();
    return std::move(found_);
  }

 private:
  void add(const TableReader& table, std::string_view key, const std::string& what) {
    found_.push_back(fmt::format("{}{}: {}", warning_head, table.head(key), what));
  }

  void check_radius() {
    const double radius = scene_.system.radius_km;
    if (radius == 0 || !system_.has("radius_km")) return;
    const auto is_of = [&](const CelestialBody* body, double length_km) {
      return body != nullptr &&
             std::abs(length_km / body->equator_radius_km - 1) <= radius_tolerance;
    };
    if (is_of(body_, radius)) return;
    const CelestialBody* const in_metres =
        body_ != nullptr ? body_ : body_with_radius(1e-3 * radius);
    if (is_of(in_metres, 1e-3 * radius)) {
      add(system_, "radius_km",
          fmt::format("{:.10g} is the radius of {} in metres; in kilometres it is {:.10g}", radius,
                      in_metres->name, 1e-3 * radius));
    } else if (body_ != nullptr) {
      add(system_, "radius_km",
          fmt::format("{:.10g} beside the mu of {}, whose equator has a radius of {:g} km", radius,
                      body_->name, body_->equator_radius_km));
    }
  }

  /// Warns if the radius is that of a known body and mu is that of none.
  void check_mu_beside_radius() {
    if (body_ != nullptr || !system_.has("radius_km") || !system_.has("mu_km3_s2")) return;
    const CelestialBody* const body = body_with_radius(scene_.system.radius_km);
    const double mu = scene_.system.mu_km3_s2;
    if (body == nullptr || std::abs(mu / body->mu_km3_s2 - 1) <= other_mu) return;
    add(system_, "mu_km3_s2",
        fmt::format("{:.10g} beside the radius of {}, whose mu is {:.10g}", mu, body->name,
                    body->mu_km3_s2));
  }

  void check_J2() {
    const double J2 = scene_.system.J[2];
    if (!system_.has("J2")) return;
    if (J2 < least_J2) {
      add(system_, "J2",
          fmt::format("{:g} is that of a body longer along its axis; J2 = -C20 of a flattened one "
                      "is positive: {:g}",
                      J2, -J2));
    } else if (body_ != nullptr && J2 > greatest_J2) {
      add(system_, "J2",
          fmt::format("{:g} is more than that of every planet: Saturn's is 0.0163, the Earth's "
                      "0.00108263",
                      J2));
    }
  }

  /// The key that gives the start of the nominal, or the size of its orbit.
  std::string_view start_key() const {
    static const auto keys = joined<std::string_view>({size_keys(), {"position_km", "oem_file"}});
    const auto found = std::find_if(keys.begin(), keys.end(),
                                    [&](std::string_view key) { return nominal_.has(key); });
    return found != keys.end() ? *found : "opm_file";
  }

  /// The number of the key itself, if it is a length; a period does not show a mistaken unit.
  std::optional<double> start_length_km(std::string_view key) const {
    const std::vector<double>& q = scene_.nominal;
    const bool is_length = key.ends_with("_km") && key != "position_km";
    if (is_length) return nominal_.number(key);
    if (key == "period_s") return std::nullopt;
    return scene_.units.length_km * std::hypot(q[0], q[1], q[2]);
  }

  void check_distance() {
    const double radius = body_ != nullptr ? body_->equator_radius_km : scene_.system.radius_km;
    const bool is_sun =
        body_ != nullptr && body_->name == "SUN";  // planets are farther away than this
    if (radius == 0) return;
    const std::string_view key = start_key();
    const auto length = start_length_km(key);
    if (!length) return;
    const std::string of_body = body_ != nullptr ? fmt::format(" of {}", body_->name) : "";
    if (*length >= farthest_start * radius && !is_sun) {
      add(nominal_, key,
          fmt::format("{} {} are {:.0f} radii{}; if these are metres, it must be {:.6g} km",
                      length_text(1000 * *length, 8),
                      key.ends_with("height_km") ? "above the surface" : "from the centre",
                      *length / radius, of_body, 1e-3 * *length));
    } else if (key == "a_km" && *length < radius) {
      add(nominal_, key,
          fmt::format("{:.6g} km from the centre are below the surface at {:.6g} km{}; if this is "
                      "a height, it must be {:.6g} km",
                      *length, radius, of_body, *length + radius));
    }
  }

  void check_speed() {
    if (!nominal_.has("velocity_km_s")) return;
    const std::vector<double>& x = scene_.nominal;  // canonical units, in which mu is 1
    const double speed = std::hypot(x[3], x[4], x[5]);
    const double escapes = speed / std::sqrt(2 / std::hypot(x[0], x[1], x[2]));
    if (!(escapes >= greatest_speed_of_escape)) return;
    const double speed_km_s = speed * scene_.units.length_km / scene_.units.time_s;
    add(nominal_, "velocity_km_s",
        fmt::format(
            "{:.6g} km/s are {:.0f} times the speed of escape; if these are m/s, it must be "
            "{:.6g} km/s",
            speed_km_s, escapes, 1e-3 * speed_km_s));
  }

  /// The centre that a file names has already been compared with the scene's.
  void check_centre() {
    if (body_ == nullptr || scene_.nominal_file || !root_.has("ephemeris")) return;
    const TableReader ephemeris = root_.table("ephemeris");
    if (!ephemeris.has("center_name")) return;
    const std::string name = ephemeris.text("center_name");
    if (body_named(name) != nullptr) return;
    add(ephemeris, "center_name",
        fmt::format("{} is none of the Sun, the Moon and the planets, and mu is that of {}",
                    in_quotes(name), body_->name));
  }

  /// Notes a small offset of the origin, which the scene does not mention.
  void check_origin() {
    const auto& file = scene_.system.gravity_file;
    if (!file || file->origin_offset_m == 0.0 || system_.has("leave_out_C10")) return;
    add(system_, "gravity_file",
        fmt::format("C(1,0) is left out, which puts the file's centre of mass at z = {:.4g} m; "
                    "that centre is the scene's origin",
                    file->origin_offset_m.value()));
  }

  TableReader root_;
  TableReader system_;
  TableReader nominal_;
  const Scene& scene_;
  const CelestialBody* body_ = nullptr;  ///< body whose mu the scene has, perhaps in other units
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> likely_slips(const TableReader& root, const Scene& scene) {
  return LikelySlips(root, scene).find();
}

}  // namespace hamjet::io
