#pragma once

#include <array>
#include <string>
#include <string_view>

#include "hamjet/charts/jet_coordinates.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"

namespace hamjet::io {

/// A frame and its derivatives as scenes name them: "RTN" or "inertial"; "rotating", "inertial" or,
/// where the axes do not turn, empty.
std::string_view frame_name(RelativeFrame frame);
std::string_view derivatives_name(RelativeFrame frame);

/// A frame in words: "RTN with rotating derivatives", "RTN with inertial derivatives", "inertial".
std::string frame_text(RelativeFrame frame);

/// Which velocities a frame's are: "as seen from the turning RTN axes" and the like.
std::string_view velocities_text(RelativeFrame frame);

/// Letters of the three axes: R, T, N or x, y, z.
std::array<std::string_view, 3> axis_letters(RelativeFrame frame);
/// Letters of the three axes in names of columns: r, t, n or x, y, z.
std::array<std::string_view, 3> axis_columns(RelativeFrame frame);

/// Why automatic coordinates are what they are: "auto: furthest, 162 km; cartesian 6.04 km, ..." of
/// the others; empty for coordinates that were named.
std::string choice_text(const ChosenCoordinates& coordinates);

/// What stands behind the frame where polynomials are in other coordinates than Cartesian ones, or
/// where the coordinates were chosen, which is then said; else nothing.
std::string coordinates_text(const ChosenCoordinates& coordinates);

/// A scene's kind of generating function for transfers, or that there is none: polynomials in other
/// coordinates are solved for momenta by Newton's method, and a kind that is asked for is not used.
std::string transfer_kind_text(const std::string& kind, const CoordinatesAtEnds& coordinates);

}  // namespace hamjet::io
