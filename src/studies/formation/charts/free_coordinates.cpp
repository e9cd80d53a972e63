#include "free_coordinates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <numeric>

#include "hamjet/error.hpp"
#include "hamjet/uncertainty/covariance.hpp"

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

std::array<std::string, 6> component_names(const SystemSettings& system, RelativeFrame frame) {
  std::array<std::string, 6> names;
  const auto usual = component_names(frame);
  std::copy(usual.begin(), usual.end(), names.begin());
  if (frame != RelativeFrame::coordinates || !system.own_text) return names;
  const std::vector<std::string>& own = system.own_text->coordinates;
  for (std::size_t i = 0; i < std::min(served_coordinates, own.size()); ++i) {
    names[i] = own[i];
    names[served_coordinates + i] = "v" + own[i];
  }
  return names;
}

std::vector<std::size_t> told_components(const SystemSettings& system) {
  std::vector<std::size_t> places;
  for (const std::size_t first : {std::size_t{0}, served_coordinates}) {
    for (std::size_t i = 0; i < told_coordinates(system); ++i) places.push_back(first + i);
  }
  return places;
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

FlowJet<double> with_free_coordinates(const FlowJet<double>& jet, double time) {
  const std::size_t told = jet.size() / 2;
  const std::size_t variables = jet.empty() ? 0 : jet[0].space().variables();
  if (told == 0 || told > served_coordinates || jet.size() != 2 * told || variables != 2 * told) {
    throw Error(ErrorKind::usage,
                "free coordinates: the jet is not one of one to three coordinates "
                "and their momenta");
  }
  const SeriesSpace& own = jet[0].space();
  const SpacePointer space = SeriesSpace::create(2 * served_coordinates, own.order());
  const auto place = [&](std::size_t v) { return v < told ? v : v - told + served_coordinates; };
  FlowJet<double> result(2 * served_coordinates, Series<double>(space));
  for (std::size_t k = 0; k < own.size(); ++k) {
    std::array<std::uint8_t, 2 * served_coordinates> exponents{};
    for (std::size_t v = 0; v < variables; ++v) exponents[place(v)] = own.exponents(k)[v];
    const std::size_t monomial = space->index(exponents);
    for (std::size_t c = 0; c < jet.size(); ++c) result[place(c)][monomial] = jet[c][k];
  }
  for (std::size_t q = told; q < served_coordinates; ++q) {
    const std::size_t p = served_coordinates + q;
    result[q][space->linear_index(q)] = 1;
    result[q][space->linear_index(p)] = time;
    result[p][space->linear_index(p)] = 1;
  }
  return result;
}

Series<double> in_told_variables(const Series<double>& series, const SystemSettings& system) {
  const std::vector<std::size_t> told = told_components(system);
  if (told.size() == series.space().variables()) return series;
  const SpacePointer space = SeriesSpace::create(told.size(), series.order());
  Series<double> result(space);
  for (std::size_t k = 0; k < space->size(); ++k) {
    std::array<std::uint8_t, 2 * served_coordinates> exponents{};
    for (std::size_t v = 0; v < told.size(); ++v) exponents[told[v]] = space->exponents(k)[v];
    result[k] = series[series.space().index(exponents)];
  }
  return result;
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
