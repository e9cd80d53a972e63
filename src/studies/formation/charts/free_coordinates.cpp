#include "free_coordinates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>

namespace hamjet {
namespace {

constexpr std::size_t served_coordinates = 3;

/// A name that the text of the system does not have anywhere.
std::string unused_name(const SystemText& text, std::string name) {
  std::string all = text.hamiltonian;
  for (const auto& names : {text.coordinates, text.momenta}) {
    for (const std::string& one : names) all += one + ' ';
  }
  for (const auto& tables : {text.parameters, text.definitions}) {
    for (const NamedText& one : tables) all += one.name + ' ' + one.text + ' ';
  }
  while (all.find(name) != std::string::npos) name += '_';
  return name;
}

}  // namespace

std::size_t told_coordinates(const SystemSettings& system) {
  if (!system.own_text || !system.own_text->is_hamiltonian()) return served_coordinates;
  return std::min(served_coordinates, system.own_text->coordinates.size());
}

Scene with_free_coordinates(Scene scene) {
  const std::size_t told = told_coordinates(scene.system);
  if (told == served_coordinates || scene.nominal.size() != 2 * told) return scene;
  SystemText text = *scene.system.own_text;
  std::string kinetic;
  for (std::size_t i = told; i < served_coordinates; ++i) {
    text.coordinates.push_back(unused_name(text, fmt::format("free{}", i + 1)));
    text.momenta.push_back(unused_name(text, fmt::format("of_free{}", i + 1)));
    kinetic += fmt::format(" + {}^2/2", text.momenta.back());
  }
  text.hamiltonian = fmt::format("({}){}", text.hamiltonian, kinetic);
  scene.own_system = std::make_shared<const DynamicalSystem>(make_system("own", text));
  scene.system.own_degrees_of_freedom = served_coordinates;
  scene.system.own_names = text.variables();
  const auto momenta = scene.nominal.begin() + static_cast<std::ptrdiff_t>(told);
  scene.nominal.insert(momenta, served_coordinates - told, 0.0);
  scene.nominal.resize(2 * served_coordinates, 0.0);
  scene.variables.resize(2 * served_coordinates);
  std::iota(scene.variables.begin(), scene.variables.end(), std::size_t{0});
  // Two coordinates that move freely may be turned, which says nothing of the scene's own.
  scene.symmetry = FlowSymmetry::none;
  if (scene.validity) {
    std::fill(scene.validity->semi_axes.begin() + static_cast<std::ptrdiff_t>(told),
              scene.validity->semi_axes.end(), 0.0);
  }
  return scene;
}

std::string told_kind(const GeneratingFunctionKind& kind, const SystemSettings& system) {
  const std::string name = kind.name();
  const std::size_t n = kind.degrees_of_freedom();
  const std::size_t told = std::min(n, told_coordinates(system));
  return name.substr(0, told) + '-' + name.substr(n + 1, told);
}

bool has_told_name(const GeneratingFunctionKind& kind, const SystemSettings& system) {
  for (std::size_t i = told_coordinates(system); i < kind.degrees_of_freedom(); ++i) {
    if (kind.final_is_momentum[i] || kind.initial_is_momentum[i]) return false;
  }
  return true;
}

}  // namespace hamjet
