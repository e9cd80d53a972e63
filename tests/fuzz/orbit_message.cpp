#include "hamjet/formats/orbit_message.hpp"

#include "fuzz_target.hpp"
#include "hamjet/formats/conjunction_data_message.hpp"

// Target: orbit messages, read as an ephemeris, as parameters and as a
// conjunction. What is read is finite and in
// order, and is read again from what is written of it.

namespace hamjet::fuzz {
namespace {

void check(const io::OrbitState& state) {
  require_finite({state.position_km.begin(), state.position_km.end()}, "position");
  require_finite({state.velocity_km_s.begin(), state.velocity_km_s.end()}, "velocity");
  require(parse_epoch(format_epoch(state.epoch)) == state.epoch, "an epoch changes");
}

void check(const io::OrbitEphemerisMessage& message) {
  require(!message.segments.empty(), "no segment");
  for (const io::EphemerisSegment& segment : message.segments) {
    require(!segment.states.empty(), "no states");
    for (const io::OrbitState& state : segment.states) check(state);
    for (std::size_t i = 1; i < segment.states.size(); ++i) {
      require(segment.states[i - 1].epoch < segment.states[i].epoch, "epochs out of order");
    }
  }
  const std::string text = io::oem_text(message);
  require(
      io::oem_text(io::read_oem("again.oem", text, io::AcceptedFrames::terrestrial_too)) == text,
      "written again it is another");
}

/// Doubts about numbers that are not used have the form of errors.
void check_doubts(const std::vector<std::string>& doubts) {
  for (const std::string& doubt : doubts) {
    require(doubt.starts_with("orbit:") || doubt.starts_with("again."), "a doubt without a place");
    require(doubt.find_first_of("\n\r\x1b") == std::string::npos, "a doubt of several lines");
  }
}

void check(const io::OrbitParameterMessage& message) {
  check(message.state);
  check_doubts(message.doubts);
  if (!message.elements) return;
  require_finite({message.elements->semi_major_axis_km, message.elements->eccentricity,
                  message.elements->anomaly_deg},
                 "elements");
}

void check(const io::ConjunctionDataMessage& message) {
  check_doubts(message.doubts);
  for (const io::ConjunctionObject& object : message.objects) {
    check(io::OrbitState{message.tca, object.position_km, object.velocity_km_s});
    for (const auto& row : object.covariance)
      require_finite({row.begin(), row.end()}, "covariance");
  }
  const std::string text = io::cdm_text(message);
  require(io::cdm_text(io::read_cdm("again.cdm", text)) == text, "written again it is another");
}

}  // namespace
}  // namespace hamjet::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hamjet;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const fuzz::Refusal refusal = {{ErrorKind::input_output}, {"orbit:"}};
  fuzz::is_read(
      [&] { fuzz::check(io::read_oem("orbit", text, io::AcceptedFrames::terrestrial_too)); },
      refusal);
  fuzz::is_read(
      [&] { fuzz::check(io::read_opm("orbit", text, io::AcceptedFrames::terrestrial_too)); },
      refusal);
  fuzz::is_read([&] { fuzz::check(io::read_cdm("orbit", text)); }, refusal);
  return 0;
}
