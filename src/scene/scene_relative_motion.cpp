#include "scene_relative_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "../formats/relative_frame_text.hpp"
#include "../text/quantity_text.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "hamjet/formats/orbit_message.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "scene_orbit.hpp"

namespace hamjet::io {
namespace {

/// A time as the key gives it, in canonical units.
double canonical_time(const TableReader& table, std::string_view key, double given,
                      const Nominal& nominal) {
  if (key == "times_s") return nominal.scale.time_of_s(given);
  if (key == "times_canonical") return given;
  if (!nominal.period_s) {
    table.fail(key, fmt::format("no period, got {} of an orbit that is not elliptic, must be "
                                "times_s or times_canonical",
                                table.found(key)));
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

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

/// A deputy as far from its chief as the centre of attraction is, or as fast as the orbit itself,
/// is beyond every expansion.
Eigen::Vector3d read_vector(const TableReader& table, std::string_view key, double limit,
                            std::string_view what) {
  const std::vector<double> numbers = table.numbers(key, 3);
  const Eigen::Vector3d vector(numbers[0], numbers[1], numbers[2]);
  if (!(vector.stableNorm() < limit)) {
    table.fail(key, fmt::format("too large, got a magnitude of {:.4g}, must be below {:.4g}, {}",
                                vector.stableNorm(), limit, what));
  }
  return vector;
}

MetricUnits metric_units(const Nominal& nominal) {
  const CanonicalUnits units = canonical_units(nominal.scale);
  return {units.length_km * 1000, units.time_s};
}

double distance_of(const Nominal& nominal) { return Eigen::Vector3d(nominal.state.data()).norm(); }

/// Of a circular orbit through the chief, canonical: mu = 1.
double circular_speed_of(const Nominal& nominal) { return 1 / std::sqrt(distance_of(nominal)); }

/// The axes at the chief; says about the table why there are none.
ChiefFrame frame_at_chief(const TableReader& table, const Nominal& nominal, RelativeFrame frame) {
  try {
    return {nominal.state, metric_units(nominal), frame};
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    table.fail("frame", fmt::format("not defined at this chief, got {}, must be \"inertial\": {}",
                                    frame_text(frame), error.what()));
  }
}

/// Refuses a message whose state is not of the chief's moment, or is in other axes.
void require_same_date(const TableReader& table, const Nominal& nominal,
                       const EphemerisSettings& message) {
  const std::string_view file = table.exactly_one_of({"oem_file", "opm_file"});
  if (!nominal.ephemeris) {
    table.fail(file,
               fmt::format("a dated state beside a chief without a date, got {} {}, must have "
                           "a table [ephemeris] that says the chief's epoch, or a chief from "
                           "a message",
                           message.epoch, message.time_system));
  }
  const EphemerisSettings& chief = *nominal.ephemeris;
  if (parse_epoch(message.epoch) != parse_epoch(chief.epoch) ||
      message.time_system != chief.time_system) {
    table.fail(table.has("epoch") ? "epoch" : file,
               fmt::format("a state of another moment than the chief's, got {} {}, must be {} {}",
                           message.epoch, message.time_system, chief.epoch, chief.time_system));
  }
  if (message.reference_frame != chief.reference_frame ||
      message.reference_frame_epoch != chief.reference_frame_epoch) {
    table.fail(file, fmt::format("a state in other axes than the chief's, got {}{}, must be {}{}",
                                 message.reference_frame, message.reference_frame_epoch,
                                 chief.reference_frame, chief.reference_frame_epoch));
  }
}

/// The relative state of a deputy that is given by its own orbit: the difference of the two
/// inertial states, neither of which has been rounded before.
RelativeState read_own_orbit(const TableReader& table, const Nominal& nominal,
                             RelativeFrame frame) {
  const Orbit deputy = read_orbit(table, nominal.centre);
  if (deputy.file) require_same_date(table, nominal, deputy.file->ephemeris);
  const CanonicalScale& scale = nominal.scale;
  std::vector<double> deviation;
  for (std::size_t i = 0; i < 3; ++i) {
    deviation.push_back(convert<double>(
        (deputy.state.position_km[i] - nominal.orbit->position_km[i]) / scale.length_km));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    deviation.push_back(
        convert<double>((deputy.state.velocity_km_s[i] - nominal.orbit->velocity_km_s[i]) *
                        scale.time_s / scale.length_km));
  }
  const double separation = Eigen::Vector3d(deviation.data()).stableNorm();
  if (!(separation < distance_of(nominal))) {
    const double unit_km = canonical_units(scale).length_km;
    table.fail("", fmt::format("too far from its chief, got {:.6g} km between the two, must be "
                               "below {:.6g} km, the chief's distance from the centre",
                               separation * unit_km, distance_of(nominal) * unit_km));
  }
  const double speed = Eigen::Vector3d(deviation.data() + 3).stableNorm();
  if (!(speed < circular_speed_of(nominal))) {
    const double unit_km_s = metric_units(nominal).velocity_m_s() / 1000;
    table.fail("", fmt::format("too fast beside its chief, got {:.6g} km/s between the two, must "
                               "be below {:.6g} km/s, the speed of a circular orbit through the "
                               "chief",
                               speed * unit_km_s, circular_speed_of(nominal) * unit_km_s));
  }
  return frame_at_chief(table, nominal, frame).relative(deviation);
}

}  // namespace

std::vector<SceneKey> relative_state_keys() {
  return joined<SceneKey>(
      {{{"position_m", form::array(form::number(), 3), absent::other("the deputy's own orbit"),
         "relative to the chief, along the axes of the frame; below its distance from the centre"},
        {"velocity_m_s", form::array(form::number(), 3), absent::other("0, at rest in the frame"),
         "below the speed of a circular orbit through the chief"}},
       orbit_keys()});
}

std::vector<SceneKey> relative_frame_keys(const Absence& frame) {
  return {
      {"frame", form::choice({"RTN", "inertial"}), frame,
       "radial, transverse, normal of the chief, or inertial; LVLH has two meanings"},
      {"derivatives", form::choice({"rotating", "inertial"}),
       absent::other("`\"rotating\"`, of RTN"),
       "velocities as seen from the turning axes (at the rate of the osculating orbit), or not; "
       "of RTN alone"}};
}

std::vector<SceneKey> transfer_time_keys(const Absence& absence) {
  const auto times = form::words(
      fmt::format("number, or array of at most {}, not 0", most_transfer_times), form::number());
  return {{"times_s", times, absence, "moving away from 0"},
          {"times_orbits", times, absence, "in periods of the nominal"},
          {"times_canonical", times, absence, "moving away from 0"},
          {"count", form::integer(1, most_transfer_times), absence,
           "so many equal parts of the duration"}};
}

void require_relative_motion(const TableReader& table, const Scene& scene) {
  if (!is_orbit(scene.system.model)) {
    table.fail("", fmt::format("not available for this model, got {}, must be an orbit: "
                               "zonal-gravity or kepler",
                               model_name(scene.system.model)));
  }
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

std::vector<double> read_transfer_times(const TableReader& table, const Scene& scene,
                                        const Nominal& nominal, std::optional<int> default_count) {
  static const std::vector<std::string_view> keys =
      TableDescription{transfer_time_keys({})}.names();
  const bool has_key =
      std::any_of(keys.begin(), keys.end(), [&](std::string_view key) { return table.has(key); });
  if (!has_key && default_count) return equal_parts(table, *default_count, scene.duration);
  const std::string_view key = table.exactly_one_of(keys);
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
    if (given[i] == 0) {
      table.fail_element(key, i,
                         "zero transfer time, got 0, must not be 0: in no time only a jump leads "
                         "from one position to another");
    }
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

namespace {

/// The frame from the tables that have the keys `frame` and `derivatives`.
RelativeFrame read_frame(const TableReader& of_frame, const TableReader& of_derivatives,
                         bool is_rtn_by_default) {
  if (of_frame.has("frame") && lower_case(of_frame.text("frame")) == "lvlh") {
    of_frame.fail("frame",
                  fmt::format("ambiguous, got {}, which means x radial outward and y along the "
                              "motion (here RTN) to some, and to others z toward the Earth's "
                              "centre, y opposite to the orbit normal and x along the motion; "
                              "must be \"RTN\", into which coordinates of the latter are to be "
                              "turned: R = -z, T = x, N = -y",
                              in_quotes(of_frame.text("frame"))));
  }
  const bool is_named = of_frame.has("frame") || !is_rtn_by_default;
  const bool is_inertial = is_named && of_frame.choice("frame") == 1;
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

}  // namespace

RelativeFrame read_relative_frame(const TableReader& table, const TableReader& fallback) {
  return read_frame(table.has("frame") || !fallback.has("frame") ? table : fallback,
                    table.has("derivatives") ? table : fallback, false);
}

RelativeFrame read_relative_frame_or_rtn(const TableReader& table) {
  return read_frame(table, table, true);
}

RelativeState read_relative_state(const TableReader& table, const Nominal& nominal,
                                  RelativeFrame frame) {
  const auto own = orbit_key_of(table);
  for (const std::string_view relative : {"position_m", "velocity_m_s"}) {
    if (!own || !table.has(relative)) continue;
    table.fail(relative, fmt::format("both forms of a deputy, got {} and {}, must be either its "
                                     "state relative to the chief or its own orbit",
                                     *own, relative));
  }
  if (own) return read_own_orbit(table, nominal, frame);
  const MetricUnits units = metric_units(nominal);
  const double distance = distance_of(nominal);
  RelativeState state;
  state.position_m = read_vector(table, "position_m", distance * units.length_m,
                                 "the chief's distance from the centre");
  if (table.has("velocity_m_s")) {
    state.velocity_m_s =
        read_vector(table, "velocity_m_s", circular_speed_of(nominal) * units.velocity_m_s(),
                    "the speed of a circular orbit through the chief");
  }
  return state;
}

RelativeState in_other_frame(const TableReader& table, const Nominal& nominal,
                             const DeputySettings& deputy, RelativeFrame frame) {
  if (deputy.frame == frame) return deputy.start;
  return frame_at_chief(table, nominal, frame)
      .relative(frame_at_chief(table, nominal, deputy.frame).deviation(deputy.start));
}

std::vector<std::string> distant_deputies(const TableReader& root, const Scene& scene) {
  std::vector<std::string> warnings;
  const double distance_m =
      Eigen::Vector3d(scene.nominal.data()).norm() * scene.units.length_km * 1000;
  const auto look = [&](const TableReader& table, const RelativeState& state) {
    const double separation_m = state.position_m.stableNorm();
    if (separation_m < distance_m / 20) return;
    warnings.push_back(fmt::format(
        "{}: far from its chief, got {}, should be well below {}: polynomials are right near the "
        "chief alone, and hamjet validity says how far",
        table.head(""), length_text(separation_m), length_text(distance_m / 20)));
  };
  if (scene.deputy) look(root.table("deputy"), scene.deputy->start);
  if (!scene.transfer) return warnings;
  const TableReader transfer = root.table("transfer");
  if (transfer.has("start")) look(transfer.table("start"), scene.transfer->start);
  if (transfer.has("end")) look(transfer.table("end"), scene.transfer->end);
  return warnings;
}

}  // namespace hamjet::io
