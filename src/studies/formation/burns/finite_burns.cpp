#include "finite_burns.hpp"

#include <algorithm>
#include <cmath>

#include "burn_search.hpp"
#include "hamjet/error.hpp"

namespace hamjet {

double BurnPlan::change_m_s() const {
  double sum = 0;
  for (const FiniteBurn& burn : burns) sum += burn.change_m_s;
  return sum;
}

std::optional<double> BurnPlan::propellant_kg() const {
  std::optional<double> sum;
  for (const FiniteBurn& burn : burns) {
    if (burn.propellant_kg) sum = sum.value_or(0) + *burn.propellant_kg;
  }
  return sum;
}

const BurnPlan* FiniteBurns::cheapest_impulses() const {
  const auto cheapest = std::min_element(
      plans.begin(), plans.end(),
      [](const BurnPlan& a, const BurnPlan& b) { return a.impulses_m_s < b.impulses_m_s; });
  return cheapest == plans.end() ? nullptr : &*cheapest;
}

namespace {

/// The points to burn at: some of those whose answers are proved and allowed, evenly spread, and
/// always the one with the least velocity change.
std::vector<std::size_t> points_to_burn(const TransferResult& result, std::size_t best) {
  constexpr std::size_t most = 48;
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    if (result.points[i].is_candidate()) all.push_back(i);
  }
  const std::size_t stride = (all.size() + most - 1) / most;
  std::vector<std::size_t> some;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool is_last = k + 1 == all.size();
    if (k % stride == 0 || is_last || all[k] == best) some.push_back(all[k]);
  }
  return some;
}

}  // namespace

SharedSystem burning_system(const ComputedProblem& problem, const ThrusterSettings& thruster) {
  const bool turns = thruster.attitude == BurnAttitude::rtn;
  return burning_system(*problem.system, {turns ? ThrustAxes::rtn : ThrustAxes::inertial,
                                          thruster.exhaust_m_s.has_value()});
}

namespace {

class BurnStudy {
 public:
  BurnStudy(const Scene& scene, const ComputedProblem& problem)
      : scene_(scene), problem_(problem), burning_(burning_system(problem, *scene.thruster)) {}

  BurnPlan plan(const std::vector<Impulse>& impulses, double duration, bool is_cheapest) const {
    BurnPlan plan;
    try {
      BurnSearch search(scene_, problem_, burning_, impulses, duration);
      plan = search.plan();
      if (is_cheapest && search.is_too_weak()) {
        plan.least_acceleration_m_s2 = search.least_acceleration_m_s2();
      }
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      plan.failure = error.what();
    }
    plan.duration = duration;
    for (const Impulse& impulse : impulses) plan.impulses_m_s += impulse.change_m_s.norm();
    return plan;
  }

 private:
  const Scene& scene_;
  const ComputedProblem& problem_;
  SharedSystem burning_;
};

}  // namespace

FiniteBurns finite_burns(const Scene& scene, const ComputedProblem& problem,
                         const TransferResult& result, const ProgressCallback& progress) {
  FiniteBurns burns;
  const BurnStudy study(scene, problem);
  const auto best = result.best_point();
  const std::vector<std::size_t> points =
      best ? points_to_burn(result, *best) : std::vector<std::size_t>();
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (progress) {
      progress("burns", static_cast<double>(k) / static_cast<double>(points.size()));
    }
    const TransferPoint& point = result.points[points[k]];
    const std::vector<Impulse> impulses = {{0, point.best().start_change_m_s},
                                           {point.time, point.best().end_change_m_s}};
    burns.plans.push_back(study.plan(impulses, point.time, points[k] == *best));
  }
  if (result.optimal && result.optimal->is_found()) {
    const ImpulsePlan& plan = *result.optimal->plan;
    burns.plans.push_back(study.plan(plan.impulses, plan.duration, true));
    burns.plans.back().is_optimal = true;
  }
  for (std::size_t i = 0; i < burns.plans.size(); ++i) {
    if (!burns.plans[i].is_found()) continue;
    if (!burns.least || burns.plans[i].change_m_s() < burns.plans[*burns.least].change_m_s()) {
      burns.least = i;
    }
  }
  if (burns.least) return burns;
  const BurnPlan* const cheapest = burns.cheapest_impulses();
  burns.failure =
      cheapest != nullptr ? cheapest->failure : "there are no impulses that burns could replace";
  return burns;
}

}  // namespace hamjet
