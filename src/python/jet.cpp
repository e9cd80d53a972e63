#include "jet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "hamjet/algebra/calculus.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"
#include "jet_dates.hpp"
#include "refusal.hpp"

namespace hamjet::python {
namespace {

/// Two jets follow each other if the nominals meet to this, relative to the state: rounding on the
/// way through a scene's units and digits, no more.
constexpr double largest_gap = 1e-12;

/// The map of a jet, with coefficients of type T.
template <class T>
FlowMap<T> map_of(const io::StoredJet& stored) {
  return FlowMap<T>(convert_map<T>(stored.jet));
}

/// Works in the arithmetic of the jet: `work` is called with a number of its type, and returns a
/// map in that type.
template <class Work>
FlowJet<Extended> in_precision(Precision precision, const Work& work) {
  if (precision == Precision::extended) return work(Extended()).jet();
  return convert_map<Extended>(work(double()).jet());
}

std::string names_of(const io::StoredJet& stored, const std::vector<std::size_t>& indices) {
  const auto names = stored.variable_names();
  std::string text;
  for (const std::size_t i : indices) text += fmt::format(" {}", names[i]);
  return text;
}

void require_same_system(const io::StoredJet& first, const io::StoredJet& second) {
  if (first.model != second.model ||
      first.nominal_initial.size() != second.nominal_initial.size() ||
      (first.parameters + second.parameters > 0 && first.own_names != second.own_names)) {
    refuse(fmt::format("compose: the jets are of different systems, {} and {}",
                       model_name(first.model), model_name(second.model)));
  }
  if (first.units.length_km != second.units.length_km ||
      first.units.time_s != second.units.time_s) {
    refuse(fmt::format(
        "compose: the jets have different canonical units, {} km and {} s, {} km and "
        "{} s; a scene's [units] length_km sets them",
        first.units.length_km, first.units.time_s, second.units.length_km, second.units.time_s));
  }
}

void require_meeting(const io::StoredJet& first, const io::StoredJet& second) {
  double size = 0;
  double gap = 0;
  for (std::size_t i = 0; i < first.nominal_final.size(); ++i) {
    size = std::max(size, std::abs(first.nominal_final[i]));
    gap = std::max(gap, std::abs(first.nominal_final[i] - second.nominal_initial[i]));
  }
  if (!(gap <= largest_gap * size)) {
    refuse(
        fmt::format("compose: the second jet starts {:.3g} canonical units from where the first "
                    "ends, must be at most {:.0e} of the state",
                    gap, largest_gap));
  }
}

/// Forces that depend on the time let the second jet start only when the first ends; other forces
/// are the same at every start.
void require_clocks_meeting(const io::StoredJet& first, const io::StoredJet& second) {
  if (first.is_autonomous && second.is_autonomous) return;
  if (first.ephemeris && second.ephemeris) return;  // their dates have been compared
  const double end = (first.start_time + first.duration).in<double>();
  const double start = second.start_time.in<double>();
  const double size = std::abs(first.duration) + std::abs(second.duration) + std::abs(end);
  if (std::abs(start - end) <= largest_gap * size) return;
  refuse(
      fmt::format("compose: the forces depend on the time, and the second jet starts at "
                  "{:.10g} canonical, must start when the first ends, at {:.10g}",
                  start, end));
}

}  // namespace

Jet::Jet(io::StoredJet stored)
    : stored_(std::move(stored)), map_(map_of<double>(stored_)), deviation_(map_.evaluator()) {
  coefficients_.reserve(map_.components() * space()->size());
  for (const Series<double>& component : map_.jet()) {
    const auto row = component.coefficients();
    coefficients_.insert(coefficients_.end(), row.begin(), row.end());
  }
}

MapEvaluator Jet::deviation_to(int degree) const {
  if (degree < 1 || degree > stored_.order()) {
    refuse(
        fmt::format("degree {}: must be 1 to the order of the jet, {}", degree, stored_.order()));
  }
  return map_.evaluator(degree);
}

MapEvaluator Jet::derivatives() const {
  std::vector<Series<double>> derivatives;
  for (const Series<double>& component : map_.jet()) {
    for (std::size_t i = 0; i < map_.variables(); ++i) {
      derivatives.push_back(derivative(component, i));
    }
  }
  return MapEvaluator(derivatives, stored_.order() - 1);
}

Jet Jet::composed_with(const Jet& after) const {
  const io::StoredJet& second = after.stored_;
  require_same_system(stored_, second);
  if (second.variables != stored_.components) {
    refuse(
        fmt::format("compose: the second jet is expanded in{}, must be in the components of the "
                    "first,{}",
                    names_of(second, second.variables), names_of(stored_, stored_.components)));
  }
  require_meeting(stored_, second);
  require_dates_meeting(stored_, second);
  require_clocks_meeting(stored_, second);
  io::StoredJet result = stored_;
  result.scene =
      stored_.scene == second.scene ? stored_.scene : stored_.scene + ", " + second.scene;
  result.label =
      stored_.label == second.label ? stored_.label : stored_.label + ", " + second.label;
  const bool is_extended =
      stored_.precision == Precision::extended && second.precision == Precision::extended;
  result.precision = is_extended ? Precision::extended : Precision::double_precision;
  result.duration = stored_.duration + second.duration;
  result.nominal_final = second.nominal_final;
  result.components = second.components;
  result.error_by_degree.clear();
  result.jet = in_precision(result.precision, [&]<class T>(T) {
    return map_of<T>(stored_).followed_by(map_of<T>(second));
  });
  return Jet(std::move(result));
}

Jet Jet::inverse() const {
  if (stored_.variables != stored_.components) {
    refuse(fmt::format("inverse: the jet is expanded in{}, must be in all of its components,{}",
                       names_of(stored_, stored_.variables),
                       names_of(stored_, stored_.components)));
  }
  io::StoredJet result = stored_;
  result.duration = -stored_.duration;
  result.start_time = stored_.start_time + stored_.duration;
  std::swap(result.nominal_initial, result.nominal_final);
  result.ephemeris = ephemeris_at_end(stored_);
  result.error_by_degree.clear();
  result.jet = in_precision(stored_.precision, [&]<class T>(T) {
    std::vector<T> start;
    for (const std::size_t c : result.components) start.emplace_back(result.nominal_final[c]);
    return map_of<T>(stored_).inverse(start);
  });
  return Jet(std::move(result));
}

std::vector<SymplecticityDefect> Jet::symplecticity() const {
  if (stored_.parameters > 0) {
    refuse(
        fmt::format("symplecticity: the state ends with {}, must be one of positions and momenta "
                    "alone, as by a jet whose variables are without parameters",
                    stored_.own_names.back()));
  }
  return symplecticity_by_degree(stored_.jet);
}

Jet jet_of(const PropagationResult& result, const RunResult& run) {
  io::StoredJet stored = io::describe_jet(result, run);
  stored.jet = run.jet;
  return Jet(std::move(stored));
}

}  // namespace hamjet::python
