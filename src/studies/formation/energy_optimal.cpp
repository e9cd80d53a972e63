#include "energy_optimal.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "../../algebra/state_sums.hpp"
#include "../../dynamics/costate_system.hpp"
#include "../exact_flow.hpp"
#include "../flights/paced_times.hpp"
#include "../jets_along_time.hpp"
#include "formation_problem.hpp"
#include "hamjet/detail/algebra/monomial_values.hpp"
#include "hamjet/error.hpp"
#include "hamjet/maps/position_boundary_values.hpp"
#include "impulses/impulse_search.hpp"
#include "single_transfer.hpp"

namespace hamjet {
namespace {

constexpr std::size_t states = 6;
using State = Eigen::Matrix<double, 6, 1>;

/// The problem of an orbit with its costates, which are zero along it.
ComputedProblem costate_problem(const ComputedProblem& orbit, int order) {
  ComputedProblem problem = orbit;
  problem.system = costate_system(*orbit.system);
  problem.nominal.resize(2 * states, 0.0);
  problem.degrees_of_freedom.clear();
  problem.components.clear();
  for (std::size_t i = 0; i < 2 * states; ++i) {
    if (i < states) problem.degrees_of_freedom.push_back(i);
    problem.components.push_back(i);
  }
  problem.variables = problem.components;
  problem.space = SeriesSpace::create(2 * states, order);
  problem.is_full_jet = true;
  problem.symmetry = FlowSymmetry::rotation;
  problem.momentum_exponent = 0;
  return problem;
}

/// The flights of a deputy from one relative state to another in one time.
class ThrustedFlight {
 public:
  ThrustedFlight(const Scene& scene, const ComputedProblem& problem, double time)
      : problem_(problem),
        time_(time),
        units_(metric_units(scene)),
        frame_(scene.transfer->frame),
        chief_system_(system_of_chief(scene, problem)),
        chief_start_(is_like_chief(scene) ? problem.nominal : scene.nominal) {
    orbit_end_ = exact_flow(problem.system, problem.nominal, problem.start_time, time);
    chief_end_ = is_like_chief(scene)
                     ? orbit_end_
                     : exact_flow(chief_system_, chief_start_, problem.start_time, time);
    chief_end_.resize(states);
    const std::vector<double> orbit(orbit_end_.begin(), orbit_end_.begin() + states);
    start_ = ChiefFrame(std::span(problem.nominal).first(states), units_, frame_)
                 .deviation(scene.transfer->start);
    end_ = state_sum(scene.transfer->end.deviation(chief_end_, units_, frame_),
                     state_difference(chief_end_, orbit));
  }

  const std::vector<double>& start() const { return start_; }
  const std::vector<double>& end() const { return end_; }

  /// The state and costates of the deputy at the start.
  std::vector<double> deputy(const std::vector<double>& costates) const {
    std::vector<double> z = problem_.nominal;
    for (std::size_t i = 0; i < states; ++i) {
      z[i] += start_[i];
      z[states + i] = costates[i];
    }
    return z;
  }

  /// Flies with these costates, and writes the misses; returns the flown less the wanted state.
  State fly(EnergyOptimalAnswer& answer) const {
    const std::vector<double> flown =
        exact_flow(problem_.system, deputy(answer.costates), problem_.start_time, time_);
    State miss;
    for (std::size_t i = 0; i < states; ++i) {
      miss[static_cast<Eigen::Index>(i)] = flown[i] - orbit_end_[i] - end_[i];
    }
    answer.miss_m = miss.head<3>().norm() * units_.length_m;
    answer.velocity_miss_m_s = miss.tail<3>().norm() * units_.velocity_m_s();
    return miss;
  }

  /// Integrates the thrust along the flight with these costates, in `panels` parts.
  void measure(EnergyOptimalTransfer& transfer, int panels) const;

  /// The thrust of a flight with these costates at the ends of `intervals` equal parts of it.
  std::vector<ThrustSample> profile(const std::vector<double>& costates, int intervals) const;

 private:
  Eigen::Vector3d thrust(const std::vector<double>& z) const {
    return -Eigen::Vector3d(z[states + 3], z[states + 4], z[states + 5]) *
           (units_.velocity_m_s() / units_.time_s);
  }
  Eigen::Vector3d along_frame(const std::vector<double>& chief,
                              const std::vector<double>& z) const {
    return ChiefFrame(std::span(chief).first(states), units_, frame_).along_axes(thrust(z));
  }

  const ComputedProblem& problem_;
  double time_;
  MetricUnits units_;
  RelativeFrame frame_;
  SharedSystem chief_system_;  ///< with costates, which are zero, if both are alike
  std::vector<double> chief_start_;
  std::vector<double> orbit_end_;  ///< of a spacecraft like the deputy, with its costates
  std::vector<double> chief_end_;
  std::vector<double> start_;
  std::vector<double> end_;  ///< from that orbit
};

void ThrustedFlight::measure(EnergyOptimalTransfer& transfer, int panels) const {
  using Rule = boost::math::quadrature::gauss<double, 8>;
  std::vector<double> z = deputy(transfer.refined->costates);
  transfer.start_thrust_m_s2 = along_frame(problem_.nominal, z);
  double now = 0;
  const auto fly_to = [&](double time) {
    z = exact_flow(problem_.system, z, problem_.start_time + now, time - now);
    now = time;
    const double size = thrust(z).norm();
    transfer.largest_m_s2 = std::max(transfer.largest_m_s2, size);
    return size;
  };
  transfer.largest_m_s2 = transfer.start_thrust_m_s2.norm();
  const double half = time_ / panels / 2;
  for (int panel = 0; panel < panels; ++panel) {
    const double middle = (2 * panel + 1) * half;
    const auto count = static_cast<int>(Rule::abscissa().size());
    // The nodes of the rule are told from the middle outwards; a flight meets them in order.
    for (int k = -count; k < count; ++k) {
      const auto node = static_cast<std::size_t>(k < 0 ? -k - 1 : k);
      const double size = fly_to(middle + std::copysign(Rule::abscissa()[node], k + 0.5) * half);
      const double weight = Rule::weights()[node] * half * units_.time_s;
      transfer.change_m_s += weight * size;
      transfer.energy_m2_s3 += weight * size * size / 2;
    }
  }
  fly_to(time_);
  transfer.end_thrust_m_s2 = along_frame(chief_end_, z);
}

std::vector<ThrustSample> ThrustedFlight::profile(const std::vector<double>& costates,
                                                  int intervals) const {
  std::vector<ThrustSample> samples;
  std::vector<double> chief = chief_start_;
  std::vector<double> z = deputy(costates);
  double now = 0;
  for (int k = 0; k <= intervals; ++k) {
    const double time = k == intervals ? time_ : time_ * k / intervals;
    if (time != now) {
      const ClockTime from = problem_.start_time + now;
      chief = exact_flow(chief_system_, chief, from, time - now);
      z = exact_flow(problem_.system, z, from, time - now);
      now = time;
    }
    samples.push_back({time, along_frame(chief, z)});
  }
  return samples;
}

/// The answers of all orders for the two states of a flight.
class EnergyOptimalPolynomials {
 public:
  explicit EnergyOptimalPolynomials(const FlowJet<double>& jet)
      : jet_(jet),
        inversion_(invert_partially(jet, parse_kind("F1", states))),
        cost_(generating_function(one_form(inversion_))),
        boundary_(inversion_),
        cost_values_(cost_.space_pointer()),
        jet_values_(jet[0].space_pointer()) {}

  double condition() const { return inversion_.condition; }

  EnergyOptimalAnswer answer(const ThrustedFlight& flight, int order, const MetricUnits& units) {
    EnergyOptimalAnswer answer;
    answer.order = order;
    answer.costates = boundary_.solve(flight.start(), flight.end(), order).initial;
    std::vector<double> ends = flight.end();
    ends.insert(ends.end(), flight.start().begin(), flight.start().end());
    cost_values_.set_point(ends);
    const double unit = units.velocity_m_s() * units.velocity_m_s() / units.time_s;
    answer.energy_m2_s3 = -cost_values_.value(cost_, order + 1) * unit;
    return answer;
  }

  /// Newton's correction of the costates for a miss, with the jet's derivatives there.
  State correction(const ThrustedFlight& flight, const EnergyOptimalAnswer& answer,
                   const State& miss) {
    std::vector<double> point = flight.start();
    point.insert(point.end(), answer.costates.begin(), answer.costates.end());
    jet_values_.set_point(point);
    Eigen::Matrix<double, 6, 6> commanded;
    for (Eigen::Index i = 0; i < 6; ++i) {
      for (Eigen::Index j = 0; j < 6; ++j) {
        commanded(i, j) =
            jet_values_.derivative(jet_[static_cast<std::size_t>(i)],
                                   states + static_cast<std::size_t>(j), jet_[0].order());
      }
    }
    return commanded.partialPivLu().solve(miss);
  }

 private:
  const FlowJet<double>& jet_;
  PartialInversion<double> inversion_;
  Series<double> cost_;
  PositionBoundaryValues boundary_;
  MonomialValues cost_values_;
  MonomialValues jet_values_;
};

/// Newton's method on the flown misses. A miss in velocity counts as the place that it makes in the
/// canonical unit of time.
void refine(EnergyOptimalPolynomials& polynomials, const ThrustedFlight& flight, const Scene& scene,
            EnergyOptimalTransfer& transfer) {
  constexpr int most_flights = 12;
  const double unit_s = metric_units(scene).time_s;
  EnergyOptimalAnswer answer = transfer.answers.back();
  for (int& flights = transfer.refinement_flights; flights < most_flights;) {
    ++flights;
    const State miss = flight.fly(answer);
    if (std::max(answer.miss_m, answer.velocity_miss_m_s * unit_s) <=
        scene.transfer->refined_miss_m) {
      transfer.refined = std::move(answer);
      return;
    }
    const State step = polynomials.correction(flight, answer, miss);
    for (std::size_t j = 0; j < states; ++j) {
      answer.costates[j] -= step[static_cast<Eigen::Index>(j)];
    }
  }
  throw Error(ErrorKind::numerical,
              fmt::format("the thrust of order {} was not corrected to {:.3g} m in {} flights, the "
                          "last of which misses by {:.3g} m and {:.3g} m/s",
                          answer.order, scene.transfer->refined_miss_m, most_flights, answer.miss_m,
                          answer.velocity_miss_m_s));
}

/// Parts of a flight with thrust for its integrals: 8 nodes in each.
constexpr IntervalCount quadrature_panels = {12, 4, 2000};
/// Parts of the flight at whose ends its thrust is told.
constexpr IntervalCount profile_intervals = {72, 48, 2000};

void solve(const Scene& scene, const ComputedProblem& problem, const FlowJet<double>& jet,
           EnergyOptimalTransfer& transfer) {
  const ThrustedFlight flight(scene, problem, transfer.time);
  EnergyOptimalPolynomials polynomials(jet);
  transfer.condition = polynomials.condition();
  for (int order = 1; order <= jet[0].order(); ++order) {
    transfer.answers.push_back(polynomials.answer(flight, order, metric_units(scene)));
    EnergyOptimalAnswer& answer = transfer.answers.back();
    try {
      flight.fly(answer);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      answer.failure = error.what();
    }
  }
  if (const std::string& failure = transfer.answers.back().failure; !failure.empty()) {
    throw Error(ErrorKind::numerical, failure);
  }
  refine(polynomials, flight, scene, transfer);
  flight.measure(transfer, interval_count(scene, transfer.time, quadrature_panels));
  const auto& most = scene.transfer->largest_thrust_m_s2;
  transfer.exceeds_thrust = most && transfer.largest_m_s2 > *most;
}

}  // namespace

EnergyOptimalTransfers energy_optimal_transfers(const Scene& scene, const ComputedProblem& orbit,
                                                const ProgressCallback& progress) {
  constexpr std::size_t most_times = 48;
  EnergyOptimalTransfers result;
  result.order = scene.transfer->thrust_order;
  const ComputedProblem problem = costate_problem(orbit, result.order);
  const std::vector<double> times = some_times(scene.transfer->times, most_times);
  result.transfers.resize(times.size());
  visit_jets(problem, symplectic_integrator(scene), times,
             [&](std::size_t index, const FlowJet<double>& jet) {
               if (progress) {
                 progress("energy-optimal thrust",
                          static_cast<double>(index) / static_cast<double>(times.size()));
               }
               EnergyOptimalTransfer& transfer = result.transfers[index];
               transfer.time = times[index];
               try {
                 solve(scene, problem, jet, transfer);
               } catch (const Error& error) {
                 if (error.kind() != ErrorKind::numerical) throw;
                 transfer.failure = error.what();
               }
             });
  for (std::size_t i = 0; i < times.size(); ++i) {
    const EnergyOptimalTransfer& one = result.transfers[i];
    if (!one.is_found() || one.exceeds_thrust) continue;
    if (!result.least || one.change_m_s < result.transfers[*result.least].change_m_s) {
      result.least = i;
    }
  }
  if (result.least) {
    const EnergyOptimalTransfer& least = result.transfers[*result.least];
    result.profile =
        ThrustedFlight(scene, problem, least.time)
            .profile(least.refined->costates, interval_count(scene, least.time, profile_intervals));
    return result;
  }
  const auto weakest = std::min_element(
      result.transfers.begin(), result.transfers.end(), [](const auto& a, const auto& b) {
        const double infinity = std::numeric_limits<double>::infinity();
        return (a.is_found() ? a.largest_m_s2 : infinity) <
               (b.is_found() ? b.largest_m_s2 : infinity);
      });
  result.failure =
      weakest->is_found()
          ? fmt::format(
                "all need more than largest_thrust_m_s2 = {:.6g}; the least is {:.6g} m/s^2",
                *scene.transfer->largest_thrust_m_s2, weakest->largest_m_s2)
          : weakest->failure;
  return result;
}

}  // namespace hamjet
