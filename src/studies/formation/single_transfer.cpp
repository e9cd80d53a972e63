#include "single_transfer.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "../../algebra/state_sums.hpp"
#include "../../integrators/momentum_unit.hpp"
#include "../exact_flow.hpp"
#include "charts/coordinate_deviations.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

MetricUnits metric_units(const Scene& scene) {
  MetricUnits units{scene.units.length_km * 1000, scene.units.time_s};
  if (is_orbit(scene.system.model) || !scene.own_system) return units;
  if (const auto law = velocity_law(*scene.own_system, scene.nominal)) units.velocities = *law;
  return units;
}

double rounding_of_flights(const ComputedProblem& problem, const FlowJet<double>& jet) {
  return rounding_of_flights(linear_part(jet), problem.nominal, nominal_of(jet),
                             problem.momentum_exponent);
}

double rounding_of_flights(const Matrix<double>& linear, std::span<const double> start,
                           std::span<const double> end, int momentum_exponent) {
  const double position = std::hypot(end[0], end[1], end[2]);
  const Matrix<double> flow = in_momentum_unit<Matrix<double>>(linear, momentum_exponent);
  const double growth = flow.norm() * std::hypot(start[0], start[1], start[2]);
  return std::numeric_limits<double>::epsilon() * (position + growth);
}

double rounding_of_flights(const ComputedProblem& problem, double time) {
  constexpr double tolerance = 1e-10;  // the tolerance of a scale, for which two digits would do
  return rounding_of_flights(
      problem, linear_jet(problem.system, problem.nominal, problem.start_time, time, tolerance));
}

SingleTransfer::SingleTransfer(const Scene& scene, const ComputedProblem& problem, double time,
                               const std::vector<double>& orbit_end,
                               const std::vector<double>& chief_end, const RelativeState& start,
                               const ArrivalState& end)
    : scene_(scene),
      problem_(problem),
      time_(time),
      units_(metric_units(scene)),
      orbit_end_(orbit_end),
      start_frame_(problem.nominal, units_, scene.transfer->frame),
      end_frame_(chief_end, units_, scene.transfer->frame),
      start_(start_frame_.deviation(start)),
      end_(state_sum(end.deviation(chief_end, units_, scene.transfer->frame),
                     state_difference(chief_end, orbit_end))) {}

std::vector<double> SingleTransfer::linear_deviation(
    const Eigen::Matrix<double, 6, 6>& flow) const {
  // q = A q0 + B p0.
  const Eigen::Vector3d start(start_[0], start_[1], start_[2]);
  const Eigen::Vector3d end(end_[0], end_[1], end_[2]);
  const Eigen::Vector3d momentum =
      flow.topRightCorner<3, 3>().partialPivLu().solve(end - flow.topLeftCorner<3, 3>() * start);
  return {start[0], start[1], start[2], momentum[0], momentum[1], momentum[2]};
}

BoundaryMomenta SingleTransfer::solve(TransferBoundary& boundary, int order,
                                      std::span<const double> guess) const {
  return boundary.solve(std::span(start_).first(3), std::span(end_).first(3), order, guess);
}

std::vector<double> SingleTransfer::variables(const GeneratingFunctionKind& kind,
                                              const BoundaryMomenta& momenta) const {
  std::vector<double> first(start_.begin(), start_.begin() + 3);
  std::vector<double> last(end_.begin(), end_.begin() + 3);
  first.insert(first.end(), momenta.initial.begin(), momenta.initial.end());
  last.insert(last.end(), momenta.final.begin(), momenta.final.end());
  std::vector<double> w;
  for (std::size_t i = 0; i < 3; ++i) w.push_back(last[kind.final_variable(i)]);
  for (std::size_t i = 0; i < 3; ++i) w.push_back(first[kind.initial_variable(i)]);
  return w;
}

TransferAnswer SingleTransfer::answer(const BoundaryMomenta& momenta, int order) const {
  Eigen::Vector3d start;
  Eigen::Vector3d end;
  for (std::size_t i = 0; i < 3; ++i) {
    start[static_cast<Eigen::Index>(i)] = momenta.initial[i] - start_[3 + i];
    end[static_cast<Eigen::Index>(i)] = end_[3 + i] - momenta.final[i];
  }
  TransferAnswer answer;
  answer.order = order;
  answer.start_change_m_s = start_frame_.velocity_change_m_s(start);
  answer.end_change_m_s = end_frame_.velocity_change_m_s(end);
  return answer;
}

std::vector<double> SingleTransfer::deputy(const std::vector<double>& initial_momentum) const {
  std::vector<double> state = problem_.nominal;
  for (std::size_t i = 0; i < 3; ++i) {
    state[i] += start_[i];
    state[3 + i] += initial_momentum[i];
  }
  return state;
}

std::vector<double> SingleTransfer::fly(const std::vector<double>& initial_momentum) const {
  return state_difference(
      exact_flow(problem_.system, deputy(initial_momentum), problem_.start_time, time_),
      orbit_end_);
}

double SingleTransfer::miss_m(const std::vector<double>& flown) const {
  return std::hypot(flown[0] - end_[0], flown[1] - end_[1], flown[2] - end_[2]) * units_.length_m;
}

TransferAnswer SingleTransfer::refine(const FlowJet<double>& jet, const DeputyFlow* flow,
                                      BoundaryMomenta momenta, int& flights) const {
  constexpr int most_flights = 12;
  const int order = scene_.order;
  MonomialValues values(jet[0].space_pointer());
  double miss = 0;
  std::string failure;
  for (flights = 0; flights < most_flights; ++flights) {
    std::vector<double> flown;
    try {
      flown = fly(momenta.initial);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      failure = error.what();
      break;
    }
    miss = miss_m(flown);
    momenta.final.assign(flown.begin() + 3, flown.end());
    if (miss <= scene_.transfer->refined_miss_m) {
      TransferAnswer refined = answer(momenta, order);
      refined.miss_m = miss;
      return refined;
    }
    std::vector<double> point(start_.begin(), start_.begin() + 3);
    point.insert(point.end(), momenta.initial.begin(), momenta.initial.end());
    values.set_point(point);
    Eigen::Matrix3d commanded;  // dq/dp0
    Eigen::Vector3d distance;
    for (std::size_t i = 0; i < 3; ++i) {
      distance[static_cast<Eigen::Index>(i)] = flown[i] - end_[i];
      for (std::size_t j = 0; j < 3 && flow == nullptr; ++j) {
        commanded(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            values.derivative(jet[i], 3 + j, order);
      }
    }
    if (flow != nullptr) {
      DeputyPredictor predictor(*flow);
      commanded = commanded_positions(
          predictor, {point[0], point[1], point[2], point[3], point[4], point[5]}, order);
    }
    const Eigen::Vector3d correction = commanded.partialPivLu().solve(distance);
    for (std::size_t j = 0; j < 3; ++j) {
      momenta.initial[j] -= correction[static_cast<Eigen::Index>(j)];
    }
  }
  TransferAnswer refined;
  refined.order = order;
  refined.failure =
      fmt::format("the refinement did not reach {:.3g} m in {} flights{}{}",
                  scene_.transfer->refined_miss_m, flights, failure.empty() ? "" : ": ",
                  failure.empty() ? fmt::format(", the last miss is {:.3g} m", miss) : failure);
  return refined;
}

}  // namespace hamjet
