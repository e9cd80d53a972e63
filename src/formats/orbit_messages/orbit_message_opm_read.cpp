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

constexpr std::string_view ignition_keyword = "MAN_EPOCH_IGNITION";

/// The manoeuvre of a block; the standard demands all of its keywords.
OpmManoeuvre manoeuvre_of(const MessageBlock& block) {
  OpmManoeuvre manoeuvre;
  manoeuvre.ignition = block.epoch(ignition_keyword);
  manoeuvre.line = block.line_of(ignition_keyword);
  const std::vector<Quantity>& numbers = manoeuvre_quantities();
  const auto number = [&](std::size_t k) {
    return block.number(numbers[k].keyword, numbers[k].unit);
  };
  manoeuvre.duration_s = number(0);
  if (manoeuvre.duration_s < 0) {
    block.fail(numbers[0].keyword, fmt::format("a burn that ends before it begins, got {:.6g} s, "
                                               "must be 0, for an impulse, or positive",
                                               manoeuvre.duration_s));
  }
  manoeuvre.mass_change_kg = number(1);
  if (manoeuvre.mass_change_kg > 0) {
    block.fail(numbers[1].keyword, fmt::format("a mass that grows, got {:.6g} kg, must be 0 or "
                                               "negative",
                                               manoeuvre.mass_change_kg));
  }
  manoeuvre.reference_frame = block.capitals("MAN_REF_FRAME");
  if (!is_orbital_frame(manoeuvre.reference_frame) &&
      !is_inertial_frame(manoeuvre.reference_frame)) {
    block.fail("MAN_REF_FRAME",
               fmt::format("axes along which no thrust is flown, got \"{}\", must be RTN, RSW, TNW "
                           "or a frame whose axes keep their direction",
                           manoeuvre.reference_frame));
  }
  for (std::size_t i = 0; i < 3; ++i) manoeuvre.change_km_s[i] = number(2 + i);
  return manoeuvre;
}

/// The blocks of manoeuvres, each of which its ignition begins.
class ManoeuvreBlocks {
 public:
  explicit ManoeuvreBlocks(const MessageLines& lines) : lines_(lines) {
    keywords_ = keywords_of(manoeuvre_quantities());
    keywords_.push_back(ignition_keyword);
    keywords_.push_back("MAN_REF_FRAME");
  }

  void add(const MessageLine& line) {
    if (blocks_.empty() || line.keyword == ignition_keyword) {
      if (!blocks_.empty()) blocks_.back().end_at(line.number);
      blocks_.emplace_back(lines_);
    }
    blocks_.back().add(line, keywords_);
  }

  std::vector<OpmManoeuvre> manoeuvres() {
    std::vector<OpmManoeuvre> result;
    if (!blocks_.empty()) blocks_.back().end_at(lines_.number());
    for (const MessageBlock& block : blocks_) result.push_back(manoeuvre_of(block));
    return result;
  }

 private:
  const MessageLines& lines_;
  std::vector<std::string_view> keywords_;
  std::vector<MessageBlock> blocks_;
};

}  // namespace

OrbitParameterMessage read_opm(const std::string& name, std::string_view text,
                               AcceptedFrames frames) {
  const std::vector<std::string_view> keywords = all_keywords();
  MessageLines lines(name, text, "opm");
  OrbitParameterMessage message;
  message.version = read_version(lines, "CCSDS_OPM_VERS", {"1.0", "2.0", "3.0"});
  MessageBlock block(lines);
  ManoeuvreBlocks manoeuvres(lines);
  bool has_user_defined = false;
  for (MessageLine line; lines.next(line);) {
    if (line.is_assignment && line.keyword.starts_with("MAN_")) {
      manoeuvres.add(line);
      continue;
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
  message.manoeuvres = manoeuvres.manoeuvres();
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
