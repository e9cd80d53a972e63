#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "hamjet/detail/studies/system_settings.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

// All that the program knows of a system is said here once: scenes, lists and results read it. A
// system is added by its Hamiltonian, its place in system_settings.hpp and its description in
// system_descriptions.cpp.

namespace hamjet {

/// A key of `[system]`.
struct SystemParameter {
  std::string_view key;
  std::string_view help;  ///< for people: what it is
  std::variant<double SystemSettings::*, std::size_t SystemSettings::*> member;
  /// The member for the second number of a key that takes two positive ones; else null.
  double SystemSettings::*second_member = nullptr;
  bool is_required = true;
  bool is_positive = true;  ///< whether a number must be above 0
  std::int64_t least = 0;   ///< for a whole number; the range includes both ends
  std::int64_t most = 0;
};

/// A system, as scenes, lists and results know it.
struct SystemDescription {
  SystemModel model;
  std::string_view name;  ///< in scenes and results
  std::string_view help;  ///< for people: what it is, and its keys
  /// An orbit in space has three degrees of freedom and kilometres; the others metres.
  bool is_orbit = false;
  /// The numbers of degrees of freedom that it can have, ascending.
  std::vector<std::size_t> degrees_of_freedom = {1};
  /// The number that given settings have; null where only one is possible.
  std::size_t (*degrees_of_freedom_of)(const SystemSettings&) = nullptr;
  /// Its keys in `[system]`, without `model` and those of zonal coefficients.
  std::vector<SystemParameter> parameters = {};
  /// Makes the system in canonical units, in which the field's radius is `canonical_radius`.
  DynamicalSystem (*make)(const SystemSettings&, double canonical_radius);
  /// The longest period of a linear system, seconds; null for the others.
  double (*period_s)(const SystemSettings&) = nullptr;
  /// Why a position with all components 0 is no valid start; empty: it is one.
  std::string_view no_start_at_origin = {};
};

/// The systems that scenes can name, in the order of the enumeration.
const std::vector<SystemDescription>& all_systems();

/// The description of one system.
const SystemDescription& description_of(SystemModel model);

}  // namespace hamjet
