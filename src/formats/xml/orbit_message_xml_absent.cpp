#include <fmt/format.h>

#include "hamjet/error.hpp"
#include "orbit_message_xml.hpp"

// Replaces the other files of this folder in a build without XML.

namespace hamjet::io {

bool is_xml_built() { return false; }

std::vector<XmlStatement> statements_of_xml(const std::string& name, std::string_view,
                                            std::string_view) {
  throw Error(ErrorKind::input_output,
              fmt::format("{}:1: XML notation, got \"<\" at the start, must be in keyword = value "
                          "notation (KVN), the only one that this build reads (HAMJET_XML is OFF)",
                          name));
}

namespace {

[[noreturn]] void refuse() {
  throw Error(ErrorKind::usage, "orbit messages in XML: not in this build (HAMJET_XML is OFF)");
}

}  // namespace

std::string oem_xml(const OrbitEphemerisMessage&) { refuse(); }
std::string opm_xml(const OrbitParameterMessage&) { refuse(); }

}  // namespace hamjet::io
