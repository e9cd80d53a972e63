#include "pickling.hpp"

#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "../formats/jet_description.hpp"
#include "../formats/stored_coefficients.hpp"
#include "../studies/formation/charts/deputy_flows.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "refusal.hpp"

namespace hamjet::python {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

[[noreturn]] void refuse_state() { refuse("pickle: this is no state of such an object"); }

/// A call of a C++ function by way of one of Python, for those of pybind11 have no name by which
/// pickle finds them.
py::tuple call_of(const char* function, const py::tuple& arguments) {
  return py::make_tuple(py::module_::import("hamjet.immutable").attr("_restored"),
                        py::make_tuple(function) + arguments);
}

/// The coefficients of a map as an array (components, count).
Numbers numbers_of(const std::vector<Series<double>>& map) {
  std::vector<double> numbers;
  for (const Series<double>& component : map) {
    numbers.insert(numbers.end(), component.coefficients().begin(), component.coefficients().end());
  }
  return array_of(std::move(numbers), {size_of(map.size()), size_of(map[0].size())});
}

std::vector<Series<double>> map_of(const Numbers& numbers, const SpacePointer& space) {
  if (numbers.ndim() != 2 || numbers.shape(0) < 1 || numbers.shape(1) != size_of(space->size())) {
    refuse_state();
  }
  std::vector<Series<double>> map;
  for (py::ssize_t c = 0; c < numbers.shape(0); ++c) {
    map.emplace_back(space,
                     std::vector<double>(numbers.data(c, 0), numbers.data(c, 0) + space->size()));
  }
  return map;
}

// The members of a jet that are one number, text or list each, in the order of its state.

using Ephemeris = std::vector<std::string>;

/// All members as texts by name: one that is added does not compile unless it takes part.
Ephemeris texts_of(const EphemerisSettings& settings) {
  const auto& [epoch, time_system, reference_frame, center_name, reference_frame_epoch, object_name,
               object_id, deputy_name, deputy_id, originator, oem_version] = settings;
  return {epoch,       time_system, reference_frame, center_name, reference_frame_epoch,
          object_name, object_id,   deputy_name,     deputy_id,   originator,
          oem_version};
}

EphemerisSettings ephemeris_of(const Ephemeris& texts) {
  if (texts.size() != texts_of({}).size()) refuse_state();
  return {texts[0], texts[1], texts[2], texts[3], texts[4], texts[5],
          texts[6], texts[7], texts[8], texts[9], texts[10]};
}

/// A flow box's chart, the radius of its field and the harmonics.
using FlowBoxState = std::tuple<std::size_t, double, std::vector<double>>;

using JetState =
    std::tuple<std::string, std::string, std::size_t, std::size_t, double, double, double,
               std::vector<double>, std::vector<double>, std::vector<std::size_t>,
               std::vector<std::size_t>, std::optional<Ephemeris>, std::vector<double>, std::size_t,
               std::size_t, std::optional<FlowBoxState>, int, double, bool,
               std::vector<std::string>, std::size_t, std::optional<double>>;

std::optional<FlowBoxState> state_of(const std::optional<io::StoredFlowBox>& box) {
  if (!box) return std::nullopt;
  const auto& J = box->field.J.values();
  return FlowBoxState{
      static_cast<std::size_t>(box->section), box->field.radius, {J.begin(), J.end()}};
}

JetState state_of(const io::StoredJet& stored) {
  // The notes are of the file that was read, and have been said.
  const auto& [scene, label, model, precision, units, duration, start_time, is_autonomous,
               nominal_initial, nominal_final, components, variables, ephemeris, error_by_degree,
               coordinates, flow_box, eval_tolerance_m, notes, own_names, parameters, jet] = stored;
  return {scene,
          label,
          static_cast<std::size_t>(model),
          static_cast<std::size_t>(precision),
          units.length_km,
          units.time_s,
          duration,
          nominal_initial,
          nominal_final,
          components,
          variables,
          ephemeris ? std::optional(texts_of(*ephemeris)) : std::nullopt,
          error_by_degree,
          static_cast<std::size_t>(coordinates.start),
          static_cast<std::size_t>(coordinates.end),
          state_of(flow_box),
          jet.at(0).order(),
          start_time.in<double>(),
          is_autonomous,
          own_names,
          parameters,
          eval_tolerance_m};
}

std::optional<io::StoredFlowBox> flow_box_of(const std::optional<FlowBoxState>& state) {
  if (!state) return std::nullopt;
  const auto& [section, radius, J] = *state;
  constexpr std::size_t count = ZonalCoefficients::count;
  if (section > static_cast<std::size_t>(ChartName::nodal) || J.size() != count) refuse_state();
  return io::StoredFlowBox{static_cast<ChartName>(section),
                           {canonical_mu, radius, ZonalCoefficients(std::span(J).first<count>())}};
}

/// Throws unless the coordinates are what such a jet may be in.
void require_coordinates(const io::StoredJet& jet) {
  const bool is_in_charts = jet.coordinates != JetCoordinates::cartesian;
  const bool is_in_flow_box = jet.coordinates == JetCoordinates::flow_box;
  if (!jet.coordinates.fit_each_other() || jet.coordinates == JetCoordinates::automatic ||
      is_in_flow_box != jet.flow_box.has_value() ||
      (is_in_charts && (!is_orbit(jet.model) || jet.variables.size() != 6))) {
    refuse_state();
  }
}

/// The stored jet of a state, without its series.
io::StoredJet stored_jet_of(const JetState& state) {
  io::StoredJet jet;
  std::size_t model = 0;
  std::size_t precision = 0;
  std::optional<Ephemeris> ephemeris;
  std::size_t start = 0;
  std::size_t end = 0;
  std::optional<FlowBoxState> flow_box;
  double start_time = 0;
  std::tie(jet.scene, jet.label, model, precision, jet.units.length_km, jet.units.time_s,
           jet.duration, jet.nominal_initial, jet.nominal_final, jet.components, jet.variables,
           ephemeris, jet.error_by_degree, start, end, flow_box, std::ignore, start_time,
           jet.is_autonomous, jet.own_names, jet.parameters, jet.eval_tolerance_m) = state;
  constexpr std::size_t coordinates = jet_coordinates_names.size();
  if (model >= model_names().size() || precision > 1 || start >= coordinates ||
      end >= coordinates) {
    refuse_state();
  }
  if (!std::isfinite(start_time)) refuse_state();
  jet.start_time = ClockTime(start_time);
  jet.model = static_cast<SystemModel>(model);
  jet.precision = static_cast<Precision>(precision);
  if (ephemeris) jet.ephemeris = ephemeris_of(*ephemeris);
  const std::size_t size = jet.nominal_initial.size();
  for (const auto* indices : {&jet.components, &jet.variables}) {
    for (const std::size_t i : *indices) {
      if (i >= size) refuse_state();
    }
  }
  if (jet.nominal_final.size() != size || jet.variables.empty()) refuse_state();
  if (!jet.own_names.empty() && jet.own_names.size() != size) refuse_state();
  const bool has_names = jet.parameters == 0 || !jet.own_names.empty();
  if (!has_names || jet.parameters >= size || (size - jet.parameters) % 2 != 0) refuse_state();
  jet.coordinates = {static_cast<JetCoordinates>(start), static_cast<JetCoordinates>(end)};
  jet.flow_box = flow_box_of(flow_box);
  require_coordinates(jet);
  return jet;
}

/// Coefficients of a jet in extended precision as digits that bring back all bits.
std::vector<std::string> digits_of(const FlowJet<Extended>& jet) {
  std::vector<std::string> digits;
  for (const Series<Extended>& component : jet) {
    for (const Extended& c : component.coefficients()) digits.push_back(io::extended_digits(c));
  }
  return digits;
}

FlowJet<Extended> jet_of_digits(const std::vector<std::string>& digits, std::size_t components,
                                const SpacePointer& space) {
  if (digits.size() != components * space->size()) refuse_state();
  FlowJet<Extended> jet;
  auto next = digits.begin();
  for (std::size_t c = 0; c < components; ++c) {
    std::vector<Extended> coefficients;
    for (std::size_t k = 0; k < space->size(); ++k) {
      const auto number = io::parse_coefficient(*next++, Precision::extended);
      if (!number) refuse_state();
      coefficients.push_back(*number);
    }
    jet.emplace_back(space, std::move(coefficients));
  }
  return jet;
}

/// A jet's coefficients as they are in a pickle.
py::object coefficients_of(const io::StoredJet& stored) {
  if (stored.precision == Precision::extended) return py::cast(digits_of(stored.jet));
  return numbers_of(convert_map<double>(stored.jet));
}

io::StoredJet restored(const JetState& state, const py::object& coefficients) {
  io::StoredJet stored = stored_jet_of(state);
  const std::optional<io::SeriesNames> names =
      stored.flow_box ? std::optional(io::series_names(stored)) : std::nullopt;
  const std::size_t components = (names ? names->components : stored.components).size();
  const SpacePointer space = SeriesSpace::create(
      (names ? names->variables : stored.variables).size(), std::get<int>(state));
  if (stored.precision == Precision::extended) {
    stored.jet = jet_of_digits(coefficients.cast<std::vector<std::string>>(), components, space);
  } else {
    stored.jet = convert_map<Extended>(map_of(coefficients.cast<Numbers>(), space));
  }
  if (stored.jet.size() != components) refuse_state();
  return stored;
}

std::shared_ptr<Jet> restored_jet(const JetState& state, const py::object& coefficients) {
  io::StoredJet stored = restored(state, coefficients);
  // A jet in Python is in positions and momenta.
  if (stored.coordinates != JetCoordinates::cartesian) refuse_state();
  return std::make_shared<Jet>(std::move(stored));
}

/// The polynomials to one degree more, by which estimates are made.
using NextDegree = std::pair<JetState, py::object>;

PolynomialsStudy restored_polynomials(const JetState& state, const py::object& coefficients,
                                      double rounding_m, const std::vector<double>& error,
                                      std::vector<double> chief_end,
                                      const std::optional<NextDegree>& next) {
  const io::StoredJet stored = restored(state, coefficients);
  if (!is_orbit(stored.model) || stored.variables.size() != 6) refuse_state();
  cli::EvaluatedScene evaluated = cli::evaluated_jet(stored);
  evaluated.rounding_m = rounding_m;
  evaluated.error = cli::FlowError::of_numbers(error);
  if (chief_end.size() != 6) refuse_state();
  if (chief_end != evaluated.chief.nominal_final)
    cli::set_chief_end(evaluated, std::move(chief_end));
  if (next) {
    const io::StoredJet further = restored(next->first, next->second);
    if (further.order() != stored.order() + 1 || further.coordinates != stored.coordinates ||
        further.nominal_initial != stored.nominal_initial) {
      refuse_state();
    }
    evaluated.further = {cli::evaluated_jet(further).flow, further.nominal_final};
  }
  return PolynomialsStudy(std::move(evaluated));
}

using ExactnessRow = std::tuple<int, double, double>;

std::shared_ptr<InvertedJet> restored_function(const std::string& kind, double condition,
                                               const std::vector<std::string>& variables,
                                               const std::vector<std::string>& remaining_variables,
                                               int order, const Numbers& function,
                                               const Numbers& gradient, const Numbers& remaining,
                                               const std::vector<ExactnessRow>& exactness) {
  const SpacePointer space = SeriesSpace::create(variables.size(), order);
  const SpacePointer lower = SeriesSpace::create(variables.size(), order - 1);
  InvertedJet::Parts parts{parse_kind(kind, variables.size() / 2),
                           condition,
                           variables,
                           remaining_variables,
                           map_of(function, space),
                           map_of(gradient, space),
                           map_of(remaining, lower),
                           {}};
  for (const auto& [degree, absolute, scaled] : exactness) {
    parts.exactness.push_back({degree, absolute, scaled, std::nullopt});
  }
  return std::make_shared<InvertedJet>(std::move(parts));
}

using Files = std::vector<std::pair<std::string, py::bytes>>;

io::StudyReport restored_report(const Files& files, int exit_code, const std::string& failure) {
  if (files.empty()) refuse_state();
  io::StudyReport report;
  for (const auto& [path, content] : files) report.files.push_back({path, std::string(content)});
  report.exit_code = exit_code;
  report.failure = failure;
  return report;
}

}  // namespace

py::tuple reduced(const CanonicalUnits& units) {
  return call_of("_restored_units", py::make_tuple(units.length_km, units.time_s));
}

py::tuple reduced(const Jet& jet) {
  const io::StoredJet& stored = jet.stored();
  return call_of("_restored_jet", py::make_tuple(state_of(stored), coefficients_of(stored)));
}

py::tuple reduced(const PolynomialsStudy& study) {
  const cli::EvaluatedScene& evaluated = study.evaluated();
  const io::StoredJet stored = cli::stored_polynomials(evaluated);
  std::optional<NextDegree> next;
  if (evaluated.further.flow) {
    cli::EvaluatedScene of_next = evaluated;
    of_next.flow = evaluated.further.flow;
    of_next.stored_end = evaluated.further.stored_end;
    const io::StoredJet further = cli::stored_polynomials(of_next);
    next.emplace(state_of(further), coefficients_of(further));
  }
  return call_of("_restored_polynomials",
                 py::make_tuple(state_of(stored), coefficients_of(stored), evaluated.rounding_m,
                                evaluated.error.numbers(), evaluated.chief.nominal_final, next));
}

py::tuple reduced(const InvertedJet& function) {
  const InvertedJet::Parts& parts = function.parts();
  std::vector<ExactnessRow> exactness;
  for (const ExactnessResidual& entry : parts.exactness) {
    exactness.emplace_back(entry.degree, entry.absolute, entry.scaled);
  }
  return call_of(
      "_restored_function",
      py::make_tuple(parts.kind.name(), parts.condition, parts.variables, parts.remaining_variables,
                     function.space()->order(), numbers_of(parts.function),
                     numbers_of(parts.gradient), numbers_of(parts.remaining), exactness));
}

py::tuple reduced(const io::StudyReport& report) {
  Files files;
  for (const io::ReportFile& file : report.files) {
    files.emplace_back(file.path.string(), py::bytes(file.content));
  }
  return call_of("_restored_report", py::make_tuple(files, report.exit_code, report.failure));
}

void bind_pickling(py::module_& module) {
  module.def("_restored_units", [](double length_km, double time_s) {
    return CanonicalUnits{length_km, time_s};
  });
  module.def("_restored_jet", &restored_jet);
  module.def("_restored_polynomials", &restored_polynomials);
  module.def("_restored_function", &restored_function);
  module.def("_restored_report", &restored_report);
}

}  // namespace hamjet::python
