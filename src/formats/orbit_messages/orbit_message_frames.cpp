#include <fmt/format.h>

#include <algorithm>

#include "../../text/scene_message.hpp"
#include "hamjet/astronomy/earth_axes.hpp"
#include "hamjet/formats/orbit_message.hpp"

namespace hamjet::io {
namespace {

/// Names of axes that are fixed among the stars, or move with precession and nutation only, by some
/// 1e-11 rad/s. Source: SANA registry of celestial body reference frames, which CCSDS 502.0-B-3,
/// annex B4 refers to, and the names that older messages use.
const std::vector<std::string_view> inertial_frames = {
    "TOD",  "EME2000", "J2000", "ICRF", "ICRF1", "ICRF2",      "ICRF3",
    "GCRF", "MOD",     "TEME",  "CIRF", "B1950", "TEMEOFDATE", "TEMEOFEPOCH"};

/// The beginnings of names of frames that rotate with a body or with an orbit.
const std::vector<std::string_view> rotating_beginnings = {
    "ITRF", "TIRF", "GTOD", "GRC", "EFG", "ECEF", "TDR", "PEF", "WGS", "IGS",
    "DTRF", "RTN",  "RSW",  "QSW", "TNW", "LVLH", "NTW", "RIC", "VVLH"};

}  // namespace

bool is_inertial_frame(std::string_view reference_frame) {
  return std::find(inertial_frames.begin(), inertial_frames.end(), reference_frame) !=
         inertial_frames.end();
}

std::string_view name_of_axes(std::string_view reference_frame) {
  if (reference_frame == "J2000") return "EME2000";
  return reference_frame == "TEME" ? "TEMEOFDATE" : reference_frame;
}

bool is_accepted_frame(std::string_view reference_frame, AcceptedFrames frames) {
  return is_inertial_frame(reference_frame) || (frames == AcceptedFrames::terrestrial_too &&
                                                axes_named(reference_frame) == EarthAxes::itrf);
}

std::string frame_problem(std::string_view reference_frame, AcceptedFrames frames) {
  const bool is_rotating = std::any_of(
      rotating_beginnings.begin(), rotating_beginnings.end(),
      [&](std::string_view beginning) { return reference_frame.starts_with(beginning); });
  return fmt::format("{}, got {}, must be one whose axes keep their direction: {}{}",
                     is_rotating ? "a frame that rotates" : "unknown frame",
                     in_quotes(reference_frame), listed(inertial_frames),
                     frames == AcceptedFrames::terrestrial_too
                         ? "; or the Earth's own: ITRF with or without a year"
                         : "");
}

}  // namespace hamjet::io
