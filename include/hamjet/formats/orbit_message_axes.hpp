#pragma once

#include <memory>
#include <optional>
#include <string>

#include "hamjet/astronomy/earth_axes.hpp"
#include "hamjet/formats/conjunction_data_message.hpp"
#include "hamjet/formats/orbit_message.hpp"

// States and covariances of messages along other axes about the Earth.

namespace hamjet::io {

/// A reference frame as messages name it. Axes of date are those of each state's own moment, or of
/// `epoch` if that is there; it is in the time system of the states.
struct MessageFrame {
  std::string name;                 ///< REF_FRAME, in capitals
  std::optional<Epoch> epoch = {};  ///< REF_FRAME_EPOCH
};

/// Changes states of a span from one frame to another, each at its own moment.
class MessageFrameChange {
 public:
  /// Dates are in `system`. The table of orientation is needed for ITRF alone; without one see
  /// EarthOrientation::without_table. Throws Error(input_output), with a line of what is wrong, for
  /// a frame whose axes are not known about the Earth (see axes_named), for TEMEOFEPOCH without an
  /// epoch, for dates in UTC before 1960 and where the table does not have them.
  MessageFrameChange(const MessageFrame& from, const MessageFrame& to, TimeSystem system,
                     const Epoch& first, const Epoch& last,
                     const std::shared_ptr<const EarthOrientation>& orientation = nullptr);

  AxesChange at(const Epoch& epoch) const;
  OrbitState of(const OrbitState& state) const;
  /// A covariance of position and velocity along the axes of `from`.
  OrbitCovariance of(const OrbitCovariance& covariance) const;

 private:
  /// One of the two frames beside GCRF.
  struct Side {
    EarthAxes axes;
    std::optional<Instant> rests_at;  ///< the epoch at which axes of date are taken
    EarthAxesConversion conversion;
  };
  Side side_of(const MessageFrame& frame, bool is_first, const Epoch& first, const Epoch& last,
               const std::shared_ptr<const EarthOrientation>& orientation) const;

  TimeSystem system_;
  std::string to_;
  Side first_;
  Side second_;
  bool is_none_;  ///< both frames have the same axes
};

/// The states of a block along other axes, with their covariances, where these are told in the
/// frame of the states, and the metadata that say so. Throws as MessageFrameChange, and for a block
/// about another centre than the Earth.
EphemerisSegment in_frame(const EphemerisSegment& segment, const MessageFrame& frame,
                          const std::shared_ptr<const EarthOrientation>& orientation = nullptr);

/// The state of an OPM along other axes; otherwise as for a block. Its Keplerian elements, which
/// were told in the old axes, are left out.
OrbitParameterMessage in_frame(
    const OrbitParameterMessage& message, const MessageFrame& frame,
    const std::shared_ptr<const EarthOrientation>& orientation = nullptr);

/// The state of an object of a CDM at the time of closest approach; its covariance is along its own
/// R, T, N in any case.
ConjunctionObject in_frame(const ConjunctionObject& object, const Epoch& tca,
                           const std::string& frame,
                           const std::shared_ptr<const EarthOrientation>& orientation = nullptr);

}  // namespace hamjet::io
