#include "hamjet/studies/assignment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../checks/flight_checks.hpp"
#include "../exact_flow.hpp"
#include "../jets_along_time.hpp"
#include "../stopwatch.hpp"
#include "formation_problem.hpp"
#include "hamjet/error.hpp"
#include "least_assignment.hpp"
#include "nearest_pairs.hpp"
#include "thrust/energy_optimal.hpp"
#include "transfer_points.hpp"

namespace hamjet {
namespace {

constexpr double no_cost = std::numeric_limits<double>::infinity();

/// One study in progress.
class AssignmentStudy {
 public:
  AssignmentStudy(const Scene& scene, const ProgressCallback& progress)
      : scene_(scene),
        settings_(*scene.assignment),
        progress_(progress),
        points_(scene, progress, seconds_) {
    result_.scene = scene;
    // All pairs if there are few, otherwise this many of them, evenly chosen.
    constexpr std::size_t most_pairs = 64;
    const std::size_t slots = settings_.slots.size();
    const std::size_t pairs = settings_.deputies.size() * slots;
    const std::size_t stride = std::max<std::size_t>(1, pairs / most_pairs);
    for (std::size_t k = 0; k < pairs; k += stride) {
      typical_.push_back({settings_.deputies[k / slots], settings_.slots[k % slots]});
    }
  }

  AssignmentResult run() {
    const IntegratorSettings& integrator = symplectic_integrator(scene_);
    result_.integrator = integrator.label;
    result_.coordinates = points_.coordinates();
    if (is_thrusted()) return run_thrusted();
    const std::vector<double>& times = scene_.transfer->times;
    const auto statistics =
        visit_jets(points_.jet_problem(), integrator, times,
                   [&](std::size_t index, const FlowJet<double>& jet) { find_costs(index, jet); });
    result_.checks = flight_checks(scene_, flights_of(scene_, times.back(), false));
    choose();
    if (!result_.failure.empty()) return std::move(result_);
    // The chosen times are visited once more for the proofs; kinds are then chosen as the first
    // time.
    points_.forget_last_kind();
    visit_jets(points_.jet_problem(), integrator, times,
               [&](std::size_t index, const FlowJet<double>& jet) { prove(index, jet); });
    for (const AssignedTransfer& transfer : result_.transfers) {
      if (transfer.transfer.has_answer()) {
        result_.total_change_m_s += transfer.transfer.best().total_change_m_s();
      }
    }
    {
      const Stopwatch watch(seconds_.proof);
      result_.pairs = nearest_of_pairs(scene_, result_.transfers);
    }
    result_.study_seconds = seconds_.study() + statistics.wall_seconds;
    result_.proof_seconds = seconds_.proof;
    return std::move(result_);
  }

 private:
  bool is_thrusted() const { return scene_.transfer->thrust == TransferThrust::energy_optimal; }

  Scene scene_of_pair(std::size_t deputy, std::size_t slot) const {
    Scene pair = scene_;
    pair.transfer->start = settings_.deputies[deputy];
    pair.transfer->end = settings_.slots[slot];
    return pair;
  }

  /// With a thrust that lasts: energies of all pairs by evaluation, then the chosen transfers by
  /// flying.
  AssignmentResult run_thrusted() {
    const std::vector<double>& times = scene_.transfer->times;
    const auto told = [&](const char* stage, std::size_t index) {
      if (progress_) {
        progress_(stage, static_cast<double>(index) / static_cast<double>(times.size()));
      }
    };
    costs_.assign(times.size(), std::vector<std::vector<double>>(
                                    settings_.deputies.size(),
                                    std::vector<double>(settings_.slots.size(), no_cost)));
    {
      const Stopwatch watch(seconds_.solution);
      visit_energy_optimal(scene_, points_.problem(), [&](std::size_t index, auto& pairs) {
        told("costs", index);
        for (std::size_t i = 0; i < settings_.deputies.size(); ++i) {
          for (std::size_t j = 0; j < settings_.slots.size(); ++j) {
            costs_[index][i][j] = energy_or_none(pairs, scene_of_pair(i, j));
          }
        }
      });
    }
    result_.checks = flight_checks(scene_, flights_of(scene_, times.back(), false));
    choose();
    if (!result_.failure.empty()) return std::move(result_);
    const Stopwatch watch(seconds_.proof);
    visit_energy_optimal(scene_, points_.problem(), [&](std::size_t index, auto& pairs) {
      told("proofs", index);
      for (AssignedTransfer& one : result_.transfers) {
        if (result_.costs[one.deputy][one.slot].time != index) continue;
        one.thrust = pairs.transfer(scene_of_pair(one.deputy, one.slot));
        one.transfer.time = times[index];
        one.transfer.failure = one.thrust->failure;
      }
    });
    for (const AssignedTransfer& one : result_.transfers) {
      if (!one.thrust || !one.thrust->is_found()) continue;
      result_.total_change_m_s += one.thrust->change_m_s;
      result_.total_energy_m2_s3 += one.thrust->energy_m2_s3;
    }
    result_.study_seconds = seconds_.study();
    result_.proof_seconds = seconds_.proof;
    return std::move(result_);
  }

  static double energy_or_none(const EnergyOptimalPairs& pairs, const Scene& pair) {
    try {
      const double energy = pairs.energy_m2_s3(pair);
      // Beyond their reach polynomials may fall below what no thrust can.
      return energy >= 0 ? energy : no_cost;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      return no_cost;
    }
  }

  /// Velocity changes of all pairs at one time; infinite if there is no answer.
  void find_costs(std::size_t index, const FlowJet<double>& jet) {
    const std::vector<double>& times = scene_.transfer->times;
    if (progress_) {
      progress_("costs", static_cast<double>(index) / static_cast<double>(times.size()));
    }
    costs_.emplace_back(settings_.deputies.size(),
                        std::vector<double>(settings_.slots.size(), no_cost));
    if (points_.is_near_singular(times[index])) return;
    const ChosenKind chosen = points_.choose_kind(times[index], jet, typical_);
    if (!chosen.failure.empty()) return;
    const DeputyFlow* const flow = points_.charted_flow(times[index]);
    const Stopwatch watch(seconds_.solution);
    const std::vector<double> orbit_end = nominal_of(jet);
    const std::vector<double> chief_end = points_.chief_beside(orbit_end, times[index]);
    TransferBoundary boundary(chosen.inversion, flow);
    for (std::size_t i = 0; i < settings_.deputies.size(); ++i) {
      if (progress_) {
        progress_("costs", static_cast<double>(index) / static_cast<double>(times.size()));
      }
      for (std::size_t j = 0; j < settings_.slots.size(); ++j) {
        try {
          const SingleTransfer transfer(scene_, points_.problem(), times[index], orbit_end,
                                        chief_end, settings_.deputies[i], settings_.slots[j]);
          const BoundaryMomenta momenta =
              transfer.solve(boundary, scene_.order, transfer.momentum_before());
          const TransferAnswer answer = transfer.answer(momenta, scene_.order);
          const double cost = answer.total_change_m_s();
          const double most = scene_.transfer->largest_impulse_m_s.value_or(no_cost);
          const bool is_allowed = answer.largest_impulse_m_s() <= most;
          if (std::isfinite(cost) && is_allowed) costs_.back()[i][j] = cost;
        } catch (const Error& error) {
          if (error.kind() != ErrorKind::numerical) throw;
        }
      }
    }
  }

  void choose() {
    std::optional<Assignment> slots;
    if (settings_.time == AssignmentTime::common) {
      slots = choose_common();
    } else {
      result_.costs = best_costs(0, costs_.size());
      slots = least_assignment(totals(result_.costs));
    }
    if (!slots) {
      result_.failure =
          "no assignment gives every deputy a slot, or every slot a deputy: at no transfer time "
          "away "
          "from singularities do enough transfers have an answer";
      return;
    }
    for (std::size_t i = 0; i < slots->size(); ++i) {
      if ((*slots)[i]) result_.transfers.push_back({i, *(*slots)[i], {}});
    }
  }

  std::optional<Assignment> choose_common() {
    std::optional<Assignment> best;
    double least = no_cost;
    for (std::size_t t = 0; t < costs_.size(); ++t) {
      const auto slots = least_assignment(costs_[t]);
      if (!slots) continue;
      double total = 0;
      for (std::size_t i = 0; i < slots->size(); ++i) {
        if ((*slots)[i]) total += costs_[t][i][*(*slots)[i]];
      }
      if (!(total < least)) continue;
      least = total;
      best = slots;
      result_.common_time = t;
    }
    if (result_.common_time) {
      result_.costs = best_costs(*result_.common_time, *result_.common_time + 1);
    }
    return best;
  }

  /// The cheapest among the times first..last - 1 for each pair.
  std::vector<std::vector<AssignmentCost>> best_costs(std::size_t first, std::size_t last) const {
    std::vector<std::vector<AssignmentCost>> best(
        settings_.deputies.size(), std::vector<AssignmentCost>(settings_.slots.size()));
    for (std::size_t i = 0; i < best.size(); ++i) {
      for (std::size_t j = 0; j < best[i].size(); ++j) {
        for (std::size_t t = first; t < last; ++t) {
          const double cost = costs_[t][i][j];
          if (!std::isfinite(cost)) continue;
          AssignmentCost& entry = best[i][j];
          double& least = is_thrusted() ? entry.energy_m2_s3 : entry.total_change_m_s;
          if (entry.time && !(cost < least)) continue;
          entry.time = t;
          least = cost;
        }
      }
    }
    return best;
  }

  std::vector<std::vector<double>> totals(
      const std::vector<std::vector<AssignmentCost>>& costs) const {
    std::vector<std::vector<double>> result;
    for (const auto& row : costs) {
      result.emplace_back();
      for (const AssignmentCost& entry : row) {
        result.back().push_back(!entry.time     ? no_cost
                                : is_thrusted() ? entry.energy_m2_s3
                                                : entry.total_change_m_s);
      }
    }
    return result;
  }

  void prove(std::size_t index, const FlowJet<double>& jet) {
    const std::vector<double>& times = scene_.transfer->times;
    if (progress_) {
      progress_("proofs", static_cast<double>(index) / static_cast<double>(times.size()));
    }
    result_.flight_floor_m = std::max(result_.flight_floor_m, points_.flight_floor_m(jet));
    std::optional<ChosenKind> chosen;
    for (AssignedTransfer& assigned : result_.transfers) {
      if (result_.costs[assigned.deputy][assigned.slot].time != index) continue;
      if (!chosen) chosen = points_.choose_kind(times[index], jet, typical_);
      assigned.transfer = points_.answer(
          *chosen, jet, {settings_.deputies[assigned.deputy], settings_.slots[assigned.slot]});
    }
  }

  const Scene& scene_;
  const AssignmentSettings& settings_;
  const ProgressCallback& progress_;
  TransferSeconds seconds_;
  TransferPoints points_;
  std::vector<RelativeTransfer> typical_;                ///< transfers for which the kind is chosen
  std::vector<std::vector<std::vector<double>>> costs_;  ///< [time][deputy][slot], m/s
  AssignmentResult result_;
};

}  // namespace

AssignmentResult study_assignment(const Scene& scene, const ProgressCallback& progress) {
  require_formation_problem(scene, scene.assignment.has_value() && scene.transfer.has_value(),
                            "assignment");
  require_states_alone(scene, "assignment");
  return AssignmentStudy(scene, progress).run();
}

std::optional<DeputyPair> nearest_pair(const AssignmentResult& result) {
  const auto nearest = std::min_element(
      result.pairs.begin(), result.pairs.end(),
      [](const auto& a, const auto& b) { return a.separation_m < b.separation_m; });
  return nearest != result.pairs.end() ? std::optional(*nearest) : std::nullopt;
}

std::vector<std::size_t> left_out(const std::vector<AssignedTransfer>& transfers, std::size_t count,
                                  std::size_t AssignedTransfer::*which) {
  std::vector<std::size_t> rest;
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_in = std::any_of(transfers.begin(), transfers.end(),
                                   [&](const auto& transfer) { return transfer.*which == i; });
    if (!is_in) rest.push_back(i);
  }
  return rest;
}

int exit_code(const AssignmentResult& result) {
  if (!result.failure.empty()) return static_cast<int>(ErrorKind::numerical);
  bool has_fault = false;
  bool is_forbidden = false;
  for (const AssignedTransfer& assigned : result.transfers) {
    const TransferPoint& transfer = assigned.transfer;
    if (assigned.thrust) {
      if (!assigned.thrust->is_found()) return static_cast<int>(ErrorKind::numerical);
      is_forbidden = is_forbidden || assigned.thrust->exceeds_thrust;
      continue;
    }
    if (!transfer.has_answer()) return static_cast<int>(ErrorKind::numerical);
    is_forbidden = is_forbidden || !transfer.is_allowed();
    has_fault =
        has_fault || transfer.is_beyond_tolerance || (transfer.refined && !transfer.is_refined());
  }
  const auto pair = nearest_pair(result);
  const auto& keep_apart = result.scene.assignment->keep_apart_m;
  const bool are_too_near = pair && keep_apart && pair->separation_m < *keep_apart;
  const bool is_failed = has_failed(result.checks) || are_too_near || is_forbidden ||
                         (result.scene.transfer->strict && has_fault);
  return is_failed ? static_cast<int>(ErrorKind::check_failed) : 0;
}

}  // namespace hamjet
