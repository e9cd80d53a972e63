#include <fmt/format.h>

#include "../../text/html_text.hpp"
#include "chart.hpp"

namespace hamjet::io {
namespace {

/// Inserts the prefix behind every occurrence of `before`.
void insert_behind(std::string& text, std::string_view before, const std::string& prefix) {
  for (std::size_t i = text.find(before); i != std::string::npos; i = text.find(before, i)) {
    i += before.size();
    text.insert(i, prefix);
    i += prefix.size();
  }
}

/// A tag with the prefix at the ids that it gives or refers to.
std::string with_prefix(std::string tag, const std::string& prefix) {
  for (const char* before : {" id='", " id=\"", "href='#", "href=\"#", "url(#"}) {
    insert_behind(tag, before, prefix);
  }
  return tag;
}

/// Takes out an element that holds no other elements.
void remove_elements(std::string& text, const std::string& name) {
  const std::string begin = "<" + name + ">";
  const std::string end = "</" + name + ">";
  for (std::size_t i = text.find(begin); i != std::string::npos; i = text.find(begin, i)) {
    const std::size_t close = text.find(end, i);
    if (close == std::string::npos) return;
    text.erase(i, close + end.size() - i);
  }
}

}  // namespace

std::string inline_svg(const std::string& svg, const std::string& prefix,
                       const std::string& description) {
  const std::size_t start = svg.find("<svg");
  if (start == std::string::npos) return "";
  std::string body = svg.substr(start);
  remove_elements(body, "title");
  remove_elements(body, "desc");
  std::string text;
  // Only tags hold ids; a name in the legend that looks like one stays as it is.
  for (std::size_t i = 0; i < body.size();) {
    const std::size_t open = std::min(body.find('<', i), body.size());
    text.append(body, i, open - i);
    const std::size_t close = std::min(body.find('>', open), body.size());
    const std::size_t end = std::min(close + 1, body.size());
    if (open < body.size()) text += with_prefix(body.substr(open, end - open), prefix);
    i = std::max(end, open);
  }
  return fmt::format("<svg role=\"img\" aria-label=\"{}\" {}", escape_html(description),
                     text.substr(4));
}

}  // namespace hamjet::io
