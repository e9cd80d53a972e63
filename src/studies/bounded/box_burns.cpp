#include "box_burns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "../formation/burns/burn_search.hpp"
#include "../formation/burns/finite_burns.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

constexpr RelativeFrame frame_of_returns = RelativeFrame::rtn_rotating;
/// What burns miss moves the deputy by this part of the box at most over all days.
constexpr double part_missed = 1e-3;
/// Flights miss by some tens of roundings of a place.
constexpr double flights_floor = 64 * std::numeric_limits<double>::epsilon();
constexpr int looks_a_return = 200;

RelativeState relative(const std::vector<double>& deputy, const std::vector<double>& chief,
                       const MetricUnits& units) {
  return ChiefFrame(chief, units, frame_of_returns).relative(state_difference(deputy, chief));
}

}  // namespace

BoxBurns::BoxBurns(const Scene& scene, const ComputedProblem& problem, TaylorFlow& flow,
                   double revolution)
    : scene_(scene),
      problem_(problem),
      flow_(flow),
      burning_(burning_system(problem, *scene.thruster)),
      thruster_(*scene.thruster),
      allowed_miss_m_(allowed_miss_m(revolution)) {}

/// A deputy that is faster by v falls behind by 6 pi v a revolution, in the unit of time of a
/// circle (Clohessy and Wiltshire), and the impulses' orbit is taken for its own until the last
/// day.
double BoxBurns::allowed_miss_m(double revolution) const {
  const BoxSettings& box = scene_.bounded->box;
  const MetricUnits units = metric_units(scene_);
  const double revolutions = box.days * 86400 / units.time_s / revolution;
  const double drift = std::max(1.0, 6 * std::numbers::pi * revolutions);
  return std::max(part_missed * box.half_widths_m->minCoeff() / drift,
                  flights_floor * units.length_m);
}

BurnedReturn BoxBurns::replace(const BoxReturn& told, Company company) {
  const MetricUnits units = metric_units(scene_);
  Scene scene = scene_;
  scene.nominal = told.chief_before;
  scene.start_time = company.now();
  scene.thruster = thruster_;
  scene.transfer.emplace();
  scene.transfer->frame = frame_of_returns;
  scene.transfer->start = relative(told.deputy_before, told.chief_before, units);
  const RelativeState end = relative(told.deputy_after, told.chief_after, units);
  scene.transfer->end = {end.position_m, end.velocity_m_s};
  scene.transfer->refined_miss_m = allowed_miss_m_;
  ComputedProblem problem = problem_;
  problem.nominal = scene.nominal;
  problem.start_time = scene.start_time;
  BurnedReturn result;
  if (thruster_.mass_kg < least_share_of_mass * scene_.thruster->mass_kg) {
    result.plan.failure =
        "the burns of the returns before leave less than a thousandth of the mass";
    return result;
  }
  try {
    result = burns_of(scene, problem, told, company);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    result.plan.failure = error.what();
  }
  const auto& tank = scene_.thruster->propellant_kg;
  if (!result.plan.is_found() && tank && *thruster_.propellant_kg < *tank) {
    result.plan.failure +=
        fmt::format("; of {:.6g} kg there are {:.6g} kg left", *tank, *thruster_.propellant_kg);
  }
  return result;
}

BurnedReturn BoxBurns::burns_of(const Scene& scene, const ComputedProblem& problem,
                                const BoxReturn& told, Company& company) {
  const std::vector<Impulse> impulses = {{0, told.first_m_s}, {told.duration, told.second_m_s}};
  BurnSearch search(scene, problem, burning_, impulses, told.duration);
  BurnedReturn result;
  BurnPlan& plan = result.plan;
  plan = search.plan();
  plan.duration = told.duration;
  plan.impulses_m_s = told.change_m_s();
  if (search.is_too_weak() && !is_least_known_) {
    plan.least_acceleration_m_s2 = search.least_acceleration_m_s2();
    is_least_known_ = true;
  }
  if (!plan.is_found()) return result;
  const double begins = told.time + plan.burns.front().start;
  const double free_from = last_end_.value_or(0);
  if (begins < free_from) {
    plan.failure = fmt::format("its first burn begins {:.4g} s before {}, for a thruster so weak",
                               (free_from - begins) * scene.units.time_s,
                               last_end_ ? "the last burn of the return before ends" : "the start");
    return result;
  }
  double now = 0;
  search.look_along(plan, told.duration / looks_a_return,
                    [&](double time, const std::vector<double>& deputy) {
                      company.advance(flow_, time - now);
                      now = time;
                      company.set_deputy(deputy);
                      result.farthest = std::max(result.farthest, company.part());
                    });
  last_end_ = told.time + plan.burns.back().end;
  if (const auto left = plan.burns.back().mass_after_kg) {
    thruster_.acceleration_m_s2 *= thruster_.mass_kg / *left;
    thruster_.mass_kg = *left;
    if (thruster_.propellant_kg) *thruster_.propellant_kg -= *plan.propellant_kg();
  }
  return result;
}

}  // namespace hamjet
