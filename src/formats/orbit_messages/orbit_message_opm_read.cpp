#include <fmt/format.h>

#include <algorithm>

#include "orbit_message_lines.hpp"
#include "orbit_message_units.hpp"

namespace hamjet::io {
namespace {

std::vector<std::string_view> keywords_of(const std::vector<Quantity>& quantities) {
  std::vector<std::string_view> keywords;
  for (const Quantity& quantity : quantities) keywords.push_back(quantity.keyword);
  return keywords;
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
  add(state_quantities());
  for (const UnusedPart& part : unused_parts()) add(part.quantities);
  keywords.push_back("COV_REF_FRAME");
  return keywords;
}

/// The covariance; the standard demands either all 21 numbers or none.
std::optional<OrbitCovariance> covariance_of(const MessageBlock& block,
                                             const OrbitParameterMessage& message) {
  const std::vector<Quantity>& quantities = covariance_quantities();
  const auto first = std::find_if(quantities.begin(), quantities.end(),
                                  [&](const Quantity& q) { return block.has(q.keyword); });
  if (first == quantities.end()) return std::nullopt;
  OrbitCovariance covariance;
  covariance.epoch = message.state.epoch;
  covariance.reference_frame = block.has("COV_REF_FRAME") ? block.capitals("COV_REF_FRAME")
                                                          : message.metadata.reference_frame;
  covariance.line = block.line_of(first->keyword);
  std::size_t place = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j, ++place) {
      covariance.matrix[i][j] = covariance.matrix[j][i] =
          block.number(quantities[place].keyword, quantities[place].unit);
    }
  }
  return covariance;
}

/// Keplerian elements, if all six are present and valid. A fault in them is no reason to refuse the
/// state.
std::optional<OrbitElements> elements_of(const MessageBlock& block,
                                         std::vector<std::string>& doubts) {
  OrbitElements elements;
  bool is_whole = true;
  const auto read = [&](std::string_view keyword, std::string_view unit, double& value) {
    const auto number = block.unused_number(keyword, unit, doubts);
    value = number.value_or(0);
    is_whole = is_whole && number;
  };
  read("SEMI_MAJOR_AXIS", "km", elements.semi_major_axis_km);
  read("ECCENTRICITY", "", elements.eccentricity);
  read("INCLINATION", "deg", elements.inclination_deg);
  read("RA_OF_ASC_NODE", "deg", elements.ascending_node_deg);
  read("ARG_OF_PERICENTER", "deg", elements.argument_of_perigee_deg);
  elements.is_mean_anomaly = !block.has("TRUE_ANOMALY");
  read(elements.is_mean_anomaly ? "MEAN_ANOMALY" : "TRUE_ANOMALY", "deg", elements.anomaly_deg);
  if (!is_whole) return std::nullopt;
  elements.line = block.line_of("SEMI_MAJOR_AXIS");
  return elements;
}

}  // namespace

OrbitParameterMessage read_opm(const std::string& name, std::string_view text,
                               AcceptedFrames frames) {
  const std::vector<std::string_view> keywords = all_keywords();
  MessageLines lines(name, text, "opm");
  OrbitParameterMessage message;
  message.version = read_version(lines, "CCSDS_OPM_VERS", {"1.0", "2.0", "3.0"});
  MessageBlock block(lines);
  bool has_user_defined = false;
  for (MessageLine line; lines.next(line);) {
    if (line.keyword.starts_with("MAN_")) {
      lines.fail(line.number, line.keyword,
                 "a manoeuvre, got one behind the state, must be left out: the orbit coasts from "
                 "EPOCH, so that manoeuvres are not flown, and the motion would not be that of "
                 "the message");
    }
    // By the standard these keywords belong to an OEM only, but some programs write them.
    if (line.is("META_START") || line.is("META_STOP")) continue;
    if (line.is_assignment && line.keyword.starts_with("USER_DEFINED_")) {
      has_user_defined = true;
      continue;
    }
    block.add(line, keywords);
  }
  block.end_at(lines.number());
  message.creation_date = block.epoch("CREATION_DATE");
  message.originator = block.text("ORIGINATOR");
  message.metadata = block.metadata(frames);
  message.state.epoch = block.epoch("EPOCH");
  const std::vector<Quantity>& state_vector = state_quantities();
  for (std::size_t i = 0; i < 3; ++i) {
    message.state.position_km[i] = block.number(state_vector[i].keyword, state_vector[i].unit);
    message.state.velocity_km_s[i] =
        block.number(state_vector[3 + i].keyword, state_vector[3 + i].unit);
  }
  for (const UnusedPart& part : unused_parts()) {
    const bool is_there =
        std::any_of(part.quantities.begin(), part.quantities.end(),
                    [&](const Quantity& quantity) { return block.has(quantity.keyword); });
    if (is_there) message.unused.emplace_back(part.name);
  }
  for (const auto& [quantity, member] : spacecraft_quantities()) {
    message.spacecraft.*member =
        block.unused_number(quantity.keyword, quantity.unit, message.doubts);
  }
  message.elements = elements_of(block, message.doubts);
  message.covariance = covariance_of(block, message);
  if (block.has("GM")) {
    message.gm_km3_s2 = block.number("GM", "km**3/s**2");
    message.gm_line = block.line_of("GM");
  }
  if (has_user_defined) message.unused.emplace_back("user-defined parameters");
  return message;
}

}  // namespace hamjet::io
