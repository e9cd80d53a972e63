#include "relative_frame_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../text/quantity_text.hpp"
#include "hamjet/detail/studies/transfer_settings.hpp"

namespace hamjet::io {

std::string_view frame_name(RelativeFrame frame) {
  if (frame == RelativeFrame::coordinates) return "coordinates";
  return frame == RelativeFrame::inertial ? "inertial" : "RTN";
}

std::string_view derivatives_name(RelativeFrame frame) {
  switch (frame) {
    case RelativeFrame::rtn_rotating:
      return "rotating";
    case RelativeFrame::rtn_inertial:
      return "inertial";
    case RelativeFrame::inertial:
    case RelativeFrame::coordinates:
      break;
  }
  return "";
}

std::string frame_text(RelativeFrame frame) {
  const std::string_view derivatives = derivatives_name(frame);
  std::string text(frame_name(frame));
  if (!derivatives.empty()) text.append(" with ").append(derivatives).append(" derivatives");
  return text;
}

std::string_view velocities_text(RelativeFrame frame) {
  switch (frame) {
    case RelativeFrame::rtn_rotating:
      return "as seen from the turning RTN axes";
    case RelativeFrame::rtn_inertial:
      return "as seen from axes that do not turn, along RTN";
    case RelativeFrame::coordinates:
      return "that are the rates of the coordinates";
    case RelativeFrame::inertial:
      break;
  }
  return "as seen from the inertial axes";
}

std::array<std::string_view, 3> axis_letters(RelativeFrame frame) {
  if (is_along_coordinates(frame)) return {"x", "y", "z"};
  return {"R", "T", "N"};
}

std::array<std::string_view, 3> axis_columns(RelativeFrame frame) {
  if (is_along_coordinates(frame)) return {"x", "y", "z"};
  return {"r", "t", "n"};
}

namespace {

std::vector<std::string> own_or(const SystemSettings& system, RelativeFrame frame,
                                const std::array<std::string_view, 3>& usual) {
  if (frame != RelativeFrame::coordinates || !system.own_text) {
    return {usual.begin(), usual.end()};
  }
  const std::vector<std::string>& own = system.own_text->coordinates;
  const std::size_t count = std::min(own.size(), usual.size());
  return {own.begin(), own.begin() + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

std::vector<std::string> axis_letters(const SystemSettings& system, RelativeFrame frame) {
  return own_or(system, frame, axis_letters(frame));
}

std::vector<std::string> axis_columns(const SystemSettings& system, RelativeFrame frame) {
  return own_or(system, frame, axis_columns(frame));
}

std::string choice_text(const ChosenCoordinates& coordinates) {
  std::string chosen;
  std::string others;
  for (const ChosenCoordinates::Reach& reach : coordinates.reaches) {
    const std::string length = length_text(reach.metres);
    if (coordinates == reach.coordinates) {
      chosen = "auto: the furthest, " + length;
    } else {
      others +=
          fmt::format("{} {} {}", others.empty() ? ";" : ",", name_of(reach.coordinates), length);
    }
  }
  return chosen + others;
}

std::string coordinates_text(const ChosenCoordinates& coordinates) {
  const std::string choice = choice_text(coordinates);
  if (choice.empty() && coordinates == JetCoordinates::cartesian) return "";
  return fmt::format("; {} coordinates{}", name_of(coordinates),
                     choice.empty() ? "" : " (" + choice + ")");
}

std::string transfer_kind_text(const std::string& kind, const CoordinatesAtEnds& coordinates) {
  if (coordinates == JetCoordinates::cartesian) return kind;
  const std::string unused =
      kind == TransferSettings().kind ? "" : fmt::format(", transfer.kind = {} is not used", kind);
  return fmt::format("none ({} polynomials are solved by Newton's method{})", name_of(coordinates),
                     unused);
}

}  // namespace hamjet::io
