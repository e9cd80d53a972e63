#include "celestial_bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "../text/letter_case.hpp"

namespace hamjet {
namespace {

constexpr std::array<CelestialBody, 10> bodies = {{{"SUN", 132712440041.279419, 695700},
                                                   {"MERCURY", 22031.868551, 2440.53},
                                                   {"VENUS", 324858.592, 6051.8},
                                                   {"EARTH", 398600.435507, 6378.1366},
                                                   {"MOON", 4902.800118, 1737.4},
                                                   {"MARS", 42828.375816, 3396.19},
                                                   {"JUPITER", 126712764.1, 71492},
                                                   {"SATURN", 37940584.8418, 60268},
                                                   {"URANUS", 5794556.4, 25559},
                                                   {"NEPTUNE", 6836527.10058, 24764}}};

const CelestialBody* find(const auto& is_wanted) {
  const auto* const found = std::find_if(bodies.begin(), bodies.end(), is_wanted);
  return found != bodies.end() ? found : nullptr;
}

}  // namespace

std::span<const CelestialBody> celestial_bodies() { return bodies; }

const CelestialBody* body_named(std::string_view name) {
  constexpr std::string_view barycentre = " BARYCENTER";
  std::string wanted = io::capitals(std::string(name));
  if (wanted.ends_with(barycentre) && !wanted.starts_with("EARTH")) {
    wanted.resize(wanted.size() - barycentre.size());
  }
  return find([&](const CelestialBody& body) { return body.name == wanted; });
}

const CelestialBody* body_with_mu(double mu_km3_s2) {
  return find([&](const CelestialBody& body) {
    return std::abs(mu_km3_s2 / body.mu_km3_s2 - 1) <= body_mu_tolerance;
  });
}

}  // namespace hamjet
