#include "decay.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "../../algebra/scalar_search.hpp"
#include "../../algebra/state_sums.hpp"
#include "../../dynamics/fields/density_profile.hpp"
#include "../../dynamics/fields/reference_ellipsoid.hpp"
#include "../earth_system.hpp"
#include "../flights/flight_arcs.hpp"
#include "../formation/companion_flow.hpp"
#include "../formation/formation_problem.hpp"
#include "hamjet/detail/algebra/pack.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

constexpr double lowest_orbit_km = 100;

double density_at(const DensityProfile& profile, double height_km) {
  Pack<double, 1> density;
  profile.expand(Pack<double, 1>(height_km), 0, &density);
  return density.lane(0);
}

/// The height over the ellipsoid's radius at the latitude of the place, right to some 50 m.
double height_km(const Scene& scene, const std::vector<double>& state) {
  const ReferenceEllipsoid ellipsoid;
  const Eigen::Vector3d place(state.data());
  const double distance = place.norm();
  const double sine = place[2] / distance;
  return distance * scene.units.length_km -
         ellipsoid.equatorial_radius_km * (1 - ellipsoid.flattening * sine * sine);
}

/// Ends a flight from within.
struct Below {
  double time = 0;
};

class DecayFlight {
 public:
  explicit DecayFlight(const Scene& scene)
      : scene_(scene),
        together_(scene),
        last_(scene.system.earth->last_s / scene.units.time_s),
        limit_km_(std::max(
            lowest_orbit_km,
            greatest_density(*scene.system.earth->atmosphere).table().heights_km.front())) {}

  std::optional<Decay> find(std::string_view name, const std::vector<double>& state,
                            double drag_m2_kg, const std::vector<double>& whole) const {
    if (is_safe(state, drag_m2_kg)) return std::nullopt;
    const auto decayed = [&](double time) {
      return Decay{name, time * scene_.units.time_s, limit_km_};
    };
    if (height_km(scene_, state) < limit_km_) return decayed(0);
    double flown = 0;
    try {
      fly_arcs(together_.system(), {whole}, scene_.start_time, last_, [&](const FlightArc& arc) {
        look(arc);
        flown = arc.time_at(1);
      });
    } catch (const Below& below) {
      return decayed(below.time);
    } catch (const Error& error) {
      // Within one step the air becomes so dense that nothing can be flown.
      if (error.kind() != ErrorKind::numerical) throw;
      return decayed(flown);
    }
    return std::nullopt;
  }
  const FlownTogether& together() const { return together_; }

 private:
  /// The height above the limit.
  double margin_km(const FlightArc& arc, double share) const {
    return height_km(scene_, arc.state(0, share)) - limit_km_;
  }

  void look(const FlightArc& arc) const {
    constexpr int parts = 8;
    for (int k = 1; k <= parts; ++k) {
      const double below = static_cast<double>(k) / parts;
      const double margin = margin_km(arc, below);
      if (!(margin < 0)) continue;
      const double above = below - 1.0 / parts;
      constexpr int bits = 40;
      throw Below{arc.time_at(root_between(
          "decay", [&](double share) { return margin_km(arc, share); },
          {above, margin_km(arc, above)}, {below, margin}, bits))};
    }
  }

  bool is_safe(const std::vector<double>& state, double drag_m2_kg) const {
    constexpr double margin_km = 25;  // a margin of the perigee's height, for what the field moves
    constexpr double safe_fall_km = 5;
    const auto perigee = perigee_height_km(scene_, state);
    if (!perigee || !(*perigee - margin_km > limit_km_ + margin_km)) return false;
    const AtmosphereSettings& air = *scene_.system.earth->atmosphere;
    const double density =
        air.density_factor * density_at(greatest_density(air), *perigee - margin_km);
    // On a circle da/dt = -B rho sqrt(mu a).
    const double radius_m = 1000 * (scene_.system.radius_km + *perigee);
    const double fall_m_s =
        drag_m2_kg * density * std::sqrt(1e9 * scene_.system.mu_km3_s2 * radius_m);
    return fall_m_s * scene_.system.earth->last_s < 1000 * safe_fall_km;
  }

  const Scene& scene_;
  FlownTogether together_;
  double last_;  ///< canonical
  double limit_km_;
};

}  // namespace

std::optional<double> perigee_height_km(const Scene& scene, const std::vector<double>& state) {
  if (!scene.system.earth) return std::nullopt;
  const Eigen::Vector3d q(state.data()), p(state.data() + 3);
  const double inverse_axis = 2 / q.norm() - p.squaredNorm();
  if (!(inverse_axis > 0)) return std::nullopt;
  const double square = 1 - inverse_axis * q.cross(p).squaredNorm();
  const double perigee = (1 - std::sqrt(std::max(0.0, square))) / inverse_axis;
  return perigee * scene.units.length_km - ReferenceEllipsoid().equatorial_radius_km;
}

std::vector<Decay> find_decays(const Scene& scene) {
  if (!scene.system.earth || !scene.system.earth->atmosphere || !(scene.system.earth->last_s > 0)) {
    return {};
  }
  const EarthSettings& earth = *scene.system.earth;
  const DecayFlight flight(scene);
  std::vector<Decay> found;
  const std::vector<double> chief(scene.nominal.begin(), scene.nominal.begin() + 6);
  const auto add = [&](std::string_view name, const std::vector<double>& state, double drag,
                       const std::vector<double>& whole) {
    if (const auto one = flight.find(name, state, drag, whole)) found.push_back(*one);
  };
  add("chief", chief, earth.drag_m2_kg, flight.together().of_chief(chief));
  if (!scene.deputy) return found;
  std::vector<double> deviation = deputy_deviation(scene);
  deviation.resize(6);
  const std::vector<double> deputy = state_sum(chief, deviation);
  add("deputy", deputy, scene.deputy->drag_m2_kg.value_or(earth.drag_m2_kg),
      flight.together().of_deputy(deputy));
  return found;
}

}  // namespace hamjet
