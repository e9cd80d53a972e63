#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "descriptions/settings_fields.hpp"
#include "hamjet/detail/dynamics/spherical_harmonic_coefficients.hpp"
#include "hamjet/studies/comparison.hpp"
#include "hamjet/version.hpp"
#include "reference.hpp"

namespace hamjet {
namespace {

/// Writes values as a text in which different values never look alike.
class KeyText {
 public:
  template <class Value>
  void add(std::string_view name, const Value& value) {
    text_ += fmt::format("{} ", name);
    write(value);
    text_ += "; ";
  }

  const std::string& text() const noexcept { return text_; }

 private:
  /// The shortest text that brings back the number.
  void write(double value) { text_ += fmt::format("{}", value); }
  template <std::integral Integer>
  void write(Integer value) {
    text_ += fmt::format("{}", value);
  }
  /// A text is written with its length, because it may contain anything.
  void write(const std::string& value) { text_ += fmt::format("{}:{}", value.size(), value); }
  template <NamedEnumeration Enumeration>
  void write(Enumeration value) {
    text_ += names_of(value)[static_cast<std::size_t>(value)];
  }
  void write(const ZonalCoefficients& J) {
    for (int n = ZonalCoefficients::lowest; n <= ZonalCoefficients::highest; ++n) {
      if (J[n] != 0) text_ += fmt::format("J{} {} ", n, J[n]);
    }
  }
  void write(const std::shared_ptr<const SphericalHarmonicCoefficients>& field) {
    if (!field) return;
    for (int n = 0; n <= field->degree(); ++n) {
      for (int m = 0; m <= std::min(n, field->order()); ++m) {
        text_ += fmt::format("{} {} ", field->C(n, m), field->S(n, m));
      }
    }
  }
  /// The sunlight is not written, because it follows from the other settings and the nominal.
  void write(const std::shared_ptr<const Sunlight>&) {}
  /// The profile is not written, because the heights and densities beside it stand for it.
  void write(const std::shared_ptr<const DensityProfile>&) {}
  /// The table of the orientation is not written, because the checksum beside it stands for it.
  void write(const std::shared_ptr<const EarthOrientation>&) {}
  template <class Value>
  void write(const std::optional<Value>& value) {
    if (!value) {
      text_ += "none";
    } else {
      write(*value);
    }
  }
  template <class Value>
  void write(const std::vector<Value>& values) {
    text_ += fmt::format("{} of ", values.size());
    for (const Value& value : values) {
      write(value);
      text_ += ", ";
    }
  }
  template <HasFields Settings>
  void write(const Settings& settings) {
    text_ += "{";
    for_each_field(settings, [&](std::string_view name, const auto& member) { add(name, member); });
    text_ += "}";
  }

  std::string text_;
};

/// A function as the list of its operations and its outputs.
std::string operations_text(const OperationList& list) {
  std::string text = fmt::format("outputs {}: ", fmt::join(list.outputs(), " "));
  for (const Operation& operation : list.operations()) {
    text += fmt::format("{} {} {} {}", static_cast<int>(operation.code), operation.u, operation.v,
                        operation.constant.str());
    for (const LinearTerm& term : operation.terms) {
      text += fmt::format(" {} {}", term.value, term.coefficient.str());
    }
    text += ", ";
  }
  return text;
}

/// A system as all lists that are integrated: a field or force may be written by hand, separately
/// from the Hamiltonian.
std::string system_text(const DynamicalSystem& system) {
  std::string text = operations_text(system.hamiltonian) + "; " +
                     operations_text(system.vector_field) +
                     fmt::format("; {} waves", system.waves_on_a_circle) +
                     fmt::format("; breaks {}", fmt::join(system.break_times, " "));
  for (const auto& [i, j] : system.rotated_planes) text += fmt::format("; turned {} {}", i, j);
  if (!system.second_order) return text;
  text += "; " + operations_text(system.second_order->force) + "; inverse mass";
  for (const Extended& entry : system.second_order->inverse_mass) text += " " + entry.str();
  return text;
}

enum class KeyOf { reference, comparison };

/// A new member of Scene does not compile here until it is named and added to the key of everything
/// that it determines.
std::string scene_key(const Scene& scene, int jet_order, KeyOf whose) {
  const auto& [name, title, precision, system, units, told_units, mass_kg, canonical_radius,
               nominal, start_time, duration, manoeuvres, order, arcs, symmetry, coordinates,
               variables, jet_times, integrators, separation, kinds, reference,
               relative_hamiltonian_times, checks, comparison, figure, deputy, transfer, thruster,
               validity, eval, assignment, uncertainty, bounded, event, periodic, output, ephemeris,
               nominal_file, warnings, own_system] = scene;
  KeyText key;
  key.add("key", 6);  // version of this text, and of the data that are kept under it
  key.add("reference stages", reference_stages);
  key.add("compared stages", compared_stages);
  key.add("looser by", looser_tolerance);
  const ReferenceSettings settings = reference.value_or(ReferenceSettings{});
  key.add("reference", settings);
  key.add("bits", reference_arithmetic(precision, settings.tolerance).bits);
  key.add("system", system);
  if (own_system) key.add("own system", system_text(*own_system));
  key.add("radius", canonical_radius);
  key.add("nominal", nominal);
  if (start_time != ClockTime::epoch()) key.add("start", start_time.in<Extended>().str());
  key.add("duration", duration);
  key.add("order", jet_order);
  key.add("variables", variables);
  // Runs tell what a mass of 1 is, and do not compute with it.
  static_cast<void>(mass_kg);
  // Runs are of orbits that coast.
  static_cast<void>(manoeuvres);
  // A comparison is about jets in positions and momenta, whichever coordinates a scene uses to
  // predict deputies.
  static_cast<void>(coordinates);
  if (whose == KeyOf::reference) return key.text();
  key.add("version", std::string(version));
  key.add("units", units);
  key.add("separation", separation);
  key.add("kinds", kinds);
  key.add("symmetry", static_cast<int>(symmetry));
  key.add("compare", comparison);
  key.add("along time", integrators);
  for (const CandidateSeries& series : candidate_series(scene)) {
    for (const Candidate& candidate : series.candidates) key.add("run", candidate.settings);
  }
  return key.text();
}

}  // namespace

std::string reference_key(const Scene& scene, int order) {
  return scene_key(scene, order, KeyOf::reference);
}

std::string comparison_key(const Scene& scene) {
  return scene_key(scene, scene.order, KeyOf::comparison);
}

}  // namespace hamjet
