#include "drawn_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace hamjet::attack {
namespace {

constexpr double earth_radius_km = 6378.1363;
constexpr double pi = std::numbers::pi;

void draw_zonals(RandomNumbers& random, Model& model) {
  const std::array<double, 21>& all = shipped_zonals();
  const int choice = random.integer(0, 5);
  if (choice == 0) return;
  model.radius = earth_radius_km;
  const int highest = choice == 1 ? 2 : choice == 2 ? 3 : choice == 3 ? 6 : 20;
  for (std::size_t n = 2; n <= static_cast<std::size_t>(highest); ++n) {
    if (choice < 5 || random.chance(0.4)) model.zonal[n] = all[n];
  }
}

int highest_zonal(const Model& model) {
  int highest = 20;
  while (highest > 0 && model.zonal[static_cast<std::size_t>(highest)] == 0) --highest;
  return highest;
}

double draw_angle(RandomNumbers& random, double largest) {
  return random.chance(0.1) ? 90 * random.integer(0, static_cast<int>(largest / 90))
                            : random.uniform(0, largest);
}

/// Position and velocity from a parameter p, an eccentricity and angles in degrees, rounded.
void set_state(DrawnScene& scene, double p, double e, const std::array<double, 4>& degrees) {
  const auto [i, raan, argp, ta] = degrees;
  const double u = (argp + ta) * pi / 180, w = argp * pi / 180;
  const double ci = std::cos(i * pi / 180), si = std::sin(i * pi / 180);
  const double co = std::cos(raan * pi / 180), so = std::sin(raan * pi / 180);
  const double r = p / (1 + e * std::cos(ta * pi / 180));
  const double v = std::sqrt(scene.mu_km3_s2 / p);
  const auto turned = [&](double x, double y) {
    return std::vector<double>{co * x - so * ci * y, so * x + co * ci * y, si * y};
  };
  scene.position = turned(r * std::cos(u), r * std::sin(u));
  scene.velocity =
      turned(-v * (std::sin(u) + e * std::sin(w)), v * (std::cos(u) + e * std::cos(w)));
}

void draw_orbit(RandomNumbers& random, DrawnScene& scene) {
  draw_zonals(random, scene.model);
  const int highest = highest_zonal(scene.model);
  const double kind = random.uniform(0, 1);
  double e = kind < 0.75   ? random.uniform(0, 0.95)
             : kind < 0.85 ? random.log_uniform(1e-6, 0.1)
             : kind < 0.93 ? 1 - random.log_uniform(5e-4, 0.05)
                           : random.uniform(1.05, 4);
  const bool is_open = e > 1;
  double a = random.log_uniform(6600, 70000);
  // Below the surface of the highest zonal's field the field is not the Earth's; the field of the
  // lowest zonals is smooth enough there.
  const double lowest = highest > 4 ? 6450 : highest > 0 ? 3000 : 0;
  if (is_open) {
    a = random.log_uniform(6600, 70000);  // distance of the perigee
  } else if (a * (1 - e) < lowest) {
    a = std::min(70000.0, lowest / (1 - e));
    e = std::min(e, 1 - lowest / a);
  }
  scene.eccentricity = e;
  scene.checks_surface =
      highest > 0 && (is_open || a * (1 - e) > 1.01 * earth_radius_km) && random.chance(0.5);
  const double i = draw_angle(random, 180), raan = draw_angle(random, 360),
               argp = draw_angle(random, 360);
  double ta = draw_angle(random, 360);
  double period = 0;
  if (is_open) {
    ta = random.uniform(-0.85, 0.85) * std::acos(-1 / e) * 180 / pi;
    set_state(scene, a * (1 + e), e, {i, raan, argp, ta});
    period = 2 * pi * std::sqrt(a * a * a / scene.mu_km3_s2);
  } else {
    if (random.chance(0.6)) {
      scene.elements = {a, e, i, raan, argp, ta};
    } else {
      set_state(scene, a * (1 - e * e), e, {i, raan, argp, ta});
    }
    period = 2 * pi * std::sqrt(a * a * a / scene.mu_km3_s2);
  }
  scene.revolutions = is_open ? random.log_uniform(0.05, 5) : random.log_uniform(0.05, 30);
  scene.duration_s = scene.revolutions * period;
  if (random.chance(0.5)) scene.length_km = random.log_uniform(1e-3, 1.5e8);
}

/// A number of either sign, near rest or not.
double draw_near_rest(RandomNumbers& random, double largest) {
  const double size = random.chance(0.5) ? random.uniform(0, 1) : random.log_uniform(1e-9, 1);
  return random.chance(0.05) ? 0 : (random.chance(0.5) ? 1 : -1) * size * largest;
}

void draw_mechanics(RandomNumbers& random, DrawnScene& scene) {
  Model& model = scene.model;
  scene.is_orbit = false;
  model.kind = static_cast<ModelKind>(random.integer(1, 5));
  model.degrees_of_freedom = 1;
  double frequency = 1, q_size = 1;
  if (model.kind == ModelKind::harmonic_oscillator || model.kind == ModelKind::oscillator_pair) {
    model.mass = random.log_uniform(0.01, 100);
    model.stiffness = random.log_uniform(0.01, 1e4);
    frequency = std::sqrt(model.stiffness / model.mass);
  }
  if (model.kind == ModelKind::oscillator_pair) {
    model.degrees_of_freedom = 2;
    model.second_stiffness = model.stiffness * random.log_uniform(1e-3, 1);
  }
  if (model.kind == ModelKind::spring_pendulum) {
    model.degrees_of_freedom = 2;
    model.mass = random.log_uniform(0.1, 10);
    model.length = random.log_uniform(0.1, 10);
    model.gravity = random.chance(0.2) ? 0 : random.uniform(1, 20);
    model.stiffness =
        model.mass * random.log_uniform(1, 300) * std::max(model.gravity, 1.0) / model.length;
    frequency = std::sqrt(model.stiffness / model.mass);
  }
  if (model.kind == ModelKind::fermi_pasta_ulam) {
    const int pairs = random.integer(1, 3);
    model.degrees_of_freedom = 2 * static_cast<std::size_t>(pairs);
    model.omega = random.log_uniform(1, 50);
    frequency = model.omega;
  }
  const double scale = random.chance(0.5) ? 1 : random.log_uniform(1e-9, 1);
  for (std::size_t i = 0; i < model.degrees_of_freedom; ++i) {
    scene.position.push_back(scale * draw_near_rest(random, q_size));
    scene.velocity.push_back(scale * draw_near_rest(random, q_size * frequency * model.mass));
  }
  if (model.kind == ModelKind::spring_pendulum) {
    // The pendulum hangs, deflected by at most a radian, and its length differs from its rest
    // length as drawn.
    const double rest = model.length + model.mass * model.gravity / model.stiffness;
    const double angle = scene.position[0], stretch = 1 + 0.2 * scene.position[1];
    scene.position = {rest * stretch * std::sin(angle), -rest * stretch * std::cos(angle)};
    for (double& p : scene.velocity) p *= 0.2 * model.length;
  }
  scene.revolutions = random.log_uniform(0.05, 30);
  scene.duration_s = 2 * pi * scene.revolutions / frequency;
  // At the top of the barrier the rate is 1: a deviation grows by the factor e in each unit of
  // time.
  if (model.kind == ModelKind::double_well) scene.duration_s = random.log_uniform(0.1, 15);
}

void draw_method(RandomNumbers& random, DrawnScene& scene) {
  const double steps_each = random.log_uniform(15, 1500);
  scene.step_s = std::abs(scene.duration_s) / std::max(1.0, scene.revolutions * steps_each);
  const double choice = random.uniform(0, 1);
  if (choice < 0.6) {
    scene.stages = random.chance(0.4) ? 8 : random.integer(2, 12);
    // A method of few stages cannot reach a tolerance near rounding.
    const double least = scene.stages >= 6 ? 1e-14 : scene.stages >= 4 ? 1e-11 : 1e-6;
    scene.tolerance =
        random.chance(0.4) && scene.stages >= 6 ? 1e-13 : random.log_uniform(least, 1e-5);
  } else if (choice < 0.7) {
    scene.stages = random.integer(1, 12);
  } else if (choice < 0.78) {
    scene.method = "velocity-verlet";
    scene.verlet_order = 2 * random.integer(1, 4);
  } else if (choice < 0.82) {
    scene.method = "stormer";
  } else if (choice < 0.87) {
    scene.method = "newmark";
    scene.beta = random.chance(0.5) ? 0.25 : random.uniform(0, 0.5);
  } else if (choice < 0.93) {
    scene.method = "fehlberg78";
    if (random.chance(0.7)) scene.tolerance = random.log_uniform(1e-14, 1e-4);
  } else {
    scene.method = random.chance(0.5) ? "cvode-adams" : "cvode-bdf";
    scene.tolerance = random.log_uniform(1e-11, 1e-4);
  }
  if (scene.method == "gauss") scene.compensated_summation = !random.chance(0.1);
  const bool can_be_split =
      scene.method == "gauss" || scene.method == "velocity-verlet" || scene.method == "stormer";
  if (can_be_split && random.chance(0.5))
    scene.arcs = random.chance(0.3) ? 0 : random.integer(2, 8);
}

void draw_jet(RandomNumbers& random, DrawnScene& scene) {
  scene.order = random.integer(1, 6);
  const std::size_t variables = scene.dimension();
  if (variables > 6) scene.order = std::min(scene.order, variables > 8 ? 2 : 3);
  if (random.chance(0.2)) {
    for (std::size_t i = 0; i < variables; ++i) {
      if (random.chance(0.5)) scene.variables.push_back(i);
    }
  }
  if (random.chance(0.25)) scene.duration_s = -scene.duration_s;
}

}  // namespace

RandomNumbers::RandomNumbers(std::uint64_t seed, std::uint64_t scene) {
  std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                         static_cast<std::uint32_t>(scene),
                         static_cast<std::uint32_t>(scene >> 32)};
  generator_.seed(sequence);
}

double RandomNumbers::uniform(double low, double high) {
  return low + (high - low) * (static_cast<double>(generator_() >> 11) * 0x1p-53);
}

double RandomNumbers::log_uniform(double low, double high) {
  return std::exp(uniform(std::log(low), std::log(high)));
}

int RandomNumbers::integer(int low, int high) {
  return low + static_cast<int>(generator_() % static_cast<std::uint64_t>(high - low + 1));
}

DrawnScene draw_scene(std::uint64_t seed, std::uint64_t number) {
  RandomNumbers random(seed, number);
  DrawnScene scene;
  scene.seed = seed;
  scene.number = number;
  if (random.chance(0.75)) {
    draw_orbit(random, scene);
  } else {
    draw_mechanics(random, scene);
  }
  draw_method(random, scene);
  draw_jet(random, scene);
  if (random.chance(0.04) && scene.method.rfind("cvode", 0) != 0) {
    scene.precision = "extended";
    scene.order = std::min(scene.order, 3);
    const double shorter = std::min(1.0, 2 / scene.revolutions);
    scene.revolutions *= shorter;
    scene.duration_s *= shorter;
    if (scene.tolerance && scene.stages >= 8) *scene.tolerance *= 1e-6;
  }
  return scene;
}

const std::array<double, 21>& shipped_zonals() {
  static const std::array<double, 21> zonals = [] {
    std::array<double, 21> result{};
    std::ifstream file(HAMJET_SOURCE_DIR "/data/gravity/EGM96-zonals.gfc");
    for (std::string line; std::getline(file, line);) {
      std::istringstream words(line);
      std::string key;
      std::size_t n = 0, m = 0;
      double c = 0;
      if (words >> key >> n >> m >> c && key == "gfc" && m == 0 && n >= 2 && n <= 20) {
        result[n] = -std::sqrt(2.0 * static_cast<double>(n) + 1) * c;
      }
    }
    if (result[20] == 0) throw std::runtime_error("the shipped gravity field cannot be read");
    return result;
  }();
  return zonals;
}

}  // namespace hamjet::attack
