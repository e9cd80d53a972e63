#pragma once

#include <concepts>
#include <string_view>
#include <type_traits>
#include <vector>

#include "hamjet/studies/scene.hpp"

// The members of the settings by name, declared once each. What compares, stores or reads settings
// goes through for_each_field, so that a member that is added takes part everywhere or does not
// compile.

namespace hamjet {
namespace detail {

/// Calls `visit` with each of the names, which commas separate, and the member of the same place.
template <class Visit, class... Members>
void visit_named(std::string_view names, const Visit& visit, Members&... members) {
  const auto next_name = [&names] {
    names.remove_prefix(names.find_first_not_of(", "));
    const std::string_view name = names.substr(0, names.find(','));
    names.remove_prefix(name.size());
    return name;
  };
  (visit(next_name(), members), ...);
}

}  // namespace detail

/// Defines for_each_field(settings, visit), which calls visit(name, member) for every member of a
/// `Settings`, const or not, in the order of the structure. The list must name all of them in that
/// order: a structured binding to fewer names than there are members is refused by the compiler.
#define HAMJET_FIELDS(Settings, ...)                          \
  template <class Given, class Visit>                         \
  requires std::same_as<std::remove_const_t<Given>, Settings> \
  void for_each_field(Given& settings, const Visit& visit) {  \
    auto& [__VA_ARGS__] = settings;                           \
    detail::visit_named(#__VA_ARGS__, visit, __VA_ARGS__);    \
  }

HAMJET_FIELDS(GravityFile, file, model_name, tide_system)
HAMJET_FIELDS(SystemSettings, model, mu_km3_s2, radius_km, J, mass_kg, stiffness_N_per_m,
              second_stiffness_N_per_m, length_m, gravity_m_s2, omega_rad_per_s, pairs,
              gravity_file)
HAMJET_FIELDS(CanonicalUnits, length_km, time_s)
HAMJET_FIELDS(IntegratorSettings, label, method, stages, order, beta, compensated_summation,
              step_canonical, tolerance, require_relative_error, require_symplecticity)
HAMJET_FIELDS(ReferenceSettings, tolerance)
HAMJET_FIELDS(ComparisonSettings, methods, stages, steps_canonical, tolerances, orders, repeats,
              time_budget_s, wanted_error_m)
#undef HAMJET_FIELDS

/// Settings whose members for_each_field knows.
template <class Settings>
concept HasFields = requires(Settings& settings) {
  for_each_field(settings, [](std::string_view, auto&) {});
};

/// The names of an enumeration in scenes and results, in its order.
inline const std::vector<std::string_view>& names_of(SystemModel) { return model_names(); }
inline const std::vector<std::string_view>& names_of(IntegrationMethod) { return method_names(); }

/// An enumeration whose enumerators have names.
template <class Enumeration>
concept NamedEnumeration = std::is_enum_v<Enumeration> && requires(Enumeration value) {
  names_of(value);
};

}  // namespace hamjet
