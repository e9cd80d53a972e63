#pragma once

#include <limits>
#include <string>

#include "hamjet/report/relative_motion_report.hpp"
#include "sample_scene.hpp"

// Small results of the studies of relative motion, of made-up numbers, with every case that a
// report must show.

namespace hamjet::io {

inline Scene sample_relative_scene() {
  Scene scene = sample_scene(7);
  scene.transfer = TransferSettings{};
  TransferSettings& settings = *scene.transfer;
  settings.start.position_m = {0, -8000, 6000};
  settings.end.position_m = {0, 100, 0};
  settings.times = {1, 2, 3, 4, 5, 6};
  settings.refine = true;
  settings.singular_margin = 0.05;
  scene.validity = ValiditySettings{};
  scene.validity->times = {1, 2};
  return scene;
}

inline TransferAnswer sample_answer(int order, double size, double miss_m) {
  TransferAnswer answer;
  answer.order = order;
  answer.start_change_m_s = {size, -size / 3, 0.1 * size};
  answer.end_change_m_s = {-0.2 * size, size / 7, size};
  answer.miss_m = miss_m;
  return answer;
}

inline TransferAnswer failed_answer(int order, const std::string& failure) {
  TransferAnswer answer;
  answer.order = order;
  answer.failure = failure;
  return answer;
}

inline TransferPoint sample_point(double time, double size) {
  TransferPoint point;
  point.time = time;
  point.kind = parse_kind("F1", 3);
  point.condition = 10.0 / 3;
  point.position_condition = 10.0 / 3;
  point.singular_distance = 0.7;
  point.answers = {sample_answer(1, 1.1 * size, 1234.5), sample_answer(2, size, 0.1 + 0.2)};
  point.refined = sample_answer(2, 1.0001 * size, 1.0 / 3e4);
  point.refinement_flights = 2;
  point.hamilton_jacobi_residual = 1e-14 / 3;
  return point;
}

/// Times 1 to 6: a good one, one whose linear answer failed, one near a singularity, one at which
/// no kind exists, one whose refinement failed, and the best.
inline TransferResult sample_transfer() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  TransferResult result;
  result.scene = sample_relative_scene();
  result.integrator = "gauss8";
  result.statistics.steps = 44;
  result.points = {sample_point(1, 3), sample_point(2, 4), sample_point(3, 500),
                   TransferPoint{},    sample_point(5, 5), sample_point(6, 2)};
  result.points[1].answers[0] = failed_answer(1, "no convergence, \"really\", after 20");
  result.points[2].is_near_singular = true;
  result.points[2].is_beyond_tolerance = true;
  result.points[2].kind = parse_kind("qpq-qqp", 3);
  result.points[2].position_condition = infinity;
  result.points[2].singular_distance = 0.01;
  result.points[2].refined.reset();
  result.points[2].hamilton_jacobi_residual.reset();
  result.points[3].time = 4;
  result.points[3].failure = "no kind of generating function exists at this time";
  result.points[3].position_condition = infinity;
  result.points[4].refined = failed_answer(2, "the refinement did not reach 0.001 m");
  result.points[4].singular_distance.reset();
  result.conditions.kinds = all_kinds(3);
  for (const TransferPoint& point : result.points) {
    result.conditions.times.push_back(point.time);
    std::vector<double> values;
    for (std::size_t k = 0; k < 64; ++k) values.push_back(2 + static_cast<double>(k) / 3);
    values[0] = point.position_condition;
    result.conditions.values.push_back(values);
  }
  const Eigen::Vector3d direction(0, 0.6, -0.8);
  result.singular_times = {
      {parse_kind("F1", 3), 3.01, 2e-9, 1, 1e-17, 0.25, direction, Eigen::Vector3d(0, 0, 1)},
      {parse_kind("F1", 3), 6.3, 4e-9, 2, 2e-17, 1e-9, -direction},
      {parse_kind("F2", 3), 1.5, 2e-9, 1, 3e-17, 0.5, direction}};
  result.flight_floor_m = 2e-6;
  result.hamilton_jacobi_floor = 1e-15;
  result.seconds = {0.5, 0.25, 0.125, 0.0625, 3, 1};
  return result;
}

inline RelativeTrajectory sample_trajectory() {
  RelativeTrajectory trajectory;
  for (int k = 0; k <= 10; ++k) {
    RelativeState state;
    state.position_m = {100.0 * k * (10 - k), -8000 + 810.0 * k, 6000 - 600.0 * k};
    trajectory.times.push_back(0.6 * k);
    trajectory.states.push_back(state);
  }
  return trajectory;
}

inline ValidityResult sample_validity() {
  ValidityResult result;
  result.scene = sample_relative_scene();
  result.integrator = "gauss8";
  result.points = {{1, {{1, 2000.0 / 3, 650, 0.9, false, {}}, {2, 4e4, 3.9e4, 0.99, false, {}}}},
                   {2, {{1, 100, 0, 0, false, {}}, {2, 2e4, 5e5, 0.2, true, {}}}}};
  result.points[1].entries[1].limit = ReachLimit{2.96875, "period", 2.1875, "tau", 0.90625};
  result.flight_floor_m = 1e-6;
  result.flights = 1234;
  result.propagation_seconds = 0.5;
  result.proof_seconds = 2.5;
  return result;
}

inline TransferResult with_validity(TransferResult result) {
  result.validity = sample_validity();
  return result;
}

inline AssignmentResult sample_assignment() {
  AssignmentResult result;
  result.scene = sample_relative_scene();
  result.scene.assignment = AssignmentSettings{};
  result.scene.assignment->deputies.resize(2);
  result.scene.assignment->slots.resize(2);
  result.integrator = "gauss8";
  result.costs = {{{1, 7.5}, {0, 1.0 / 3}}, {{5, 2.25}, {std::nullopt, 0}}};
  result.transfers = {{0, 1, sample_point(1, 3)}, {1, 0, sample_point(6, 2)}};
  result.total_change_m_s = 1.0 / 3 + 2.25;
  result.flight_floor_m = 1e-6;
  result.study_seconds = 0.5;
  result.proof_seconds = 1.5;
  return result;
}

/// The files that need no plot do not need gnuplot.
inline ReportOrigin sample_transfer_origin(const std::string& gnuplot = "/nonexistent/gnuplot") {
  return {"hamjet transfer sample.toml --set 'title=\"<b>\"'", "2025-01-02 03:04 UTC",
          "A processor & more", "", gnuplot};
}

}  // namespace hamjet::io
