#include <fmt/format.h>

#include <algorithm>

#include "../text/scene_message.hpp"
#include "scene_sections.hpp"

namespace hamjet::io {
namespace {

const std::vector<std::string_view> format_names = {"hdf5", "dace", "oem"};

}  // namespace

const TableDescription& output_table() {
  static const TableDescription table = {
      {{"formats", form::array(form::choice(format_names)), absent::refused(),
        "beside CSV and JSON: `jets.h5`, `jet.dace`, `nominal.oem` (of an orbit that "
        "`[ephemeris]` or its file dates)"}}};
  return table;
}

OutputSettings read_output(const TableReader& output, SystemModel model) {
  output.check_keys();
  OutputSettings settings;
  bool* const wanted[] = {&settings.hdf5, &settings.dace, &settings.oem};
  const std::vector<std::string> formats = output.texts("formats");
  for (std::size_t i = 0; i < formats.size(); ++i) {
    const auto name = std::find(format_names.begin(), format_names.end(), formats[i]);
    if (name == format_names.end()) {
      output.fail_element("formats", i,
                          fmt::format("unknown format, got {}, {}", in_quotes(formats[i]),
                                      suggestion(formats[i], format_names)));
    }
    *wanted[name - format_names.begin()] = true;
#ifndef HAMJET_HAVE_HDF5
    if (settings.hdf5) {
      output.fail_element("formats", i,
                          "not in this build, got \"hdf5\", must be left out, or hamjet be built "
                          "with the HDF5 library");
    }
#endif
    if (settings.oem && !is_orbit(model)) {
      output.fail_element("formats", i,
                          fmt::format("not available for the model {}, got \"oem\", must be left "
                                      "out: an orbit ephemeris message holds orbits",
                                      model_name(model)));
    }
  }
  return settings;
}

}  // namespace hamjet::io
