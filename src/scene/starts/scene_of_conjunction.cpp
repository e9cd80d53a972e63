#include "scene_of_conjunction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../../dynamics/celestial_bodies.hpp"
#include "../../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "hamjet/formats/conjunction_data_message.hpp"
#include "hamjet/formats/orbit_message.hpp"

namespace hamjet::io {
namespace {

constexpr std::string_view radius_key = "uncertainty.collision.radius_m";
/// The window to each side, in periods. Orbits that cross nearly head-on meet again after half a
/// period, which is another conjunction.
constexpr double window_in_periods = 0.25;

[[noreturn]] void fail_message(const std::string& file_name, const std::string& problem) {
  throw Error(ErrorKind::scene, printable(file_name, std::string::npos) + ": " + problem);
}

std::string toml_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

/// A text of [ephemeris], of which keys are left out without one that orbit messages can hold.
std::string named(std::string_view key, const std::string& text) {
  constexpr std::size_t longest = 80;
  const bool is_told =
      !text.empty() && text.size() <= longest && text.front() != ' ' && text.back() != ' ' &&
      std::all_of(text.begin(), text.end(), [](char c) { return c >= 0x20 && c < 0x7f; });
  return is_told ? fmt::format("{} = {}\n", key, toml_text(text)) : std::string();
}

std::string rows_of(const std::array<std::array<double, 6>, 6>& matrix) {
  std::string rows;
  for (const auto& row : matrix) rows += fmt::format("  [{:.17g}],\n", fmt::join(row, ", "));
  return "[\n" + rows + "]\n";
}

bool is_known_exactly(const ConjunctionObject& object) {
  return std::all_of(object.covariance.begin(), object.covariance.end(), [](const auto& row) {
    return std::all_of(row.begin(), row.end(), [](double entry) { return entry == 0; });
  });
}

double square_of(const std::array<double, 3>& v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

/// The period of an ellipse, or of the circle at that distance for other orbits.
double period_of(const ConjunctionObject& object, double mu_km3_s2) {
  const double distance = std::sqrt(square_of(object.position_km));
  const double inverse = 2 / distance - square_of(object.velocity_km_s) / mu_km3_s2;
  const double axis = inverse * distance > 0.01 ? 1 / inverse : distance;
  return 2 * std::numbers::pi * std::sqrt(axis * axis * axis / mu_km3_s2);
}

}  // namespace

bool is_conjunction_message(std::string_view text) {
  // A scene may name the keyword in a comment, but no message has a table.
  return is_cdm(text) && text.find("[nominal]") == std::string_view::npos;
}

std::string scene_of_conjunction(std::string_view text, const std::string& file_name,
                                 const std::vector<Override>& overrides) {
  const ConjunctionDataMessage message = read_cdm(printable(file_name, std::string::npos), text);
  const auto& [chief, deputy] = message.objects;
  if (std::none_of(overrides.begin(), overrides.end(), [](const Override& one) {
        return one.key == radius_key || one.key == "uncertainty.collision";
      })) {
    fail_message(file_name, fmt::format("{}: missing, a conjunction data message does not say it, "
                                        "must be the sum of both radii: --radius_m 15, or --set "
                                        "{}=15",
                                        radius_key, radius_key));
  }
  for (const ConjunctionObject& object : message.objects) {
    if (object.reference_frame != "GCRF" && object.reference_frame != "EME2000") {
      fail_message(file_name,
                   fmt::format("REF_FRAME: axes that rotate with the Earth, got {}, must "
                               "be GCRF or EME2000",
                               printable(object.reference_frame)));
    }
    if (object.reference_frame != chief.reference_frame) {
      fail_message(file_name, fmt::format("REF_FRAME: not the same of both objects, got {} and {}, "
                                          "must be one of them",
                                          chief.reference_frame, object.reference_frame));
    }
  }
  const CelestialBody* const body = body_named(chief.orbit_center);
  if (body == nullptr || body_named(deputy.orbit_center) != body) {
    fail_message(file_name,
                 fmt::format("ORBIT_CENTER: no known body that both objects have, got {} "
                             "and {}, must be EARTH or another one",
                             printable(chief.orbit_center), printable(deputy.orbit_center)));
  }
  if (is_known_exactly(chief) && is_known_exactly(deputy)) {
    fail_message(file_name,
                 "CR_R: no covariance, got 0 for both objects, must be that of one at least");
  }
  const double window_s = window_in_periods * std::min(period_of(chief, body->mu_km3_s2),
                                                       period_of(deputy, body->mu_km3_s2));
  std::array<double, 3> position_m{};
  std::array<double, 3> velocity_m_s{};
  for (std::size_t i = 0; i < 3; ++i) {
    position_m[i] = 1000 * (deputy.position_km[i] - chief.position_km[i]);
    velocity_m_s[i] = 1000 * (deputy.velocity_km_s[i] - chief.velocity_km_s[i]);
  }
  std::string scene = fmt::format(
      "title = {}\n"
      "system = {{ model = \"kepler\", mu_km3_s2 = {} }}\n"
      "nominal = {{ position_km = [{:.17g}], velocity_km_s = [{:.17g}] }}\n"
      "jet = {{ order = 3, duration_s = {:.17g} }}\n"
      "[deputy]\nframe = \"inertial\"\nposition_m = [{:.17g}]\nvelocity_m_s = [{:.17g}]\n"
      "[ephemeris]\nepoch = \"{}\"\ntime_system = \"UTC\"\nreference_frame = \"{}\"\n"
      "center_name = {}\n",
      toml_text(printable(fmt::format("{} and {}, closest approach {} UTC",
                                      chief.object_name.empty() ? "OBJECT1" : chief.object_name,
                                      deputy.object_name.empty() ? "OBJECT2" : deputy.object_name,
                                      format_epoch(message.tca).substr(0, 19)))),
      body->mu_km3_s2, fmt::join(chief.position_km, ", "), fmt::join(chief.velocity_km_s, ", "),
      window_s, fmt::join(position_m, ", "), fmt::join(velocity_m_s, ", "),
      format_epoch(message.tca), chief.reference_frame, toml_text(chief.orbit_center));
  scene += named("object_name", chief.object_name) +
           named("object_id", chief.international_designator) +
           named("deputy_name", deputy.object_name) +
           named("deputy_id", deputy.international_designator);
  scene += "[uncertainty]\nsamples = 0\nframe = \"RTN\"\n";
  if (!is_known_exactly(chief)) scene += "covariance_m_m_s = " + rows_of(chief.covariance);
  if (!is_known_exactly(deputy)) {
    scene += "[uncertainty.deputy]\ncovariance_m_m_s = " + rows_of(deputy.covariance);
  }
  return scene + fmt::format("[uncertainty.collision]\nwindow_s = [{:.17g}, {:.17g}]\n", -window_s,
                             window_s);
}

}  // namespace hamjet::io
