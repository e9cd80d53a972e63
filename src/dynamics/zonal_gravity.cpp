#include "hamjet/dynamics/zonal_gravity.hpp"

namespace hamjet {

DynamicalSystem zonal_gravity(const ZonalGravity& field) {
  return make_system("zonal-gravity", 3, ZonalGravityHamiltonian{field}, ZonalGravityForce{field});
}

DynamicalSystem kepler(double mu) {
  DynamicalSystem system = zonal_gravity({.mu = mu});
  system.name = "kepler";
  return system;
}

}  // namespace hamjet
