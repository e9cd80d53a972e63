#include "known_text.hpp"

#include <algorithm>
#include <array>

namespace hamjet::io {
namespace {

struct KnownMessage {
  std::string_view version_keyword;
  KnownText text;
};

constexpr std::string_view of_SGP4 =
    "whose mean elements are valid with SGP4 alone: must be a state that SGP4 computes from them, "
    "as an OPM or OEM, or as position_km and velocity_km_s";

constexpr std::string_view as_init_writes = "as hamjet init --from writes it";

constexpr std::array<KnownMessage, 5> known_messages = {
    {{"CCSDS_OPM_VERS",
      {"an orbit parameter message (OPM)", "which the key opm_file of [nominal] or [deputy] reads",
       as_init_writes}},
     {"CCSDS_OEM_VERS",
      {"an orbit ephemeris message (OEM)", "which the key oem_file of [nominal] or [deputy] reads",
       as_init_writes}},
     {"CCSDS_CDM_VERS",
      {"a conjunction data message (CDM)", "whose covariances the key file of [uncertainty] reads",
       "with uncertainty = { file = \"...\" }"}},
     {"CCSDS_OMM_VERS", {"an orbit mean-elements message (OMM)", of_SGP4}},
     {"CCSDS_OCM_VERS",
      {"an orbit comprehensive message (OCM)", "which is not read: must be an OPM or OEM"}}}};

constexpr KnownText two_line_elements = {"two-line elements (TLE)", of_SGP4};

/// The next line that is not blank, without blanks around it.
std::string_view next_line(std::string_view& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return text = {};
  text.remove_prefix(first);
  std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  text.remove_prefix(line.size());
  return line.substr(0, line.find_last_not_of(" \t") + 1);
}

/// Whether a line has 69 characters, begins with its number and ends with a check digit, as in
/// two-line elements.
bool is_element_line(std::string_view line, char number) {
  constexpr std::size_t length = 69;
  return line.size() == length && line[0] == number && line[1] == ' ' && line.back() >= '0' &&
         line.back() <= '9';
}

}  // namespace

const KnownText* known_text(std::string_view text) {
  constexpr std::size_t longest_beginning = 4096;
  text = text.substr(0, longest_beginning);
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::string_view rest = text;
  std::array<std::string_view, 3> lines;
  for (std::string_view& line : lines) line = next_line(rest);
  const bool is_xml = lines[0].starts_with('<');
  for (const KnownMessage& message : known_messages) {
    const bool is_it = is_xml ? text.find(message.version_keyword) != std::string_view::npos
                              : lines[0].starts_with(message.version_keyword);
    if (is_it) return &message.text;
  }
  // A line with the object's name may stand before the two lines.
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    if (is_element_line(lines[i], '1') && is_element_line(lines[i + 1], '2')) {
      return &two_line_elements;
    }
  }
  return nullptr;
}

}  // namespace hamjet::io
