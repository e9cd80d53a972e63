#include "orbit_ephemeris.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "../../algebra/state_sums.hpp"
#include "../../studies/exact_flow.hpp"
#include "../../studies/formation/formation_problem.hpp"
#include "../../studies/formation/single_transfer.hpp"
#include "../output_formats.hpp"
#include "../relative_frame_text.hpp"
#include "../xml/orbit_message_xml.hpp"
#include "dated_scene.hpp"
#include "hamjet/error.hpp"
#include "hamjet/formats/orbit_message.hpp"
#include "hamjet/formats/orbit_message_axes.hpp"

namespace hamjet::io {
namespace {

/// A message of one segment without states.
OrbitEphemerisMessage message_of(const Scene& scene, const std::string& source) {
  const EphemerisSettings& settings = *scene.ephemeris;
  OrbitEphemerisMessage message;
  message.version = settings.oem_version;
  message.creation_date = current_epoch();
  message.originator = settings.originator;
  message.comments = origin_comments(scene, source);
  EphemerisSegment segment;
  segment.metadata = {settings.object_name,
                      settings.object_id,
                      settings.center_name,
                      scene.system.earth ? scene.system.earth->axes : settings.reference_frame,
                      time_system_of(settings),
                      std::nullopt};
  if (!settings.reference_frame_epoch.empty()) {
    segment.metadata.reference_frame_epoch = parse_epoch(settings.reference_frame_epoch).value();
  }
  segment.comments = model_comments(scene);
  message.segments.push_back(segment);
  return message;
}

OrbitState orbit_state(const Scene& scene, double time, std::span<const double> state) {
  const Extended length = scene.units.length_km;
  OrbitState result{moment_of(scene, time), {}, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    result.position_km[i] = convert<double>(state[i] * length);
    // The momenta of an orbit are per unit of mass.
    result.velocity_km_s[i] = convert<double>(state[3 + i] * length / scene.units.time_s);
  }
  return result;
}

/// Turns states that are flown along GCRF into the axes that the scene asks for. The span of the
/// change begins no later than the scene, for without a table UT1 = UTC where it begins.
void turn_to_axes(const Scene& scene, std::vector<OrbitState>& states) {
  if (!scene.system.earth || states.empty()) return;
  const EarthSettings& earth = *scene.system.earth;
  Epoch first = moment_of(scene, 0), last = first;
  for (const OrbitState& state : states) {
    first = std::min(first, state.epoch);
    last = std::max(last, state.epoch);
  }
  const MessageFrameChange change({scene.ephemeris->reference_frame}, {earth.axes},
                                  time_system_of(*scene.ephemeris), first, last, earth.orientation);
  for (OrbitState& state : states) state = change.of(state);
}

/// Adds states in order of time, whatever the direction in which they are given; of two states
/// within a picosecond the first one stays.
void add_states(const Scene& scene, OrbitEphemerisMessage& message,
                std::vector<OrbitState> states) {
  turn_to_axes(scene, states);
  std::stable_sort(states.begin(), states.end(),
                   [](const OrbitState& a, const OrbitState& b) { return a.epoch < b.epoch; });
  const auto end =
      std::unique(states.begin(), states.end(),
                  [](const OrbitState& a, const OrbitState& b) { return a.epoch == b.epoch; });
  states.erase(end, states.end());
  message.segments.front().states = std::move(states);
}

std::string change_text(const Eigen::Vector3d& change_m_s, RelativeFrame frame) {
  const auto letters = axis_letters(frame);
  return fmt::format("{} = {:.9g} km/s, {} = {:.9g} km/s, {} = {:.9g} km/s", letters[0],
                     change_m_s[0] / 1000, letters[1], change_m_s[1] / 1000, letters[2],
                     change_m_s[2] / 1000);
}

std::vector<OrbitState> flown_states(const Scene& scene, const std::vector<double>& times,
                                     const std::vector<std::vector<double>>& states) {
  std::vector<OrbitState> result;
  for (std::size_t i = 0; i < times.size(); ++i) {
    result.push_back(orbit_state(scene, times[i], states[i]));
  }
  return result;
}

std::string accuracy_text(const RunResult& run) {
  if (!run.error_by_degree) return "Accuracy: not measured, for the scene asks for no reference";
  return fmt::format(
      "Accuracy: relative error of the last state {:.2g}, against a reference in extended "
      "precision",
      run.error_by_degree->front());
}

/// The nominal's state at one moment, with the comments that messages of its whole motion also
/// have.
OrbitParameterMessage opm_at(const PropagationResult& result, const RunResult& run,
                             std::string_view place, double time,
                             const std::vector<double>& state) {
  OrbitEphemerisMessage common = message_of(
      result.scene, fmt::format("The {} of the nominal of the run {}", place, run.settings.label));
  EphemerisSegment& segment = common.segments.front();
  segment.comments.push_back(accuracy_text(run));
  OrbitParameterMessage message;
  message.version = common.version;
  message.comments = std::move(common.comments);
  message.creation_date = common.creation_date;
  message.originator = std::move(common.originator);
  message.metadata = std::move(segment.metadata);
  message.state_comments = std::move(segment.comments);
  std::vector<OrbitState> one = {orbit_state(result.scene, time, state)};
  turn_to_axes(result.scene, one);
  message.state = one.front();
  if (const auto& earth = result.scene.system.earth) {
    const SpacecraftParts& parts = earth->parts;
    message.spacecraft = {parts.mass_kg, parts.radiation_area_m2, parts.radiation_coefficient,
                          parts.drag_area_m2, parts.drag_coefficient};
  }
  return message;
}

OrbitParameterMessage start_of(const PropagationResult& result, const RunResult& run) {
  return opm_at(result, run, "start", 0, result.scene.nominal);
}

OrbitParameterMessage end_of(const PropagationResult& result, const RunResult& run) {
  return opm_at(result, run, "end", result.scene.duration, run.nominal_final);
}

OrbitEphemerisMessage nominal_of(const PropagationResult& result, const RunResult& run) {
  OrbitEphemerisMessage message =
      message_of(result.scene, fmt::format("The nominal of the run {}", run.settings.label));
  std::vector<std::string>& comments = message.segments.front().comments;
  comments.push_back(accuracy_text(run));
  comments.push_back(
      "States at the steps of the integrator, which are not spaced for interpolation. Taylor "
      "coefficients, generating functions and checks cannot stand here: see jet.csv, summary.json");
  std::vector<OrbitState> states;
  for (const NominalPoint& point : run.nominal) {
    states.push_back(orbit_state(result.scene, point.time, point.state));
  }
  add_states(result.scene, message, std::move(states));
  return message;
}

using OfNominal = std::string (*)(const PropagationResult&, const RunResult&);

/// The properties that all formats of messages have in common.
OutputFormat message_format(std::string_view name, std::string_view help, std::string_view file,
                            OfNominal of_nominal) {
  return {.name = name,
          .help = help,
          .file = file,
          .needs_orbit = true,
          .needs_date = true,
          .of_nominal = of_nominal};
}

/// The same properties for XML, which a build may lack.
OutputFormat xml_format(std::string_view name, std::string_view help, std::string_view file,
                        OfNominal of_nominal) {
  OutputFormat format = message_format(name, help, file, of_nominal);
  format.library = "pugixml";
  format.is_built = is_xml_built;
  return format;
}

constexpr std::string_view opm_help = "orbit parameter messages";
constexpr std::string_view oem_help = "an orbit ephemeris message";

}  // namespace

std::string nominal_oem(const PropagationResult& result, const RunResult& run) {
  return oem_text(nominal_of(result, run));
}

std::vector<ReportFile> transfer_oems(const TransferResult& result,
                                      const RelativeTrajectory& trajectory) {
  const Scene& scene = result.scene;
  OrbitEphemerisMessage chief =
      message_of(scene, "The chief, flown with the full equations of motion");
  add_states(scene, chief, flown_states(scene, trajectory.times, trajectory.chief));

  OrbitEphemerisMessage deputy = message_of(
      scene, fmt::format("The deputy of the best transfer relative to {}, flown with the full "
                         "equations of motion",
                         scene.ephemeris->object_name));
  EphemerisSegment& segment = deputy.segments.front();
  segment.metadata.object_name = scene.ephemeris->deputy_name;
  segment.metadata.object_id = scene.ephemeris->deputy_id;
  const TransferAnswer& answer = result.points[*result.best_point()].best();
  const RelativeFrame frame = scene.transfer->frame;
  segment.comments.push_back(
      fmt::format("The states begin after the first velocity change and end before the second; the "
                  "changes are given along axes relative to the chief: {}",
                  frame_text(frame)));
  segment.comments.push_back("First change: " + change_text(answer.start_change_m_s, frame));
  segment.comments.push_back("Second change: " + change_text(answer.end_change_m_s, frame));
  segment.comments.push_back(fmt::format("It misses its place by {:.3g} m", answer.miss_m));
  add_states(scene, deputy, flown_states(scene, trajectory.times, trajectory.deputy));
  std::vector<ReportFile> files;
  if (scene.output.has(oem_format.name)) {
    files = {{"chief.oem", oem_text(chief)}, {"deputy.oem", oem_text(deputy)}};
  }
  if (scene.output.has(oem_xml_format.name)) {
    files.push_back({"chief.oem.xml", oem_xml(chief)});
    files.push_back({"deputy.oem.xml", oem_xml(deputy)});
  }
  return files;
}

namespace {

/// What a transfer's OPM tells as manoeuvres.
struct MessagePlan {
  std::vector<Impulse> impulses;
  const BurnPlan* burns = nullptr;
  std::string name;

  double start() const { return burns != nullptr ? std::min(0.0, burns->burns.front().start) : 0; }
};

MessagePlan message_plan(const TransferResult& result) {
  if (result.burns && result.burns->least) {
    const BurnPlan& plan = result.burns->plans[*result.burns->least];
    return {{}, &plan, "the burns of the thruster"};
  }
  if (result.optimal && result.optimal->is_found()) {
    return {result.optimal->plan->impulses, nullptr, "the optimal impulses"};
  }
  const TransferPoint& point = result.points[*result.best_point()];
  return {{{0, point.best().start_change_m_s}, {point.time, point.best().end_change_m_s}},
          nullptr,
          "the two impulses of the best time"};
}

/// The axes in which changes along inertial axes are told.
std::string inertial_axes_of(const Scene& scene) {
  return scene.system.earth ? "GCRF" : scene.ephemeris->reference_frame;
}

std::vector<OpmManoeuvre> manoeuvres_of(const Scene& scene, const MessagePlan& plan,
                                        const SharedSystem& chief_system) {
  std::vector<OpmManoeuvre> manoeuvres;
  for (const Impulse& impulse : plan.impulses) {
    const std::vector<double> chief =
        impulse.time == 0 ? scene.nominal
                          : exact_flow(chief_system, scene.nominal, scene.start_time, impulse.time);
    const ChiefFrame frame(chief, metric_units(scene), scene.transfer->frame);
    const std::vector<double> change =
        frame.deviation({Eigen::Vector3d::Zero(), impulse.change_m_s});
    OpmManoeuvre one{moment_of(scene, impulse.time), 0, 0, inertial_axes_of(scene), {}, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      one.change_km_s[i] = change[3 + i] * scene.units.length_km / scene.units.time_s;
    }
    manoeuvres.push_back(std::move(one));
  }
  if (plan.burns == nullptr) return manoeuvres;
  const bool is_rtn = scene.thruster->attitude == BurnAttitude::rtn;
  for (const FiniteBurn& burn : plan.burns->burns) {
    OpmManoeuvre one{moment_of(scene, burn.start),
                     (burn.end - burn.start) * scene.units.time_s,
                     -burn.propellant_kg.value_or(0),
                     is_rtn ? "RTN" : inertial_axes_of(scene),
                     {},
                     0};
    for (std::size_t i = 0; i < 3; ++i) {
      one.change_km_s[i] = burn.direction[static_cast<Eigen::Index>(i)] * burn.change_m_s / 1000;
    }
    manoeuvres.push_back(std::move(one));
  }
  return manoeuvres;
}

/// A spacecraft of the transfer at the plan's moment.
OrbitParameterMessage opm_of_transfer(const Scene& scene, const std::string& source, double time,
                                      const std::vector<double>& state) {
  OrbitEphemerisMessage common = message_of(scene, source);
  OrbitParameterMessage message;
  message.version = common.version;
  message.comments = std::move(common.comments);
  message.creation_date = common.creation_date;
  message.originator = std::move(common.originator);
  message.metadata = std::move(common.segments.front().metadata);
  message.state_comments = std::move(common.segments.front().comments);
  std::vector<OrbitState> one = {orbit_state(scene, time, state)};
  turn_to_axes(scene, one);
  message.state = one.front();
  return message;
}

}  // namespace

std::vector<ReportFile> transfer_opms(const TransferResult& result) {
  const Scene& scene = result.scene;
  const MessagePlan plan = message_plan(result);
  const double start = plan.start();
  const SharedSystem chief_system(make_system(scene));
  const SharedSystem deputy_system(make_system(with_deputy_coefficients(scene)));
  const auto at_start = [&](const SharedSystem& system, const std::vector<double>& state) {
    return start == 0 ? state : exact_flow(system, state, scene.start_time, start);
  };
  const OrbitParameterMessage chief = opm_of_transfer(scene, "The chief of a transfer", start,
                                                      at_start(chief_system, scene.nominal));
  const std::vector<double> deputy_start =
      state_sum(scene.nominal, ChiefFrame(scene.nominal, metric_units(scene), scene.transfer->frame)
                                   .deviation(scene.transfer->start));
  OrbitParameterMessage deputy = opm_of_transfer(
      scene,
      fmt::format("The deputy of a transfer relative to {}, before its first manoeuvre; the "
                  "manoeuvres are {}, without which it coasts",
                  scene.ephemeris->object_name, plan.name),
      start, at_start(deputy_system, deputy_start));
  deputy.metadata.object_name = scene.ephemeris->deputy_name;
  deputy.metadata.object_id = scene.ephemeris->deputy_id;
  deputy.manoeuvres = manoeuvres_of(scene, plan, chief_system);
  if (plan.burns != nullptr && scene.thruster->exhaust_m_s) {
    deputy.spacecraft.mass_kg = scene.thruster->mass_kg;
  }
  std::vector<ReportFile> files;
  if (scene.output.has(start_opm_format.name)) {
    files = {{"chief.opm", opm_text(chief)}, {"deputy.opm", opm_text(deputy)}};
  }
  if (scene.output.has(start_opm_xml_format.name)) {
    files.push_back({"chief.opm.xml", opm_xml(chief)});
    files.push_back({"deputy.opm.xml", opm_xml(deputy)});
  }
  return files;
}

const OutputFormat oem_format = message_format("oem", oem_help, "nominal.oem", nominal_oem);
const OutputFormat oem_xml_format =
    xml_format("oem-xml", oem_help, "nominal.oem.xml",
               [](const PropagationResult& result, const RunResult& run) {
                 return oem_xml(nominal_of(result, run));
               });

const OutputFormat start_opm_format = message_format(
    "opm", opm_help, "start.opm", [](const PropagationResult& result, const RunResult& run) {
      return opm_text(start_of(result, run));
    });
const OutputFormat end_opm_format = message_format(
    "opm", opm_help, "end.opm", [](const PropagationResult& result, const RunResult& run) {
      return opm_text(end_of(result, run));
    });
const OutputFormat start_opm_xml_format =
    xml_format("opm-xml", opm_help, "start.opm.xml",
               [](const PropagationResult& result, const RunResult& run) {
                 return opm_xml(start_of(result, run));
               });
const OutputFormat end_opm_xml_format = xml_format(
    "opm-xml", opm_help, "end.opm.xml", [](const PropagationResult& result, const RunResult& run) {
      return opm_xml(end_of(result, run));
    });

}  // namespace hamjet::io
