#include "parameter_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../text/quantity_text.hpp"
#include "../text/scene_message.hpp"

namespace hamjet::cli {

ParameterRange::ParameterRange(const io::StoredJet& jet) {
  const std::vector<std::string_view> names = jet.variable_names();
  const std::size_t states = 2 * jet.degrees_of_freedom();
  for (std::size_t place = 0; place < jet.variables.size(); ++place) {
    const std::size_t v = jet.variables[place];
    const bool has_limit = v >= states && jet.nominal_initial[v] != 0;
    if (has_limit) {
      parameters_.push_back({place, std::string(names[v]), jet.nominal_initial[v], 0});
    }
  }
}

void ParameterRange::look(std::span<const double> variables) {
  ++points_;
  bool is_beyond = false;
  for (Parameter& parameter : parameters_) {
    const double deviation = variables[parameter.place];
    is_beyond = is_beyond || std::abs(deviation) > std::abs(parameter.value);
    if (std::abs(deviation) > std::abs(parameter.furthest)) parameter.furthest = deviation;
  }
  if (is_beyond) ++beyond_;
}

std::optional<std::string> ParameterRange::warning() const {
  if (beyond_ == 0) return std::nullopt;
  const auto share = [](const Parameter& one) { return std::abs(one.furthest / one.value); };
  const auto worst =
      std::max_element(parameters_.begin(), parameters_.end(),
                       [&](const auto& a, const auto& b) { return share(a) < share(b); });
  return fmt::format(
      "{}{}: far from its value of {:.6g}, got a deviation of {:.6g} ({} of {} beyond), should be "
      "up to {:.6g}, the value itself: polynomials in it are right near the value alone",
      io::warning_head, worst->name, worst->value, worst->furthest, beyond_,
      counted(points_, "point"), std::abs(worst->value));
}

}  // namespace hamjet::cli
