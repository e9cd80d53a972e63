#include "eval_coordinates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "../formats/relative_frame_text.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "refusal.hpp"

namespace hamjet::cli {
namespace {

const std::vector<std::string_view>& frames() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const DeputyForm form : forms()) all.push_back(name_of(form));
    all.push_back(canonical_frame);
    return all;
  }();
  return names;
}

DeputyForm form_of(const std::string& frame, const std::optional<std::string>& derivatives) {
  if (frame == name_of(DeputyForm::rtn_inertial) &&
      derivatives.value_or("rotating") == "inertial") {
    return DeputyForm::rtn_inertial;
  }
  return *std::find_if(forms().begin(), forms().end(),
                       [&](DeputyForm form) { return name_of(form) == frame; });
}

void check_one_frame(Caller caller, std::string_view name, const std::string& frame) {
  const std::string given = argument(caller, name, io::printable(frame));
  if (frame == "LVLH") {
    refuse(given +
           ": has two meanings: x radially outward and z along the orbit's normal, or z toward "
           "the nadir and y opposite the normal; say RTN, which is radial, transverse, normal");
  }
  if (std::find(frames().begin(), frames().end(), frame) == frames().end()) {
    refuse(fmt::format("{}: no such frame; {}", given, io::suggestion(frame, frames())));
  }
}

std::vector<std::string_view> columns_of(DeputyForm form) {
  std::vector<std::string_view> names;
  for (const DeputyComponent& component : components_of(form)) names.push_back(component.name);
  return names;
}

/// The form in words: with derivatives where there are two kinds.
std::string text_of(DeputyForm form) {
  if (form == DeputyForm::rtn_rotating) return io::frame_text(RelativeFrame::rtn_rotating);
  if (form == DeputyForm::rtn_inertial) return io::frame_text(RelativeFrame::rtn_inertial);
  return std::string(name_of(form));
}

}  // namespace

const std::vector<DeputyForm>& forms() {
  static const std::vector<DeputyForm> all = [] {
    std::vector<DeputyForm> found = {DeputyForm::rtn_rotating, DeputyForm::inertial};
    found.insert(found.end(), nonlinear_forms.begin(), nonlinear_forms.end());
    return found;
  }();
  return all;
}

void EvalFrames::check() const {
  check_one_frame(caller, "frame", frame);
  if (to) check_one_frame(caller, "to", *to);
  const std::string given_frame = argument(caller, "frame", frame);
  if (to && (frame == canonical_frame) != (*to == canonical_frame)) {
    refuse(fmt::format("{}: got {}, must both be canonical or neither", argument(caller, "to", *to),
                       given_frame));
  }
  if (!derivatives) return;
  const std::string_view rtn = name_of(DeputyForm::rtn_rotating);
  if (frame != rtn && final_frame() != rtn) {
    refuse(fmt::format("{}: goes with RTN alone, as {} or {}, got {}",
                       argument(caller, "derivatives"), argument(caller, "frame"),
                       argument(caller, "to"), given_frame));
  }
  if (*derivatives != "rotating" && *derivatives != "inertial") {
    refuse(fmt::format("{}: must be rotating or inertial",
                       argument(caller, "derivatives", io::printable(*derivatives))));
  }
}

EvalCoordinates::EvalCoordinates(const io::StoredJet& stored, const EvalFrames& frames,
                                 const CanonicalFactors& told)
    : stored_(stored), told_(told) {
  frames.check();
  if (frames.frame == canonical_frame) {
    const auto names = stored.variable_names();
    for (const std::size_t v : stored.variables) initial_columns_.push_back(names[v]);
    for (const std::size_t c : stored.components) final_columns_.push_back(names[c]);
    return;
  }
  if (!is_orbit(stored.model)) {
    refuse(fmt::format("{}: the model {} is no orbit; {}",
                       argument(frames.caller, "frame", frames.frame), model_name(stored.model),
                       frames.caller == Caller::command
                           ? "say " + argument(frames.caller, "frame", canonical_frame)
                           : "evaluate() takes canonical deviations"));
  }
  const DeputyForm initial = form_of(frames.frame, frames.derivatives);
  const DeputyForm final = form_of(frames.final_frame(), frames.derivatives);
  initial_columns_ = columns_of(initial);
  final_columns_ = columns_of(final);
  has_axes_of_chief_ = final == DeputyForm::rtn_rotating || final == DeputyForm::rtn_inertial ||
                       final == DeputyForm::curvilinear;
  const MetricUnits units{stored.units.length_km * 1000, stored.units.time_s};
  text_ = text_of(initial);
  if (final != initial) text_ += ", results " + text_of(final);
  // In canonical units of an orbit mu is 1. Parameters behind the six numbers are the chief's.
  const std::span<const double> start(stored.nominal_initial), end(stored.nominal_final);
  initial_.emplace(start.first(6), units, 1, initial);
  final_.emplace(end.first(6), units, 1, final);
  const auto& chief = stored.nominal_final;
  chief_distance_ = std::hypot(chief[0], chief[1], chief[2]);
}

double EvalCoordinates::told_factor(std::size_t component) const {
  const std::size_t n = stored_.degrees_of_freedom();
  if (component >= 2 * n) return 1;  // parameters have their own units
  return component < n ? told_.length : told_.momentum;
}

std::vector<double> EvalCoordinates::initial_row(std::span<const double> canonical) const {
  if (initial_) {
    const auto numbers = initial_->coordinates(canonical);
    return {numbers.begin(), numbers.end()};
  }
  std::vector<double> row;
  for (const std::size_t v : stored_.variables) row.push_back(canonical[v] * told_factor(v));
  return row;
}

std::vector<double> EvalCoordinates::variables(std::span<const double> deviation) const {
  if (!initial_) {
    std::vector<double> numbers(deviation.begin(), deviation.end());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      numbers[i] /= told_factor(stored_.variables[i]);
    }
    return numbers;
  }
  const std::array<double, 6> canonical = [&] {
    try {
      return initial_->deviation(deviation);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      throw Error(ErrorKind::usage, error.what());
    }
  }();
  std::vector<double> result(stored_.variables.size(), 0);
  std::size_t of_phase_space = 0;
  for (std::size_t i = 0; i < result.size() && stored_.variables[i] < canonical.size(); ++i) {
    result[i] = canonical[stored_.variables[i]];
    ++of_phase_space;
  }
  if (of_phase_space == canonical.size()) return result;
  // What the rotation of the axes leaves of a component that ought to vanish is round-off.
  constexpr double round_off = 8 * std::numeric_limits<double>::epsilon();
  double size = 0;
  for (const double x : canonical) size = std::max(size, std::abs(x));
  for (std::size_t i = 0; i < canonical.size(); ++i) {
    const bool is_variable =
        std::binary_search(stored_.variables.begin(), stored_.variables.end(), i);
    if (!is_variable && std::abs(canonical[i]) > round_off * size) {
      const auto names = stored_.variable_names();
      std::string expanded;
      for (const std::size_t v : stored_.variables) expanded += fmt::format(" {}", names[v]);
      throw Error(ErrorKind::usage,
                  "the deviation leaves the variables that the jet is expanded in:" + expanded);
    }
  }
  return result;
}

double EvalCoordinates::turned_m(std::span<const double> components, double chief_error) const {
  if (!has_axes_of_chief_) return 0;
  double square = 0;
  for (std::size_t c = 0; c < components.size() && stored_.components[c] < 3; ++c) {
    square += components[c] * components[c];
  }
  return chief_error / chief_distance_ * std::sqrt(square) * stored_.units.length_km * 1000;
}

std::vector<double> EvalCoordinates::final_state(std::span<const double> components,
                                                 double chief_error, MissEstimate& miss) const {
  miss.integration_m += turned_m(components, chief_error);
  if (!final_) {
    std::vector<double> numbers(components.begin(), components.end());
    for (std::size_t c = 0; c < numbers.size(); ++c) {
      numbers[c] *= told_factor(stored_.components[c]);
    }
    return numbers;
  }
  std::array<double, 6> full{};  // of an orbit
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (stored_.components[c] < full.size()) full[stored_.components[c]] = components[c];
  }
  try {
    const auto numbers = final_->coordinates(full);
    return {numbers.begin(), numbers.end()};
  } catch (const Error& error) {
    // Beyond its reach the polynomial may give numbers that are no orbit of a deputy at all.
    if (error.kind() != ErrorKind::numerical) throw;
    if (miss.is_inside()) miss.support = TruncationEstimate::Support::unknown;
    return std::vector<double>(full.size(), std::numeric_limits<double>::quiet_NaN());
  }
}

}  // namespace hamjet::cli
