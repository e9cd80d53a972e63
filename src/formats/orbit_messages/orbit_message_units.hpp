#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "hamjet/formats/orbit_message.hpp"

// The keywords of orbit messages whose values are numbers, with their units (CCSDS 502.0-B-3,
// tables 3-3 and 5-3, and 8.2).

namespace hamjet::io {

struct Quantity {
  std::string_view keyword;
  std::string_view unit;  ///< empty for no unit
};

/// A part of an OPM beside its state.
struct UnusedPart {
  std::string_view name;
  std::vector<Quantity> quantities;
};

/// Position and velocity.
const std::vector<Quantity>& state_quantities();
const std::vector<UnusedPart>& unused_parts();
/// The numbers of a covariance's lower triangle, row by row.
const std::vector<Quantity>& covariance_quantities();

/// A number of the spacecraft, in the order of the standard.
struct SpacecraftQuantity {
  Quantity quantity;
  std::optional<double> OpmSpacecraft::*member;
};
const std::vector<SpacecraftQuantity>& spacecraft_quantities();

/// The numbers of a manoeuvre: its duration, its change of mass, and its three velocity changes.
const std::vector<Quantity>& manoeuvre_quantities();
/// Axes of an object's own orbit in which a manoeuvre may be told.
bool is_orbital_frame(std::string_view reference_frame);

/// The unit of a keyword; empty if it has none.
std::string_view unit_of_keyword(std::string_view keyword);

}  // namespace hamjet::io
