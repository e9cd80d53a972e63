#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/formats/orbit_message.hpp"

// Orbit messages in XML notation (CCSDS 505.0-B-3, XML Specification for Navigation Data Messages,
// 2023; CCSDS 502.0-B-3, section 8; CCSDS 508.0-B-1, Conjunction Data Message, 2013, section 4).

namespace hamjet::io {

/// The content of an element of a message, like a line in keyword = value notation.
struct XmlStatement {
  std::size_t line = 0;  ///< line of the element
  std::string text;
  std::string unit = {};  ///< unit of a keyword's value, where the element gives one
};

/// Whether this build reads XML.
bool is_xml_built();

/// The statements of an OEM, OPM or CDM in XML, in order, so that the readers of the other notation
/// read this one with the same checks. `kind` is the wanted message, "oem", "opm" or "cdm". In a
/// combined message (ndm) the message of this kind is taken and, of several OEM, all segments
/// together. For a message of another kind, only the statement of its version is returned. Throws
/// Error(input_output), `name:line: element: problem`, for a text that is not XML, for another root
/// element, for elements that the standard does not have in their place or in their order, and, in
/// the states and covariances of an OEM, for units other than the standard's. In a build without
/// XML it throws for every text.
std::vector<XmlStatement> statements_of_xml(const std::string& name, std::string_view text,
                                            std::string_view kind);

/// Write an OEM, and an OPM of the state alone, in XML, with the order and units of the schema.
/// Numbers have the digits of oem_text and opm_text, so that reading either notation gives the
/// same. In a build without XML they throw Error(usage).
std::string oem_xml(const OrbitEphemerisMessage& message);
std::string opm_xml(const OrbitParameterMessage& message);

}  // namespace hamjet::io
