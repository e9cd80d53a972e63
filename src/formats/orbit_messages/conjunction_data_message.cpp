#include "hamjet/formats/conjunction_data_message.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../../text/scene_message.hpp"
#include "comment_lines.hpp"
#include "orbit_message_lines.hpp"
#include "orbit_message_units.hpp"

namespace hamjet::io {
namespace {

using Keywords = std::vector<std::string_view>;

constexpr std::string_view cdm_version_keyword = "CCSDS_CDM_VERS";

/// Keywords before the first object (tables 3-1 and 3-2).
const Keywords head_keywords = {"CREATION_DATE",
                                "ORIGINATOR",
                                "MESSAGE_FOR",
                                "MESSAGE_ID",
                                "TCA",
                                "MISS_DISTANCE",
                                "RELATIVE_SPEED",
                                "RELATIVE_POSITION_R",
                                "RELATIVE_POSITION_T",
                                "RELATIVE_POSITION_N",
                                "RELATIVE_VELOCITY_R",
                                "RELATIVE_VELOCITY_T",
                                "RELATIVE_VELOCITY_N",
                                "START_SCREEN_PERIOD",
                                "STOP_SCREEN_PERIOD",
                                "SCREEN_VOLUME_FRAME",
                                "SCREEN_VOLUME_SHAPE",
                                "SCREEN_VOLUME_X",
                                "SCREEN_VOLUME_Y",
                                "SCREEN_VOLUME_Z",
                                "SCREEN_ENTRY_TIME",
                                "SCREEN_EXIT_TIME",
                                "COLLISION_PROBABILITY",
                                "COLLISION_PROBABILITY_METHOD"};

/// Keywords of an object (tables 3-3 and 3-4), without state and covariance.
const Keywords other_object_keywords = {"OBJECT",
                                        "OBJECT_DESIGNATOR",
                                        "CATALOG_NAME",
                                        "OBJECT_NAME",
                                        "INTERNATIONAL_DESIGNATOR",
                                        "OBJECT_TYPE",
                                        "OPERATOR_CONTACT_POSITION",
                                        "OPERATOR_ORGANIZATION",
                                        "OPERATOR_PHONE",
                                        "OPERATOR_EMAIL",
                                        "EPHEMERIS_NAME",
                                        "COVARIANCE_METHOD",
                                        "MANEUVERABLE",
                                        "ORBIT_CENTER",
                                        "REF_FRAME",
                                        "GRAVITY_MODEL",
                                        "ATMOSPHERIC_MODEL",
                                        "N_BODY_PERTURBATIONS",
                                        "SOLAR_RAD_PRESSURE",
                                        "EARTH_TIDES",
                                        "INTRACK_THRUST",
                                        "TIME_LASTOB_START",
                                        "TIME_LASTOB_END",
                                        "RECOMMENDED_OD_SPAN",
                                        "ACTUAL_OD_SPAN",
                                        "OBS_AVAILABLE",
                                        "OBS_USED",
                                        "TRACKS_AVAILABLE",
                                        "TRACKS_USED",
                                        "RESIDUALS_ACCEPTED",
                                        "WEIGHTED_RMS",
                                        "THRUST_ACCELERATION",
                                        "SEDR"};

/// The numbers of the covariance of position and velocity, row by row of its lower triangle.
struct CovarianceKeyword {
  std::string keyword;
  std::string_view unit;
};
const std::vector<CovarianceKeyword>& covariance_keywords_of_cdm() {
  static const std::vector<CovarianceKeyword> keywords = [] {
    const Keywords names = {"R", "T", "N", "RDOT", "TDOT", "NDOT"};
    std::vector<CovarianceKeyword> result;
    for (std::size_t i = 0; i < names.size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        const std::size_t velocities = (i >= 3 ? 1 : 0) + (j >= 3 ? 1 : 0);
        result.push_back({fmt::format("C{}_{}", names[i], names[j]), velocities == 0 ? "m**2"
                                                                     : velocities == 1
                                                                         ? "m**2/s"
                                                                         : "m**2/s**2"});
      }
    }
    return result;
  }();
  return keywords;
}

/// A number of an object by which air and light act on it (table 3-4).
struct SurfaceKeyword {
  std::string_view keyword;
  std::string_view unit;
  std::optional<double> ConjunctionSpacecraft::*member;
};
constexpr std::array<SurfaceKeyword, 6> surface_keywords = {
    {{"AREA_PC", "m**2", &ConjunctionSpacecraft::visible_area_m2},
     {"AREA_DRG", "m**2", &ConjunctionSpacecraft::drag_area_m2},
     {"AREA_SRP", "m**2", &ConjunctionSpacecraft::radiation_area_m2},
     {"MASS", "kg", &ConjunctionSpacecraft::mass_kg},
     {"CD_AREA_OVER_MASS", "m**2/kg", &ConjunctionSpacecraft::drag_m2_kg},
     {"CR_AREA_OVER_MASS", "m**2/kg", &ConjunctionSpacecraft::radiation_m2_kg}}};

/// The rows of the covariance that belong to C_D A / m and C_R A / m.
constexpr std::array<Quantity, 7> drag_row = {{{"CDRG_R", "m**3/kg"},
                                               {"CDRG_T", "m**3/kg"},
                                               {"CDRG_N", "m**3/kg"},
                                               {"CDRG_RDOT", "m**3/(kg*s)"},
                                               {"CDRG_TDOT", "m**3/(kg*s)"},
                                               {"CDRG_NDOT", "m**3/(kg*s)"},
                                               {"CDRG_DRG", "m**4/kg**2"}}};
constexpr std::array<Quantity, 8> radiation_row = {{{"CSRP_R", "m**3/kg"},
                                                    {"CSRP_T", "m**3/kg"},
                                                    {"CSRP_N", "m**3/kg"},
                                                    {"CSRP_RDOT", "m**3/(kg*s)"},
                                                    {"CSRP_TDOT", "m**3/(kg*s)"},
                                                    {"CSRP_NDOT", "m**3/(kg*s)"},
                                                    {"CSRP_DRG", "m**4/kg**2"},
                                                    {"CSRP_SRP", "m**4/kg**2"}}};

const Keywords& object_keywords() {
  static const Keywords keywords = [] {
    Keywords result = other_object_keywords;
    for (const Quantity& quantity : state_quantities()) result.push_back(quantity.keyword);
    for (const CovarianceKeyword& keyword : covariance_keywords_of_cdm()) {
      result.push_back(keyword.keyword);
    }
    for (const SurfaceKeyword& keyword : surface_keywords) result.push_back(keyword.keyword);
    for (const Quantity& quantity : drag_row) result.push_back(quantity.keyword);
    for (const Quantity& quantity : radiation_row) result.push_back(quantity.keyword);
    for (const std::string_view more : {"CTHR_R", "CTHR_T", "CTHR_N", "CTHR_RDOT", "CTHR_TDOT",
                                        "CTHR_NDOT", "CTHR_DRG", "CTHR_SRP", "CTHR_THR"}) {
      result.push_back(more);
    }
    return result;
  }();
  return keywords;
}

/// A row of the covariance; no value where it is not there as a whole.
template <std::size_t count>
std::optional<std::array<double, count>> row_of(const MessageBlock& block,
                                                const std::array<Quantity, count>& row,
                                                std::vector<std::string>& doubts) {
  std::array<double, count> numbers{};
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = block.unused_number(row[i].keyword, row[i].unit, doubts);
    if (!number) return std::nullopt;
    numbers[i] = *number;
  }
  return numbers;
}

ConjunctionObject object_of(const MessageBlock& block, std::vector<std::string>& doubts) {
  ConjunctionObject object;
  object.object_designator = block.text("OBJECT_DESIGNATOR");
  object.catalog_name = block.text("CATALOG_NAME");
  object.object_name = block.text("OBJECT_NAME");
  object.international_designator = block.text("INTERNATIONAL_DESIGNATOR");
  object.ephemeris_name = block.text("EPHEMERIS_NAME");
  object.covariance_method = block.text("COVARIANCE_METHOD");
  object.maneuverable = block.text("MANEUVERABLE");
  if (block.has("ORBIT_CENTER")) object.orbit_center = block.capitals("ORBIT_CENTER");
  object.reference_frame = block.capitals("REF_FRAME");
  if (object.reference_frame == "J2000") object.reference_frame = "EME2000";
  const Keywords frames = {"GCRF", "EME2000", "ITRF"};
  if (std::find(frames.begin(), frames.end(), object.reference_frame) == frames.end()) {
    block.fail("REF_FRAME", fmt::format("unknown reference frame, got {}, must be one of: {}",
                                        in_quotes(object.reference_frame), listed(frames)));
  }
  const std::vector<Quantity>& state = state_quantities();
  for (std::size_t i = 0; i < 3; ++i) {
    object.position_km[i] = block.number(state[i].keyword, state[i].unit);
    object.velocity_km_s[i] = block.number(state[3 + i].keyword, state[3 + i].unit);
  }
  std::size_t place = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j, ++place) {
      const CovarianceKeyword& of = covariance_keywords_of_cdm()[place];
      object.covariance[i][j] = object.covariance[j][i] = block.number(of.keyword, of.unit);
    }
  }
  object.covariance_line = block.line_of("CR_R");
  for (const SurfaceKeyword& one : surface_keywords) {
    object.spacecraft.*one.member = block.unused_number(one.keyword, one.unit, doubts);
  }
  object.spacecraft.drag_covariance = row_of(block, drag_row, doubts);
  object.spacecraft.radiation_covariance = row_of(block, radiation_row, doubts);
  return object;
}

std::optional<std::array<double, 3>> three_numbers(const MessageBlock& head,
                                                   const std::string& keyword,
                                                   std::string_view unit,
                                                   std::vector<std::string>& doubts) {
  const auto R = head.unused_number(keyword + "_R", unit, doubts);
  const auto T = head.unused_number(keyword + "_T", unit, doubts);
  const auto N = head.unused_number(keyword + "_N", unit, doubts);
  if (!R || !T || !N) return std::nullopt;
  return std::array<double, 3>{*R, *T, *N};
}

}  // namespace

bool is_cdm(std::string_view text) { return text.find(cdm_version_keyword) != text.npos; }

ConjunctionDataMessage read_cdm(const std::string& name, std::string_view text) {
  MessageLines lines(name, text, "cdm");
  read_version(lines, cdm_version_keyword, {"1.0"});
  MessageBlock head(lines);
  MessageLine line;
  bool has_line = lines.next(line);
  for (; has_line && line.keyword != "OBJECT"; has_line = lines.next(line)) {
    head.add(line, head_keywords);
  }
  head.end_at(lines.number());
  ConjunctionDataMessage message;
  message.creation_date = head.epoch("CREATION_DATE");
  message.originator = head.text("ORIGINATOR");
  message.message_id = head.text("MESSAGE_ID");
  message.tca = head.epoch("TCA");
  message.miss_distance_m = head.number("MISS_DISTANCE", "m");
  message.relative_speed_m_s = head.unused_number("RELATIVE_SPEED", "m/s", message.doubts);
  message.relative_position_m = three_numbers(head, "RELATIVE_POSITION", "m", message.doubts);
  message.relative_velocity_m_s = three_numbers(head, "RELATIVE_VELOCITY", "m/s", message.doubts);
  message.collision_probability = head.unused_number("COLLISION_PROBABILITY", "", message.doubts);
  if (message.collision_probability &&
      !(*message.collision_probability >= 0 && *message.collision_probability <= 1)) {
    message.doubts.push_back(
        fmt::format("{}:{}: COLLISION_PROBABILITY: no probability, got {}, must be from 0 to 1; it "
                    "is not used",
                    name, head.line_of("COLLISION_PROBABILITY"), *message.collision_probability));
    message.collision_probability.reset();
  }
  if (head.has("COLLISION_PROBABILITY_METHOD")) {
    message.collision_probability_method = head.text("COLLISION_PROBABILITY_METHOD");
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const std::string wanted = fmt::format("OBJECT{}", k + 1);
    if (!has_line || line.value != wanted) {
      lines.fail(has_line ? line.number : lines.number(), "OBJECT",
                 fmt::format("missing, got {}, must be {} here",
                             has_line ? in_quotes(line.value) : "the end of the file", wanted));
    }
    MessageBlock block(lines);
    do {
      block.add(line, object_keywords());
      has_line = lines.next(line);
    } while (has_line && line.keyword != "OBJECT");
    block.end_at(lines.number());
    message.objects[k] = object_of(block, message.doubts);
  }
  if (has_line) {
    lines.fail(line.number, "OBJECT",
               fmt::format("a third object, got {}, must be the end of the "
                           "file",
                           in_quotes(line.value)));
  }
  return message;
}

std::string cdm_text(const ConjunctionDataMessage& message) {
  std::string text;
  const auto add = [&](std::string_view keyword, std::string_view value,
                       std::string_view unit = {}) {
    text += fmt::format("{:<36} = {}{}\n", keyword, value,
                        unit.empty() ? "" : fmt::format(" [{}]", unit));
  };
  const auto add_number = [&](std::string_view keyword, double number, std::string_view unit) {
    add(keyword, fmt::format("{:.15e}", number), unit);
  };
  const auto add_comments = [&](const std::vector<std::string>& comments) {
    for (const std::string& comment : comments) {
      for (const std::string_view line : comment_lines(comment)) {
        text += fmt::format("COMMENT {}\n", line);
      }
    }
  };
  const auto add_three = [&](const std::string& keyword, const std::array<double, 3>& numbers,
                             std::string_view unit) {
    add_number(keyword + "_R", numbers[0], unit);
    add_number(keyword + "_T", numbers[1], unit);
    add_number(keyword + "_N", numbers[2], unit);
  };
  add(cdm_version_keyword, "1.0");
  add_comments(message.comments);
  add("CREATION_DATE", format_epoch(message.creation_date));
  add("ORIGINATOR", message.originator);
  add("MESSAGE_ID", message.message_id);
  add("TCA", format_epoch(message.tca));
  add_number("MISS_DISTANCE", message.miss_distance_m, "m");
  if (message.relative_speed_m_s) add_number("RELATIVE_SPEED", *message.relative_speed_m_s, "m/s");
  if (message.relative_position_m) {
    add_three("RELATIVE_POSITION", *message.relative_position_m, "m");
  }
  if (message.relative_velocity_m_s) {
    add_three("RELATIVE_VELOCITY", *message.relative_velocity_m_s, "m/s");
  }
  if (message.collision_probability) {
    add_number("COLLISION_PROBABILITY", *message.collision_probability, "");
    if (!message.collision_probability_method.empty()) {
      add("COLLISION_PROBABILITY_METHOD", message.collision_probability_method);
    }
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const ConjunctionObject& object = message.objects[k];
    add("OBJECT", fmt::format("OBJECT{}", k + 1));
    add("OBJECT_DESIGNATOR", object.object_designator);
    add("CATALOG_NAME", object.catalog_name);
    add("OBJECT_NAME", object.object_name);
    add("INTERNATIONAL_DESIGNATOR", object.international_designator);
    add("EPHEMERIS_NAME", object.ephemeris_name);
    add("COVARIANCE_METHOD", object.covariance_method);
    add("MANEUVERABLE", object.maneuverable);
    add("ORBIT_CENTER", object.orbit_center);
    add("REF_FRAME", object.reference_frame);
    add_comments(object.comments);
    for (const SurfaceKeyword& one : surface_keywords) {
      if (const auto number = object.spacecraft.*one.member) {
        add_number(one.keyword, *number, one.unit);
      }
    }
    const std::vector<Quantity>& state = state_quantities();
    for (std::size_t i = 0; i < 6; ++i) {
      add_number(state[i].keyword, i < 3 ? object.position_km[i] : object.velocity_km_s[i - 3],
                 state[i].unit);
    }
    std::size_t place = 0;
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j <= i; ++j, ++place) {
        const CovarianceKeyword& of = covariance_keywords_of_cdm()[place];
        add_number(of.keyword, object.covariance[i][j], of.unit);
      }
    }
    const auto add_row = [&](const auto& row, const auto& numbers) {
      for (std::size_t i = 0; numbers && i < row.size(); ++i) {
        add_number(row[i].keyword, (*numbers)[i], row[i].unit);
      }
    };
    add_row(drag_row, object.spacecraft.drag_covariance);
    add_row(radiation_row, object.spacecraft.radiation_covariance);
  }
  return text;
}

}  // namespace hamjet::io
