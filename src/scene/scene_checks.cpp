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
  setting.limit = table.positive_number(key);
  return setting;
}

}  // namespace

SelfCheckSettings read_checks(const TableReader& checks, const Scene& scene) {
  checks.check_keys({self_check_names()});
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
