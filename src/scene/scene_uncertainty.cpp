#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../algebra/state_sums.hpp"
#include "../studies/formation/charts/free_coordinates.hpp"
#include "../text/quantity_text.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "scene_covariance_file.hpp"
#include "scene_relative_motion.hpp"
#include "scene_uncertain_parameters.hpp"

namespace hamjet::io {
namespace {

constexpr int most_flown_samples = 10000000;
constexpr double largest_seed = 1e15;

/// The velocities of covariances are differences of inertial velocities unless the table says
/// otherwise, as in CCSDS messages.
RelativeFrame read_covariance_frame(const TableReader& table, const TableReader& fallback,
                                    const Nominal& nominal) {
  const RelativeFrame frame = read_relative_frame(table, fallback, nominal);
  const bool says_derivatives = table.has("derivatives") || fallback.has("derivatives");
  return frame == RelativeFrame::rtn_rotating && !says_derivatives ? RelativeFrame::rtn_inertial
                                                                   : frame;
}

std::vector<SceneKey> covariance_frame_keys(const Absence& frame) {
  std::vector<SceneKey> keys = relative_frame_keys(frame);
  for (SceneKey& key : keys) {
    if (key.name != "derivatives") continue;
    key.absence = absent::other("`\"inertial\"`, as in CCSDS messages");
  }
  return keys;
}

/// The keys of read_state_uncertainty.
std::vector<SceneKey> state_uncertainty_keys() {
  return {
      {"position_m", deviations_form(), absent::other("0, or another form of the covariance"),
       "standard deviations along the axes of the frame, as many as a system of the scene's own "
       "has coordinates"},
      {"velocity_m_s", deviations_form(), absent::other("0, or another form of the covariance"),
       "standard deviations along the axes of the frame"},
      {"covariance_m_m_s", form::words("6 rows of 6 numbers, symmetric, positive semidefinite"),
       absent::other("another form of the covariance"),
       "covariance of position and velocity along the axes of the frame: m^2, m^2/s, m^2/s^2; of "
       "an own system with n coordinates 2 n rows"},
      {"file", form::words("path of an OEM, OPM or CDM"),
       absent::other("another form of the covariance"),
       "whose covariance of the chief's moment is taken, in its own frame: RTN (also RSW, QSW, "
       "RIC) or the chief's axes; a scene with dates, and the file's state must be that of the "
       "spacecraft within 6 standard deviations and five digits"},
      {"object", form::text(),
       absent::other("the spacecraft's; of a CDM `\"OBJECT1\"`, of a deputy `\"OBJECT2\"`"),
       "name or identifier in the file, which may then have another name in the scene"}};
}

/// All coordinates but `auto`.
std::vector<std::string_view> names_of_measurable() {
  return {jet_coordinates_names.begin(), jet_coordinates_names.end() - 1};
}

std::vector<JetCoordinates> read_compared_coordinates(const TableReader& uncertainty) {
  constexpr std::string_view key = "coordinates";
  const auto names = names_of_measurable();
  std::vector<JetCoordinates> result;
  const std::vector<std::string> given = uncertainty.texts(key);
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto found = std::find(names.begin(), names.end(), given[i]);
    const auto coordinates = static_cast<JetCoordinates>(found - names.begin());
    if (found == names.end() ||
        std::find(result.begin(), result.end(), coordinates) != result.end()) {
      uncertainty.fail_element(key, i,
                               fmt::format("unknown coordinates, or twice, got {}, must be one of "
                                           "{}, once",
                                           in_quotes(given[i]), listed(names)));
    }
    result.push_back(coordinates);
  }
  return result;
}

const TableDescription& deputy_uncertainty_table() {
  static const TableDescription table = {
      joined<SceneKey>({covariance_frame_keys(absent::other("of `[uncertainty]`")),
                        state_uncertainty_keys(), uncertain_parameter_keys()}),
      "How well the deputy's state at the start is known, independently of the chief's; RTN are "
      "the axes of the deputy's own orbit."};
  return table;
}

const TableDescription& burn_table() {
  static const TableDescription table = {
      joined<SceneKey>(
          {covariance_frame_keys(absent::other("of `[uncertainty]`")),
           {{"velocity_change_m_s", form::array(form::number(), 3), absent::refused(),
             "velocity change of the burn that ends at the start; the start is the state after it"},
            {"magnitude", form::between(0, 1), absent::other("0"),
             "standard deviation of the burn's size, as a share of the size"},
            {"direction_deg", form::between(0, 90), absent::other("0"),
             "standard deviation of the burn's direction about each of the two axes across it"}}}),
      "Execution errors, after Gates, of the deputy's burn, or of the chief's in a scene without "
      "one; linear in the errors."};
  return table;
}

/// Above these limits an expansion about the chief is meaningless, and a unit is most likely wrong.
struct Limits {
  double position_m = 0;
  double velocity_m_s = 0;
  std::string_view of_position = "the chief's distance from the centre";
  std::string_view of_velocity = "the speed of a circular orbit through the chief";
};

Limits limits_of(const Nominal& nominal) {
  const CanonicalUnits units = canonical_units(nominal.scale);
  const double length_m = units.length_km * 1000;
  if (!nominal.orbit) {
    // Beyond this powers of a deviation leave the range of doubles, and its moments say nothing.
    constexpr double far = 1e9;
    double size = 1;
    for (const double number : nominal.state) size = std::max(size, std::abs(number));
    const double most_m = far * size * length_m;
    return {most_m, most_m / units.time_s, "far from the nominal", "far from the nominal"};
  }
  const double distance = Eigen::Vector3d(nominal.state.data()).norm();
  return {distance * length_m, length_m / units.time_s / std::sqrt(distance)};
}

/// Of a system with fewer coordinates than three the matrix has fewer rows.
Covariance read_covariance(const TableReader& table, const Limits& limits, RelativeFrame frame,
                           const SystemSettings& system) {
  constexpr std::string_view key = "covariance_m_m_s";
  const std::vector<std::size_t> told = told_components(system);
  const std::vector<double> entries = table.square_matrix(key, told.size());
  Matrix<double> matrix = Matrix<double>::Zero(6, 6);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    matrix(static_cast<Eigen::Index>(told[i / told.size()]),
           static_cast<Eigen::Index>(told[i % told.size()])) = entries[i];
  }
  const auto own_names = component_names(system, frame);
  std::array<std::string_view, 6> names;
  std::copy(own_names.begin(), own_names.end(), names.begin());
  if (const auto fault = Covariance::fault_of(matrix, names)) table.fail(key, *fault);
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double deviation = std::sqrt(matrix(i, i));
    const double limit = i < 3 ? limits.position_m : limits.velocity_m_s;
    if (deviation < limit) continue;
    table.fail_element(
        key, static_cast<std::size_t>(i),
        fmt::format("too large, got a standard deviation of {:.4g} {} of {}, must be "
                    "below {:.4g}, {}; variances are in m^2 and m^2/s^2",
                    deviation, i < 3 ? "m" : "m/s", names[static_cast<std::size_t>(i)], limit,
                    i < 3 ? limits.of_position : limits.of_velocity));
  }
  return Covariance(matrix, names);
}

/// Whether a table has a covariance in one of the forms.
bool has_covariance(const TableReader& table) {
  const auto keys = state_uncertainty_keys();
  return std::any_of(keys.begin(), keys.end(), [&](const SceneKey& key) {
    return key.name != "object" && table.has(key.name);
  });
}

/// The state of the chief, or of the deputy whose table is given, with its names in the scene and
/// in its messages.
KnownState state_of_owner(const Scene& scene, const Nominal& nominal, const TableReader* deputy) {
  KnownState state;
  const CanonicalUnits units = canonical_units(nominal.scale);
  std::vector<double> canonical = nominal.state;
  if (deputy != nullptr) {
    const ChiefFrame frame(nominal.state, {units.length_km * 1000, units.time_s},
                           scene.deputy->frame);
    canonical = state_sum(std::move(canonical), frame.deviation(scene.deputy->start));
  }
  state.position_km = Eigen::Vector3d(canonical.data()) * units.length_km;
  state.velocity_km_s = Eigen::Vector3d(canonical.data() + 3) * (units.length_km / units.time_s);
  std::vector<std::string> names;
  const auto add = [&](const EphemerisSettings& settings) {
    names.insert(names.end(), {settings.object_name, settings.object_id});
  };
  if (deputy != nullptr) {
    if (const auto message = settings_of_orbit_file(*deputy)) add(*message);
  } else if (nominal.file) {
    add(nominal.file->ephemeris);
  }
  if (scene.ephemeris) {
    if (deputy != nullptr) {
      names.insert(names.end(), {scene.ephemeris->deputy_name, scene.ephemeris->deputy_id});
    } else {
      add(*scene.ephemeris);
    }
    state.center_name = scene.ephemeris->center_name;
    state.reference_frame = scene.ephemeris->reference_frame;
    state.reference_frame_epoch = scene.ephemeris->reference_frame_epoch;
  }
  state.names = known_names(std::move(names));
  return state;
}

/// `deputy` is the table of the deputy whose uncertainty is read, or null for the chief's.
StateUncertainty read_state_uncertainty(const TableReader& table, const TableReader& fallback,
                                        const Scene& scene, const Nominal& nominal,
                                        const TableReader* deputy) {
  StateUncertainty state;
  state.frame = read_covariance_frame(table, fallback, nominal);
  const Limits limits = limits_of(nominal);
  if (table.has("file")) {
    for (const std::string_view key : {"position_m", "velocity_m_s", "covariance_m_m_s"}) {
      if (table.has(key)) {
        table.fail(key, "numbers beside a file, got both, must be one of them");
      }
    }
    const CovarianceOwner owner = {deputy != nullptr ? "deputy" : "chief",
                                   deputy != nullptr ? "OBJECT2" : "OBJECT1",
                                   state_of_owner(scene, nominal, deputy),
                                   coefficient_of_owner(scene, deputy != nullptr, true),
                                   coefficient_of_owner(scene, deputy != nullptr, false)};
    StateUncertainty of_file = read_covariance_file(table, nominal, owner);
    const bool is_of_paths = fallback.has("collision") || fallback.has("safety");
    if (is_of_paths && !of_file.parameters.empty()) {
      table.warn("file",
                 "rows of C_D A / m and C_R A / m are left out beside [uncertainty.collision] and "
                 "[uncertainty.safety], which are of states alone");
      of_file.parameters.clear();
    }
    return of_file;
  }
  if (table.has("object")) {
    table.fail("object", "there is no file, got an object without the key file, must be left out");
  }
  const bool has_deviations = table.has("position_m") || table.has("velocity_m_s");
  // A state that is known exactly may be that of a spacecraft whose drag is not.
  if (has_uncertain_parameters(table) && !has_covariance(table)) return state;
  if (table.has("covariance_m_m_s")) {
    if (has_deviations) {
      table.fail(table.has("position_m") ? "position_m" : "velocity_m_s",
                 "standard deviations beside a covariance, got both, must be one of them");
    }
    state.covariance = read_covariance(table, limits, state.frame, scene.system);
    return state;
  }
  if (!has_deviations) {
    table.fail("position_m",
               fmt::format("missing, must be an array of {}, as may velocity_m_s be, or "
                           "covariance_m_m_s{} must be there",
                           counted(told_coordinates(scene.system), "standard deviation"),
                           nominal.orbit ? " or file" : ""));
  }
  Vector<double> deviations = Vector<double>::Zero(6);
  const auto read = [&](std::string_view key, double limit, std::string_view what,
                        Eigen::Index place) {
    if (!table.has(key)) return;
    for (const double deviation :
         read_deviations(table, key, limit, what, told_coordinates(scene.system))) {
      deviations[place++] = deviation;
    }
  };
  read("position_m", limits.position_m, limits.of_position, 0);
  read("velocity_m_s", limits.velocity_m_s, limits.of_velocity, 3);
  state.covariance = Covariance::of_standard_deviations(deviations);
  return state;
}

BurnUncertainty read_burn(const TableReader& burn, const TableReader& fallback,
                          const Nominal& nominal) {
  burn.check_keys();
  BurnUncertainty settings;
  settings.frame = read_covariance_frame(burn, fallback, nominal);
  const std::vector<double> change = burn.numbers("velocity_change_m_s", 3);
  settings.velocity_change_m_s = {change[0], change[1], change[2]};
  const Limits limits = limits_of(nominal);
  const double limit = limits.velocity_m_s;
  if (!(settings.velocity_change_m_s.stableNorm() < limit)) {
    burn.fail("velocity_change_m_s",
              fmt::format("too large, got a magnitude of {:.4g}, must be below {:.4g}, {}",
                          settings.velocity_change_m_s.stableNorm(), limit, limits.of_velocity));
  }
  burn.read_if_any("magnitude", settings.magnitude);
  burn.read_if_any("direction_deg", settings.direction_deg);
  if (settings.magnitude == 0 && settings.direction_deg == 0) {
    burn.fail("magnitude",
              "no error of the burn, got neither magnitude nor direction_deg above 0, "
              "must be one of them");
  }
  return settings;
}

}  // namespace

const TableDescription& uncertainty_table() {
  static const UncertaintySettings preset;
  static const TableDescription table = {
      joined<SceneKey>(
          {covariance_frame_keys(absent::value("RTN")),
           state_uncertainty_keys(),
           uncertain_parameter_keys(),
           {{"gaussian_in", form::choice({gaussian_in_names.begin(), gaussian_in_names.end()}),
             absent::value(gaussian_in_names[0]),
             "the coordinates in which the states at the start are Gaussian: positions and "
             "velocities, or elements of the orbit (Poincaré's, near to equinoctial ones), with "
             "the covariance that the linear map to them makes; auto: elements of a spacecraft "
             "whose orbit bends away from the line of a Gaussian in positions by a tenth or more "
             "of what is uncertain across it"},
            {"deputy", form::table(deputy_uncertainty_table()), absent::other("known exactly"),
             "uncertainty of the deputy, in a scene that has one"},
            {"burn", form::table(burn_table()), absent::other("none"), "errors of a burn"},
            {"collision", form::table(collision_table()), absent::other("not looked for"),
             "whether chief and deputy may hit each other"},
            {"safety", form::table(safety_table()), absent::other("not looked for"),
             "how near the spacecraft of a formation come to each other where a burn fails"},
            {"acceleration_density_m2_s3", form::between(0, 1e6),
             absent::value(preset.acceleration_density_m2_s3),
             "power spectral density of white noise of the acceleration along each axis; its part "
             "of the covariance is linear; not beside a collision or safety study, which leave it "
             "out"}},
           domain_keys(absent::other("one jet about each mean"),
                       "the deviations within 3 standard deviations are split into domains, with "
                       "jets in positions and velocities about centres of their own, until each "
                       "coordinate of every position is right to it, by an estimate; of a "
                       "collision, the distribution into narrower ones; safety has one jet",
                       "no more are made of a spacecraft; `tolerance_m` must be there"),
           transfer_time_keys(absent::other("the end")),
           {{"coordinates", form::array(form::choice(names_of_measurable())),
             absent::other("those of `[jet]` alone"),
             "coordinates in which the distribution at the last time is also given, side by side"},
            {"samples", form::integer(0, most_flown_samples), absent::value(preset.samples),
             "flown with the full equations beside the moments; 0: none"},
            {"seed", form::integer(0, largest_seed), absent::value(preset.seed),
             "seed of the samples"}}}),
      "How well the chief's state at the start is known; RTN are the axes of the chief's own "
      "orbit. The results are in the same frame, at the chief."};
  return table;
}

UncertaintySettings read_uncertainty(const TableReader& root, const Scene& scene,
                                     const Nominal& nominal) {
  const TableReader uncertainty = root.table("uncertainty");
  uncertainty.check_keys();
  require_deviations(uncertainty, scene);
  if (!nominal.orbit) {
    refuse_keys_of_orbits(
        uncertainty,
        {"file", "object", "gaussian_in", "deputy", "collision", "safety", "coordinates",
         "acceleration_density_m2_s3", "tolerance_m", "most_domains"},
        "the moments of a start that is Gaussian in them, and flights");
    if (uncertainty.has("burn") && told_coordinates(scene.system) < 3) {
      uncertainty.fail("burn",
                       "has a direction in space, got it beside fewer than three coordinates, must "
                       "be left out; velocity_m_s may have its error");
    }
  }
  UncertaintySettings settings;
  settings.frame = read_covariance_frame(uncertainty, uncertainty, nominal);
  if (uncertainty.has("deputy")) {
    const TableReader deputy = uncertainty.table("deputy");
    deputy.check_keys();
    if (!scene.deputy) {
      deputy.fail("", "the scene has no deputy, got no table [deputy], must have one");
    }
    const TableReader owner = root.table("deputy");
    settings.deputy = read_state_uncertainty(deputy, uncertainty, scene, nominal, &owner);
    read_uncertain_parameters(deputy, scene, *settings.deputy, nullptr);
  }
  if (uncertainty.has("burn")) {
    settings.burn = read_burn(uncertainty.table("burn"), uncertainty, nominal);
  }
  const bool has_parameters = has_uncertain_parameters(uncertainty);
  if (has_covariance(uncertainty) || has_parameters || (!settings.deputy && !settings.burn)) {
    settings.chief = read_state_uncertainty(uncertainty, uncertainty, scene, nominal, nullptr);
    read_uncertain_parameters(uncertainty, scene, *settings.chief, &settings.common);
  }
  if (uncertainty.has("collision")) {
    settings.collision =
        read_collision(uncertainty.table("collision"), scene, settings.burn.has_value());
  }
  if (uncertainty.has("safety")) {
    settings.safety =
        read_safety(uncertainty.table("safety"), scene, nominal, settings.burn.has_value());
  }
  settings.times = read_transfer_times(uncertainty, scene, nominal, 1);
  if (uncertainty.has("coordinates")) {
    settings.coordinates = read_compared_coordinates(uncertainty);
    const auto box = std::find(settings.coordinates.begin(), settings.coordinates.end(),
                               JetCoordinates::flow_box);
    if (scene.system.earth && box != settings.coordinates.end()) {
      uncertainty.fail_element(
          "coordinates", static_cast<std::size_t>(box - settings.coordinates.begin()),
          "needs a flow that is the same at every start, and the forces of the model earth depend "
          "on the time, got \"flow-box\", must be left out");
    }
  }
  if (uncertainty.has("tolerance_m")) {
    settings.domains = read_domains(uncertainty, scene, "deviations");
  } else if (uncertainty.has("most_domains")) {
    uncertainty.fail("most_domains",
                     "nothing is split, got it without tolerance_m, must be left out or beside "
                     "tolerance_m");
  }
  uncertainty.read_if_any("gaussian_in", settings.gaussian_in);
  uncertainty.read_if_any("acceleration_density_m2_s3", settings.acceleration_density_m2_s3);
  if (settings.acceleration_density_m2_s3 > 0 && (settings.collision || settings.safety)) {
    uncertainty.fail(
        "acceleration_density_m2_s3",
        fmt::format("not beside [uncertainty.{}], got {}, must be 0 or left out: noise "
                    "along the way is in the moments alone, and without it a "
                    "probability would be too low",
                    settings.collision ? "collision" : "safety",
                    settings.acceleration_density_m2_s3));
  }
  uncertainty.read_if_any("samples", settings.samples);
  uncertainty.read_if_any("seed", settings.seed);
  return settings;
}

}  // namespace hamjet::io
