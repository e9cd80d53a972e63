#include "energy_optimal.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "../../flights/paced_times.hpp"
#include "../../jets_along_time.hpp"
#include "../formation_problem.hpp"
#include "../impulses/impulse_search.hpp"
#include "../single_transfer.hpp"
#include "hamjet/detail/algebra/monomial_values.hpp"
#include "hamjet/error.hpp"
#include "hamjet/maps/position_boundary_values.hpp"
#include "thrust_feedback.hpp"
#include "thrusted_flight.hpp"

namespace hamjet {
namespace {

constexpr std::size_t states = ThrustedFlight::states;
using State = ThrustedFlight::State;

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
  int order() const { return jet_[0].order(); }

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

/// A miss in velocity counts as the place that it makes in the canonical unit of time.
double miss_in_m(const EnergyOptimalAnswer& answer, const Scene& scene) {
  return std::max(answer.miss_m, answer.velocity_miss_m_s * metric_units(scene).time_s);
}

/// Newton's method on the flown misses, of which `miss` is that of the last answer, with the
/// derivatives of the polynomials; empty if the answer was corrected, otherwise why not.
std::string refine(EnergyOptimalPolynomials& polynomials, const ThrustedFlight& flight,
                   const Scene& scene, State miss, EnergyOptimalTransfer& transfer) {
  constexpr int most_flights = 12;
  EnergyOptimalAnswer answer = transfer.answers.back();
  if (!answer.failure.empty()) return answer.failure;
  try {
    for (int& flights = transfer.refinement_flights; flights < most_flights;) {
      if (flights++ > 0) miss = flight.fly(answer);
      if (miss_in_m(answer, scene) <= scene.transfer->refined_miss_m) {
        transfer.refined = std::move(answer);
        return "";
      }
      const State step = polynomials.correction(flight, answer, miss);
      for (std::size_t j = 0; j < states; ++j) {
        answer.costates[j] -= step[static_cast<Eigen::Index>(j)];
      }
    }
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    return error.what();
  }
  return fmt::format(
      "the thrust of order {} was not corrected to {:.3g} m in {} flights, the last "
      "of which misses by {:.3g} m and {:.3g} m/s",
      answer.order, scene.transfer->refined_miss_m, most_flights, answer.miss_m,
      answer.velocity_miss_m_s);
}

/// Follows the costates from no deviation, where there is no thrust, to the scene's, all in the
/// same proportions: at each share of them by Newton's method with derivatives of the flight
/// itself, from where the last two shares lead.
class ThrustContinuation {
 public:
  ThrustContinuation(const ThrustedFlight& flight, const Scene& scene,
                     EnergyOptimalTransfer& transfer)
      : flight_(flight), scene_(scene), transfer_(transfer), last_{0, {}}, before_{0, {}} {
    last_.costates.assign(states, 0.0);
    before_ = last_;
  }

  /// The largest share that was reached, 1 if all went well; the transfer then has its answer.
  double reach() {
    constexpr int most_attempts = 80;
    constexpr double least_step = 1e-3;
    double step = 0.125;
    for (int attempts = 0; attempts < most_attempts && step > least_step && last_.share < 1;
         ++attempts) {
      const double share = std::min(1.0, last_.share + step);
      std::optional<Point> next = solved({share, predicted(share)});
      if (!next) {
        step /= 2;
        continue;
      }
      before_ = std::exchange(last_, std::move(*next));
      ++transfer_.continuation_steps;
      step *= 1.5;
    }
    return last_.share;
  }

 private:
  struct Point {
    double share = 0;
    std::vector<double> costates;
  };

  /// On the line through the last two points; from the first one, as the linear theory.
  std::vector<double> predicted(double share) const {
    std::vector<double> costates = last_.costates;
    for (std::size_t j = 0; j < states; ++j) {
      costates[j] += last_.share > 0 ? (share - last_.share) / (last_.share - before_.share) *
                                           (last_.costates[j] - before_.costates[j])
                                     : share * transfer_.answers.front().costates[j];
    }
    return costates;
  }

  std::optional<Point> solved(Point point) {
    constexpr int most_flights = 10;
    // Between the ends of the way the costates need not be exact.
    const double most_m = point.share < 1 ? std::max(scene_.transfer->refined_miss_m, 1e-3)
                                          : scene_.transfer->refined_miss_m;
    EnergyOptimalAnswer answer;
    answer.order = transfer_.answers.back().order;
    double last_miss_m = std::numeric_limits<double>::infinity();
    try {
      for (int flights = 0; flights < most_flights; ++flights) {
        ++transfer_.refinement_flights;
        const State miss = flight_.missing(point.costates, point.share);
        flight_.set_misses(answer, miss);
        const double miss_m = miss_in_m(answer, scene_);
        if (!(miss_m <= last_miss_m)) return std::nullopt;
        last_miss_m = miss_m;
        if (miss_m <= most_m) {
          if (point.share == 1) {
            answer.costates = point.costates;
            answer.energy_m2_s3 = transfer_.answers.back().energy_m2_s3;
            transfer_.refined = std::move(answer);
          }
          return point;
        }
        const State step =
            flight_.commanded(point.costates, point.share).partialPivLu().solve(miss);
        for (std::size_t j = 0; j < states; ++j) {
          point.costates[j] -= step[static_cast<Eigen::Index>(j)];
        }
      }
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
    }
    return std::nullopt;
  }

  const ThrustedFlight& flight_;
  const Scene& scene_;
  EnergyOptimalTransfer& transfer_;
  Point last_;
  Point before_;
};

/// Parts of a flight with thrust for its integrals: 8 nodes in each.
constexpr IntervalCount quadrature_panels = {12, 4, 2000};
/// Parts of the flight at whose ends its thrust is told.
constexpr IntervalCount profile_intervals = {72, 48, 2000};

void solve(const Scene& scene, const ComputedProblem& problem,
           EnergyOptimalPolynomials& polynomials, EnergyOptimalTransfer& transfer) {
  const ThrustedFlight flight(scene, problem, transfer.time);
  transfer.condition = polynomials.condition();
  State miss = State::Zero();
  for (int order = 1; order <= polynomials.order(); ++order) {
    transfer.answers.push_back(polynomials.answer(flight, order, metric_units(scene)));
    EnergyOptimalAnswer& answer = transfer.answers.back();
    try {
      miss = flight.fly(answer);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      answer.failure = error.what();
    }
  }
  if (const std::string failure = refine(polynomials, flight, scene, miss, transfer);
      !failure.empty()) {
    const double share = ThrustContinuation(flight, scene, transfer).reach();
    if (share < 1) {
      throw Error(ErrorKind::numerical,
                  fmt::format("{}; followed from smaller deviations it comes to {:.3g} of these",
                              failure, share));
    }
  }
  const int panels = interval_count(scene, transfer.time, quadrature_panels);
  flight.measure(transfer, paced_times(scene, transfer.time, panels));
  const auto& most = scene.transfer->largest_thrust_m_s2;
  transfer.exceeds_thrust = most && transfer.largest_m_s2 > *most;
}

EnergyOptimalTransfer solved(const Scene& scene, const ComputedProblem& problem,
                             EnergyOptimalPolynomials& polynomials, double time) {
  EnergyOptimalTransfer transfer;
  transfer.time = time;
  try {
    solve(scene, problem, polynomials, transfer);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    transfer.failure = error.what();
  }
  return transfer;
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
                 EnergyOptimalPolynomials polynomials(jet);
                 transfer = solved(scene, problem, polynomials, times[index]);
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
    const ThrustedFlight flight(scene, problem, least.time);
    result.profile = flight.profile(least.refined->costates,
                                    interval_count(scene, least.time, profile_intervals));
    if (scene.transfer->feedback > 0) {
      if (progress) progress("feedback", 0);
      result.feedback =
          thrust_feedback(scene, orbit, problem, flight, least.refined->costates,
                          interval_count(scene, least.time, quadrature_panels), progress);
    }
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

void visit_energy_optimal(const Scene& scene, const ComputedProblem& orbit,
                          const std::function<void(std::size_t, EnergyOptimalPairs&)>& visit) {
  const ComputedProblem problem = costate_problem(orbit, scene.transfer->thrust_order);
  const std::vector<double>& times = scene.transfer->times;
  visit_jets(
      problem, symplectic_integrator(scene), times,
      [&](std::size_t index, const FlowJet<double>& jet) {
        std::optional<EnergyOptimalPolynomials> polynomials;
        try {
          polynomials.emplace(jet);
        } catch (const Error& error) {
          if (error.kind() != ErrorKind::numerical) throw;
          return;
        }
        EnergyOptimalPairs pairs;
        pairs.energy_m2_s3 = [&](const Scene& pair) {
          const ThrustedFlight flight(pair, problem, times[index]);
          return polynomials->answer(flight, polynomials->order(), metric_units(pair)).energy_m2_s3;
        };
        pairs.transfer = [&](const Scene& pair) {
          return solved(pair, problem, *polynomials, times[index]);
        };
        visit(index, pairs);
      });
}

}  // namespace hamjet
