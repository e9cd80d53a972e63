#pragma once

#include <string>
#include <string_view>

namespace hamjet::io {

/// A key of a scene, dotted as `--set` takes it, as the label of an axis: "deputy position,
/// component 1 (m)" of deputy.position_m.0, "inclination (degrees)" of nominal.i_deg.
std::string key_title(std::string_view key);

}  // namespace hamjet::io
