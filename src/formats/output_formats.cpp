#include "output_formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "dace_text.hpp"
#include "hdf5/hdf5_jets.hpp"
#include "orbit_messages/orbit_ephemeris.hpp"

namespace hamjet::io {

const std::vector<const OutputFormat*>& output_formats() {
  static const std::vector<const OutputFormat*> formats = {
      &hdf5_format,    &dace_format,          &csv_format,
      &oem_format,     &oem_xml_format,       &start_opm_format,
      &end_opm_format, &start_opm_xml_format, &end_opm_xml_format,
  };
  return formats;
}

std::vector<const OutputFormat*> wanted_formats(const Scene& scene) {
  std::vector<const OutputFormat*> wanted;
  std::copy_if(output_formats().begin(), output_formats().end(), std::back_inserter(wanted),
               [&](const OutputFormat* format) { return scene.output.has(format->name); });
  return wanted;
}

std::string jet_file_endings(bool with_help) {
  std::vector<std::string> endings;
  for (const OutputFormat* format : output_formats()) {
    if (format->ending.empty()) continue;
    endings.emplace_back(format->ending);
    if (with_help && !format->help.empty()) endings.back() += fmt::format(" ({})", format->help);
  }
  const auto last = endings.end() - 1;
  return fmt::format("{} or {}", fmt::join(endings.begin(), last, ", "), *last);
}

}  // namespace hamjet::io
