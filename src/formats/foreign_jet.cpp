#include "foreign_jet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../text/scene_message.hpp"
#include "hamjet/error.hpp"

namespace hamjet::io {
namespace {

/// The label of the single run that a jet from another program has.
constexpr const char* foreign_label = "foreign";

[[noreturn]] void refuse(std::string_view key, const std::string& what) {
  throw Error(ErrorKind::usage, fmt::format("{}: {}", key, what));
}

bool is_given(const DescriptionMember& member, const JetDescription& given) {
  return std::visit([&](auto value) { return (given.*value).has_value(); }, member.value);
}

void require_all(const std::string& name, const JetDescription& given) {
  std::vector<std::string> keys;
  std::vector<std::string> options;
  for (const DescriptionMember& member : description_members()) {
    if (!member.is_needed || is_given(member, given)) continue;
    keys.emplace_back(member.key);
    options.push_back(member.option());
  }
  if (keys.empty()) return;
  throw Error(ErrorKind::usage, fmt::format("{}: a jet from elsewhere needs {} as well ({})", name,
                                            fmt::join(keys, ", "), fmt::join(options, ", ")));
}

SystemModel model_of(const std::string& name) {
  const auto& names = model_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    refuse("model", fmt::format("got {}, {}", in_quotes(name), suggestion(name, names)));
  }
  return static_cast<SystemModel>(found - names.begin());
}

double finite(std::string_view key, double number) {
  if (!std::isfinite(number)) refuse(key, fmt::format("got {}, must be finite", number));
  return number;
}

double positive(std::string_view key, double number) {
  if (!(finite(key, number) > 0)) refuse(key, fmt::format("got {}, must be above 0", number));
  return number;
}

void check_state(const std::vector<double>& state, SystemModel model, std::size_t parameters) {
  const std::vector<std::size_t> sizes = possible_dimensions(model, parameters);
  if (std::find(sizes.begin(), sizes.end(), state.size()) == sizes.end()) {
    refuse("nominal_initial", fmt::format("got {} numbers, must be {} of the model {}{}",
                                          state.size(), fmt::join(sizes, " or "), model_name(model),
                                          parameters == 0 ? "" : " with these parameters"));
  }
  for (const double number : state) finite("nominal_initial", number);
}

}  // namespace

std::string DescriptionMember::option() const {
  std::string name = fmt::format("--{}", key);
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

const std::vector<DescriptionMember>& description_members() {
  static const std::vector<DescriptionMember> members = {
      {"model", "as in scenes, or own for a Hamiltonian that they do not have",
       &JetDescription::model},
      {"length_unit_km", "kilometres in the file's unit of length",
       &JetDescription::length_unit_km},
      {"time_unit_s", "seconds in its unit of time", &JetDescription::time_unit_s},
      {"duration_canonical", "of the flow, in that unit", &JetDescription::duration_canonical},
      {"nominal_initial",
       "the state about which the polynomials expand, all its numbers in those units",
       &JetDescription::nominal_initial},
      {"state_parameters",
       "names of the parameters with which nominal_initial ends, of a system that has some",
       &JetDescription::state_parameters, false}};
  return members;
}

bool is_any_given(const JetDescription& given) {
  const auto& members = description_members();
  return std::any_of(members.begin(), members.end(),
                     [&](const DescriptionMember& member) { return is_given(member, given); });
}

StoredJet foreign_jet(const std::string& name, const std::string& scene, std::string_view text,
                      const OutputFormat& format, const JetDescription& given) {
  require_all(name, given);
  StoredJet stored;
  stored.scene = scene;
  stored.label = foreign_label;
  stored.model = model_of(*given.model);
  stored.units = {positive("length_unit_km", *given.length_unit_km),
                  positive("time_unit_s", *given.time_unit_s)};
  stored.duration = finite("duration_canonical", *given.duration_canonical);
  stored.nominal_initial = *given.nominal_initial;
  const std::vector<std::string> parameters =
      given.state_parameters.value_or(std::vector<std::string>());
  check_state(stored.nominal_initial, stored.model, parameters.size());
  if (const auto problem = set_state_parameters(stored, parameters)) {
    refuse("state_parameters", *problem);
  }
  const std::size_t size = stored.nominal_initial.size();
  for (std::size_t i = 0; i < size; ++i) stored.components.push_back(i);
  stored.variables = stored.components;
  const std::vector<Series<double>> polynomials = format.read_polynomials(name, text);
  const std::size_t variables = polynomials.front().space().variables();
  if (polynomials.size() != size || variables != size) {
    throw Error(ErrorKind::input_output,
                fmt::format("{}: has {} polynomials in {} variables, must have {} in {}: the final "
                            "state by the deviations of nominal_initial",
                            name, polynomials.size(), variables, size, size));
  }
  for (const Series<double>& polynomial : polynomials) {
    Series<Extended>& series = stored.jet.emplace_back(polynomial.space_pointer());
    std::copy(polynomial.coefficients().begin(), polynomial.coefficients().end(),
              series.coefficients().begin());
    stored.nominal_final.push_back(polynomial.constant());
  }
  return stored;
}

}  // namespace hamjet::io
