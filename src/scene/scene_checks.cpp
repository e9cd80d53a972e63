#include <fmt/format.h>

#include "scene_sections.hpp"

namespace hamjet::io {
namespace {

SelfCheckSetting read_check(const TableReader& table, SelfCheckName name) {
  const std::string_view key = name_of(name);
  SelfCheckSetting setting;
  if (const auto is_on = table.boolean_if_any(key)) {
    setting.is_on = *is_on;
    return setting;
  }
  if (name == SelfCheckName::finite) {
    table.fail(key, fmt::format("wrong type, got {}, must be true or false", table.found(key)));
  }
  if (!table.is_number(key)) {
    table.fail(key, fmt::format("wrong type, got {}, must be a number above 0 (the limit), true or "
                                "false",
                                table.found(key)));
  }
  setting.limit = table.number(key);
  return setting;
}

/// The quantity that each check examines, in the order of the enumeration.
constexpr std::string_view subjects[self_check_count] = {
    "every number of the result is finite",
    "the equations of implicit methods are solved to round-off",
    "the method's own estimate of its local error",
    "the energy along the nominal",
    "Poisson brackets of every degree, of symplectic methods",
    "inverted maps composed with the map",
    "the nominal's smallest distance from the centre; the limit needs `system.radius_km`",
    "the error of every degree, estimated by independent runs along a few directions"};

}  // namespace

const TableDescription& checks_table() {
  static const TableDescription table = [] {
    TableDescription checks;
    for (std::size_t i = 0; i < self_check_count; ++i) {
      const bool has_limit = static_cast<SelfCheckName>(i) != SelfCheckName::finite;
      checks.keys.push_back(
          {self_check_names()[i],
           has_limit
               ? form::words("`true`, `false`, or the limit: number above 0", form::positive())
               : form::boolean(),
           absent::value(true), subjects[i]});
    }
    return checks;
  }();
  return table;
}

SelfCheckSettings read_checks(const TableReader& checks, const Scene& scene) {
  checks.check_keys();
  SelfCheckSettings settings;
  for (std::size_t i = 0; i < self_check_names().size(); ++i) {
    const auto name = static_cast<SelfCheckName>(i);
    if (checks.has(name_of(name))) settings[name] = read_check(checks, name);
  }
  const auto surface = name_of(SelfCheckName::surface);
  if (settings[SelfCheckName::surface].limit && !(scene.system.radius_km > 0)) {
    checks.fail(surface, fmt::format("has no meaning here, got {}, must be a number only where "
                                     "system.radius_km is given",
                                     checks.found(surface)));
  }
  return settings;
}

}  // namespace hamjet::io
