#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hamjet/scene/scene_reader.hpp"

namespace hamjet::io {

/// Whether a text is a Conjunction Data Message.
bool is_conjunction_message(std::string_view text);

/// The scene of a Conjunction Data Message, as TOML: OBJECT1 as chief and OBJECT2 as deputy with
/// their covariances at the closest approach, in two-body motion about the Earth, and a window of a
/// quarter of the shorter period to each side. The radius, which a message does not say, comes from
/// the overrides. Throws Error(scene) for what the message lacks (a radius, axes that do not
/// rotate, a centre with a known gravitational parameter, a covariance of one object at least), and
/// as read_cdm.
std::string scene_of_conjunction(std::string_view text, const std::string& file_name,
                                 const std::vector<Override>& overrides);

}  // namespace hamjet::io
