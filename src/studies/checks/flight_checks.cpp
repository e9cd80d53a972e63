#include "flight_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "../../algebra/state_sums.hpp"
#include "../energy_error.hpp"
#include "../flights/extreme_distance.hpp"
#include "../formation/formation_problem.hpp"
#include "../formation/single_transfer.hpp"
#include "../stopwatch.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

constexpr double largest_flown_energy_change = 1e-9;

/// The outcome of one flight.
struct FlightOutcome {
  LowestPoint lowest;
  double energy_change = 0;  ///< relative
};

/// What is measured along one flight.
class MeasuredFlight {
 public:
  MeasuredFlight(const SharedSystem& system, const CheckedFlight& flight, bool measures_energy)
      : flight_(&flight) {
    if (!measures_energy) return;
    energy_.emplace(*system, flight.start, flight.start_time);
    // If terms cancel, their sum is no scale for the change.
    scale_ = std::max(std::abs(static_cast<double>(energy_->initial())),
                      energy_->terms(extended(flight.start)) / 100);
  }

  void add(const FlightArc& arc, std::size_t craft) {
    least_.add(arc, place_along(arc, craft));
    if (!energy_) return;
    const Extended change =
        energy_->value(extended(arc.state(craft, 1)), flight_->start_time + arc.time_at(1)) -
        energy_->initial();
    // At an equilibrium at the origin all terms are 0, and stay so.
    const double size = change == 0 ? 0 : std::abs(static_cast<double>(change)) / scale_;
    if (!(size <= energy_change_)) energy_change_ = size;
  }

  FlightOutcome outcome() const {
    FlightOutcome result;
    result.lowest.distance = least_.distance();
    result.lowest.time = least_.time();
    result.energy_change = energy_change_;
    return result;
  }

 private:
  const CheckedFlight* flight_;
  ExtremeDistance least_{ExtremeDistance::Kind::least};
  std::optional<EnergyError> energy_;
  double scale_ = 0;
  double energy_change_ = 0;
};

/// The outcomes of flights that begin and end together, side by side.
std::vector<FlightOutcome> outcomes_of(const SharedSystem& system,
                                       std::span<const CheckedFlight> flights, bool measures_energy,
                                       const std::function<void(const FlightArc&)>& observer = {}) {
  std::vector<MeasuredFlight> measured;
  std::vector<std::vector<double>> states;
  for (const CheckedFlight& flight : flights) {
    measured.emplace_back(system, flight, measures_energy);
    states.push_back(flight.start);
  }
  fly_arcs(system, std::move(states), flights[0].start_time, flights[0].time,
           [&](const FlightArc& arc) {
             for (std::size_t craft = 0; craft < measured.size(); ++craft) {
               measured[craft].add(arc, craft);
             }
             if (observer) observer(arc);
           });
  std::vector<FlightOutcome> outcomes;
  for (const MeasuredFlight& flight : measured) outcomes.push_back(flight.outcome());
  return outcomes;
}

bool fly_together(std::span<const CheckedFlight> flights) {
  return std::all_of(flights.begin(), flights.end(), [&](const CheckedFlight& flight) {
    return flight.time == flights[0].time &&
           flight.start_time.in<Extended>() == flights[0].start_time.in<Extended>();
  });
}

void judge_energy(SelfCheck& check, const CheckedFlight& worst, double change,
                  ConservedQuantity kept) {
  const double limit = check.limit.value_or(largest_flown_energy_change);
  check.limit = limit;
  if (std::isfinite(change)) check.value = change;
  check.state = change <= limit ? SelfCheckState::passed : SelfCheckState::failed;
  check.text = fmt::format("{} along the flight of {} changed by at most {:.2g} of its size",
                           kept == ConservedQuantity::energy ? "the energy" : "Jacobi's integral",
                           worst.name, change);
}

void judge_surface(SelfCheck& check, const Scene& scene, const CheckedFlight& worst,
                   const LowestPoint& lowest) {
  const bool is_own_limit = check.limit.has_value();
  const double limit = check.limit.value_or(scene.system.radius_km);
  const double distance = lowest.distance * scene.units.length_km;
  check.limit = limit;
  check.value = distance;
  check.state = distance >= limit ? SelfCheckState::passed : SelfCheckState::failed;
  check.text = fmt::format(
      "{} {} {:.6g} km {} {}{} at t = {:.6g} s", worst.name, distance >= limit ? "stays" : "passes",
      std::abs(distance - limit), distance >= limit ? "above" : "below",
      is_own_limit ? fmt::format("the distance of {:.10g} km", limit) : "the surface",
      distance >= limit ? ", lowest" : "", lowest.time * scene.units.time_s);
}

}  // namespace

std::vector<CheckedFlight> flights_of(const Scene& scene, double time, bool with_deputy) {
  std::vector<CheckedFlight> flights = {{"the chief", scene.nominal, scene.start_time, time}};
  if (with_deputy && scene.deputy) {
    flights.push_back(
        {"the deputy", state_sum(scene.nominal, deputy_deviation(scene)), scene.start_time, time});
  }
  return flights;
}

std::optional<double> surface_limit(const Scene& scene) {
  const SelfCheckSetting& setting = scene.checks[SelfCheckName::surface];
  if (!setting.is_on || !(scene.system.radius_km > 0)) return std::nullopt;
  return setting.limit.value_or(scene.system.radius_km) / scene.units.length_km;
}

LowestPoint lowest_point(const SharedSystem& system, const std::vector<double>& start,
                         const ClockTime& start_time, double time) {
  ExtremeDistance least(ExtremeDistance::Kind::least);
  LowestPoint lowest;
  try {
    fly_arcs(system, {start}, start_time, time,
             [&](const FlightArc& arc) { least.add(arc, place_along(arc, 0)); });
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    lowest.failure = error.what();
    return lowest;
  }
  lowest.distance = least.distance();
  lowest.time = least.time();
  return lowest;
}

std::vector<SelfCheck> flight_checks(const Scene& scene, const std::vector<CheckedFlight>& flights,
                                     const std::function<void(const FlightArc&)>& observer) {
  std::vector<SelfCheck> checks(2);
  SelfCheck& energy = checks[0];
  SelfCheck& surface = checks[1];
  energy.name = SelfCheckName::energy;
  surface.name = SelfCheckName::surface;
  for (SelfCheck& check : checks) {
    const SelfCheckSetting& setting = scene.checks[check.name];
    check.limit = setting.limit;
    check.state = setting.is_on ? SelfCheckState::passed : SelfCheckState::off;
    if (!setting.is_on) check.text = "turned off in the scene";
  }
  if (surface.state != SelfCheckState::off && !(scene.system.radius_km > 0)) {
    surface.state = SelfCheckState::not_applicable;
    surface.limit.reset();
    surface.text = "the model has no radius";
  }
  const SharedSystem system = make_system(scene);
  if (energy.state != SelfCheckState::off &&
      system->conserved_quantity() == ConservedQuantity::none) {
    energy.state = SelfCheckState::not_applicable;
    energy.limit.reset();
    energy.text = no_energy_is_kept;
  }
  const auto is_on = [](const SelfCheck& check) { return check.state == SelfCheckState::passed; };
  const bool is_any_on = std::any_of(checks.begin(), checks.end(), is_on);
  if (flights.empty() || !(is_any_on || observer)) return checks;
  const Stopwatch watch(energy.seconds);
  const CheckedFlight* leaving = &flights.front();
  const CheckedFlight* falling = &flights.front();
  double change = 0;
  bool is_flown = false;
  LowestPoint lowest;
  lowest.distance = std::numeric_limits<double>::infinity();
  const auto take = [&](const CheckedFlight& flight, const FlightOutcome& outcome) {
    if (!(outcome.energy_change <= change)) {
      change = outcome.energy_change;
      leaving = &flight;
    }
    if (outcome.lowest.distance < lowest.distance) {
      lowest = outcome.lowest;
      falling = &flight;
    }
  };
  if (observer || (flights.size() > 1 && fly_together(flights))) {
    try {
      const std::vector<FlightOutcome> outcomes =
          outcomes_of(system, flights, is_on(energy), observer);
      for (std::size_t i = 0; i < flights.size(); ++i) take(flights[i], outcomes[i]);
      is_flown = true;
    } catch (const Error& error) {
      // The flights one by one tell which of them it is.
      if (error.kind() != ErrorKind::numerical || observer) throw;
    }
  }
  for (std::size_t i = 0; i < flights.size() && !is_flown; ++i) {
    const CheckedFlight& flight = flights[i];
    try {
      take(flight, outcomes_of(system, {&flight, 1}, is_on(energy))[0]);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      for (SelfCheck& check : checks) {
        if (!is_on(check)) continue;
        check.state = SelfCheckState::failed;
        check.text = fmt::format("{} cannot be followed: {}", flight.name, error.what());
      }
      return checks;
    }
  }
  if (is_on(energy)) judge_energy(energy, *leaving, change, system->conserved_quantity());
  if (is_on(surface)) judge_surface(surface, scene, *falling, lowest);
  return checks;
}

}  // namespace hamjet
