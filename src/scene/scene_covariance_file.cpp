#include "scene_covariance_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../studies/earth_system.hpp"
#include "../text/quantity_text.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "hamjet/formats/conjunction_data_message.hpp"
#include "hamjet/formats/orbit_message.hpp"
#include "hamjet/formats/orbit_message_axes.hpp"
#include "starts/scene_nominal_file.hpp"
#include "systems/scene_earth.hpp"

namespace hamjet::io {
namespace {

constexpr std::string_view file_key = "file";

/// A covariance of a message, in metres, with its place in the file and the state that it belongs
/// to.
struct GivenCovariance {
  Epoch epoch;
  std::string time_system;
  std::string reference_frame;
  Matrix<double> matrix;
  std::size_t line = 0;
  KnownState state;
  bool has_state = true;                  ///< an OEM may have no state at that epoch
  std::string place = {};                 ///< OBJECT1 or OBJECT2 of a CDM
  ConjunctionSpacecraft spacecraft = {};  ///< of a CDM
};

/// The content of a file: the covariances of the wanted object, or of all objects that may be
/// meant.
struct CovariancesOfFile {
  std::vector<GivenCovariance> found;
  std::vector<std::string> doubts;
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

GivenCovariance of_orbit(const OrbitMetadata& metadata, const OrbitCovariance& covariance,
                         std::span<const OrbitState> states, double mu_km3_s2) {
  GivenCovariance given = {covariance.epoch,
                           std::string(time_system_name(metadata.time_system)),
                           covariance.reference_frame,
                           square(covariance.matrix, 1e6),
                           covariance.line,
                           {}};
  given.state.names = known_names({metadata.object_name, metadata.object_id});
  given.state.center_name = metadata.center_name;
  given.state.reference_frame = metadata.reference_frame;
  if (metadata.reference_frame_epoch) {
    given.state.reference_frame_epoch = format_epoch(*metadata.reference_frame_epoch);
  }
  given.has_state = interpolate_state(states, covariance.epoch, mu_km3_s2, given.state);
  return given;
}

GivenCovariance of_conjunction(const ConjunctionDataMessage& message, std::size_t number) {
  const ConjunctionObject& object = message.objects[number];
  GivenCovariance given = {
      message.tca, "UTC", "RTN", square(object.covariance, 1), object.covariance_line, {}};
  given.state.names = known_names_of(object);
  given.state.center_name = object.orbit_center;
  given.state.reference_frame = object.reference_frame;
  given.state.position_km = Eigen::Vector3d(object.position_km.data());
  given.state.velocity_km_s = Eigen::Vector3d(object.velocity_km_s.data());
  given.place = fmt::format("OBJECT{}", number + 1);
  given.spacecraft = object.spacecraft;
  return given;
}

/// All covariances of a file, or only those of the object that the table names.
CovariancesOfFile covariances_of(const TableReader& table, const std::string& name,
                                 const std::string& text, const SystemSettings& system) {
  const double mu_km3_s2 = system.mu_km3_s2;
  const AcceptedFrames frames = frames_of(system);
  CovariancesOfFile file;
  if (is_cdm(text)) {
    ConjunctionDataMessage message = read_cdm(name, text);
    for (std::size_t k = 0; k < 2; ++k) file.found.push_back(of_conjunction(message, k));
    file.doubts = std::move(message.doubts);
  } else if (text.find("CCSDS_OPM_VERS") != text.npos || text.find("<opm") != text.npos) {
    OrbitParameterMessage message = read_opm(name, text, frames);
    if (message.covariance) {
      file.found.push_back(
          of_orbit(message.metadata, *message.covariance, {&message.state, 1}, mu_km3_s2));
    }
    file.doubts = std::move(message.doubts);
  } else {
    for (const EphemerisSegment& segment : read_oem(name, text, frames).segments) {
      for (const OrbitCovariance& covariance : segment.covariances) {
        file.found.push_back(of_orbit(segment.metadata, covariance, segment.states, mu_km3_s2));
      }
    }
  }
  if (table.has("object")) {
    const std::string wanted = table.text("object");
    std::erase_if(file.found, [&](const GivenCovariance& given) {
      const auto& names = given.state.names;
      return given.place != wanted && std::find(names.begin(), names.end(), wanted) == names.end();
    });
  }
  return file;
}

std::string names_text(const std::vector<std::string>& names) {
  return printable(names.empty() ? "an object without a name"
                                 : fmt::format("{}", fmt::join(names, ", ")));
}

class CovarianceFile {
 public:
  CovarianceFile(const TableReader& table, const Nominal& nominal, const CovarianceOwner& owner)
      : table_(table),
        nominal_(nominal),
        owner_(owner),
        name_(printable(table.path_beside_scene(file_key).string(), std::string::npos)) {}

  StateUncertainty read() const {
    const GivenCovariance given = in_axes_of_flight(chosen());
    require_same_spacecraft(given);
    StateUncertainty state;
    state.frame = frame_of(given);
    const auto names = component_names(state.frame);
    if (const auto fault = Covariance::fault_of(given.matrix, names)) {
      table_.fail(file_key, fmt::format("in line {}: {}", given.line, *fault));
    }
    state.covariance = Covariance(given.matrix, names);
    add_coefficients(given, state);
    return state;
  }

 private:
  /// The rows of C_D A / m and C_R A / m, of forces that the scene has.
  void add_coefficients(const GivenCovariance& given, StateUncertainty& state) const {
    const ConjunctionSpacecraft& craft = given.spacecraft;
    const auto add = [&](std::string_view name, const auto& row, const std::optional<double>& told,
                         const std::optional<double>& own, std::string_view keyword) {
      if (!own || !row || row->back() == 0) return;
      if (row->back() < 0) {
        table_.fail(file_key, fmt::format("in line {}: no covariance, got a variance of {} of {}, "
                                          "must not be below 0",
                                          given.line, row->back(), name));
      }
      // Digits of a message, not another spacecraft.
      constexpr double agreement = 0.01;
      if (told && std::abs(*told - *own) > agreement * std::abs(*own)) {
        table_.warn(file_key, fmt::format("{} of {} is not that of the scene, got {:.6g} beside "
                                          "{:.6g} m^2/kg, should agree; the covariance is taken",
                                          keyword, printable(given.place), *told, *own));
      }
      UncertainParameter parameter{
          std::string(name), std::sqrt(row->back()), {row->begin(), row->begin() + 6}};
      // Between both coefficients, where both are uncertain.
      if (row->size() == 8 && !state.parameters.empty()) {
        parameter.covariances.push_back((*row)[6]);
      }
      state.parameters.push_back(std::move(parameter));
    };
    add(drag_parameter, craft.drag_covariance, craft.drag_m2_kg, owner_.drag_m2_kg,
        "CD_AREA_OVER_MASS");
    add(radiation_parameter, craft.radiation_covariance, craft.radiation_m2_kg,
        owner_.radiation_m2_kg, "CR_AREA_OVER_MASS");
    if (state.parameters.empty()) return;
    if (const auto fault =
            Covariance::fault_of(state.joint_matrix(), component_names(state.frame))) {
      table_.fail(file_key, fmt::format("in line {}: with the rows of C_D A / m and C_R A / m: {}",
                                        given.line, *fault));
    }
  }

  /// The covariance at the chief's moment, which must be the only one that can be meant.
  GivenCovariance chosen() const {
    const std::string text = table_.content_beside_scene(file_key, largest_orbit_message_bytes);
    CovariancesOfFile file = covariances_of(table_, name_, text, nominal_.centre.system);
    std::vector<GivenCovariance>& all = file.found;
    if (all.empty()) {
      table_.fail(
          table_.has("object") ? "object" : file_key,
          table_.has("object")
              ? fmt::format("no covariance of it in the file, got {}, must be an object that "
                            "has one",
                            in_quotes(table_.text("object")))
              : fmt::format("no covariance, got {}, must be an OEM, OPM or CDM with one", name_));
    }
    if (!nominal_.ephemeris) {
      table_.fail(file_key,
                  fmt::format("a dated covariance beside a chief without a date, got {} {}, must "
                              "have a table [ephemeris] that says the chief's epoch, or a chief "
                              "from a message",
                              format_epoch(all[0].epoch), all[0].time_system));
    }
    table_.warn(file_key, file.doubts);
    const EphemerisSettings& chief = *nominal_.ephemeris;
    const GivenCovariance first = all[0];
    const std::size_t others = all.size() - 1;
    std::erase_if(all, [&](const GivenCovariance& given) {
      if (const auto& earth = nominal_.centre.system.earth) {
        return !is_at_start(*earth, given.epoch, given.time_system);
      }
      return parse_epoch(chief.epoch) != given.epoch || given.time_system != chief.time_system;
    });
    if (all.empty()) {
      table_.fail(
          file_key,
          fmt::format(
              "no covariance of the chief's moment, got {} {}{}, must be {} {}",
              format_epoch(first.epoch), first.time_system,
              others > 0 && first.place.empty() ? fmt::format(" and {} others", others) : "",
              chief.epoch, chief.time_system));
    }
    return only_one(all);
  }

  /// State and covariance along the axes in which a scene about the real Earth is flown, where they
  /// are told in other known ones. Axes such as RTN turn with the orbit and stay.
  GivenCovariance in_axes_of_flight(GivenCovariance given) const {
    const auto& earth = nominal_.centre.system.earth;
    if (!earth) return given;
    const auto change_from = [&](const std::string& frame) {
      MessageFrame from{frame};
      const std::string& epoch = given.state.reference_frame_epoch;
      if (!epoch.empty()) from.epoch = parse_epoch(epoch);
      try {
        return MessageFrameChange(from, {"GCRF"}, time_system_named(given.time_system).value(),
                                  given.epoch, given.epoch, earth->orientation)
            .at(given.epoch);
      } catch (const Error& error) {
        table_.fail(file_key, fmt::format("in line {}: {}", given.line, error.what()));
      }
    };
    if (axes_named(given.reference_frame)) {
      given.matrix = change_from(given.reference_frame).of_covariance(given.matrix);
      given.reference_frame = "GCRF";
    }
    if (given.has_state && axes_named(given.state.reference_frame)) {
      KnownState& state = given.state;
      change_from(state.reference_frame).apply(state.position_km, state.velocity_km_s);
      state.reference_frame = "GCRF";
      state.reference_frame_epoch.clear();
    }
    return given;
  }

  GivenCovariance only_one(const std::vector<GivenCovariance>& all) const {
    if (all.size() == 1) return all[0];
    if (!all[0].place.empty()) {
      return *std::find_if(all.begin(), all.end(), [&](const GivenCovariance& given) {
        return given.place == owner_.object_of_cdm;
      });
    }
    // If an ephemeris has several objects, the owner of the table is meant.
    std::vector<GivenCovariance> own;
    for (const GivenCovariance& given : all) {
      const bool is_known = !given.state.names.empty() && !owner_.state.names.empty();
      if (is_known && !are_other_objects(given.state.names, owner_.state.names)) {
        own.push_back(given);
      }
    }
    if (own.empty()) own = all;
    for (const GivenCovariance& given : own) {
      if (are_other_objects(given.state.names, own[0].state.names)) {
        table_.fail("object", fmt::format("missing, got covariances of {} and of {} in {}:{}, must "
                                          "be one of them",
                                          names_text(own[0].state.names),
                                          names_text(given.state.names), name_, given.line));
      }
      if (given.matrix != own[0].matrix || given.reference_frame != own[0].reference_frame) {
        table_.fail(file_key,
                    fmt::format("two covariances of the chief's moment, got them in lines {} and "
                                "{} of {}, must be one",
                                own[0].line, given.line, name_));
      }
    }
    return own[0];
  }

  /// Refuses a covariance that is about another centre, another state or another object.
  void require_same_spacecraft(const GivenCovariance& given) const {
    const KnownState& own = owner_.state;
    const std::string in_line = fmt::format("in {}:{}", name_, given.line);
    if (!is_same_centre(given.state.center_name, own.center_name)) {
      table_.fail(file_key, fmt::format("a covariance about another centre than the {}'s, got {} "
                                        "{}, must be {}",
                                        owner_.who, printable(given.state.center_name), in_line,
                                        printable(own.center_name)));
    }
    require_same_state(given, in_line);
    if (table_.has("object") || !are_other_objects(given.state.names, own.names)) return;
    table_.fail(
        file_key,
        fmt::format("a covariance of another object than the {}, got {} {}, must be {}; "
                    "object = {} says that it is meant",
                    owner_.who, names_text(given.state.names), in_line, names_text(own.names),
                    in_quotes(given.place.empty() ? given.state.names[0] : given.place)));
  }

  void require_same_state(const GivenCovariance& given, const std::string& in_line) const {
    if (!given.has_state) {
      table_.warn(file_key, fmt::format("the covariance {} is of a moment that no states of the "
                                        "file enclose, so that it was not compared with the {}'s "
                                        "state",
                                        in_line, owner_.who));
      return;
    }
    const auto deviation_km = [&](Eigen::Index first) {
      return std::sqrt(std::max(0.0, given.matrix.diagonal().segment(first, 3).sum())) / 1000;
    };
    const double of_position = deviation_km(0);
    double of_velocity = deviation_km(3);
    if (frame_of(given) == RelativeFrame::rtn_rotating) {
      // Inertial velocities also contain the rotation of the axes.
      of_velocity +=
          of_position * owner_.state.velocity_km_s.norm() / owner_.state.position_km.norm();
    }
    const StateDifference difference =
        difference_of_states(given.state, owner_.state, of_position, of_velocity);
    if (!difference.is_contradiction()) return;
    const std::string names = given.state.names.empty()
                                  ? std::string()
                                  : fmt::format(" of {}", names_text(given.state.names));
    table_.fail(
        file_key,
        fmt::format("a covariance of another state than the {}'s, got one{} {} at {} and {:.3g} "
                    "m/s from it, must be within {} and {:.3g} m/s ({:g} standard deviations, "
                    "five digits of the state{}){}",
                    owner_.who, names, in_line, length_text(1000 * difference.position_km),
                    std::round(1e9 * difference.velocity_km_s) / 1e6,
                    length_text(1000 * difference.most_position_km),
                    1000 * difference.most_velocity_km_s, most_standard_deviations,
                    given.state.reference_frame == owner_.state.reference_frame
                        ? ""
                        : fmt::format(", {} beside {}", given.state.reference_frame,
                                      owner_.state.reference_frame),
                    given.place.empty() ? "" : "; object = \"OBJECT1\" or \"OBJECT2\" chooses"));
  }

  /// The axes of the covariance. RSW, QSW and RIC are other names of RTN, whose velocities are
  /// differences of inertial ones unless the name ends with _ROTATING (SANA registry of orbit
  /// relative reference frames, to which CCSDS 502.0-B-3, annex B5 refers).
  RelativeFrame frame_of(const GivenCovariance& given) const {
    std::string_view name = given.reference_frame;
    constexpr std::string_view inertial = "_INERTIAL", rotating = "_ROTATING";
    const bool is_rotating = name.ends_with(rotating);
    if (is_rotating || name.ends_with(inertial)) name.remove_suffix(inertial.size());
    for (const std::string_view axes : {"RTN", "RSW", "QSW", "RIC"}) {
      if (name != axes) continue;
      return is_rotating ? RelativeFrame::rtn_rotating : RelativeFrame::rtn_inertial;
    }
    const EphemerisSettings& chief = *nominal_.ephemeris;
    EphemerisSettings own = chief;
    own.reference_frame = given.reference_frame;
    own.reference_frame_epoch = given.state.reference_frame_epoch;
    if (is_same_axes(own, chief)) return RelativeFrame::inertial;
    table_.fail(
        file_key,
        fmt::format("a covariance in other axes, got {} in {}:{}, must be RTN (or RSW, QSW, RIC, "
                    "also with _INERTIAL or _ROTATING) or the chief's {}",
                    printable(axes_text(given.reference_frame, own.reference_frame_epoch)), name_,
                    given.line, axes_text(chief.reference_frame, chief.reference_frame_epoch)));
  }

  const TableReader& table_;
  const Nominal& nominal_;
  const CovarianceOwner& owner_;
  std::string name_;
};

}  // namespace

StateUncertainty read_covariance_file(const TableReader& table, const Nominal& nominal,
                                      const CovarianceOwner& owner) {
  return CovarianceFile(table, nominal, owner).read();
}

}  // namespace hamjet::io
