#include "fuel_optimal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "../../exact_flow.hpp"
#include "../../flights/paced_times.hpp"
#include "../burns/canonical_thruster.hpp"
#include "../formation_problem.hpp"
#include "../impulses/planned_transfer.hpp"
#include "../single_transfer.hpp"
#include "bang_bang_search.hpp"
#include "hamjet/error.hpp"
#include "thrusted_flight.hpp"

namespace hamjet {
namespace {

constexpr std::size_t most_fuel_times = 12;
/// Parts of the flight at whose ends thrust and primer vector are told.
constexpr IntervalCount primer_intervals = {96, 96, 2000};
/// How far the primer vector may be on the wrong side of 1, where rounding alone puts it.
constexpr double primer_rounding = 1e-9;

class FuelOptimalStudy {
 public:
  FuelOptimalStudy(const Scene& scene, const ComputedProblem& orbit, const CompanionFlow& flow)
      : scene_(scene),
        unlimited_(scene),
        orbit_(orbit),
        with_costates_(costate_problem(orbit, 1)),
        flow_(flow),
        units_(metric_units(scene)),
        thruster_(*scene.thruster, units_) {
    // The bound is that of impulses of any size, anywhere, that do arrive.
    unlimited_.transfer->refined_miss_m =
        std::min(unlimited_.transfer->refined_miss_m, TransferSettings{}.refined_miss_m);
    unlimited_.transfer->largest_impulse_m_s.reset();
    unlimited_.transfer->keep_out_m.reset();
  }

  FuelOptimalTransfer transfer(const EnergyOptimalTransfer& energy) const {
    FuelOptimalTransfer transfer;
    transfer.time = energy.time;
    if (!energy.is_found()) {
      transfer.failure = "no energy-optimal thrust to follow it from: " + energy.failure;
      return transfer;
    }
    transfer.energy_optimal_m_s = energy.change_m_s;
    constexpr double most_masses = 10;  // of the logarithm of the masses before and behind
    const auto& exhaust_m_s = scene_.thruster->exhaust_m_s;
    if (exhaust_m_s && energy.change_m_s > most_masses * *exhaust_m_s) {
      transfer.failure = fmt::format(
          "the exhaust of {:.4g} m/s, of specific_impulse_s, is too slow: {:.4g} m/s, as least "
          "energy takes them, leave {:.2g} of the mass",
          *exhaust_m_s, energy.change_m_s, std::exp(-energy.change_m_s / *exhaust_m_s));
      return transfer;
    }
    add_impulses(transfer);
    try {
      const ThrustedFlight ends(scene_, with_costates_, energy.time);
      const SwitchedFlight flight(*orbit_.system, orbit_.start_time, energy.time);
      const BangBangThrust thrust = bang_bang_thrust(flight, task(ends, energy));
      transfer.continuation_steps = thrust.steps;
      transfer.flights = thrust.flights;
      if (thrust.failure.empty()) {
        describe(transfer, thrust, ends, flight);
      } else {
        transfer.failure = thrust.failure;
        if (thrust.lowest) tell_weakness(transfer, *thrust.lowest);
      }
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      transfer.failure = error.what();
    }
    return transfer;
  }

  std::vector<PrimerSample> profile(const FuelOptimalTransfer& transfer) const {
    std::vector<PrimerSample> samples;
    const ThrustedFlight ends(scene_, with_costates_, transfer.time);
    const SwitchedFlight flight(*orbit_.system, orbit_.start_time, transfer.time);
    const std::vector<ThrustSpan> flown = flight.fly(ends.deputy(transfer.costates), law());
    const int intervals = interval_count(scene_, transfer.time, primer_intervals);
    std::vector<double> times;
    for (int k = 0; k <= intervals; ++k) {
      times.push_back(k == intervals ? transfer.time : transfer.time * k / intervals);
    }
    for (const ThrustSpan& place : flight.at(flown, law(), times)) {
      const double time = times[samples.size()];
      const double primer = primer_length(place.state) / place.threshold;
      PrimerSample sample{time, Eigen::Vector3d::Zero(), primer};
      if (primer > 1) {
        sample.thrust_m_s2 = place.acceleration * units_.velocity_m_s() / units_.time_s *
                             direction(ends.chief_at(time), place.state);
      }
      samples.push_back(sample);
    }
    return samples;
  }

 private:
  SwitchedThrust law() const { return {thruster_.acceleration, 0, 1 / thruster_.exhaust}; }

  BangBangTask task(const ThrustedFlight& ends, const EnergyOptimalTransfer& energy) const {
    BangBangTask task;
    task.start = ends.deputy(energy.refined->costates);
    task.start.resize(SwitchedFlight::states);
    for (std::size_t i = 0; i < SwitchedFlight::states; ++i) {
      task.end.push_back(ends.orbit_end()[i] + ends.end()[i]);
    }
    task.energy_costates = energy.refined->costates;
    task.energy_largest = energy.largest_m_s2 * units_.time_s / units_.velocity_m_s();
    task.most = law().most;
    task.inverse_exhaust = law().inverse_exhaust;
    task.tolerance = scene_.transfer->refined_miss_m / units_.length_m;
    return task;
  }

  void add_impulses(FuelOptimalTransfer& transfer) const {
    // Impulses at any times are planned along orbits alone.
    if (!is_orbit(scene_.system.model)) return;
    try {
      const PlannedTransfer planned(unlimited_, orbit_, flow_, transfer.time);
      const FlownImpulses flown = planned.corrected(planned.by_linear_theory());
      if (!flown.failure.empty()) return;
      const ImpulsePlan plan = planned.plan(flown);
      transfer.impulses_m_s = plan.total_change_m_s();
      transfer.impulses_bound_m_s = plan.lower_bound_m_s;
    } catch (const Error& error) {
      // There is a thrust without them too.
      if (error.kind() != ErrorKind::numerical) throw;
    }
  }

  void tell_weakness(FuelOptimalTransfer& transfer, double lowest) const {
    transfer.least_acceleration_m_s2 = lowest * units_.velocity_m_s() / units_.time_s;
    transfer.failure = fmt::format(
        "the thruster's {:.4g} m/s^2 are too weak for {:.6g} s: the least with which a thrust was "
        "found is {:.4g} m/s^2, {:.3g} times as much",
        scene_.thruster->acceleration_m_s2, transfer.time * units_.time_s,
        *transfer.least_acceleration_m_s2,
        *transfer.least_acceleration_m_s2 / scene_.thruster->acceleration_m_s2);
  }

  Eigen::Vector3d direction(const std::vector<double>& chief, const std::vector<double>& z) const {
    const Eigen::Vector3d costate(z[9], z[10], z[11]);
    return ChiefFrame(chief, units_, scene_.transfer->frame).along_axes(-costate.normalized());
  }

  void describe(FuelOptimalTransfer& transfer, const BangBangThrust& thrust,
                const ThrustedFlight& ends, const SwitchedFlight& flight) const {
    transfer.costates = thrust.costates;
    transfer.miss_m = thrust.miss.head<3>().norm() * units_.length_m;
    transfer.velocity_miss_m_s = thrust.miss.tail<3>().norm() * units_.velocity_m_s();
    for (std::size_t k = 0; k + 1 < thrust.flown.size(); ++k) {
      const ThrustSpan& span = thrust.flown[k];
      if (k > 0) {
        transfer.primer_at_switches = std::max(
            transfer.primer_at_switches, std::abs(primer_length(span.state) / span.threshold - 1));
      }
      if (span.phase != ThrustPhase::full) continue;
      ThrustBurn burn;
      burn.start = span.start;
      burn.end = span.end;
      burn.change_m_s =
          law().mass_falls()
              ? -*scene_.thruster->exhaust_m_s *
                    std::log1p(-span.acceleration * span.length() * law().inverse_exhaust)
              : scene_.thruster->acceleration_m_s2 * span.length() * units_.time_s;
      burn.start_direction = direction(ends.chief_at(span.start), span.state);
      burn.end_direction = direction(ends.chief_at(span.end), thrust.flown[k + 1].state);
      transfer.change_m_s += burn.change_m_s;
      transfer.burns.push_back(burn);
    }
    add_conditions(transfer, thrust, flight);
    if (law().mass_falls()) {
      transfer.propellant_kg = -scene_.thruster->mass_kg *
                               std::expm1(-transfer.change_m_s / *scene_.thruster->exhaust_m_s);
      const auto& most_kg = scene_.thruster->propellant_kg;
      if (most_kg && *transfer.propellant_kg > *most_kg) {
        transfer.failure =
            fmt::format("the burns of {:.6g} s take {:.6g} kg, above propellant_kg = {:.6g}",
                        transfer.time * units_.time_s, *transfer.propellant_kg, *most_kg);
        return;
      }
    }
    if (transfer.primer_in_coasts > 1 + primer_rounding ||
        (!transfer.burns.empty() && transfer.primer_in_burns < 1 - primer_rounding)) {
      transfer.failure = fmt::format(
          "the maximum principle does not hold: the primer vector comes to {:.10g} in coasts and "
          "to {:.10g} in burns",
          transfer.primer_in_coasts, transfer.primer_in_burns);
    }
  }

  /// The conditions of the maximum principle on the flight's polynomials.
  void add_conditions(FuelOptimalTransfer& transfer, const BangBangThrust& thrust,
                      const SwitchedFlight& flight) const {
    constexpr int each_step = 8;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double least = infinity, lowest = infinity, highest = -infinity, scale = 0;
    flight.visit(thrust.flown, law(), each_step, [&](const SwitchedFlight::Instant& instant) {
      const double primer = primer_length(instant.state) / instant.threshold;
      const bool burns = instant.phase == ThrustPhase::full;
      if (burns) {
        least = std::min(least, primer);
      } else {
        transfer.primer_in_coasts = std::max(transfer.primer_in_coasts, primer);
      }
      // The rates have the thrust in them.
      double hamiltonian = burns ? instant.acceleration * instant.threshold : 0;
      for (std::size_t i = 0; i < SwitchedFlight::states; ++i) {
        const double term = instant.state[SwitchedFlight::states + i] * instant.rates[i];
        hamiltonian += term;
        scale = std::max(scale, std::abs(term));
      }
      lowest = std::min(lowest, hamiltonian);
      highest = std::max(highest, hamiltonian);
    });
    transfer.primer_in_burns = transfer.burns.empty() ? 0 : least;
    if (flight.is_autonomous() && scale > 0) {
      transfer.hamiltonian_change = (highest - lowest) / scale;
    }
  }

  const Scene& scene_;
  Scene unlimited_;
  const ComputedProblem& orbit_;
  ComputedProblem with_costates_;
  const CompanionFlow& flow_;
  MetricUnits units_;
  CanonicalThruster thruster_;
};

/// Evenly spread over a list, and including its last entry.
std::vector<std::size_t> spread_indices(std::size_t count, std::size_t most) {
  std::vector<std::size_t> indices;
  const std::size_t taken = std::min(count, most);
  for (std::size_t k = 1; k <= taken; ++k) indices.push_back(k * count / taken - 1);
  return indices;
}

}  // namespace

std::string failures_text(const FuelOptimalTransfers& fuel) {
  // Of each kind of limit the failure that lacks least; where there are none, the first.
  const FuelOptimalTransfer* weak = nullptr;
  const FuelOptimalTransfer* empty = nullptr;
  const FuelOptimalTransfer* other = nullptr;
  for (const FuelOptimalTransfer& one : fuel.transfers) {
    if (one.is_found()) continue;
    if (one.least_acceleration_m_s2) {
      if (!weak || *one.least_acceleration_m_s2 < *weak->least_acceleration_m_s2) weak = &one;
    } else if (one.propellant_kg) {
      if (!empty || *one.propellant_kg < *empty->propellant_kg) empty = &one;
    } else if (!other) {
      other = &one;
    }
  }
  if (!weak && !empty) return other ? other->failure : "";
  if (weak && empty) return weak->failure + "; " + empty->failure;
  return (weak ? weak : empty)->failure;
}

FuelOptimalTransfers fuel_optimal_transfers(const Scene& scene, const ComputedProblem& orbit,
                                            const CompanionFlow& flow,
                                            const EnergyOptimalTransfers& energy,
                                            const ProgressCallback& progress) {
  FuelOptimalTransfers result;
  result.acceleration_m_s2 = scene.thruster->acceleration_m_s2;
  const FuelOptimalStudy study(scene, orbit, flow);
  const std::vector<std::size_t> indices = spread_indices(energy.transfers.size(), most_fuel_times);
  for (const std::size_t index : indices) {
    if (progress) {
      progress("fuel-optimal thrust",
               static_cast<double>(result.transfers.size()) / static_cast<double>(indices.size()));
    }
    result.transfers.push_back(study.transfer(energy.transfers[index]));
    const FuelOptimalTransfer& one = result.transfers.back();
    if (!one.is_found()) continue;
    if (!result.least || one.change_m_s < result.transfers[*result.least].change_m_s) {
      result.least = result.transfers.size() - 1;
    }
  }
  if (result.least) {
    result.profile = study.profile(result.transfers[*result.least]);
    return result;
  }
  result.failure = failures_text(result);
  return result;
}

}  // namespace hamjet
