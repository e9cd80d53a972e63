#include "encounter_trajectories.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

constexpr std::size_t most_looks = 200000;

double small_circle_period(double distance) {
  return 2 * std::numbers::pi * std::pow(distance, 1.5);
}

}  // namespace

WindowJets window_jets(const EncounterProblem& problem, std::size_t craft) {
  FlowProblem<double> flow{problem.system_of(craft), SeriesSpace::create(6, problem.order),
                           {0, 1, 2, 3, 4, 5},       problem.spacecraft[craft].state,
                           problem.start_time,       problem.from};
  if (const auto& straight = problem.spacecraft[craft].straight) {
    flow.initial_jet = straight->series(flow.space);
    for (std::size_t i = 0; i < 6; ++i) (*flow.initial_jet)[i][0] = flow.initial_state[i];
  }
  if (problem.from != 0) {
    IntegrationStatistics statistics;
    flow.initial_jet = integrate_gauss(flow, problem.settings, statistics);
    for (std::size_t i = 0; i < 6; ++i) flow.initial_state[i] = (*flow.initial_jet)[i][0];
    flow.start_time = problem.start_time + problem.from;
  }
  flow.duration = problem.to - problem.from;
  return std::make_shared<const JetTrajectory<double>>(flow, problem.settings);
}

EncounterTrajectories::EncounterTrajectories(const EncounterProblem& problem)
    : EncounterTrajectories(problem, {window_jets(problem, 0), window_jets(problem, 1)}) {}

EncounterTrajectories::EncounterTrajectories(const EncounterProblem& problem,
                                             std::array<WindowJets, 2> jets)
    : from_(problem.from), to_(problem.to), jets_(std::move(jets)) {
  for (std::size_t craft = 0; craft < 2; ++craft) {
    starts_[craft] = problem.spacecraft[craft].state;
    factors_[craft] = problem.spacecraft[craft].factor;
  }
}

FlowJet<double> EncounterTrajectories::jet(std::size_t craft, double time) const {
  return jets_[craft]->at(std::clamp(time - from_, 0.0, to_ - from_));
}

LinearRelativeState EncounterTrajectories::linear(
    const std::array<FlowJet<double>, 2>& jets) const {
  LinearRelativeState state;
  for (Eigen::Index i = 0; i < 6; ++i) {
    const auto c = static_cast<std::size_t>(i);
    state.mean[i] = jets[1][c][0] - jets[0][c][0];
  }
  state.by_deviation.leftCols(6) = -linear_part(jets[0]) * factors_[0];
  state.by_deviation.rightCols(6) = linear_part(jets[1]) * factors_[1];
  return state;
}

LinearRelativeState EncounterTrajectories::linear(double time) const {
  return linear(std::array<FlowJet<double>, 2>{jet(0, time), jet(1, time)});
}

Eigen::Matrix<double, 6, 1> EncounterTrajectories::relative_mean(double time) const {
  const FlowJet<double> first = jet(0, time);
  const FlowJet<double> second = jet(1, time);
  Eigen::Matrix<double, 6, 1> state;
  for (Eigen::Index i = 0; i < 6; ++i) {
    state[i] = second[static_cast<std::size_t>(i)][0] - first[static_cast<std::size_t>(i)][0];
  }
  return state;
}

double EncounterTrajectories::distance(double time) const {
  return relative_mean(time).head(3).norm();
}

double EncounterTrajectories::approach_rate(double time) const {
  const Eigen::Matrix<double, 6, 1> state = relative_mean(time);
  return state.head(3).dot(state.tail(3));
}

double EncounterTrajectories::approach_rate_slope(double time) const {
  // The relative acceleration by a difference over a small part of the orbit. Newton's method
  // divides by it; it is not a result.
  const double step = period(0) * 1e-6;
  return (approach_rate(time + step) - approach_rate(time - step)) / (2 * step);
}

double EncounterTrajectories::period(std::size_t craft) const {
  const std::vector<double>& r = starts_[craft];
  return small_circle_period(std::hypot(r[0], r[1], r[2]));
}

double EncounterTrajectories::local_period(std::size_t craft, double time) const {
  const FlowJet<double> now = jet(craft, time);
  return small_circle_period(std::hypot(now[0][0], now[1][0], now[2][0]));
}

double EncounterTrajectories::second_order(const std::array<FlowJet<double>, 2>& jets,
                                           double deviations) const {
  double sum = 0;
  for (std::size_t craft = 0; craft < 2; ++craft) {
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const Series<double>& component = jets[craft][c];
      const SeriesSpace& space = component.space();
      if (space.order() < 2) return 0;
      Eigen::Matrix<double, 6, 6> form = Eigen::Matrix<double, 6, 6>::Zero();
      for (std::size_t m = space.first(2); m < space.first(3); ++m) {
        const auto exponents = space.exponents(m);
        Eigen::Index i = 0;
        while (exponents[static_cast<std::size_t>(i)] == 0) ++i;
        Eigen::Index j = 5;
        while (exponents[static_cast<std::size_t>(j)] == 0) --j;
        form(i, j) += component[m] / 2;
        form(j, i) += component[m] / 2;
      }
      square += (factors_[craft].transpose() * form * factors_[craft]).squaredNorm();
    }
    sum += std::sqrt(square);
  }
  return sum * deviations * deviations;
}

std::vector<double> EncounterTrajectories::times_of_looks(double per_period, double fewest) const {
  const double span = to_ - from_;
  std::vector<double> times = {from_};
  while (times.back() < to_) {
    const double now = times.back();
    const double period = std::min(local_period(0, now), local_period(1, now));
    const double step = std::min(period / per_period, span / fewest);
    if (times.size() > most_looks) {
      throw Error(
          ErrorKind::too_large,
          fmt::format("encounter: the distance would be looked at more than {} times in the "
                      "window; a shorter window is needed",
                      most_looks));
    }
    // The last step takes the remainder too, so that it is never a sliver.
    const bool is_last = now + 1.5 * step > to_;
    times.push_back(is_last ? to_ : now + step);
  }
  return times;
}

}  // namespace hamjet
