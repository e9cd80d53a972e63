#include <fmt/format.h>

#include <algorithm>

#include "../formats/output_formats.hpp"
#include "../text/scene_message.hpp"
#include "scene_sections.hpp"

namespace hamjet::io {

namespace {

std::vector<std::string_view> format_names() {
  std::vector<std::string_view> names;
  for (const OutputFormat* format : output_formats()) {
    if (format->name.empty()) continue;
    // Formats of the same name are requested together.
    if (std::find(names.begin(), names.end(), format->name) == names.end()) {
      names.push_back(format->name);
    }
  }
  return names;
}

/// The file names of each format among the results.
std::string file_names() {
  std::string names;
  for (const OutputFormat* format : output_formats()) {
    if (format->name.empty()) continue;
    names += fmt::format("{}`{}`", names.empty() ? "" : ", ", format->file);
  }
  return names;
}

}  // namespace

const TableDescription& output_table() {
  static const std::string help = fmt::format(
      "beside CSV and JSON: {} (of an orbit that `[ephemeris]` or its file dates)", file_names());
  static const TableDescription table = {
      {{"formats", form::array(form::choice(format_names())), absent::refused(), help}}};
  return table;
}

OutputSettings read_output(const TableReader& output, SystemModel model) {
  output.check_keys();
  OutputSettings settings{output.texts("formats")};
  const std::vector<std::string_view> names = format_names();
  for (std::size_t i = 0; i < settings.formats.size(); ++i) {
    const std::string got = in_quotes(settings.formats[i]);
    const auto fail = [&](const std::string& problem) {
      output.fail_element("formats", i, problem);
    };
    if (std::find(names.begin(), names.end(), settings.formats[i]) == names.end()) {
      fail(fmt::format("unknown format, got {}, {}", got, suggestion(settings.formats[i], names)));
    }
    const auto is_named = [&](const OutputFormat* f) { return f->name == settings.formats[i]; };
    const OutputFormat& format =
        **std::find_if(output_formats().begin(), output_formats().end(), is_named);
    if (!format.is_built()) {
      fail(
          fmt::format("not in this build, got {}, must be left out, or hamjet be built with the "
                      "{} library",
                      got, format.library));
    }
    if (format.needs_orbit && !is_orbit(model)) {
      fail(fmt::format("not available for the model {}, got {}, must be left out: {} holds orbits",
                       model_name(model), got, format.help));
    }
  }
  return settings;
}

}  // namespace hamjet::io
