#include <fmt/format.h>

#include <algorithm>

#include "orbit_message_lines.hpp"

namespace hamjet::io {
namespace {

/// Keywords that are numbers, with their units (CCSDS 502.0-B-3, table 3-3).
struct Quantity {
  std::string_view keyword;
  std::string_view unit;
};

/// A part of the message that is checked and not used.
struct UnusedPart {
  std::string_view name;
  std::vector<Quantity> quantities;
};

const std::vector<Quantity> state_vector = {
    {"X", "km"}, {"Y", "km"}, {"Z", "km"}, {"X_DOT", "km/s"}, {"Y_DOT", "km/s"}, {"Z_DOT", "km/s"}};

std::vector<std::string_view> keywords_of(const std::vector<Quantity>& quantities) {
  std::vector<std::string_view> keywords;
  for (const Quantity& quantity : quantities) keywords.push_back(quantity.keyword);
  return keywords;
}

const std::vector<UnusedPart>& unused_parts() {
  static const std::vector<UnusedPart> parts = {{"Keplerian elements",
                                                 {{"SEMI_MAJOR_AXIS", "km"},
                                                  {"ECCENTRICITY", ""},
                                                  {"INCLINATION", "deg"},
                                                  {"RA_OF_ASC_NODE", "deg"},
                                                  {"ARG_OF_PERICENTER", "deg"},
                                                  {"TRUE_ANOMALY", "deg"},
                                                  {"MEAN_ANOMALY", "deg"},
                                                  {"GM", "km**3/s**2"}}},
                                                {"spacecraft parameters",
                                                 {{"MASS", "kg"},
                                                  {"SOLAR_RAD_AREA", "m**2"},
                                                  {"SOLAR_RAD_COEFF", ""},
                                                  {"DRAG_AREA", "m**2"},
                                                  {"DRAG_COEFF", ""}}},
                                                {"covariance",
                                                 {{"CX_X", "km**2"},
                                                  {"CY_X", "km**2"},
                                                  {"CY_Y", "km**2"},
                                                  {"CZ_X", "km**2"},
                                                  {"CZ_Y", "km**2"},
                                                  {"CZ_Z", "km**2"},
                                                  {"CX_DOT_X", "km**2/s"},
                                                  {"CX_DOT_Y", "km**2/s"},
                                                  {"CX_DOT_Z", "km**2/s"},
                                                  {"CX_DOT_X_DOT", "km**2/s**2"},
                                                  {"CY_DOT_X", "km**2/s"},
                                                  {"CY_DOT_Y", "km**2/s"},
                                                  {"CY_DOT_Z", "km**2/s"},
                                                  {"CY_DOT_X_DOT", "km**2/s**2"},
                                                  {"CY_DOT_Y_DOT", "km**2/s**2"},
                                                  {"CZ_DOT_X", "km**2/s"},
                                                  {"CZ_DOT_Y", "km**2/s"},
                                                  {"CZ_DOT_Z", "km**2/s"},
                                                  {"CZ_DOT_X_DOT", "km**2/s**2"},
                                                  {"CZ_DOT_Y_DOT", "km**2/s**2"},
                                                  {"CZ_DOT_Z_DOT", "km**2/s**2"}}}};
  return parts;
}

std::vector<std::string_view> all_keywords() {
  std::vector<std::string_view> keywords = {"CLASSIFICATION", "CREATION_DATE", "ORIGINATOR",
                                            "MESSAGE_ID",     "OBJECT_NAME",   "OBJECT_ID",
                                            "CENTER_NAME",    "REF_FRAME",     "REF_FRAME_EPOCH",
                                            "TIME_SYSTEM",    "EPOCH"};
  const auto add = [&](const std::vector<Quantity>& quantities) {
    const auto more = keywords_of(quantities);
    keywords.insert(keywords.end(), more.begin(), more.end());
  };
  add(state_vector);
  for (const UnusedPart& part : unused_parts()) add(part.quantities);
  keywords.push_back("COV_REF_FRAME");
  return keywords;
}

}  // namespace

OrbitParameterMessage read_opm(const std::string& name, std::string_view text) {
  const std::vector<std::string_view> keywords = all_keywords();
  MessageLines lines(name, text);
  OrbitParameterMessage message;
  message.version = read_version(lines, "CCSDS_OPM_VERS", {"2.0", "3.0"});
  MessageBlock block(lines);
  bool has_user_defined = false;
  for (MessageLine line; lines.next(line);) {
    if (line.keyword.starts_with("MAN_")) {
      lines.fail(line.number, line.keyword,
                 "a manoeuvre, got one behind the state, must be left out: manoeuvres are not "
                 "flown, and the motion would not be that of the message");
    }
    if (line.is_assignment && line.keyword.starts_with("USER_DEFINED_")) {
      has_user_defined = true;
      continue;
    }
    block.add(line, keywords);
  }
  block.end_at(lines.number());
  message.creation_date = block.epoch("CREATION_DATE");
  message.originator = block.text("ORIGINATOR");
  message.metadata = block.metadata();
  message.state.epoch = block.epoch("EPOCH");
  for (std::size_t i = 0; i < 3; ++i) {
    message.state.position_km[i] = block.number(state_vector[i].keyword, state_vector[i].unit);
    message.state.velocity_km_s[i] =
        block.number(state_vector[3 + i].keyword, state_vector[3 + i].unit);
  }
  for (const UnusedPart& part : unused_parts()) {
    bool is_there = false;
    for (const Quantity& quantity : part.quantities) {
      if (!block.has(quantity.keyword)) continue;
      block.number(quantity.keyword, quantity.unit);
      is_there = true;
    }
    if (is_there) message.unused.emplace_back(part.name);
  }
  if (block.has("GM")) {
    message.gm_km3_s2 = block.number("GM", "km**3/s**2");
    message.gm_line = block.line_of("GM");
  }
  if (has_user_defined) message.unused.emplace_back("user-defined parameters");
  return message;
}

}  // namespace hamjet::io
