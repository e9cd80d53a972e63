#include "double_integrator.hpp"

namespace hamjet {
namespace {

/// The least cost delta^T W^-1 delta / 2 on the fixed components.
double least_cost(const std::array<double, 4>& gramian,
                  const std::array<std::optional<double>, 2>& end, double position,
                  double velocity) {
  if (!end[1]) return position * position / (2 * gramian[0]);
  if (!end[0]) return velocity * velocity / (2 * gramian[3]);
  const double determinant = gramian[0] * gramian[3] - gramian[1] * gramian[2];
  return (gramian[3] * position * position - 2 * gramian[1] * position * velocity +
          gramian[0] * velocity * velocity) /
         (2 * determinant);
}

}  // namespace

std::array<double, 4> double_integrator_gramian(Discretization discretization, double duration,
                                                std::optional<std::size_t> steps) {
  const double t = duration;
  if (!steps) return {t * t * t / 3, t * t / 2, t * t / 2, t};
  const auto n = static_cast<double>(*steps);
  const double tau = t / n;
  // The effects b_j are (tau i, 1), i = 0..N-1 for Stormer and 1/2..N-1/2 for midpoint.
  const bool is_stormer = discretization == Discretization::stormer;
  const double sum = is_stormer ? n * (n - 1) / 2 : n * n / 2;
  const double squares = is_stormer ? (n - 1) * n * (2 * n - 1) / 6 : n * (4 * n * n - 1) / 12;
  return {tau * tau * tau * squares, tau * tau * sum, tau * tau * sum, t};
}

std::optional<ClosedFormCost> double_integrator_cost(
    Discretization discretization, std::span<const double> start,
    const std::array<std::optional<double>, 2>& end, double duration, std::size_t steps) {
  if (!end[0] && !end[1]) return std::nullopt;
  // A single step of Stormer's form does not move the position by the control at all.
  if (steps < 2 && end[0] && (end[1] || discretization == Discretization::stormer)) {
    return std::nullopt;
  }
  const double position = end[0] ? *end[0] - start[0] - duration * start[1] : 0;
  const double velocity = end[1] ? *end[1] - start[1] : 0;
  return ClosedFormCost{
      least_cost(double_integrator_gramian(discretization, duration, std::nullopt), end, position,
                 velocity),
      least_cost(double_integrator_gramian(discretization, duration, steps), end, position,
                 velocity)};
}

}  // namespace hamjet
