#include <fmt/format.h>

#include <algorithm>

#include "../../text/scene_message.hpp"
#include "../number_table.hpp"
#include "orbit_message_lines.hpp"

namespace hamjet::io {
namespace {

const std::vector<std::string_view> header_keywords = {"CLASSIFICATION", "CREATION_DATE",
                                                       "ORIGINATOR", "MESSAGE_ID"};
const std::vector<std::string_view> metadata_keywords = {
    "OBJECT_NAME",       "OBJECT_ID",   "CENTER_NAME",   "REF_FRAME",
    "REF_FRAME_EPOCH",   "TIME_SYSTEM", "START_TIME",    "USEABLE_START_TIME",
    "USEABLE_STOP_TIME", "STOP_TIME",   "INTERPOLATION", "INTERPOLATION_DEGREE"};
const std::vector<std::string_view> covariance_keywords = {"EPOCH", "COV_REF_FRAME"};

void split_at_blanks(std::string_view text, std::vector<std::string_view>& fields) {
  fields.clear();
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(blanks), text.size());
    if (end > 0) fields.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

class OemReader {
 public:
  OemReader(const std::string& name, std::string_view text, AcceptedFrames frames)
      : lines_(name, text, "oem"), frames_(frames) {}

  OrbitEphemerisMessage read() {
    OrbitEphemerisMessage message;
    message.version = read_version(lines_, "CCSDS_OEM_VERS", {"1.0", "2.0", "3.0"});
    advance();
    read_header(message);
    while (has_line_) {
      message.segments.push_back(read_segment());
      const TimeSystem first = message.segments.front().metadata.time_system;
      if (message.segments.back().metadata.time_system != first) {
        lines_.fail(message.segments.back().line, "TIME_SYSTEM",
                    fmt::format("changes, got another one than in the first block, must be {} in "
                                "all of them",
                                time_system_name(first)));
      }
    }
    return message;
  }

 private:
  void advance() { has_line_ = lines_.next(line_); }

  /// Reads the header, up to the first block of metadata.
  void read_header(OrbitEphemerisMessage& message) {
    MessageBlock header(lines_);
    for (; has_line_ && !line_.is("META_START"); advance()) header.add(line_, header_keywords);
    header.end_at(lines_.number());
    message.creation_date = header.epoch("CREATION_DATE");
    message.originator = header.text("ORIGINATOR");
    if (!has_line_) lines_.fail(lines_.number(), "META_START", missing_block);
  }

  EphemerisSegment read_segment() {
    EphemerisSegment segment;
    segment.line = line_.number;
    if (!line_.is("META_START")) {
      lines_.fail(line_.number, "META_START",
                  fmt::format("missing, got {}, must begin a block of metadata here",
                              in_quotes(line_.text)));
    }
    advance();
    read_metadata(segment);
    read_states(segment);
    if (has_line_ && line_.is("COVARIANCE_START")) {
      read_covariances(segment);
      segment.has_covariance = true;
    }
    return segment;
  }

  void read_metadata(EphemerisSegment& segment) {
    MessageBlock block(lines_);
    for (; !line_.is("META_STOP"); advance()) {
      if (!has_line_ || line_.is("META_START") || starts_with_digit()) {
        lines_.fail(
            lines_.number(), "META_STOP",
            fmt::format("missing, got {}, must end the metadata that begin in line {}",
                        has_line_ ? in_quotes(line_.text) : "the end of the file", segment.line));
      }
      block.add(line_, metadata_keywords);
    }
    block.end_at(line_.number);
    segment.metadata = block.metadata(frames_);
    start_ = block.epoch("START_TIME");
    stop_ = block.epoch("STOP_TIME");
    if (stop_ < start_) {
      block.fail("STOP_TIME", fmt::format("before START_TIME, got {}, must be {} or later",
                                          block.text("STOP_TIME"), block.text("START_TIME")));
    }
    if (block.has("USEABLE_START_TIME")) segment.useable_start = block.epoch("USEABLE_START_TIME");
    if (block.has("USEABLE_STOP_TIME")) segment.useable_stop = block.epoch("USEABLE_STOP_TIME");
    advance();
  }

  void read_states(EphemerisSegment& segment) {
    for (; has_line_ && !line_.is("META_START") && !line_.is("COVARIANCE_START"); advance()) {
      const OrbitState state = read_state();
      if (!segment.states.empty() && !(segment.states.back().epoch < state.epoch)) {
        lines_.fail(line_.number, "",
                    fmt::format("epochs out of order, got {}, must be after {}", fields_[0],
                                format_epoch(segment.states.back().epoch)));
      }
      segment.states.push_back(state);
      segment.has_acceleration |= fields_.size() > 7;
    }
    if (segment.states.empty()) {
      lines_.fail(
          lines_.number(), "",
          fmt::format("no states, got {}, must be lines of an epoch, a position and a "
                      "velocity after the metadata that begin in line {}",
                      has_line_ ? in_quotes(line_.text) : "the end of the file", segment.line));
    }
  }

  OrbitState read_state() {
    split_at_blanks(line_.text, fields_);
    OrbitState state;
    const auto epoch = parse_epoch(fields_[0]);
    if (!epoch) {
      lines_.fail(line_.number, "",
                  fmt::format("no line of states, got {} at its start, must be {}",
                              in_quotes(fields_[0]), epoch_form));
    }
    state.epoch = *epoch;
    if (state.epoch < start_ || stop_ < state.epoch) {
      lines_.fail(line_.number, "",
                  fmt::format("an epoch outside of the span, got {}, must be from START_TIME {} to "
                              "STOP_TIME {}",
                              fields_[0], format_epoch(start_), format_epoch(stop_)));
    }
    if (fields_.size() != 7 && fields_.size() != 10) {
      lines_.fail(line_.number, "",
                  fmt::format("wrong length, got {} numbers behind the epoch, must be 6, position "
                              "in km and velocity in km/s, or 9 with the acceleration",
                              fields_.size() - 1));
    }
    for (std::size_t i = 1; i < fields_.size(); ++i) {
      const double number = number_at(i);
      if (i <= 3) state.position_km[i - 1] = number;
      if (i > 3 && i <= 6) state.velocity_km_s[i - 4] = number;
    }
    return state;
  }

  double number_at(std::size_t i) const {
    const auto number = finite_number(fields_[i]);
    if (!number) {
      lines_.fail(line_.number, "",
                  fmt::format("no number, got {}, must be a finite number", in_quotes(fields_[i])));
    }
    return *number;
  }

  /// Reads covariances. Each has an epoch, its frame if that differs from the frame of the states,
  /// and the six rows of a lower triangle.
  void read_covariances(EphemerisSegment& segment) {
    const std::size_t begin = line_.number;
    std::optional<OrbitCovariance> covariance;
    std::size_t row = 0;
    const auto require_whole = [&] {
      if (!covariance || row == 6) return;
      lines_.fail(line_.number, "",
                  fmt::format("a covariance of {} rows, got {}, must be 6 rows behind its EPOCH",
                              row, in_quotes(line_.text)));
    };
    const auto keep = [&] {
      require_whole();
      if (covariance) segment.covariances.push_back(*covariance);
    };
    for (advance(); !line_.is("COVARIANCE_STOP"); advance()) {
      if (!has_line_ || line_.is("META_START")) {
        lines_.fail(lines_.number(), "COVARIANCE_STOP",
                    fmt::format("missing, got {}, must end the covariances that begin in line {}",
                                has_line_ ? in_quotes(line_.text) : "the end of the file", begin));
      }
      if (line_.is_assignment) {
        MessageBlock statement(lines_);
        statement.add(line_, covariance_keywords);
        if (line_.keyword == "EPOCH") {
          keep();
          OrbitCovariance next;
          next.epoch = statement.epoch("EPOCH");
          next.reference_frame = segment.metadata.reference_frame;
          covariance = next;
          row = 0;
        } else if (covariance && row == 0) {
          covariance->reference_frame = statement.capitals("COV_REF_FRAME");
        } else {
          statement.fail("COV_REF_FRAME",
                         "out of order, got one that does not follow an EPOCH, "
                         "must stand between EPOCH and the first row");
        }
        continue;
      }
      split_at_blanks(line_.text, fields_);
      if (fields_.size() > 6) {
        lines_.fail(line_.number, "",
                    fmt::format("wrong length, got {} numbers, must be a row of a covariance, at "
                                "most 6",
                                fields_.size()));
      }
      if (!covariance) {
        lines_.fail(line_.number, "EPOCH",
                    "missing, got a row of a covariance before it, must be "
                    "the epoch of the covariance");
      }
      if (row == 6 || fields_.size() != row + 1) {
        lines_.fail(line_.number, "",
                    fmt::format("wrong length, got {} numbers in row {} of a covariance, must be "
                                "{}",
                                fields_.size(), row + 1,
                                row == 6 ? "COVARIANCE_STOP or the next EPOCH"
                                         : fmt::format("{}, of a lower triangle", row + 1)));
      }
      if (row == 0) covariance->line = line_.number;
      for (std::size_t i = 0; i < fields_.size(); ++i) {
        covariance->matrix[row][i] = covariance->matrix[i][row] = number_at(i);
      }
      ++row;
    }
    keep();
    advance();
  }

  bool starts_with_digit() const { return line_.text[0] >= '0' && line_.text[0] <= '9'; }

  static constexpr const char* missing_block =
      "missing, got the end of the file, must begin a block of metadata";

  MessageLines lines_;
  AcceptedFrames frames_;
  MessageLine line_;
  bool has_line_ = false;
  Epoch start_;  ///< start of the block that is being read
  Epoch stop_;
  std::vector<std::string_view> fields_;
};

}  // namespace

OrbitEphemerisMessage read_oem(const std::string& name, std::string_view text,
                               AcceptedFrames frames) {
  return OemReader(name, text, frames).read();
}

}  // namespace hamjet::io
