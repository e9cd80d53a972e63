#include "scene_relative_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "../formats/relative_frame_text.hpp"
#include "../studies/earth_system.hpp"
#include "../studies/formation/charts/coordinate_deviations.hpp"
#include "../studies/formation/formation_problem.hpp"
#include "../text/letter_case.hpp"
#include "../text/quantity_text.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/relative_motion/deputy_coordinates.hpp"
#include "scene_uncertain_parameters.hpp"

namespace hamjet::io {
namespace {

/// The time that the key gives, in canonical units.
double canonical_time(const TableReader& table, std::string_view key, double given,
                      const Nominal& nominal) {
  if (key.ends_with("_s")) return nominal.scale.time_of_s(given);
  if (key.ends_with("_canonical")) return nominal.time_of_canonical(given);
  if (!nominal.period_s) {
    const std::string_view stem = key.substr(0, key.find('_'));
    table.fail(key, fmt::format("no period, got {} of a nominal that is no ellipse, must be {}_s "
                                "or {}_canonical",
                                table.found(key), stem, stem));
  }
  return convert<double>(Extended(given) * *nominal.period_s / nominal.scale.time_s);
}

std::vector<double> equal_parts(const TableReader& table, int count, double duration) {
  if (duration == 0) {
    table.fail("count", fmt::format("no time to divide, got {} parts of a jet.duration of 0, must "
                                    "be a duration that is not 0, or times",
                                    count));
  }
  std::vector<double> times;
  for (int i = 1; i <= count; ++i) times.push_back(i == count ? duration : duration * i / count);
  return times;
}

}  // namespace

std::vector<SceneKey> relative_frame_keys(const Absence& frame) {
  return {
      {"frame", form::choice({"RTN", "inertial", "coordinates"}), frame,
       "radial, transverse, normal of the chief, or inertial (LVLH has two meanings); of a system "
       "without an orbit its coordinates, which then are the only frame"},
      {"derivatives", form::choice({"rotating", "inertial"}),
       absent::other("`\"rotating\"`, of RTN"),
       "velocities as seen from the turning axes (at the rate of the osculating orbit), or not; "
       "of RTN alone"}};
}

std::vector<SceneKey> transfer_time_keys(const Absence& absence) {
  const auto times = form::words(
      fmt::format("number, or array of at most {}, not 0", most_transfer_times), form::number());
  return {{"times_s", times, absence, "moving away from 0"},
          {"times_orbits", times, absence, "the same in periods of the nominal"},
          {"times_canonical", times, absence, "moving away from 0"},
          {"count", form::integer(1, most_transfer_times), absence,
           "number of equal parts of the duration"}};
}

std::vector<SceneKey> instant_keys() {
  const auto absence = absent::other("another of these three");
  return {{"time_s", form::number(), absence, "since the start"},
          {"time_orbits", form::number(), absence, "the same in periods of the nominal"},
          {"time_canonical", form::number(), absence, "since the start"}};
}

std::string_view read_instant(const TableReader& table, const Nominal& nominal, double& time) {
  const std::string_view key = table.exactly_one_of({"time_s", "time_orbits", "time_canonical"});
  const double given = table.number(key);
  time = canonical_time(table, key, given, nominal);
  if (!std::isfinite(time)) {
    table.fail(key, fmt::format("out of range, got {}, must be within binary64 in canonical units",
                                given));
  }
  return key;
}

namespace {

void require_all_variables(const TableReader& table, const Scene& scene) {
  const std::vector<std::string_view> names = variable_names(scene.system);
  if (scene.variables.size() != names.size()) {
    std::vector<std::string_view> given;
    for (const std::size_t variable : scene.variables) given.push_back(names[variable]);
    table.fail("", fmt::format("not defined for these jet.variables, got {}, must be all of {}",
                               listed(given), listed(names)));
  }
  if (scene.precision == Precision::extended) {
    table.fail("",
               "not available in extended precision, got precision = \"extended\", must be "
               "\"double\": every answer is proved by flying in double precision, whose rounding "
               "hides what more digits would tell");
  }
}

}  // namespace

void require_relative_motion(const TableReader& table, const Scene& scene) {
  if (!is_orbit(scene.system.model)) {
    const bool is_own = scene.system.model == SystemModel::own;
    table.fail("", fmt::format("not available for this model, got {}, must be an orbit: "
                               "zonal-gravity, kepler or earth{}{}",
                               model_name(scene.system.model), is_own ? "; " : "",
                               is_own ? studies_of_own_systems : ""));
  }
  require_all_variables(table, scene);
}

void require_deviations(const TableReader& table, const Scene& scene) {
  if (is_orbit(scene.system.model)) return require_relative_motion(table, scene);
  if (const std::string missing = missing_for_deviations(scene); !missing.empty()) {
    table.fail("", missing);
  }
  require_all_variables(table, scene);
}

void refuse_keys_of_orbits(const TableReader& table, const std::vector<std::string_view>& keys,
                           std::string_view instead) {
  for (const std::string_view key : keys) {
    if (!table.has(key)) continue;
    table.fail(key, fmt::format("for spacecraft in an orbit, got {}, must be left out: along the "
                                "coordinates of this system are {}",
                                table.found(key), instead));
  }
}

namespace {

const std::vector<std::string_view>& time_keys() {
  static const std::vector<std::string_view> keys =
      TableDescription{transfer_time_keys({})}.names();
  return keys;
}

bool has_times(const TableReader& table) {
  return std::any_of(time_keys().begin(), time_keys().end(),
                     [&](std::string_view key) { return table.has(key); });
}

/// The times of the only key that is present; a time of 0 is refused with this reason.
std::vector<double> read_times(const TableReader& table, const Scene& scene, const Nominal& nominal,
                               std::string_view of_zero) {
  const std::string_view key = table.exactly_one_of(time_keys());
  if (key == "count") {
    const auto count = table.integer("count");
    return equal_parts(table, static_cast<int>(count), scene.duration);
  }
  const std::vector<double> given = table.number_or_numbers(key);
  if (given.size() > static_cast<std::size_t>(most_transfer_times)) {
    table.fail(key, fmt::format("too many, got {} times, must be at most {}", given.size(),
                                most_transfer_times));
  }
  std::vector<double> times;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const double time = canonical_time(table, key, given[i], nominal);
    if (given[i] == 0) table.fail_element(key, i, std::string(of_zero));
    if (!std::isfinite(time) || time == 0) {
      table.fail_element(key, i,
                         fmt::format("out of range, got {}, which is {} in canonical units, must "
                                     "be within binary64 there",
                                     given[i], time));
    }
    const bool is_further =
        times.empty() || (std::abs(time) > std::abs(times.back()) && time * times.back() > 0);
    if (!is_further) {
      table.fail_element(key, i,
                         fmt::format("out of order, got {} after {}, must move away from 0 and "
                                     "keep the sign",
                                     given[i], given[i - 1]));
    }
    times.push_back(time);
  }
  return times;
}

}  // namespace

std::vector<double> read_transfer_times(const TableReader& table, const Scene& scene,
                                        const Nominal& nominal, std::optional<int> default_count) {
  if (!has_times(table) && default_count) {
    return equal_parts(table, *default_count, scene.duration);
  }
  return read_times(table, scene, nominal,
                    default_count
                        ? "the start itself, got 0, must not be 0: there all is as it was given"
                        : "zero transfer time, got 0, must not be 0: in no time only a jump leads "
                          "from one position to another");
}

std::vector<double> read_jet_times(const TableReader& jet, const Scene& scene,
                                   const Nominal& nominal) {
  if (!has_times(jet)) return {};
  const std::string_view key = jet.exactly_one_of(time_keys());
  if (scene.arcs != std::optional<std::size_t>(1)) {
    jet.fail(key, fmt::format("not possible, got jet.arcs = {}, must be 1 or left out: jets at "
                              "several times come from one propagation",
                              jet.found("arcs")));
  }
  for (const IntegratorSettings& settings : scene.integrators) {
    if (settings.method == IntegrationMethod::gauss) continue;
    jet.fail(key, fmt::format("not possible, got the integrator {} of the method {}, which has no "
                              "jets between its steps, must be gauss alone",
                              settings.label, method_name(settings.method)));
  }
  std::vector<double> times = read_times(
      jet, scene, nominal, "zero, got 0, must not be 0: at the start every jet is the identity");
  // A time that equals the duration, up to the rounding of its unit, is that of the run's own jet.
  constexpr double rounding = 1e-12;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double part = times[i] / scene.duration;
    if (part > 0 && part <= 1 + rounding) continue;
    jet.fail_element(key, i,
                     fmt::format("outside the span, got {} times the duration, must lie between 0 "
                                 "and the duration",
                                 part));
  }
  if (times.back() / scene.duration >= 1 - rounding) times.pop_back();
  return times;
}

namespace {

/// Refuses a name that is not a frame here: that of other axes, or of a form that has keys of its
/// own.
void refuse_other_frames(const TableReader& table) {
  const std::string given = table.text_if_any("frame").value_or("");
  if (lower_case(given) == "lvlh") {
    table.fail("frame",
               fmt::format("ambiguous, got {}, which means x radial outward and y along the "
                           "motion (here RTN) to some, and to others z toward the Earth's "
                           "centre, y opposite to the orbit normal and x along the motion; "
                           "must be \"RTN\", into which coordinates of the latter are to be "
                           "turned: R = -z, T = x, N = -y",
                           in_quotes(given)));
  }
  for (const DeputyForm form : nonlinear_forms) {
    if (!nearest(lower_case(given), {name_of(form)})) continue;
    std::vector<std::string_view> keys;
    for (const DeputyComponent& component : components_of(form)) keys.push_back(component.name);
    table.fail("frame",
               fmt::format("the name of a form, not of a frame, got {}, must be \"RTN\", "
                           "\"inertial\" or left out: the start of a deputy in the form {} is "
                           "given by the keys {} in place of position_m and velocity_m_s",
                           in_quotes(given), name_of(form), listed(keys)));
  }
}

/// The only frame of a system without an orbit.
RelativeFrame frame_of_coordinates(const TableReader& of_frame, const TableReader& of_derivatives) {
  if (of_frame.has("frame") && of_frame.choice("frame") != 2) {
    of_frame.fail("frame", fmt::format("axes of an orbit, got {}, must be \"coordinates\" or left "
                                       "out: this system has no chief with such axes",
                                       of_frame.found("frame")));
  }
  if (of_derivatives.has("derivatives")) {
    of_derivatives.fail("derivatives",
                        fmt::format("of RTN alone, got {}, must be left out: velocities are the "
                                    "rates of the coordinates",
                                    of_derivatives.found("derivatives")));
  }
  return RelativeFrame::coordinates;
}

}  // namespace

RelativeFrame read_relative_frame(const TableReader& table, const TableReader& fallback,
                                  const Nominal& nominal) {
  const TableReader& of_frame = table.has("frame") ? table : fallback;
  const TableReader& of_derivatives = table.has("derivatives") ? table : fallback;
  if (!nominal.orbit) return frame_of_coordinates(of_frame, of_derivatives);
  if (of_frame.has("frame")) refuse_other_frames(of_frame);
  const std::size_t choice = of_frame.has("frame") ? of_frame.choice("frame") : 0;
  if (choice == 2) {
    of_frame.fail("frame",
                  "the frame of systems without an orbit, got \"coordinates\", must be \"RTN\" or "
                  "\"inertial\": the coordinates of an orbit are along the inertial axes");
  }
  const bool is_inertial = choice == 1;
  // The derivatives that the other table states for its own frame mean nothing for a frame that has
  // none.
  if (is_inertial && table.has("frame") && !table.has("derivatives")) {
    return RelativeFrame::inertial;
  }
  if (!of_derivatives.has("derivatives")) {
    return is_inertial ? RelativeFrame::inertial : RelativeFrame::rtn_rotating;
  }
  const bool are_inertial = of_derivatives.choice("derivatives") == 1;
  if (is_inertial) {
    of_derivatives.fail("derivatives",
                        fmt::format("the frame inertial has one kind of derivatives, got {}, must "
                                    "be left out",
                                    of_derivatives.found("derivatives")));
  }
  return are_inertial ? RelativeFrame::rtn_inertial : RelativeFrame::rtn_rotating;
}

RelativeFrame read_relative_frame(const TableReader& table, const Nominal& nominal) {
  return read_relative_frame(table, table, nominal);
}

bool has_collision(const TableReader& root) {
  if (!root.has("uncertainty")) return false;
  try {
    return root.table("uncertainty").has("collision");
  } catch (const Error&) {
    return false;  // a value that is not a table is reported where it is read
  }
}

std::vector<std::string> likely_slips_of_deputies(const TableReader& root, const Scene& scene) {
  std::vector<std::string> warnings;
  if (scene.transfer && scene.transfer->kind != TransferSettings().kind &&
      scene.coordinates != JetCoordinates::cartesian) {
    warnings.push_back(fmt::format(
        "{}{}: not used, got {} with jet.coordinates = {}, should be left out: polynomials in such "
        "coordinates have no generating function and are solved by Newton's method",
        warning_head, root.table("transfer").head("kind"), in_quotes(scene.transfer->kind),
        in_quotes(name_of(scene.coordinates))));
  }
  if (!is_orbit(scene.system.model)) return warnings;
  const double distance_m =
      Eigen::Vector3d(scene.nominal.data()).norm() * scene.units.length_km * 1000;
  const double chief_m_s = Eigen::Vector3d(scene.nominal.data() + 3).norm() *
                           scene.units.length_km * 1000 / scene.units.time_s;
  const auto look = [&](const TableReader& table, const RelativeState& state) {
    const double speed_m_s = state.velocity_m_s.stableNorm();
    if (speed_m_s > 0 && speed_m_s >= chief_m_s / 20) {
      warnings.push_back(fmt::format(
          "{}{}: fast beside its chief, got {:.4g} m/s, should be well below {:.4g} m/s, a "
          "twentieth of the chief's own speed: polynomials are right near the chief alone; a "
          "velocity_m_s is relative to the chief's, in m/s",
          warning_head, table.head(table.has("velocity_m_s") ? "velocity_m_s" : ""), speed_m_s,
          chief_m_s / 20));
    }
    const double separation_m = state.position_m.stableNorm();
    if (separation_m < distance_m / 20) return;
    warnings.push_back(fmt::format(
        "{}{}: far from its chief, got {}, should be well below {}: polynomials "
        "are right near the "
        "chief alone, and hamjet validity says how far",
        warning_head, table.head(""), length_text(separation_m), length_text(distance_m / 20)));
  };
  if (scene.deputy && !has_collision(root)) look(root.table("deputy"), scene.deputy->start);
  for (const std::string& name : differing_parameters(scene)) {
    const bool is_drag = name == drag_parameter;
    const double chief = coefficient_of_owner(scene, false, is_drag).value_or(0);
    const double difference = parameter_difference(scene, name);
    if (chief == 0 || std::abs(difference) <= chief) continue;
    warnings.push_back(fmt::format(
        "{}{}: far from that of its chief, got {} = {:.6g} beside {:.6g}, should be up to {:.6g}, "
        "twice as much: polynomials in it are right near the chief's value alone",
        warning_head, root.table("deputy").head("spacecraft"), name, chief + difference, chief,
        2 * chief));
  }
  if (scene.deputy && has_collision(root) && scene.system.earth && scene.system.earth->radiation &&
      scene.system.earth->radiation->shadow != ShadowModel::none) {
    const double separation_m = scene.deputy->start.position_m.stableNorm();
    if (separation_m >= distance_m / 20) {
      warnings.push_back(fmt::format(
          "{}{}: lit as its chief is, got a deputy {} away, should be well below {}, or shadow = "
          "\"none\": the edges of the shadow are those of the chief's orbit",
          warning_head, root.table("deputy").head(""), length_text(separation_m),
          length_text(distance_m / 20)));
    }
  }
  if (!scene.transfer) return warnings;
  const TableReader transfer = root.table("transfer");
  if (transfer.has("start")) look(transfer.table("start"), scene.transfer->start);
  if (transfer.has("end")) look(transfer.table("end"), scene.transfer->end);
  return warnings;
}

}  // namespace hamjet::io
