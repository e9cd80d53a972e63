#include "companion_flow.hpp"

#include "../../algebra/state_sums.hpp"
#include "../earth_system.hpp"
#include "formation_problem.hpp"

namespace hamjet {

CompanionFlow::CompanionFlow(const Scene& scene, const ComputedProblem& problem, double duration,
                             double per_revolution, const std::function<void(double)>& progress)
    : LinearFlow(problem, duration, per_revolution, progress) {
  if (is_like_chief(scene)) return;
  chief_problem_ = std::make_unique<const ComputedProblem>(make_problem(scene));
  chief_ = std::make_unique<const LinearFlow>(*chief_problem_, duration, per_revolution);
}

std::vector<double> CompanionFlow::chief(double time) const {
  return chief_ ? chief_->nominal(time) : nominal(time);
}

std::vector<double> CompanionFlow::chief_deviation(double time) const {
  std::vector<double> state = nominal(time);
  if (!chief_) return std::vector<double>(state.size(), 0.0);
  return state_difference(chief_->nominal(time), state);
}

FlownTogether::FlownTogether(const Scene& scene) : scene_(with_deputy_parameters(scene)) {
  if (!scene_.system.earth) return;
  chief_ = parameter_values(scene_.system);
  deputy_ = state_sum(chief_, deputy_parameters(scene_));
}

const SharedSystem& FlownTogether::system() const {
  if (!system_) system_ = make_system(scene_);
  return system_;
}

namespace {

std::vector<double> joined_state(std::vector<double> state, const std::vector<double>& more) {
  state.insert(state.end(), more.begin(), more.end());
  return state;
}

}  // namespace

std::vector<double> FlownTogether::of_chief(const std::vector<double>& state) const {
  return joined_state(state, chief_);
}

std::vector<double> FlownTogether::of_deputy(const std::vector<double>& state) const {
  return joined_state(state, deputy_);
}

}  // namespace hamjet
