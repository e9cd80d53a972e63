#include "hamjet/formats/orbit_message_axes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../../dynamics/celestial_bodies.hpp"
#include "../../text/scene_message.hpp"
#include "hamjet/error.hpp"

namespace hamjet::io {
namespace {

[[noreturn]] void refuse(const std::string& problem) {
  throw Error(ErrorKind::input_output, problem);
}

EarthAxes axes_of(const std::string& frame) {
  const auto axes = axes_named(frame);
  if (!axes) {
    refuse(
        fmt::format("REF_FRAME: axes that are not known here, got {}, must be one of: GCRF, "
                    "EME2000, MOD, TOD, TEME, CIRF, ITRF",
                    in_quotes(frame)));
  }
  return *axes;
}

Instant instant(const Epoch& epoch, TimeSystem system) {
  try {
    return instant_of(epoch, system);
  } catch (const Error& error) {
    refuse(error.what());
  }
}

void require_earth(const std::string& centre) {
  const CelestialBody* const body = body_named(centre);
  if (body != nullptr && body->name == "EARTH") return;
  refuse(fmt::format("CENTER_NAME: axes of the Earth about another centre, got {}, must be EARTH",
                     in_quotes(centre)));
}

bool is_of_date(EarthAxes axes) {
  return axes == EarthAxes::mod || axes == EarthAxes::tod || axes == EarthAxes::teme ||
         axes == EarthAxes::cirf;
}

MessageFrame frame_of(const OrbitMetadata& metadata) {
  return {metadata.reference_frame, metadata.reference_frame_epoch};
}

OrbitMetadata in_frame(OrbitMetadata metadata, const MessageFrame& frame) {
  metadata.reference_frame = frame.name;
  metadata.reference_frame_epoch = frame.epoch;
  return metadata;
}

}  // namespace

MessageFrameChange::MessageFrameChange(const MessageFrame& from, const MessageFrame& to,
                                       TimeSystem system, const Epoch& first, const Epoch& last,
                                       const std::shared_ptr<const EarthOrientation>& orientation)
    : system_(system),
      to_(to.name),
      first_(side_of(from, true, first, last, orientation)),
      second_(side_of(to, false, first, last, orientation)),
      is_none_(first_.axes == second_.axes && first_.rests_at == second_.rests_at) {}

MessageFrameChange::Side MessageFrameChange::side_of(
    const MessageFrame& frame, bool is_first, const Epoch& first, const Epoch& last,
    const std::shared_ptr<const EarthOrientation>& orientation) const {
  const EarthAxes axes = axes_of(frame.name);
  if (frame.name == "TEMEOFEPOCH" && !frame.epoch) {
    refuse("REF_FRAME_EPOCH: missing, must be the epoch of the axes TEMEOFEPOCH");
  }
  std::optional<Instant> rests_at;
  if (frame.epoch && is_of_date(axes)) rests_at = instant(*frame.epoch, system_);
  const Instant begin = rests_at ? *rests_at : instant(first, system_);
  const Instant end = rests_at ? *rests_at : instant(last, system_);
  const EarthAxes from = is_first ? axes : EarthAxes::gcrf;
  const EarthAxes to = is_first ? EarthAxes::gcrf : axes;
  try {
    return {axes, rests_at, EarthAxesConversion(from, to, begin, end, orientation)};
  } catch (const Error& error) {
    // TEME and the Earth's own axes need UTC, which begins in 1960.
    if (error.kind() == ErrorKind::usage) refuse(error.what());
    throw;
  }
}

AxesChange MessageFrameChange::at(const Epoch& epoch) const {
  if (is_none_) return {};
  const Instant moment = instant(epoch, system_);
  const auto of_side = [&](const Side& side) {
    return side.conversion.at(side.rests_at ? *side.rests_at : moment);
  };
  return of_side(first_).followed_by(of_side(second_));
}

OrbitState MessageFrameChange::of(const OrbitState& state) const {
  OrbitState result = state;
  Eigen::Map<Eigen::Vector3d> position(result.position_km.data());
  Eigen::Map<Eigen::Vector3d> velocity(result.velocity_km_s.data());
  at(state.epoch).apply(position, velocity);
  return result;
}

OrbitCovariance MessageFrameChange::of(const OrbitCovariance& covariance) const {
  using Rows = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  OrbitCovariance result = covariance;
  Eigen::Map<Rows> matrix(result.matrix[0].data());
  matrix = at(covariance.epoch).of_covariance(matrix);
  result.reference_frame = to_;
  return result;
}

EphemerisSegment in_frame(const EphemerisSegment& segment, const MessageFrame& frame,
                          const std::shared_ptr<const EarthOrientation>& orientation) {
  require_earth(segment.metadata.center_name);
  Epoch first = segment.states.front().epoch, last = segment.states.back().epoch;
  for (const OrbitCovariance& covariance : segment.covariances) {
    first = std::min(first, covariance.epoch);
    last = std::max(last, covariance.epoch);
  }
  const MessageFrameChange change(frame_of(segment.metadata), frame, segment.metadata.time_system,
                                  first, last, orientation);
  EphemerisSegment result = segment;
  for (OrbitState& state : result.states) state = change.of(state);
  for (OrbitCovariance& covariance : result.covariances) {
    if (covariance.reference_frame == segment.metadata.reference_frame) {
      covariance = change.of(covariance);
    }
  }
  result.metadata = in_frame(segment.metadata, frame);
  return result;
}

OrbitParameterMessage in_frame(const OrbitParameterMessage& message, const MessageFrame& frame,
                               const std::shared_ptr<const EarthOrientation>& orientation) {
  require_earth(message.metadata.center_name);
  const MessageFrameChange change(frame_of(message.metadata), frame, message.metadata.time_system,
                                  message.state.epoch, message.state.epoch, orientation);
  OrbitParameterMessage result = message;
  result.state = change.of(message.state);
  if (result.covariance && result.covariance->reference_frame == message.metadata.reference_frame) {
    result.covariance = change.of(*result.covariance);
  }
  result.elements.reset();
  result.metadata = in_frame(message.metadata, frame);
  return result;
}

ConjunctionObject in_frame(const ConjunctionObject& object, const Epoch& tca,
                           const std::string& frame,
                           const std::shared_ptr<const EarthOrientation>& orientation) {
  require_earth(object.orbit_center);
  const MessageFrameChange change({object.reference_frame}, {frame}, TimeSystem::utc, tca, tca,
                                  orientation);
  const OrbitState turned = change.of({tca, object.position_km, object.velocity_km_s});
  ConjunctionObject result = object;
  result.reference_frame = frame;
  result.position_km = turned.position_km;
  result.velocity_km_s = turned.velocity_km_s;
  return result;
}

}  // namespace hamjet::io
