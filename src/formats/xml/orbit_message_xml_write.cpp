#include <fmt/format.h>

#include <array>
#include <pugixml.hpp>
#include <sstream>
#include <string>

#include "../orbit_messages/orbit_message_units.hpp"
#include "hamjet/error.hpp"
#include "orbit_message_xml.hpp"

namespace hamjet::io {
namespace {

using Node = pugi::xml_node;

/// Adds an element that holds a text; the text is escaped when it is printed.
Node add(Node parent, const char* name, const std::string& text) {
  Node leaf = parent.append_child(name);
  leaf.text().set(text.c_str());
  return leaf;
}

void add_comments(Node parent, const std::vector<std::string>& comments) {
  for (const std::string& comment : comments) add(parent, "COMMENT", comment);
}

/// Makes a document with its root and the header that both kinds of messages have.
template <class Message>
Node begin(pugi::xml_document& document, const char* kind, const char* keyword,
           const Message& message) {
  Node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  Node root = document.append_child(kind);
  root.append_attribute("xmlns:xsi") = "http://www.w3.org/2001/XMLSchema-instance";
  root.append_attribute("xsi:noNamespaceSchemaLocation") =
      "https://sanaregistry.org/r/ndmxml_unqualified/ndmxml-3.0.0-master-3.0.xsd";
  root.append_attribute("id") = keyword;
  root.append_attribute("version") = message.version.c_str();
  Node header = root.append_child("header");
  add_comments(header, message.comments);
  add(header, "CREATION_DATE", format_epoch(message.creation_date));
  add(header, "ORIGINATOR", message.originator);
  return root;
}

/// Adds object, centre, frame and time system, in the order of the standard.
void add_metadata(Node parent, const OrbitMetadata& metadata) {
  add(parent, "OBJECT_NAME", metadata.object_name);
  add(parent, "OBJECT_ID", metadata.object_id);
  add(parent, "CENTER_NAME", metadata.center_name);
  add(parent, "REF_FRAME", metadata.reference_frame);
  if (metadata.reference_frame_epoch) {
    add(parent, "REF_FRAME_EPOCH", format_epoch(*metadata.reference_frame_epoch));
  }
  add(parent, "TIME_SYSTEM", std::string(time_system_name(metadata.time_system)));
}

void add_state(Node parent, const OrbitState& state, const std::vector<std::string>& comments) {
  Node vector = parent.append_child("stateVector");
  add_comments(vector, comments);
  add(vector, "EPOCH", format_epoch(state.epoch));
  constexpr std::array<const char*, 6> names = {"X", "Y", "Z", "X_DOT", "Y_DOT", "Z_DOT"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double number = i < 3 ? state.position_km[i] : state.velocity_km_s[i - 3];
    Node leaf = add(vector, names[i], fmt::format("{:.15e}", number));
    leaf.append_attribute("units") = std::string(unit_of_keyword(names[i])).c_str();
  }
}

/// Adds the elements in the order of the schema of CCSDS 505.0-B-3, which is that of the standard.
void add_spacecraft(Node parent, const OpmSpacecraft& spacecraft) {
  Node block;
  for (const auto& [quantity, member] : spacecraft_quantities()) {
    if (!(spacecraft.*member)) continue;
    if (!block) block = parent.append_child("spacecraftParameters");
    Node leaf = add(block, std::string(quantity.keyword).c_str(),
                    fmt::format("{:.15e}", *(spacecraft.*member)));
    if (!quantity.unit.empty()) {
      leaf.append_attribute("units") = std::string(quantity.unit).c_str();
    }
  }
}

void add_manoeuvres(Node parent, const std::vector<OpmManoeuvre>& manoeuvres) {
  for (const OpmManoeuvre& one : manoeuvres) {
    Node block = parent.append_child("maneuverParameters");
    const auto number = [&](const char* name, double value) {
      add(block, name, fmt::format("{:.15e}", value)).append_attribute("units") =
          std::string(unit_of_keyword(name)).c_str();
    };
    add(block, "MAN_EPOCH_IGNITION", format_epoch(one.ignition));
    number("MAN_DURATION", one.duration_s);
    number("MAN_DELTA_MASS", one.mass_change_kg);
    add(block, "MAN_REF_FRAME", one.reference_frame);
    number("MAN_DV_1", one.change_km_s[0]);
    number("MAN_DV_2", one.change_km_s[1]);
    number("MAN_DV_3", one.change_km_s[2]);
  }
}

std::string printed(const pugi::xml_document& document) {
  std::ostringstream text;
  document.save(text, "  ", pugi::format_indent, pugi::encoding_utf8);
  return text.str();
}

}  // namespace

std::string oem_xml(const OrbitEphemerisMessage& message) {
  pugi::xml_document document;
  Node body = begin(document, "oem", "CCSDS_OEM_VERS", message).append_child("body");
  for (const EphemerisSegment& one : message.segments) {
    Node segment = body.append_child("segment");
    Node metadata = segment.append_child("metadata");
    add_metadata(metadata, one.metadata);
    add(metadata, "START_TIME", format_epoch(one.states.front().epoch));
    if (one.useable_start) add(metadata, "USEABLE_START_TIME", format_epoch(*one.useable_start));
    if (one.useable_stop) add(metadata, "USEABLE_STOP_TIME", format_epoch(*one.useable_stop));
    add(metadata, "STOP_TIME", format_epoch(one.states.back().epoch));
    Node data = segment.append_child("data");
    add_comments(data, one.comments);
    for (const OrbitState& state : one.states) add_state(data, state, {});
  }
  return printed(document);
}

std::string opm_xml(const OrbitParameterMessage& message) {
  pugi::xml_document document;
  Node segment = begin(document, "opm", "CCSDS_OPM_VERS", message)
                     .append_child("body")
                     .append_child("segment");
  add_metadata(segment.append_child("metadata"), message.metadata);
  Node data = segment.append_child("data");
  add_state(data, message.state, message.state_comments);
  add_spacecraft(data, message.spacecraft);
  add_manoeuvres(data, message.manoeuvres);
  return printed(document);
}

}  // namespace hamjet::io
