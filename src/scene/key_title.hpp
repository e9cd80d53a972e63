#pragma once

#include <string>
#include <string_view>

namespace hamjet::io {

/// The label of an axis for a key of a scene, dotted as `--set` takes it: "deputy position,
/// component 1 (m)" for deputy.position_m.0, "inclination (degrees)" for nominal.i_deg.
std::string key_title(std::string_view key);

}  // namespace hamjet::io
