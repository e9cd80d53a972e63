#include <fmt/format.h>

#include "../studies/bounded/event_study.hpp"
#include "../studies/formation_scale.hpp"
#include "scene_relative_motion.hpp"
#include "tables_of_studies.hpp"

namespace hamjet::io {
namespace {

constexpr int most_events = 100000;
constexpr double largest_amplitude = 0.05;  // as a fraction of the distance from the centre

/// Refuses a key that belongs to another surface.
void refuse(const TableReader& event, std::string_view key, std::string_view surface) {
  if (!event.has(key)) return;
  event.fail(key, fmt::format("not of this surface, got {}, must be left out, or surface = \"{}\"",
                              event.found(key), surface));
}

const TableDescription& event_table() {
  static const EventSettings preset;
  static const TableDescription table = {
      {{"surface", form::choice({"equator", "plane", "distance", "apsis", "expression"}),
        absent::refused(),
        "what vanishes at the event: the height over the equator (a node where it rises), the "
        "height over a plane, the distance from the centre less `distance_km`, the product of "
        "position and velocity (a pericentre where it rises, an apocentre where it falls), or an "
        "`expression`, the only one of a system of the scene's own"},
       {"expression", form::text(), absent::other("required with `expression`, refused without"),
        "of x, y, z in km and px, py, pz in km/s of an orbit, or of the variables, "
        "parameters and definitions of an own system, as in `[system]`"},
       {"normal", form::array(form::number(), 3),
        absent::other("required with `plane`, refused without"),
        "normal of the plane, x, y, z of the nominal's axes; of any length"},
       {"offset_km", form::number(), absent::value(preset.offset_km),
        "distance of the plane from the centre, along its normal"},
       {"distance_km", form::positive(), absent::other("required with `distance`, refused without"),
        "distance from the centre"},
       {"direction", form::choice({"either", "rising", "falling"}), absent::value("either"),
        "whether what vanishes grows or falls with time at the event"},
       {"number", form::integer(1, most_events), absent::value(preset.number),
        "number of the event, counted after the chief's start, within `jet.duration`"},
       {"amplitudes_m", form::array(form::positive()), absent::value(preset.amplitudes_m),
        "distances from the chief of deputies that are flown to see how far the polynomials hold; "
        "their velocities differ by as much times the mean motion. Those of an own system without "
        "it are powers of ten from 5e-8 to 0.05 of the size of its nominal"}},
      "A condition along the orbit: the time at which it holds and the state then, as polynomials "
      "of the initial state. If the condition is a surface that the orbit comes back to, these "
      "polynomials are its Poincaré map."};
  return table;
}

/// What is wrong in the expression is said about its key.
void read_expression(const TableReader& event, const SystemSettings& system,
                     EventSettings& settings) {
  constexpr std::string_view key = "expression";
  if (settings.surface != EventSurface::expression) return refuse(event, key, "expression");
  settings.expression = event.text(key);
  try {
    const OperationList list = record_function(event_function(system, settings.expression));
    if (list.has_time()) {
      event.fail(key, "depends on the time, got t in it, must be of variables alone");
    }
    if (list.outputs()[0] < list.first_series_value() && list.outputs()[0] >= list.inputs()) {
      event.fail(key, fmt::format("the same everywhere, got {}, must depend on the variables",
                                  event.found(key)));
    }
  } catch (const ExpressionTextError& error) {
    event.fail(key, error.problem());
  }
}

EventSettings read_event(const TableReader& event, const Scene& scene) {
  event.check_keys();
  require_deviations(event, scene);
  EventSettings settings;
  settings.surface = EventSurface(event.choice("surface"));
  if (!is_orbit(scene.system.model) && settings.surface != EventSurface::expression) {
    event.fail("surface", fmt::format("of an orbit, got {}, must be \"expression\": the surface "
                                      "is where one in the system's variables vanishes",
                                      event.found("surface")));
  }
  read_expression(event, scene.system, settings);
  if (settings.surface == EventSurface::plane) {
    const std::vector<double> normal = event.numbers("normal", 3);
    settings.normal = {normal[0], normal[1], normal[2]};
    if (settings.normal.isZero(0)) {
      event.fail("normal", "no direction, got zeros, must be a vector across the plane");
    }
    settings.normal.stableNormalize();
    event.read_if_any("offset_km", settings.offset_km);
  } else {
    refuse(event, "normal", "plane");
    refuse(event, "offset_km", "plane");
  }
  if (settings.surface == EventSurface::distance) {
    settings.distance_km = event.positive_number("distance_km");
  } else {
    refuse(event, "distance_km", "distance");
  }
  event.read_if_any("direction", settings.direction);
  event.read_if_any("number", settings.number);
  // Deputies beyond this distance have quite different orbits, some of which meet the centre.
  const double most_m = largest_amplitude * size_of_nominal(scene) * scene.units.length_km * 1000;
  if (!event.has("amplitudes_m")) {
    if (!is_orbit(scene.system.model)) {
      settings.amplitudes_m.clear();
      for (const double part : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0}) {
        settings.amplitudes_m.push_back(part * most_m);
      }
    }
    std::erase_if(settings.amplitudes_m, [&](double amplitude) { return amplitude > most_m; });
    return settings;
  }
  settings.amplitudes_m = event.numbers("amplitudes_m");
  for (std::size_t i = 0; i < settings.amplitudes_m.size(); ++i) {
    const double amplitude = settings.amplitudes_m[i];
    if (amplitude > 0 && amplitude <= most_m) continue;
    event.fail_element("amplitudes_m", i,
                       fmt::format("out of range, got {}, must be above 0 and at most a "
                                   "twentieth of the chief's distance from the centre (of an own "
                                   "system, of the nominal's size), {:.6g}",
                                   amplitude, most_m));
  }
  return settings;
}

}  // namespace

TableOfStudy event_of_scenes() {
  return {.name = "event",
          .description = &event_table,
          .absence = "none, and the frozen orbit is found",
          .help = "what `hamjet poincare` works on",
          .read = [](const TableReader& table, Scene& scene, const Nominal&) {
            scene.event = read_event(table, scene);
          }};
}

}  // namespace hamjet::io
