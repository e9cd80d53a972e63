#include "scene_covariance_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "../text/scene_message.hpp"
#include "hamjet/formats/conjunction_data_message.hpp"
#include "hamjet/formats/orbit_message.hpp"

namespace hamjet::io {
namespace {

constexpr std::string_view file_key = "file";

/// A covariance of a message in metres, and where it stands.
struct GivenCovariance {
  Epoch epoch;
  std::string time_system;
  std::string reference_frame;
  Matrix<double> matrix;
  std::size_t line = 0;
};

Matrix<double> square(const std::array<std::array<double, 6>, 6>& rows, double unit) {
  Matrix<double> matrix(6, 6);
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j] * unit;
    }
  }
  return matrix;
}

GivenCovariance of_orbit(const OrbitMetadata& metadata, const OrbitCovariance& covariance) {
  return {covariance.epoch,
          std::string(time_system_names()[static_cast<std::size_t>(metadata.time_system)]),
          covariance.reference_frame, square(covariance.matrix, 1e6), covariance.line};
}

bool is_object(const TableReader& table, const std::vector<std::string_view>& names) {
  if (!table.has("object")) return true;
  const std::string wanted = table.text("object");
  return std::find(names.begin(), names.end(), wanted) != names.end();
}

/// All covariances of the object that the table names.
std::vector<GivenCovariance> covariances_of(const TableReader& table, const std::string& name,
                                            const std::string& text,
                                            std::string_view default_object) {
  std::vector<GivenCovariance> found;
  if (text.find("CCSDS_CDM_VERS") != text.npos) {
    const ConjunctionDataMessage message = read_cdm(name, text);
    for (std::size_t k = 0; k < 2; ++k) {
      const ConjunctionObject& object = message.objects[k];
      const std::string place = fmt::format("OBJECT{}", k + 1);
      const bool is_wanted =
          table.has("object")
              ? is_object(table, {place, object.object_designator, object.object_name,
                                  object.international_designator})
              : place == default_object;
      if (!is_wanted) continue;
      found.push_back(
          {message.tca, "UTC", "RTN", square(object.covariance, 1), object.covariance_line});
    }
  } else if (text.find("CCSDS_OPM_VERS") != text.npos || text.find("<opm") != text.npos) {
    const OrbitParameterMessage message = read_opm(name, text);
    if (message.covariance &&
        is_object(table, {message.metadata.object_name, message.metadata.object_id})) {
      found.push_back(of_orbit(message.metadata, *message.covariance));
    }
  } else {
    for (const EphemerisSegment& segment : read_oem(name, text).segments) {
      if (!is_object(table, {segment.metadata.object_name, segment.metadata.object_id})) continue;
      for (const OrbitCovariance& covariance : segment.covariances) {
        found.push_back(of_orbit(segment.metadata, covariance));
      }
    }
  }
  return found;
}

}  // namespace

StateUncertainty read_covariance_file(const TableReader& table, const Nominal& nominal,
                                      std::string_view default_object) {
  const std::string text = table.content_beside_scene(file_key, largest_orbit_message_bytes);
  const std::string name = printable(table.path_beside_scene(file_key).string(), std::string::npos);
  const std::vector<GivenCovariance> all = covariances_of(table, name, text, default_object);
  if (all.empty()) {
    table.fail(
        table.has("object") ? "object" : file_key,
        table.has("object")
            ? fmt::format("no covariance of it in the file, got {}, must be an object that "
                          "has one",
                          in_quotes(table.text("object")))
            : fmt::format("no covariance, got {}, must be an OEM, OPM or CDM with one", name));
  }
  if (!nominal.ephemeris) {
    table.fail(file_key,
               fmt::format("a dated covariance beside a chief without a date, got {} {}, must "
                           "have a table [ephemeris] that says the chief's epoch, or a chief "
                           "from a message",
                           format_epoch(all[0].epoch), all[0].time_system));
  }
  const EphemerisSettings& chief = *nominal.ephemeris;
  const auto chosen = std::find_if(all.begin(), all.end(), [&](const GivenCovariance& given) {
    return parse_epoch(chief.epoch) == given.epoch && given.time_system == chief.time_system;
  });
  if (chosen == all.end()) {
    table.fail(file_key,
               fmt::format("no covariance of the chief's moment, got {} {}{}, must be {} {}",
                           format_epoch(all[0].epoch), all[0].time_system,
                           all.size() > 1 ? fmt::format(" and {} others", all.size() - 1) : "",
                           chief.epoch, chief.time_system));
  }
  StateUncertainty state;
  if (chosen->reference_frame == "RTN" || chosen->reference_frame == "RSW") {
    state.frame = RelativeFrame::rtn_inertial;
  } else if (chosen->reference_frame == chief.reference_frame) {
    state.frame = RelativeFrame::inertial;
  } else {
    table.fail(
        file_key,
        fmt::format("a covariance in other axes, got {} in line {}, must be RTN, RSW or "
                    "the chief's {}",
                    in_quotes(chosen->reference_frame), chosen->line, chief.reference_frame));
  }
  const auto names = component_names(state.frame);
  if (const auto fault = Covariance::fault_of(chosen->matrix, names)) {
    table.fail(file_key, fmt::format("in line {}: {}", chosen->line, *fault));
  }
  state.covariance = Covariance(chosen->matrix, names);
  return state;
}

}  // namespace hamjet::io
