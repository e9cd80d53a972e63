#include "impulse_program.hpp"

#include <cmath>

namespace hamjet {

std::vector<LinearProgram::Row> DirectedImpulses::rows(std::size_t times, bool is_limited) {
  constexpr std::size_t components = 6;
  std::vector<LinearProgram::Row> all(components);
  if (is_limited) all.resize(components + times, {0, 1});
  return all;
}

DirectedImpulses::DirectedImpulses(const std::vector<ImpulseEffect>& effects, const Vector6& change,
                                   double most)
    : effects_(effects),
      is_limited_(std::isfinite(most)),
      unit_(is_limited_ ? most : 1),
      program_(rows(effects.size(), is_limited_)) {
  LinearProgram::Column share{-1, 1 / unit_, {}};
  for (std::size_t i = 0; i < 6; ++i) {
    share.entries.push_back({i, -change[static_cast<Eigen::Index>(i)]});
  }
  program_.add({share});
  cost_ = 0;
  std::vector<ChosenImpulse> axes;
  for (std::size_t k = 0; k < effects.size(); ++k) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      axes.push_back({k, Eigen::Vector3d::Unit(i)});
      axes.push_back({k, -Eigen::Vector3d::Unit(i)});
    }
  }
  add(axes);
}

LinearProgram::Column DirectedImpulses::column(std::size_t time,
                                               const Eigen::Vector3d& direction) const {
  LinearProgram::Column column;
  column.cost = cost_;
  const Vector6 effect = effects_[time] * direction;
  for (std::size_t i = 0; i < 6; ++i) {
    column.entries.push_back({i, effect[static_cast<Eigen::Index>(i)]});
  }
  if (is_limited_) column.entries.push_back({6 + time, 1});
  return column;
}

void DirectedImpulses::add(const std::vector<ChosenImpulse>& unit_vectors) {
  std::vector<LinearProgram::Column> columns;
  for (const ChosenImpulse& one : unit_vectors) columns.push_back(column(one.time, one.change));
  program_.add(columns);
  directions_.insert(directions_.end(), unit_vectors.begin(), unit_vectors.end());
}

double DirectedImpulses::solve_share() {
  program_.solve();
  return program_.values()[0] * unit_;
}

void DirectedImpulses::solve_sum() {
  if (cost_ == 0) {
    cost_ = 1;
    std::vector<double> costs(1 + directions_.size(), cost_);
    costs[0] = 0;
    program_.set_costs(costs);
    program_.fix(0, 1 / unit_);
  }
  program_.solve();
}

DirectedImpulses::Vector6 DirectedImpulses::costate() const {
  return Eigen::Map<const Vector6>(program_.duals().data());
}

std::vector<ChosenImpulse> DirectedImpulses::impulses() const {
  std::vector<Eigen::Vector3d> changes(effects_.size(), Eigen::Vector3d::Zero());
  for (std::size_t j = 0; j < directions_.size(); ++j) {
    changes[directions_[j].time] += unit_ * program_.values()[1 + j] * directions_[j].change;
  }
  std::vector<ChosenImpulse> found;
  for (std::size_t k = 0; k < changes.size(); ++k) {
    if (!changes[k].isZero(0)) found.push_back({k, changes[k]});
  }
  return found;
}

bool DirectedImpulses::add_directions() {
  constexpr double worth = 1e-11;
  const Vector6 y = costate();
  const auto excess = [&](std::size_t k) {
    const double limit_price = is_limited_ ? program_.duals()[6 + k] : 0;
    return (effects_[k].transpose() * y).norm() - cost_ + limit_price;
  };
  std::vector<double> all;
  for (std::size_t k = 0; k < effects_.size(); ++k) all.push_back(excess(k));
  std::vector<ChosenImpulse> added;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!(all[k] > worth)) continue;
    // Without a limit of impulses, only the best of neighbouring times is added.
    const bool is_maximum =
        (k == 0 || all[k] >= all[k - 1]) && (k + 1 == all.size() || all[k] >= all[k + 1]);
    if (is_limited_ || is_maximum) added.push_back({k, (effects_[k].transpose() * y).normalized()});
  }
  add(added);
  return !added.empty();
}

}  // namespace hamjet
