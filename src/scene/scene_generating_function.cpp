#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "../text/quantity_text.hpp"
#include "../text/scene_message.hpp"
#include "scene_sections.hpp"

namespace hamjet::io {
namespace {

/// An orbit in the equatorial plane stays there if the gravity field is symmetric about this plane
/// (no odd zonal coefficient). Then x, y, px, py are a system of their own, with two degrees of
/// freedom.
bool is_planar_subsystem(const Scene& scene) {
  constexpr std::size_t z = 2, pz = 5;
  return is_orbit(scene.system.model) && scene.system.J.is_even() && scene.nominal[z] == 0 &&
         scene.nominal[pz] == 0 && scene.variables == std::vector<std::size_t>{0, 1, 3, 4};
}

}  // namespace

std::size_t degrees_of_freedom_of_kinds(const TableReader& table, std::string_view key,
                                        const Scene& scene) {
  const std::vector<std::string_view> names = variable_names(scene.system);
  if (const auto& parameters = state_parameters(scene.system); !parameters.empty()) {
    table.fail(key, fmt::format("not defined beside the parameter {} among jet.variables, got {}, "
                                "must be left out: a generating function is one of positions and "
                                "momenta alone",
                                parameters[0], table.found(key)));
  }
  if (is_planar_subsystem(scene)) return 2;
  if (scene.variables.size() != names.size()) {
    std::vector<std::string_view> given;
    for (const std::size_t variable : scene.variables) given.push_back(names[variable]);
    table.fail(key,
               fmt::format("not defined for these jet.variables, got {}, must be all of {}{}",
                           listed(given), listed(names),
                           is_orbit(scene.system.model)
                               ? " (or x, y, px, py on an exactly equatorial orbit without odd J_n)"
                               : ""));
  }
  return names.size() / 2;
}

std::string explicit_kind(const std::string& kind, std::size_t degrees_of_freedom) {
  const std::string q(degrees_of_freedom, 'q'), p(degrees_of_freedom, 'p');
  if (kind == "F1") return q + '-' + q;
  if (kind == "F2") return q + '-' + p;
  if (kind == "F3") return p + '-' + q;
  if (kind == "F4") return p + '-' + p;
  if (kind == "auto") return kind;
  if (kind.size() != 2 * degrees_of_freedom + 1) return "";
  for (std::size_t i = 0; i < kind.size(); ++i) {
    const bool right = i == degrees_of_freedom ? kind[i] == '-' : kind[i] == 'q' || kind[i] == 'p';
    if (!right) return "";
  }
  return kind;
}

const TableDescription& generating_function_table() {
  static const TableDescription table = {
      {{"kinds", form::words("array of kinds", form::array(form::text())), absent::refused(),
        "kinds to compute, each once: `F1` to `F4`, letters such as `qpq-qqp`, or `auto`, the best "
        "conditioned"},
       {"despite_drag",
        form::boolean(),
        absent::value(false),
        "whether to invert the map of a system with drag, which has no potential, and to tell the "
        "residual that this leaves",
        {"earth"}}}};
  return table;
}

std::vector<std::string> read_generating_function(const TableReader& generating_function,
                                                  const Scene& scene) {
  generating_function.check_keys();
  const std::vector<std::string> kinds = generating_function.texts("kinds");
  bool despite_drag = false;
  generating_function.read_if_any("despite_drag", despite_drag);
  if (scene.system.earth && scene.system.earth->atmosphere && !despite_drag) {
    generating_function.fail(
        "kinds",
        fmt::format(
            "no potential, got {} of a system with drag, whose map is not symplectic, must "
            "be left out, or beside despite_drag = true, which tells the exactness residual "
            "that the forces cause",
            generating_function.found("kinds")));
  }
  const std::size_t degrees_of_freedom =
      degrees_of_freedom_of_kinds(generating_function, "kinds", scene);
  std::map<std::string, std::string> named;  // for each explicit kind, the name that the scene uses
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const std::string kind = explicit_kind(kinds[i], degrees_of_freedom);
    if (kind.empty()) {
      generating_function.fail_element(
          "kinds", i,
          fmt::format("unknown kind, got {}, must be F1, F2, F3, F4, auto, or {} q or p "
                      "for the final variables, a hyphen, and as many for the initial ones, as in "
                      "{}",
                      in_quotes(kinds[i]), counted(degrees_of_freedom, "letter"),
                      explicit_kind("F2", degrees_of_freedom)));
    }
    const auto [first, is_new] = named.emplace(kind, kinds[i]);
    if (!is_new) {
      generating_function.fail_element(
          "kinds", i,
          fmt::format("duplicate kind, got {}, which is the same as {}, must be there once",
                      in_quotes(kinds[i]), in_quotes(first->second)));
    }
  }
  return kinds;
}

}  // namespace hamjet::io
