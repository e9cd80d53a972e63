#include "drift_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../../formats/relative_frame_text.hpp"
#include "../../store/json_values.hpp"
#include "../../studies/formation/formation_problem.hpp"
#include "../../text/quantity_text.hpp"
#include "hamjet/relative_motion/deputy_coordinates.hpp"
#include "transfer_json.hpp"

namespace hamjet::io {
namespace {

/// A drift of less than this share of the separation a revolution holds its place.
constexpr double held_share = 1e-4;

/// What is nothing but rounding beside the others, or beside a millimetre, is not shown.
double shown(double value, double scale) {
  return std::abs(value) < 1e-9 * std::max(scale, 1e-3) ? 0 : value;
}

/// Whether the osculating semi-major axes tell the drift: J2 lets others drift, too.
bool is_of_axes(const RelativeDrift& drift) {
  const double of_axes = -3 * std::numbers::pi * (*drift.elements_m)[0];
  return std::abs(drift.per_revolution_m - of_axes) < 0.05 * std::abs(drift.per_revolution_m);
}

}  // namespace

std::string vector_text(const Eigen::Vector3d& vector, int digits, double scale) {
  scale = std::max(scale, vector.norm());
  return fmt::format("[{:.{}g}, {:.{}g}, {:.{}g}]", shown(vector[0], scale), digits,
                     shown(vector[1], scale), digits, shown(vector[2], scale), digits);
}

std::string drift_text(const Scene& scene, const std::optional<RelativeDrift>& drift,
                       const RelativeState& state, RelativeFrame frame, std::string_view where) {
  if (!drift) return "";
  const double per_revolution = std::abs(drift->per_revolution_m);
  const double held = std::max(drift->floor_m, held_share * state.position_m.norm());
  // Air and light that act on one alone change the drift from revolution to revolution.
  const bool is_unlike = !is_like_chief(scene);
  if (per_revolution <= held && !is_unlike) {
    return fmt::format("Left to itself{} it stays there: it drifts by {} a revolution.", where,
                       drift->is_none() ? "less than " + length_text(drift->floor_m)
                                        : length_text(per_revolution));
  }
  std::string text = fmt::format(
      "Left to itself{} it drifts {} {} {} along the track: its period is {:.3g} s {} "
      "than that of its chief",
      where, length_text(per_revolution), is_unlike ? "in the first revolution" : "a revolution",
      drift->per_revolution_m > 0 ? "forwards" : "backwards", std::abs(drift->period_difference_s),
      drift->period_difference_s > 0 ? "longer" : "shorter");
  if (drift->elements_m && is_of_axes(*drift)) {
    text += fmt::format(" (a da is {:.4g} m, and without drift 0)",
                        shown((*drift->elements_m)[0], state.position_m.norm()));
  }
  if (drift->holding_change_m_s) {
    const Eigen::Vector3d holding = state.velocity_m_s + *drift->holding_change_m_s;
    text += fmt::format("; with velocity_m_s = {} ({}) in place of {} it would not",
                        vector_text(holding, 7, state.velocity_m_s.norm()), frame_text(frame),
                        vector_text(state.velocity_m_s, 7, holding.norm()));
  }
  if (is_unlike) {
    text +=
        "; it differs from its chief in what air or light does to it, so that the drift changes "
        "with every revolution";
  }
  return text + ".";
}

std::string elements_text(const std::optional<RelativeDrift>& drift) {
  if (!drift || !drift->elements_m) return "";
  std::string text;
  double scale = 0;
  for (const double element : *drift->elements_m) scale = std::max(scale, std::abs(element));
  const auto& components = components_of(DeputyForm::relative_elements);
  for (std::size_t i = 0; i < components.size(); ++i) {
    text += fmt::format("{}{} {:.5g}", i == 0 ? "" : ", ", components[i].name,
                        shown((*drift->elements_m)[i], scale));
  }
  return text;
}

void add_drift(nlohmann::ordered_json& json, const std::optional<RelativeDrift>& drift,
               const RelativeState& state) {
  using Json = nlohmann::ordered_json;
  json["drift_m_per_revolution"] = drift ? json_number(drift->per_revolution_m) : Json(nullptr);
  json["period_difference_s"] = drift ? json_number(drift->period_difference_s) : Json(nullptr);
  json["velocity_without_drift_m_s"] =
      drift && drift->holding_change_m_s
          ? vector_json(state.velocity_m_s + *drift->holding_change_m_s)
          : Json(nullptr);
  json["relative_elements_m"] =
      drift && drift->elements_m ? Json(*drift->elements_m) : Json(nullptr);
}

}  // namespace hamjet::io
