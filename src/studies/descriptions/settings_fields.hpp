#pragma once

#include <string_view>
#include <type_traits>
#include <vector>

#include "hamjet/detail/studies/fields.hpp"
#include "hamjet/studies/scene.hpp"

// The members of the settings by name, each declared once. All code that compares, stores or reads
// settings uses for_each_field, so that a new member takes part everywhere or does not compile.

namespace hamjet {
HAMJET_FIELDS(CanonicalUnits, length_km, time_s)
HAMJET_FIELDS(ReferenceSettings, tolerance)
HAMJET_FIELDS(ComparisonSettings, methods, stages, steps_canonical, tolerances, orders, repeats,
              time_budget_s, wanted_error_m)

/// The names of an enumeration in scenes and results, in its order.
inline const std::vector<std::string_view>& names_of(SystemModel) { return model_names(); }
inline const std::vector<std::string_view>& names_of(IntegrationMethod) { return method_names(); }
inline const auto& names_of(AtmosphereModel) { return atmosphere_names; }
inline const auto& names_of(ShadowModel) { return shadow_names; }

/// An enumeration whose enumerators have names.
template <class Enumeration>
concept NamedEnumeration = std::is_enum_v<Enumeration> && requires(Enumeration value) {
  names_of(value);
};

}  // namespace hamjet
