#include "jet_dates.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "hamjet/astronomy/epoch.hpp"
#include "refusal.hpp"

namespace hamjet::python {
namespace {

/// Orbit messages are often dated to the millisecond; where the nominals meet is judged by itself.
constexpr double largest_gap_s = 1e-3;

/// When the flow ends; no value without a date, or beyond the calendar.
std::optional<Epoch> end_of(const io::StoredJet& jet) {
  if (!jet.ephemeris) return std::nullopt;
  const auto start = parse_epoch(jet.ephemeris->epoch);
  // Within a leap second there is nothing to count from.
  if (!start || start->is_within_leap_second()) return std::nullopt;
  return later(*start, Extended(jet.duration) * Extended(jet.units.time_s));
}

/// What dates and places are in, in words.
std::string frame_text(const EphemerisSettings& settings) {
  return fmt::format("{} about {} in {}", settings.reference_frame, settings.center_name,
                     settings.time_system);
}

}  // namespace

void require_dates_meeting(const io::StoredJet& first, const io::StoredJet& second) {
  if (!first.ephemeris || !second.ephemeris) return;
  const std::string frame = frame_text(*first.ephemeris);
  const std::string other = frame_text(*second.ephemeris);
  if (frame != other) {
    refuse(fmt::format("compose: the second jet is in {}, must be in the frame of the first, {}",
                       other, frame));
  }
  const auto end = end_of(first);
  const auto start = parse_epoch(second.ephemeris->epoch);
  if (!end || !start || std::abs(seconds_between(*end, *start)) <= largest_gap_s) return;
  refuse(fmt::format("compose: the second jet starts at {}, must start when the first ends, {}",
                     format_epoch(*start), format_epoch(*end)));
}

std::optional<EphemerisSettings> ephemeris_at_end(const io::StoredJet& jet) {
  const auto end = end_of(jet);
  if (!end) return std::nullopt;
  EphemerisSettings settings = *jet.ephemeris;
  settings.epoch = format_epoch(*end);
  return settings;
}

}  // namespace hamjet::python
