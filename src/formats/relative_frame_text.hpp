#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/charts/jet_coordinates.hpp"
#include "hamjet/detail/studies/system_settings.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"

namespace hamjet::io {

/// A frame in the words of scenes, "RTN", "inertial" or "coordinates", and its derivatives:
/// "rotating", "inertial" or, where the axes do not turn, an empty text.
std::string_view frame_name(RelativeFrame frame);
std::string_view derivatives_name(RelativeFrame frame);

/// A frame in words: "RTN with rotating derivatives", "RTN with inertial derivatives", "inertial",
/// "coordinates".
std::string frame_text(RelativeFrame frame);

/// Which velocities a frame has: "as seen from the turning RTN axes" and the like.
std::string_view velocities_text(RelativeFrame frame);

/// Letters of the three axes: R, T, N or x, y, z, the first to the third coordinate.
std::array<std::string_view, 3> axis_letters(RelativeFrame frame);
/// Letters of the three axes in names of columns: r, t, n or x, y, z.
std::array<std::string_view, 3> axis_columns(RelativeFrame frame);

/// The same of a system: along the coordinates of one that its scene writes, their names, of which
/// there may be fewer than three.
std::vector<std::string> axis_letters(const SystemSettings& system, RelativeFrame frame);
std::vector<std::string> axis_columns(const SystemSettings& system, RelativeFrame frame);

/// The reason for a choice of automatic coordinates: "auto: furthest, 162 km; cartesian 6.04 km,
/// ...". Empty for coordinates that the scene names.
std::string choice_text(const ChosenCoordinates& coordinates);

/// The text that follows the frame where polynomials are not in Cartesian coordinates, or where the
/// coordinates were chosen automatically; otherwise empty.
std::string coordinates_text(const ChosenCoordinates& coordinates);

/// The scene's kind of generating function for transfers, or a statement that none is used. In
/// coordinates other than Cartesian, Newton's method finds the momenta, and a requested kind is not
/// used.
std::string transfer_kind_text(const std::string& kind, const CoordinatesAtEnds& coordinates);

}  // namespace hamjet::io
