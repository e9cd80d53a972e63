#include "stored_chief.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "../algebra/other_units.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet::cli {
namespace {

bool are_same(const CanonicalUnits& a, const CanonicalUnits& b) {
  return a.length_km == b.length_km && a.time_s == b.time_s;
}

/// Of two states the numbers to be compared: all, or positions and momenta alone where one of them
/// lacks parameters behind them, which a scene need not name to have the orbit of a jet.
std::ptrdiff_t common(const std::vector<double>& a, const std::vector<double>& b,
                      std::size_t state) {
  return static_cast<std::ptrdiff_t>(a.size() == b.size() ? a.size() : state);
}

/// Whether positions and momenta are the same but for the roundings of two units.
bool are_nearly_same(const std::vector<double>& a, const std::vector<double>& b,
                     std::size_t degrees_of_freedom) {
  constexpr double roundings = 8 * std::numeric_limits<double>::epsilon();
  const std::size_t n = degrees_of_freedom;
  const auto behind = static_cast<std::ptrdiff_t>(2 * n);
  if (!std::equal(a.begin() + behind, a.begin() + common(a, b, 2 * n), b.begin() + behind)) {
    return false;
  }
  for (const std::size_t first : {std::size_t{0}, n}) {
    double size = 0;
    double apart = 0;
    for (std::size_t i = first; i < first + n; ++i) {
      size = std::max(size, std::abs(a[i]));
      apart = std::max(apart, std::abs(a[i] - b[i]));
    }
    if (!(apart <= roundings * size)) return false;
  }
  return true;
}

/// Whether a jet starts when the scene does, where that matters.
bool starts_as(const io::StoredJet& stored, const Scene& scene) {
  if (stored.is_autonomous && make_system(scene).is_autonomous()) return true;
  constexpr double rounding = 1e-14;
  const double start_s = stored.start_time.in<double>() * stored.units.time_s;
  const double scene_start_s = scene.start_time.in<double>() * scene.units.time_s;
  return std::abs(start_s - scene_start_s) <= rounding * std::abs(start_s);
}

}  // namespace

bool is_about_chief(const io::StoredJet& stored, const Scene& scene) {
  if (stored.model != scene.system.model || !are_same(stored.units, told_units(scene))) {
    return false;
  }
  if (!starts_as(stored, scene)) return false;
  if (are_same(stored.units, scene.units)) {
    const std::size_t state = 2 * stored.degrees_of_freedom();
    return std::equal(
        stored.nominal_initial.begin(),
        stored.nominal_initial.begin() + common(stored.nominal_initial, scene.nominal, state),
        scene.nominal.begin());
  }
  return are_nearly_same(told_state(scene, scene.nominal), stored.nominal_initial,
                         stored.degrees_of_freedom());
}

double duration_in_units_of(const Scene& scene, const io::StoredJet& stored) {
  return convert<double>(Extended(stored.duration) * stored.units.time_s / scene.units.time_s);
}

FlowJet<double> jet_in_units_of(const Scene& scene, const io::StoredJet& stored) {
  const Extended length = Extended(stored.units.length_km) / scene.units.length_km;
  const Extended momentum = length * scene.units.time_s / stored.units.time_s;
  const std::size_t n = stored.degrees_of_freedom();
  const auto factors = [&](const std::vector<std::size_t>& places) {
    std::vector<Extended> result;
    for (const std::size_t place : places)
      result.push_back(place < n ? length : place < 2 * n ? momentum : Extended(1));
    return result;
  };
  FlowJet<Extended> jet = stored.jet;
  tell_in_other_units<Extended>(jet, factors(stored.components), factors(stored.variables));
  return convert_map<double>(jet);
}

}  // namespace hamjet::cli
