#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/formats/orbit_message.hpp"

// Orbit messages in XML notation (CCSDS 505.0-B-3, XML Specification for Navigation Data Messages,
// 2023; CCSDS 502.0-B-3, section 8; CCSDS 508.0-B-1, Conjunction Data Message, 2013, section 4).

namespace hamjet::io {

/// What an element of a message says, as a line of the keyword = value notation would.
struct XmlStatement {
  std::size_t line = 0;  ///< of the element
  std::string text;
  std::string unit = {};  ///< of a keyword's value, where the element says one
};

/// Whether this build reads XML.
bool is_xml_built();

/// The statements of an OEM, OPM or CDM in XML, in order, so that whoever reads the other notation
/// reads this one with the same checks. `kind` is the message that is wanted, "oem", "opm" or
/// "cdm": of a combined message (ndm) the one of this kind is taken, and of several OEM all
/// segments together. Of a message of another kind the statement of its version is all there is.
/// Throws Error(input_output), `name:line: element: problem`, for what is no XML, for another root,
/// for elements where the standard has none of that name or that are out of the order that it has,
/// and in the states and covariances of an OEM for units other than the standard's; and in a build
/// without XML for everything.
std::vector<XmlStatement> statements_of_xml(const std::string& name, std::string_view text,
                                            std::string_view kind);

/// An OEM, and an OPM of the state alone, in XML, with the schema's order and units; numbers have
/// the digits of oem_text and opm_text, so that what is read back is what is read of those. Throw
/// Error(usage) in a build without XML.
std::string oem_xml(const OrbitEphemerisMessage& message);
std::string opm_xml(const OrbitParameterMessage& message);

}  // namespace hamjet::io
