#include "hamjet/studies/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/error.hpp"

namespace hamjet {

double rounding_of(Precision precision) {
  return precision == Precision::double_precision
             ? std::numeric_limits<double>::epsilon()
             : static_cast<double>(std::numeric_limits<Extended>::epsilon());
}

const CanonicalUnits& told_units(const Scene& scene) {
  return scene.told_units ? *scene.told_units : scene.units;
}

CanonicalFactors told_factors(const Scene& scene) {
  const CanonicalUnits& told = told_units(scene);
  CanonicalFactors factors;
  factors.length = scene.units.length_km / told.length_km;
  factors.time = scene.units.time_s / told.time_s;
  factors.momentum = factors.length / factors.time;
  return factors;
}

double told_time(const Scene& scene, double time) { return time * told_factors(scene).time; }

std::vector<double> told_state(const Scene& scene, std::vector<double> state) {
  const CanonicalFactors factors = told_factors(scene);
  // Parameters behind positions and momenta have their own units.
  const std::size_t n = degrees_of_freedom_of(scene.system);
  for (std::size_t i = 0; i < std::min(2 * n, state.size()); ++i) {
    state[i] *= i < n ? factors.length : factors.momentum;
  }
  return state;
}

Scene make_scene(DynamicalSystem system, std::vector<double> nominal, double duration, int order,
                 const CanonicalUnits& units) {
  constexpr std::size_t most =
      8;  // largest number of degrees of freedom for which variable_names has names
  const std::size_t n = system.degrees_of_freedom;
  if (n < 1 || n > most || nominal.size() != 2 * n) {
    throw Error(ErrorKind::usage,
                fmt::format("scene of an own system: {} degrees of freedom and a nominal of {} "
                            "numbers, must be 1 to {} and twice as many numbers",
                            n, nominal.size(), most));
  }
  const auto is_finite = [](double x) { return std::isfinite(x); };
  const bool has_numbers =
      std::all_of(nominal.begin(), nominal.end(), is_finite) && is_finite(duration);
  const bool has_units = units.length_km > 0 && units.time_s > 0 && is_finite(units.length_km) &&
                         is_finite(units.time_s);
  if (order < 1 || !has_numbers || !has_units) {
    throw Error(ErrorKind::usage,
                fmt::format("scene of an own system: order {}, units {} km and {} s, must be an "
                            "order of at least 1, positive units, and a finite nominal and "
                            "duration",
                            order, units.length_km, units.time_s));
  }
  Scene scene;
  scene.name = system.name;
  for (char& c : scene.name) {
    const bool is_usual = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
    if (!is_usual) c = '_';
  }
  scene.title = system.name;
  scene.system.model = SystemModel::own;
  scene.system.own_degrees_of_freedom = n;
  scene.units = units;
  scene.nominal = std::move(nominal);
  scene.duration = duration;
  scene.order = order;
  scene.variables.resize(2 * n);
  std::iota(scene.variables.begin(), scene.variables.end(), std::size_t{0});
  scene.own_system = std::make_shared<const DynamicalSystem>(std::move(system));
  return scene;
}

}  // namespace hamjet
