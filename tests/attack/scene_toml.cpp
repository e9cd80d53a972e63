#include <fmt/format.h>
#include <fmt/ranges.h>

#include "drawn_scene.hpp"

namespace hamjet::attack {
namespace {

std::string numbers(const std::vector<double>& values) {
  return fmt::format("[{:.17g}]", fmt::join(values, ", "));
}

std::string system_table(const DrawnScene& scene) {
  const Model& m = scene.model;
  switch (m.kind) {
    case ModelKind::zonal_gravity: {
      if (m.radius == 0) {
        return fmt::format("model = \"kepler\"\nmu_km3_s2 = {:.17g}\n", scene.mu_km3_s2);
      }
      std::string text =
          fmt::format("model = \"zonal-gravity\"\nmu_km3_s2 = {:.17g}\nradius_km = {:.17g}\n",
                      scene.mu_km3_s2, m.radius);
      for (std::size_t n = 2; n <= 20; ++n) {
        if (m.zonal[n] != 0 || scene.has_zeros)
          text += fmt::format("J{} = {:.17g}\n", n, m.zonal[n]);
      }
      return text;
    }
    case ModelKind::harmonic_oscillator:
      return fmt::format(
          "model = \"harmonic-oscillator\"\nmass_kg = {:.17g}\nstiffness_N_per_m = {:.17g}\n",
          m.mass, m.stiffness);
    case ModelKind::double_well:
      return "model = \"double-well\"\n";
    case ModelKind::oscillator_pair:
      return fmt::format(
          "model = \"oscillator-pair\"\nmass_kg = {:.17g}\nstiffness_N_per_m = [{:.17g}, "
          "{:.17g}]\n",
          m.mass, m.stiffness, m.second_stiffness);
    case ModelKind::spring_pendulum:
      return fmt::format(
          "model = \"spring-pendulum\"\nmass_kg = {:.17g}\nstiffness_N_per_m = {:.17g}\nlength_m = "
          "{:.17g}\ngravity_m_s2 = {:.17g}\n",
          m.mass, m.stiffness, m.length, m.gravity);
    case ModelKind::fermi_pasta_ulam:
      return fmt::format("model = \"fermi-pasta-ulam\"\nomega_rad_per_s = {:.17g}\npairs = {}\n",
                         m.omega, m.degrees_of_freedom / 2);
  }
  return {};
}

std::string nominal_table(const DrawnScene& scene) {
  if (scene.elements) {
    const auto& [a, e, i, raan, argp, ta] = *scene.elements;
    return fmt::format(
        "a_km = {:.17g}\ne = {:.17g}\ni_deg = {:.17g}\nraan_deg = {:.17g}\nargp_deg = "
        "{:.17g}\nta_deg = {:.17g}\n",
        a, e, i, raan, argp, ta);
  }
  return fmt::format("{} = {}\n{} = {}\n", scene.is_orbit ? "position_km" : "position_m",
                     numbers(scene.position), scene.is_orbit ? "velocity_km_s" : "momentum_kg_m_s",
                     numbers(scene.velocity));
}

std::string variable_name(const DrawnScene& scene, std::size_t i) {
  if (scene.is_orbit) {
    static const char* const names[] = {"x", "y", "z", "px", "py", "pz"};
    return names[i];
  }
  const std::size_t n = scene.model.degrees_of_freedom;
  const char* letter = i < n ? "q" : "p";
  return n == 1 ? letter : fmt::format("{}{}", letter, i % n + 1);
}

std::string integrator_table(const DrawnScene& scene) {
  std::string text = fmt::format("label = \"run\"\nmethod = \"{}\"\n", scene.method);
  if (scene.method == "gauss") {
    text += fmt::format("stages = {}\ncompensated_summation = {}\n", scene.stages,
                        scene.compensated_summation);
  }
  if (scene.method == "velocity-verlet") text += fmt::format("order = {}\n", scene.verlet_order);
  if (scene.method == "newmark") text += fmt::format("beta = {:.17g}\n", scene.beta);
  return text + (scene.tolerance ? fmt::format("tolerance = {:.17g}\n", *scene.tolerance)
                                 : fmt::format("step_s = {:.17g}\n", scene.step_s));
}

}  // namespace

std::string toml(const DrawnScene& scene) {
  std::string text = fmt::format(
      "schema = 1\ntitle = \"seed {} scene {}\"\nprecision = \"{}\"\n\n[system]\n{}\n[nominal]\n{}"
      "\n[jet]\norder = {}\nduration_s = {:.17g}\n",
      scene.seed, scene.number, scene.precision, system_table(scene), nominal_table(scene),
      scene.order, scene.duration_s);
  if (scene.keeps_rotation) text += "symmetry = \"none\"\n";
  if (scene.arcs == 0) text += "arcs = \"auto\"\n";
  if (scene.arcs > 1) text += fmt::format("arcs = {}\n", scene.arcs);
  if (!scene.variables.empty()) {
    std::vector<std::string> names;
    for (const std::size_t i : scene.variables) {
      names.push_back("\"" + variable_name(scene, i) + "\"");
    }
    text += fmt::format("variables = [{}]\n", fmt::join(names, ", "));
  }
  text += "\n[[integrator]]\n" + integrator_table(scene);
  if (scene.length_km) text += fmt::format("\n[units]\nlength_km = {:.17g}\n", *scene.length_km);
  if (scene.is_orbit && !scene.checks_surface) text += "\n[checks]\nsurface = false\n";
  return text;
}

std::string summary(const DrawnScene& scene) {
  static const char* const names[] = {"orbit",           "harmonic-oscillator", "double-well",
                                      "oscillator-pair", "spring-pendulum",     "fermi-pasta-ulam"};
  std::string text = names[static_cast<std::size_t>(scene.model.kind)];
  if (scene.is_orbit) {
    int count = 0, highest = 0;
    for (int n = 2; n <= 20; ++n) {
      if (scene.model.zonal[static_cast<std::size_t>(n)] != 0) {
        ++count;
        highest = n;
      }
    }
    text += fmt::format(" e={:.4g}", scene.eccentricity);
    if (count > 0) text += fmt::format(" {} zonals to J{}", count, highest);
    if (scene.length_km) text += fmt::format(" unit={:.3g}km", *scene.length_km);
  }
  text += fmt::format(" {:.3g}rev order={} {}",
                      scene.duration_s < 0 ? -scene.revolutions : scene.revolutions, scene.order,
                      scene.method);
  if (scene.method == "gauss") text += fmt::format("{}", scene.stages);
  if (scene.method == "velocity-verlet") text += fmt::format("{}", scene.verlet_order);
  text += scene.tolerance ? fmt::format(" tol={:.1e}", *scene.tolerance)
                          : fmt::format(" step={:.3g}s", scene.step_s);
  if (scene.arcs == 0) text += " arcs=auto";
  if (scene.arcs > 1) text += fmt::format(" arcs={}", scene.arcs);
  if (!scene.variables.empty()) text += fmt::format(" {} variables", scene.variables.size());
  if (scene.precision == "extended") text += " extended";
  return text;
}

}  // namespace hamjet::attack
