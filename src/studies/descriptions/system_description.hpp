#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "hamjet/detail/studies/system_settings.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

// The single description of every system: scenes, lists and results read it. A system is added by
// its Hamiltonian, its place in system_settings.hpp and its description in system_descriptions.cpp.

namespace hamjet {

/// A key of `[system]`.
struct SystemParameter {
  std::string_view key;
  std::string_view help;  ///< what it is, for people
  std::variant<double SystemSettings::*, std::size_t SystemSettings::*> member;
  /// The member for the second number of a key that takes two positive numbers; otherwise null.
  double SystemSettings::*second_member = nullptr;
  bool is_required = true;
  bool is_positive = true;  ///< whether a number must be above 0
  std::int64_t least = 0;   ///< least value of a whole number; the range includes both ends
  std::int64_t most = 0;
};

/// The description of a system for scenes, lists and results.
struct SystemDescription {
  SystemModel model;
  std::string_view name;              ///< name in scenes and results
  std::string_view help;              ///< description for people, with its keys
  bool has_state_parameters = false;  ///< whether states may end with parameters
  /// An orbit in space has three degrees of freedom and kilometres; the other systems have metres.
  bool is_orbit = false;
  /// The numbers of degrees of freedom that the system can have, ascending.
  std::vector<std::size_t> degrees_of_freedom = {1};
  /// The number of degrees of freedom with given settings; null if only one is possible.
  std::size_t (*degrees_of_freedom_of)(const SystemSettings&) = nullptr;
  /// Its keys in `[system]`, without `model` and those of zonal coefficients.
  std::vector<SystemParameter> parameters = {};
  /// Makes the system in canonical units, in which the field's radius is `canonical_radius`.
  DynamicalSystem (*make)(const SystemSettings&, double canonical_radius);
  /// The longest period of a linear system in seconds; null for the others.
  double (*period_s)(const SystemSettings&) = nullptr;
  /// The reason why a position with all components 0 is not a valid start; empty if it is one.
  std::string_view no_start_at_origin = {};
};

/// The systems that scenes can name, in the order of the enumeration.
const std::vector<SystemDescription>& all_systems();

/// The description of one system.
const SystemDescription& description_of(SystemModel model);

}  // namespace hamjet
