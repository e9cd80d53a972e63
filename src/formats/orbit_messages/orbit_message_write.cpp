#include <fmt/format.h>

#include <iterator>

#include "comment_lines.hpp"
#include "hamjet/formats/orbit_message.hpp"
#include "orbit_message_units.hpp"

namespace hamjet::io {
namespace {

void write_comments(std::back_insert_iterator<fmt::memory_buffer> out,
                    const std::vector<std::string>& comments) {
  for (const std::string& comment : comments) {
    for (const std::string_view line : comment_lines(comment)) {
      fmt::format_to(out, "COMMENT {}\n", line);
    }
  }
}

/// Writes the header, which both kinds of messages have.
template <class Message>
void write_header(std::back_insert_iterator<fmt::memory_buffer> out, std::string_view keyword,
                  const Message& message) {
  fmt::format_to(out, "{} = {}\n", keyword, message.version);
  write_comments(out, message.comments);
  fmt::format_to(out, "CREATION_DATE = {}\nORIGINATOR = {}\n", format_epoch(message.creation_date),
                 message.originator);
}

/// Writes object, centre, frame and time system, in the order of the standard.
void write_metadata(std::back_insert_iterator<fmt::memory_buffer> out,
                    const OrbitMetadata& metadata) {
  fmt::format_to(out,
                 "OBJECT_NAME = {}\n"
                 "OBJECT_ID = {}\n"
                 "CENTER_NAME = {}\n"
                 "REF_FRAME = {}\n",
                 metadata.object_name, metadata.object_id, metadata.center_name,
                 metadata.reference_frame);
  if (metadata.reference_frame_epoch) {
    fmt::format_to(out, "REF_FRAME_EPOCH = {}\n", format_epoch(*metadata.reference_frame_epoch));
  }
  fmt::format_to(out, "TIME_SYSTEM = {}\n", time_system_name(metadata.time_system));
}

void write_segment(std::back_insert_iterator<fmt::memory_buffer> out,
                   const EphemerisSegment& segment) {
  fmt::format_to(out, "META_START\n");
  write_metadata(out, segment.metadata);
  fmt::format_to(out, "START_TIME = {}\n", format_epoch(segment.states.front().epoch));
  if (segment.useable_start) {
    fmt::format_to(out, "USEABLE_START_TIME = {}\n", format_epoch(*segment.useable_start));
  }
  if (segment.useable_stop) {
    fmt::format_to(out, "USEABLE_STOP_TIME = {}\n", format_epoch(*segment.useable_stop));
  }
  fmt::format_to(out, "STOP_TIME = {}\nMETA_STOP\n\n", format_epoch(segment.states.back().epoch));
  write_comments(out, segment.comments);
  for (const OrbitState& state : segment.states) {
    fmt::format_to(out, "{}", format_epoch(state.epoch));
    for (const double x : state.position_km) fmt::format_to(out, " {:22.15e}", x);
    for (const double v : state.velocity_km_s) fmt::format_to(out, " {:22.15e}", v);
    fmt::format_to(out, "\n");
  }
}

}  // namespace

std::string oem_text(const OrbitEphemerisMessage& message) {
  fmt::memory_buffer buffer;
  const auto out = std::back_inserter(buffer);
  write_header(out, "CCSDS_OEM_VERS", message);
  for (const EphemerisSegment& segment : message.segments) {
    fmt::format_to(out, "\n");
    write_segment(out, segment);
  }
  return fmt::to_string(buffer);
}

std::string opm_text(const OrbitParameterMessage& message) {
  fmt::memory_buffer buffer;
  const auto out = std::back_inserter(buffer);
  write_header(out, "CCSDS_OPM_VERS", message);
  fmt::format_to(out, "\n");
  write_metadata(out, message.metadata);
  fmt::format_to(out, "\n");
  write_comments(out, message.state_comments);
  const OrbitState& state = message.state;
  fmt::format_to(out, "EPOCH = {}\n", format_epoch(state.epoch));
  constexpr std::string_view axes = "XYZ";
  for (std::size_t i = 0; i < 3; ++i) {
    fmt::format_to(out, "{} = {:.15e} [km]\n", axes[i], state.position_km[i]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    fmt::format_to(out, "{}_DOT = {:.15e} [km/s]\n", axes[i], state.velocity_km_s[i]);
  }
  for (const auto& [quantity, member] : spacecraft_quantities()) {
    const std::optional<double>& number = message.spacecraft.*member;
    if (!number) continue;
    const std::string unit = quantity.unit.empty() ? "" : fmt::format(" [{}]", quantity.unit);
    fmt::format_to(out, "{} = {:.15e}{}\n", quantity.keyword, *number, unit);
  }
  for (const OpmManoeuvre& one : message.manoeuvres) {
    fmt::format_to(out, "\nMAN_EPOCH_IGNITION = {}\n", format_epoch(one.ignition));
    fmt::format_to(out, "MAN_DURATION = {:.15e} [s]\n", one.duration_s);
    fmt::format_to(out, "MAN_DELTA_MASS = {:.15e} [kg]\n", one.mass_change_kg);
    fmt::format_to(out, "MAN_REF_FRAME = {}\n", one.reference_frame);
    for (std::size_t i = 0; i < 3; ++i) {
      fmt::format_to(out, "MAN_DV_{} = {:.15e} [km/s]\n", i + 1, one.change_km_s[i]);
    }
  }
  return fmt::to_string(buffer);
}

}  // namespace hamjet::io
