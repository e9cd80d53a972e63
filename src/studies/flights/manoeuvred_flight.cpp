#include "manoeuvred_flight.hpp"

#include <fmt/format.h>

#include <cmath>

#include "../../dynamics/burning_system.hpp"
#include "../exact_flow.hpp"
#include "hamjet/error.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"

namespace hamjet {
namespace {

/// The rows are the axes of a thrust at a state.
Eigen::Matrix3d thrust_axes(const std::vector<double>& state, ThrustAxes axes) {
  if (axes == ThrustAxes::inertial) return Eigen::Matrix3d::Identity();
  const Eigen::Vector3d q(state.data());
  const Eigen::Vector3d p(state.data() + 3);
  const Eigen::Vector3d normal = q.cross(p).normalized();
  const Eigen::Vector3d first = (axes == ThrustAxes::rtn ? q : p).normalized();
  Eigen::Matrix3d rows;
  rows.row(0) = first;
  rows.row(1) = normal.cross(first);
  rows.row(2) = normal;
  return rows;
}

}  // namespace

bool has_manoeuvres(const Scene& scene) {
  return !scene.manoeuvres.empty() || (scene.deputy && !scene.deputy->manoeuvres.empty());
}

void require_coasting(const Scene& scene) {
  if (!has_manoeuvres(scene)) return;
  const bool is_chiefs = !scene.manoeuvres.empty();
  const std::size_t count = is_chiefs ? scene.manoeuvres.size() : scene.deputy->manoeuvres.size();
  throw Error(ErrorKind::scene,
              fmt::format("{}.opm_file: a message with manoeuvres, got {}, which `hamjet motion` "
                          "alone flies; must be without, or beside manoeuvres = \"leave-out\", "
                          "with which the orbit coasts",
                          is_chiefs ? "nominal" : "deputy", count));
}

Scene without_manoeuvres(Scene scene) {
  scene.manoeuvres.clear();
  if (scene.deputy) scene.deputy->manoeuvres.clear();
  return scene;
}

std::vector<double> behind_impulse(std::vector<double> state, const Manoeuvre& impulse) {
  const Eigen::Vector3d change = thrust_axes(state, impulse.axes).transpose() * impulse.change;
  for (std::size_t i = 0; i < 3; ++i) state[3 + i] += change[static_cast<Eigen::Index>(i)];
  return state;
}

// With the mass m = m_0 (1 - s (t - t_0) / T) the acceleration is w s / T / (m / m_0) = w / (t_e -
// t), where t_e = t_0 + T / s is when no mass were left, and the change is w ln(1 / (1 - s)).
std::vector<double> burnt_flow(const DynamicalSystem& system, std::vector<double> state,
                               const ClockTime& scene_start, const Manoeuvre& burn, double from,
                               double to) {
  const std::size_t size = state.size();
  const bool mass_falls = burn.mass_share > 0;
  const auto burning = SharedSystem(burning_system(system, {burn.axes, mass_falls}));
  const Eigen::Vector3d thrust =
      burn.change / (mass_falls ? -std::log1p(-burn.mass_share) : burn.length);
  for (const double x : thrust) state.push_back(x);
  if (mass_falls) {
    state.push_back((scene_start + (burn.start + burn.length / burn.mass_share)).in<double>());
  }
  state = exact_flow(burning, state, scene_start + from, to - from);
  state.resize(size);
  return state;
}

}  // namespace hamjet
