#include "box_burns.hpp"

#include <fmt/format.h>

#include "../formation/burns/burn_search.hpp"
#include "../formation/burns/finite_burns.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

constexpr RelativeFrame frame_of_returns = RelativeFrame::rtn_rotating;
/// Burns miss the place of the impulses' end by this part of the box at most.
constexpr double part_missed = 1e-4;
constexpr int looks_a_return = 200;

RelativeState relative(const std::vector<double>& deputy, const std::vector<double>& chief,
                       const MetricUnits& units) {
  return ChiefFrame(chief, units, frame_of_returns).relative(state_difference(deputy, chief));
}

}  // namespace

BoxBurns::BoxBurns(const Scene& scene, const ComputedProblem& problem, TaylorFlow& flow)
    : scene_(scene),
      problem_(problem),
      flow_(flow),
      burning_(burning_system(problem, *scene.thruster)),
      thruster_(*scene.thruster) {}

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
  scene.transfer->refined_miss_m = part_missed * scene.bounded->box.half_widths_m->minCoeff();
  ComputedProblem problem = problem_;
  problem.nominal = scene.nominal;
  problem.start_time = scene.start_time;
  BurnedReturn result;
  try {
    result = burns_of(scene, problem, told, company);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    result.plan.failure = error.what();
  }
  has_failed_ = has_failed_ || !result.plan.is_found();
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
  if (search.is_too_weak() && !has_failed_) {
    plan.least_acceleration_m_s2 = search.least_acceleration_m_s2();
  }
  if (!plan.is_found()) return result;
  const double begins = told.time + plan.burns.front().start;
  if (begins < last_end_.value_or(0)) {
    plan.failure = last_end_ ? "its first burn begins before the last of the return before ends"
                             : "its first burn begins before the start";
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
