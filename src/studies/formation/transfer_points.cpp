#include "transfer_points.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

#include "../../algebra/raise_to.hpp"
#include "../../algebra/state_sums.hpp"
#include "../../dynamics/frozen_system.hpp"
#include "../../integrators/momentum_unit.hpp"
#include "../checks/flight_checks.hpp"
#include "../exact_flow.hpp"
#include "../flights/relative_drift.hpp"
#include "../random_direction.hpp"
#include "../stopwatch.hpp"
#include "charts/free_coordinates.hpp"
#include "formation_problem.hpp"
#include "hamjet/error.hpp"
#include "hamjet/studies/validity.hpp"
#include "keep_out.hpp"

namespace hamjet {
namespace {

/// A direction along R, T, N of the chief, if the chief has an orbital plane.
std::optional<Eigen::Vector3d> along_rtn(const std::vector<double>& chief,
                                         const Eigen::Vector3d& direction) {
  try {
    return ChiefFrame(chief, MetricUnits{}, RelativeFrame::rtn_inertial).along_axes(direction);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    return std::nullopt;
  }
}

using FlowMatrix = Eigen::Matrix<double, 6, 6>;

/// The answer that `work` returns, or its numerical failure.
template <class Work>
TransferAnswer attempt(int order, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    TransferAnswer failed;
    failed.order = order;
    failed.failure = error.what();
    return failed;
  }
}

}  // namespace

TransferPoints::TransferPoints(const Scene& scene, const ProgressCallback& progress,
                               TransferSeconds& seconds)
    : scene_(scene),
      settings_(*scene.transfer),
      has_orbit_(is_orbit(scene.system.model)),
      seconds_(seconds),
      both_(scene),
      problem_(make_problem(with_deputy_coefficients(scene))),
      kinds_(all_kinds(3)),
      coordinates_(measured_coordinates_of(scene)) {
  if (coordinates_ != JetCoordinates::cartesian) {
    linear_problem_ = problem_;
    linear_problem_->space = SeriesSpace::create(problem_.variables.size(), 1);
  }
  std::erase_if(kinds_, [&](const GeneratingFunctionKind& kind) {
    return !has_told_name(kind, scene.system);
  });
  find_singular_times(progress);
}

const DeputyFlow* TransferPoints::charted_flow(double time) {
  if (coordinates_ == JetCoordinates::cartesian) return nullptr;
  if (charted_flow_ && propagated_ == time) return charted_flow_.get();
  const Stopwatch watch(seconds_.propagation);
  const bool is_behind = propagation_ && std::abs(time) < std::abs(propagated_);
  if (!propagation_ || is_behind) {
    propagation_.emplace(scene_, problem_, symplectic_integrator(scene_), coordinates_);
  }
  charted_flow_ = propagation_->advance_to(time);
  propagated_ = time;
  return charted_flow_.get();
}

void TransferPoints::find_singular_times(const ProgressCallback& progress) {
  const Stopwatch watch(seconds_.singularities);
  const double last = settings_.times.back();
  // The flow goes a little beyond the last time, so that a singularity just after it is seen too.
  // It goes no further than a quarter of a revolution at the initial distance, within which there
  // is some singularity anyway.
  const double quarter =
      has_orbit_ ? std::numbers::pi / 2 * std::pow(initial_distance(problem_.nominal), 1.5)
                 : std::abs(last);
  const double margin = std::min(settings_.singular_margin, quarter);
  flow_.emplace(scene_, problem_, last + std::copysign(margin, last), checkpoints_per_revolution,
                [&](double done) {
                  if (progress) progress("linear flow", done);
                });
  const CompanionFlow& flow = *flow_;
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    if (progress) {
      progress("singular times", static_cast<double>(k) / static_cast<double>(kinds_.size()));
    }
    for (SingularTime& found : hamjet::find_singular_times(flow, kinds_[k])) {
      if (has_orbit_) found.direction_rtn = along_rtn(flow.chief(found.time), found.direction);
      singular_times_.push_back(std::move(found));
    }
  }
}

std::optional<double> TransferPoints::singular_distance(double time) const {
  std::optional<double> nearest;
  // The singular times of the first kind come first.
  for (const SingularTime& singular : singular_times_) {
    if (singular.kind != kinds_.front()) break;
    const double distance = std::abs(singular.time - time);
    nearest = std::min(nearest.value_or(distance), distance);
  }
  return nearest;
}

bool TransferPoints::is_near_singular(double time) const {
  const auto distance = singular_distance(time);
  return distance && *distance < settings_.singular_margin;
}

std::vector<double> TransferPoints::expansion_parameters(
    const FlowJet<double>& jet, const std::vector<RelativeTransfer>& transfers, double time) const {
  const std::vector<Series<double>>& map = jet;
  const FlowMatrix flow = linear_part(map);
  const int exponent = problem_.momentum_exponent;
  const FlowMatrix comparable = in_momentum_unit(flow, exponent);
  std::vector<Eigen::PartialPivLU<Eigen::Matrix3d>> blocks;
  std::vector<double> parameters;
  for (const GeneratingFunctionKind& kind : kinds_) {
    blocks.emplace_back(inverted_block(comparable, kind));
    // Round-off is amplified too, and decides if nothing else does.
    parameters.push_back(std::numeric_limits<double>::epsilon() * comparable.norm() *
                         blocks.back().inverse().norm());
  }
  const std::vector<double> orbit_end = nominal_of(jet);
  const std::vector<double> chief_end = chief_beside(orbit_end, time);
  MonomialValues values(jet[0].space_pointer());
  for (const RelativeTransfer& ends : transfers) {
    const SingleTransfer transfer(scene_, problem_, time, orbit_end, chief_end, ends.start,
                                  ends.end);
    values.set_point(transfer.linear_deviation(flow));
    FlowMatrix changed;
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) {
        changed(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            values.derivative(jet[i], j, std::min(scene_.order, 2));
      }
    }
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      const Eigen::Matrix3d difference =
          inverted_block(in_momentum_unit(changed, exponent) - comparable, kinds_[k]);
      raise_to(parameters[k], blocks[k].solve(difference).norm());
    }
  }
  return parameters;
}

ChosenKind TransferPoints::choose_kind(double time, const FlowJet<double>& jet,
                                       const std::vector<RelativeTransfer>& transfers) {
  const Stopwatch watch(seconds_.inversion);
  const std::vector<Series<double>>& map = jet;
  const int exponent = problem_.momentum_exponent;
  ChosenKind chosen;
  chosen.time = time;
  for (const GeneratingFunctionKind& kind : kinds_) {
    chosen.conditions.push_back(condition_number<double>(inverted_block(map, kind, exponent)));
  }
  if (linear_problem_) return chosen;
  const auto invert = [&](const GeneratingFunctionKind& kind) {
    return invert_partially<double>(map, kind, std::numeric_limits<double>::epsilon(), exponent);
  };
  try {
    if (settings_.kind != "auto") {
      chosen.inversion = invert(parse_kind(settings_.kind, 3));
    } else if (const auto index = choice_.choose(expansion_parameters(jet, transfers, time))) {
      chosen.inversion = invert(kinds_[*index]);
    } else {
      chosen.failure = "no kind of generating function exists at this time";
    }
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    chosen.failure = error.what();
  }
  return chosen;
}

TransferPoint TransferPoints::answer(const ChosenKind& chosen, const FlowJet<double>& jet,
                                     const RelativeTransfer& ends) {
  TransferPoint point;
  point.time = chosen.time;
  point.position_condition = chosen.conditions.front();
  point.singular_distance = singular_distance(chosen.time);
  point.is_near_singular = is_near_singular(chosen.time);
  point.failure = chosen.failure;
  if (!chosen.failure.empty()) return point;
  if (chosen.inversion) {
    point.kind = chosen.inversion->kind;
    point.condition = chosen.inversion->condition;
  }
  // The ends are relative to the flown chief: otherwise an inaccurate integrator would confirm
  // itself.
  std::optional<SingleTransfer> of_ends;
  try {
    const FlownOrbits& flown = flown_orbits(chosen.time);
    of_ends.emplace(scene_, problem_, chosen.time, flown.orbit, flown.chief, ends.start, ends.end);
  } catch (const Error& error) {
    // The end may be given in a form that is not defined at the chief's state then.
    if (error.kind() != ErrorKind::numerical) throw;
    point.failure = error.what();
    return point;
  }
  const SingleTransfer& transfer = *of_ends;
  std::vector<BoundaryMomenta> momenta(static_cast<std::size_t>(scene_.order));
  const DeputyFlow* const flow = charted_flow(chosen.time);
  {
    const Stopwatch watch(seconds_.solution);
    TransferBoundary boundary(chosen.inversion, flow);
    std::vector<double> guess = transfer.momentum_before();
    for (int order = 1; order <= scene_.order; ++order) {
      point.answers.push_back(attempt(order, [&] {
        BoundaryMomenta& found = momenta[static_cast<std::size_t>(order - 1)];
        found = transfer.solve(boundary, order, guess);
        guess = found.initial;
        return transfer.answer(found, order);
      }));
    }
  }
  {
    const Stopwatch watch(seconds_.proof);
    for (std::size_t k = 0; k < momenta.size(); ++k) {
      TransferAnswer& answer = point.answers[k];
      if (!answer.failure.empty()) continue;
      answer = attempt(answer.order, [&] {
        TransferAnswer proved = answer;
        proved.miss_m = transfer.miss_m(transfer.fly(momenta[k].initial));
        return proved;
      });
    }
    const TransferAnswer& last = point.answers.back();
    point.is_beyond_tolerance = !last.failure.empty() || !(last.miss_m <= settings_.tolerance_m);
    const bool is_to_refine =
        settings_.refine || (point.is_beyond_tolerance && !point.is_near_singular);
    if (is_to_refine && last.failure.empty()) {
      point.refined = transfer.refine(jet, flow, momenta.back(), point.refinement_flights);
    }
  }
  if (point.has_answer()) {
    judge_limits(ends, point);
    // The generating function is one of positions and momenta, which may not reach as far as other
    // coordinates.
    if (flow != nullptr) return point;
    measure_residual(chosen, jet, transfer.variables(chosen.inversion->kind, momenta.back()),
                     point);
  }
  return point;
}

void TransferPoints::add_drift(const RelativeTransfer& ends, TransferPoint& point,
                               bool finds_holding) {
  if (!point.has_answer()) return;
  const std::vector<double>& chief = flown_orbits(point.time).chief;
  const MetricUnits units = metric_units(scene_);
  const std::vector<double> end = ends.end.deviation(chief, units, settings_.frame);
  point.arrived = ChiefFrame(chief, units, settings_.frame).relative(end);
  if (!has_orbit_) return;
  // The coefficients of both end the states, and their difference the deviation.
  const std::vector<double> together = both_.of_chief(chief);
  point.drift = relative_drift(both_.scene(), together,
                               state_difference(both_.of_deputy(state_sum(chief, end)), together),
                               problem_.start_time + point.time, settings_.frame, finds_holding);
}

void TransferPoints::judge_limits(const RelativeTransfer& ends, TransferPoint& point) {
  const TransferAnswer& answer = point.best();
  if (settings_.largest_impulse_m_s) {
    point.exceeds_impulse = answer.largest_impulse_m_s() > *settings_.largest_impulse_m_s;
  }
  const std::optional<double> surface = surface_limit(scene_);
  if (!settings_.keep_out_m && !surface) return;
  const Stopwatch watch(seconds_.proof);
  RelativeState start = ends.start;
  start.velocity_m_s += answer.start_change_m_s;
  const std::vector<double> deviation =
      ChiefFrame(problem_.nominal, metric_units(scene_), settings_.frame).deviation(start);
  if (surface) {
    const std::vector<double> deputy = state_sum(problem_.nominal, deviation);
    point.lowest = lowest_point(problem_.system, deputy, problem_.start_time, point.time).distance;
    point.is_below_surface = *point.lowest < *surface;
  }
  // A trajectory through the centre need not be examined further.
  if (!settings_.keep_out_m || point.lowest == 0.0) return;
  try {
    point.keep_out_ratio =
        keep_out_ratio(both_, problem_.nominal, deviation, problem_.start_time, point.time);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    // Next to a singular time polynomials ask for velocities with which no way can be followed;
    // such a way may lead anywhere, and is forbidden.
    point.keep_out_ratio = 0;
  }
}

void TransferPoints::measure_residual(const ChosenKind& chosen, const FlowJet<double>& jet,
                                      const std::vector<double>& w, TransferPoint& point) {
  const Stopwatch watch(seconds_.residual);
  const SharedSystem then = frozen_at(problem_.system, problem_.start_time + point.time);
  HamiltonJacobiTerms terms =
      hamilton_jacobi_terms<double>(*then, nominal_of(jet), *chosen.inversion, w);
  const double scaled = terms.scaled();
  point.hamilton_jacobi_residual = scaled;
  if (largest_residual_ && !(scaled > largest_residual_->scaled)) return;
  largest_residual_ = {scaled, then, jet, chosen.inversion->kind, w, std::move(terms)};
}

std::optional<double> TransferPoints::hamilton_jacobi_floor() const {
  if (!largest_residual_) return std::nullopt;
  const Stopwatch watch(seconds_.residual);
  constexpr int draws = 16;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::mt19937_64 generator(1);
  double floor = 0;
  for (int draw = 0; draw < draws; ++draw) {
    FlowJet<double> jet = largest_residual_->jet;
    for (auto& component : jet) {
      for (double& c : component.coefficients()) {
        if (c != 0) c = std::nextafter(c, random_direction(generator, 1)[0] * infinity);
      }
    }
    try {
      const auto inversion = invert_partially<double>(jet, largest_residual_->kind,
                                                      std::numeric_limits<double>::epsilon(),
                                                      problem_.momentum_exponent);
      HamiltonJacobiTerms terms = hamilton_jacobi_terms<double>(*largest_residual_->system,
                                                                nominal_of(largest_residual_->jet),
                                                                inversion, largest_residual_->w);
      for (std::size_t i = 0; i < terms.residual.size(); ++i) {
        terms.residual[i] -= largest_residual_->terms.residual[i];
      }
      floor = std::max(floor, terms.scaled());
    } catch (const Error& error) {
      // Beside a singularity a kind may exist by an ulp only.
      if (error.kind() != ErrorKind::numerical) throw;
    }
  }
  return floor;
}

double TransferPoints::flight_floor_m(const FlowJet<double>& jet) const {
  return rounding_of_flights(problem_, jet) * metric_units(scene_).length_m;
}

double TransferPoints::chief_error_m(double time, const FlowJet<double>& jet) {
  const std::vector<double>& flown = flown_orbits(time).orbit;
  const std::vector<double> nominal = nominal_of(jet);
  return std::hypot(flown[0] - nominal[0], flown[1] - nominal[1], flown[2] - nominal[2]) *
         metric_units(scene_).length_m;
}

std::vector<double> TransferPoints::chief_beside(const std::vector<double>& orbit,
                                                 double time) const {
  return state_sum(orbit, flow_->chief_deviation(time));
}

const TransferPoints::FlownOrbits& TransferPoints::flown_orbits(double time) {
  if (flown_.orbit.empty() || time != flown_.time) {
    const Stopwatch watch(seconds_.proof);
    flown_.orbit = exact_flow(problem_.system, problem_.nominal, problem_.start_time, time);
    flown_.chief = is_like_chief(scene_) ? flown_.orbit
                                         : exact_flow(system_of_chief(scene_, problem_),
                                                      problem_.nominal, problem_.start_time, time);
    flown_.time = time;
  }
  return flown_;
}

}  // namespace hamjet
