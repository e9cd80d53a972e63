#include "orbit_message_xml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <pugixml.hpp>

#include "../../text/scene_message.hpp"
#include "../orbit_messages/orbit_message_units.hpp"
#include "hamjet/error.hpp"

namespace hamjet::io {
namespace {

using Node = pugi::xml_node;

/// Elements of position, velocity and optional acceleration, in the order of the standard.
constexpr std::array<std::string_view, 10> state_elements = {
    "EPOCH", "X", "Y", "Z", "X_DOT", "Y_DOT", "Z_DOT", "X_DDOT", "Y_DDOT", "Z_DDOT"};
constexpr std::size_t without_acceleration = 7;

/// The parts of the data of an OPM; all elements in them are keywords in the other notation.
const std::vector<std::string_view> parts_of_opm = {
    "stateVector",      "keplerianElements",  "spacecraftParameters",
    "covarianceMatrix", "maneuverParameters", "userDefinedParameters"};
const std::vector<std::string_view> parts_of_oem = {"stateVector", "covarianceMatrix"};
/// The parts of an object of a CDM.
const std::vector<std::string_view> parts_of_cdm = {"odParameters", "additionalParameters",
                                                    "stateVector", "covarianceMatrix"};

/// The elements of a combined message (CCSDS 505.0-B-3, section 4.3).
const std::vector<std::string_view> names_in_ndm = {"MESSAGE_ID", "acm", "aem", "apm", "cdm", "ocm",
                                                    "oem",        "omm", "opm", "rdm", "tdm"};

class XmlReader {
 public:
  XmlReader(const std::string& name, std::string_view text) : name_(name) {
    for (std::size_t i = text.find('\n'); i != text.npos; i = text.find('\n', i + 1)) {
      ends_of_lines_.push_back(i);
    }
    // The library does not know entities that a document defines itself, and does not expand them.
    const pugi::xml_parse_result result =
        document_.load_buffer(text.data(), text.size(),
                              pugi::parse_default | pugi::parse_trim_pcdata, pugi::encoding_utf8);
    if (!result) {
      fail_at(line_of(result.offset), "",
              fmt::format("no XML, got an error of syntax here ({}), must be an orbit message",
                          result.description()));
    }
  }

  std::vector<XmlStatement> read(std::string_view wanted) {
    const Node root = document_.document_element();
    const std::string_view kind = root.name();
    const bool is_known = kind == "ndm" || std::find(names_in_ndm.begin() + 1, names_in_ndm.end(),
                                                     kind) != names_in_ndm.end();
    // The file may be any other file, whose content must not appear in messages.
    if (!is_known) {
      fail_at(
          line_of(root.offset_debug()), "",
          fmt::format("no orbit message, got XML with another root, must be {} or ndm", wanted));
    }
    if (kind != wanted && kind != "ndm") {
      add(root, version_of(root));
      return std::move(statements_);
    }
    if (root.next_sibling()) fail(root.next_sibling(), "got a second root, must be one message");
    kind_ = wanted;
    const std::vector<Node> messages =
        kind == "ndm" ? messages_of(root, wanted) : std::vector<Node>{root};
    for (const Node message : messages) read_message(message, message == messages[0]);
    return std::move(statements_);
  }

 private:
  [[noreturn]] void fail_at(std::size_t line, std::string_view element,
                            const std::string& problem) const {
    throw Error(ErrorKind::input_output,
                fmt::format("{}:{}: {}{}{}", name_, line, printable(element),
                            element.empty() ? "" : ": ", problem));
  }
  [[noreturn]] void fail(Node node, const std::string& problem) const {
    fail_at(line_of(node.offset_debug()), node.name(), problem);
  }

  std::size_t line_of(std::ptrdiff_t offset) const {
    if (offset < 0) return 1;
    const auto end = std::lower_bound(ends_of_lines_.begin(), ends_of_lines_.end(),
                                      static_cast<std::size_t>(offset));
    return static_cast<std::size_t>(end - ends_of_lines_.begin()) + 1;
  }

  static std::string version_of(Node message) {
    return fmt::format("{} = {}", message.attribute("id").value(),
                       message.attribute("version").value());
  }

  /// The messages of one kind in a combined message, which may also have others.
  std::vector<Node> messages_of(Node combined, std::string_view wanted) const {
    std::vector<Node> found;
    for (const Node child : children(combined, names_in_ndm)) {
      if (child.name() == wanted) found.push_back(child);
    }
    if (found.empty()) fail(combined, fmt::format("got no {} in it, must have one", wanted));
    for (const Node other : found) {
      if (other == found[0]) continue;
      if (wanted == "opm") fail(other, "got a second opm, must be one state");
      if (wanted == "cdm") fail(other, "got a second cdm, must be one conjunction");
      if (version_of(other) != version_of(found[0])) {
        fail(other, fmt::format("another version than the first one, got {}, must be {}",
                                version_of(other), version_of(found[0])));
      }
    }
    return found;
  }

  /// The header of the first message is taken for all.
  void read_message(Node message, bool is_first) {
    if (is_first) add(message, version_of(message));
    const std::vector<Node> parts = children(message, {"header", "body"});
    if (parts.size() != 2 || std::string_view(parts[0].name()) != "header" ||
        std::string_view(parts[1].name()) != "body") {
      fail(message, "incomplete, must have one header and one body behind it");
    }
    if (is_first) add_leaves(parts[0]);
    if (kind_ == "cdm") return read_conjunction(parts[1]);
    const std::vector<Node> segments = children(parts[1], {"segment"});
    if (!is_ephemeris() && segments.size() != 1) {
      fail(parts[1], fmt::format("got {} segments, must have one", segments.size()));
    }
    for (const Node segment : segments) read_segment(segment);
  }

  /// Reads the part that both objects share, and a segment for each object.
  void read_conjunction(Node body) {
    const std::vector<Node> parts = children(body, {"relativeMetadataData", "segment"});
    const auto is_segment = [](Node part) { return std::string_view(part.name()) == "segment"; };
    if (parts.size() != 3 || is_segment(parts[0]) || !is_segment(parts[1]) ||
        !is_segment(parts[2])) {
      fail(body, "incomplete, must have one relativeMetadataData and two segments behind it");
    }
    for (const Node part : children(parts[0], {})) {
      if (std::string_view(part.name()) == "relativeStateVector") {
        add_leaves(part);
      } else {
        add_leaf(part);
      }
    }
    for (std::size_t i = 1; i < parts.size(); ++i) read_segment(parts[i]);
  }

  bool is_ephemeris() const { return kind_ == "oem"; }

  void add(Node node, std::string text, std::string unit = {}) {
    statements_.push_back({line_of(node.offset_debug()), std::move(text), std::move(unit)});
  }

  /// The child elements of an element that has only elements, without comments. All names must be
  /// among `names`, unless that is empty.
  std::vector<Node> children(Node parent, const std::vector<std::string_view>& names) const {
    std::vector<Node> found;
    for (const Node child : parent) {
      if (child.type() != pugi::node_element) {
        fail(parent, fmt::format("got the text {} between elements, must be elements alone",
                                 in_quotes(child.value())));
      }
      const std::string_view name = child.name();
      if (name == "COMMENT") continue;
      if (!names.empty() && std::find(names.begin(), names.end(), name) == names.end()) {
        fail(child,
             fmt::format("unknown element in {}, {}", parent.name(), suggestion(name, names)));
      }
      found.push_back(child);
    }
    return found;
  }

  /// The text of an element without child elements.
  std::string leaf_text(Node leaf) const {
    const Node child = leaf.first_child();
    if (child.type() == pugi::node_element || child != leaf.last_child()) {
      fail(leaf, "got elements or comments within, must be a text alone");
    }
    return leaf.text().get();
  }

  /// The text of a number in a row. If a unit is given, it must be that of the standard.
  std::string number_text(Node leaf) const {
    if (const pugi::xml_attribute units = leaf.attribute("units")) {
      const std::string_view right = unit_of_keyword(leaf.name());
      if (units.value() != right) {
        fail(leaf, fmt::format("wrong unit, got {}, must be {}", in_quotes(units.value()),
                               right.empty() ? "without a unit" : in_quotes(right)));
      }
    }
    return leaf_text(leaf);
  }

  /// The unit is judged by the code that reads the value.
  void add_leaf(Node leaf) {
    const std::string_view name = leaf.name();
    const bool is_own = name == "USER_DEFINED";
    add(leaf,
        fmt::format("{}{} = {}", is_own ? "USER_DEFINED_" : name,
                    is_own ? leaf.attribute("parameter").value() : "", leaf_text(leaf)),
        leaf.attribute("units").value());
  }

  void add_leaves(Node parent) {
    for (const Node leaf : children(parent, {})) add_leaf(leaf);
  }

  void read_segment(Node segment) {
    const std::vector<Node> parts = children(segment, {"metadata", "data"});
    if (parts.size() != 2 || std::string_view(parts[0].name()) != "metadata" ||
        std::string_view(parts[1].name()) != "data") {
      fail(segment, "incomplete, must have one element metadata and one element data behind it");
    }
    if (is_ephemeris()) add(parts[0], "META_START");
    add_leaves(parts[0]);
    const Node last = parts[0].last_child();
    if (is_ephemeris()) add(last ? last : parts[0], "META_STOP");
    const std::vector<Node> data = children(parts[1], is_ephemeris()   ? parts_of_oem
                                                      : kind_ == "opm" ? parts_of_opm
                                                                       : parts_of_cdm);
    if (!is_ephemeris()) {
      for (const Node part : data) add_leaves(part);
      return;
    }
    const auto is_state = [](Node part) { return std::string_view(part.name()) == "stateVector"; };
    if (!std::is_partitioned(data.begin(), data.end(), is_state)) {
      fail(parts[1], "out of order, got a stateVector behind a covarianceMatrix, must be before");
    }
    const auto matrices = std::find_if_not(data.begin(), data.end(), is_state);
    std::for_each(data.begin(), matrices, [&](Node state) { add_state(state); });
    if (matrices == data.end()) return;
    add(*matrices, "COVARIANCE_START");
    std::for_each(matrices, data.end(), [&](Node matrix) { add_covariance(matrix); });
    add(data.back(), "COVARIANCE_STOP");
  }

  void add_state(Node state) {
    const std::vector<Node> leaves = children(state, {});
    std::string line;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      const std::string_view right = i < state_elements.size() ? state_elements[i] : "no other one";
      if (leaves[i].name() != right) {
        fail(leaves[i], fmt::format("out of place in a stateVector, must be {} here", right));
      }
      const std::string text = number_text(leaves[i]);
      if (text.empty() || text.find_first_of(" \t\r\n") != text.npos) {
        fail(leaves[i],
             fmt::format("got {}, must be one {}", in_quotes(text), i == 0 ? "epoch" : "number"));
      }
      line += (i == 0 ? "" : " ") + text;
    }
    if (leaves.size() != without_acceleration && leaves.size() != state_elements.size()) {
      fail(state, fmt::format("got {} elements, must be an epoch, a position and a velocity, and "
                              "an acceleration or none",
                              leaves.size()));
    }
    add(state, std::move(line));
  }

  /// Adds the numbers as rows of a lower triangle.
  void add_covariance(Node matrix) {
    std::string row;
    std::size_t numbers = 0;
    std::size_t ends = 1;  // number of the row's last element, among all numbers
    for (const Node leaf : children(matrix, {})) {
      const std::string text = number_text(leaf);
      if (unit_of_keyword(leaf.name()).empty()) {
        add(leaf, fmt::format("{} = {}", leaf.name(), text));
        continue;
      }
      const auto& quantities = covariance_quantities();
      if (numbers == quantities.size() || quantities[numbers].keyword != leaf.name()) {
        fail(leaf, fmt::format("out of place in a covarianceMatrix, must be {} here",
                               numbers == quantities.size() ? "no other number"
                                                            : quantities[numbers].keyword));
      }
      row += (row.empty() ? "" : " ") + text;
      if (++numbers < ends) continue;
      add(leaf, std::move(row));
      row.clear();
      // Row k ends with number k (k + 1) / 2.
      std::size_t k = 1;
      while (k * (k + 1) / 2 <= ends) ++k;
      ends = k * (k + 1) / 2;
    }
    if (!row.empty()) add(matrix, std::move(row));
  }

  std::string name_;
  std::vector<std::size_t> ends_of_lines_;
  pugi::xml_document document_;
  std::string_view kind_;
  std::vector<XmlStatement> statements_;
};

}  // namespace

bool is_xml_built() { return true; }

std::vector<XmlStatement> statements_of_xml(const std::string& name, std::string_view text,
                                            std::string_view kind) {
  return XmlReader(name, text).read(kind);
}

}  // namespace hamjet::io
