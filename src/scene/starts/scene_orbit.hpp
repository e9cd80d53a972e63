#pragma once

#include <vector>

#include "scene_nominal_file.hpp"

// The state of a satellite about the centre of attraction, as the table [nominal] and the tables of
// deputies give it.

namespace hamjet::io {

/// The keys of read_orbit, which belong to `owners`.
std::vector<SceneKey> orbit_keys(const std::vector<std::string_view>& owners = {});

/// The first key of read_orbit that the table has, among the keys that determine the form of the
/// orbit.
std::optional<std::string_view> orbit_key_of(const TableReader& table);

/// A state, and the message from which it was read, if it was.
struct Orbit {
  CartesianState state;
  std::optional<NominalFile> file;
};

/// Reads the state in one of its forms: position and velocity, osculating elements, or the file of
/// a message. Throws Error(scene), and for a message as read_nominal_file.
Orbit read_orbit(const TableReader& table, const SceneCentre& centre);

}  // namespace hamjet::io
