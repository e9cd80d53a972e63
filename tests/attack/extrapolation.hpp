#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "force_models.hpp"

namespace hamjet::attack {

inline constexpr std::size_t most_degrees_of_freedom = 8;

/// The state along a line of initial states; positions and momenta are series.
template <class T, int N>
struct LineState {
  std::array<LineSeries<T, N>, most_degrees_of_freedom> q, p;
};

/// The largest coefficients of each degree, of positions and of momenta; see momentum_of_amplitude.
class GroupSizes {
 public:
  struct Pair {
    double position = 0;
    double momentum = 0;
  };

  explicit GroupSizes(double momentum_of_amplitude) : ratio_(momentum_of_amplitude) {}

  Pair of_degree(int k) const { return sizes_[static_cast<std::size_t>(k)]; }

  template <class T, int N>
  void include(const LineState<T, N>& state, std::size_t n) {
    for (int k = 0; k <= N; ++k) {
      auto& [position, momentum] = sizes_[static_cast<std::size_t>(k)];
      for (std::size_t i = 0; i < n; ++i) {
        position = std::max(position, magnitude(state.q[i][k]));
        momentum = std::max(momentum, magnitude(state.p[i][k]));
      }
      if (ratio_ == 0) continue;
      position = std::max(position, momentum / ratio_);
      momentum = position * ratio_;
    }
  }

 private:
  double ratio_;
  std::array<Pair, 16> sizes_{};
};

/// An accepted step: its length, and the number of rows of the tableau that it took.
template <class T>
struct AcceptedStep {
  T length{};
  int rows = 0;
};

/// Gragg's, Bulirsch's and Stoer's extrapolation for q'' = force(q) / m: velocity Verlet with
/// j = 1, 2, 3, ... substeps, whose error is a series in the square of the substep, extrapolated to
/// substep zero by Aitken and Neville. Order (the row of the tableau) and step adapt to the least
/// work. Every degree of the series is held to the tolerance, relative to the largest coefficient
/// of that degree so far, of positions and of momenta. Source: E. Hairer, S. P. Norsett and G.
/// Wanner, Solving Ordinary Differential Equations I, sections II.9 and II.14.
template <class T, int N>
class Extrapolation {
 public:
  using State = LineState<T, N>;

  Extrapolation(const Model& model, double tolerance)
      : model_(model),
        n_(model.degrees_of_freedom),
        tolerance_(tolerance),
        sizes_(momentum_of_amplitude(model)) {}

  /// Carries the state over the time and keeps the steps that the integration took. False if the
  /// solution could not be followed within the number of steps.
  bool run(State& state, const T& duration, long most_steps) {
    steps_.clear();
    sizes_ = GroupSizes(momentum_of_amplitude(model_));
    sizes_.include(state, n_);
    T time(0);
    const double direction = to_double(duration) < 0 ? -1 : 1;
    double length = first_length(state, std::abs(to_double(duration)));
    int target =
        std::clamp(static_cast<int>(-std::log10(tolerance_) * 0.5), least_rows, most_rows - 2);
    for (long tries = 0; tries < most_steps; ++tries) {
      const T rest = duration - time;
      const double span = std::abs(to_double(rest));
      if (span == 0) return true;
      const bool is_last = length >= span * (1 - 1e-12);
      // The end is reached by two steps of about the same length instead of a long and a tiny one.
      if (!is_last && length > 0.6 * span) length = 0.5 * span;
      const T step = is_last ? rest : T(direction * length);
      const Attempt attempt = try_step(state, step, target);
      if (!std::isfinite(attempt.next_length) || attempt.next_length <= 1e-14 * span) return false;
      if (attempt.rows > 0) {
        state = tableau_[0];
        sizes_.include(state, n_);
        steps_.push_back({step, attempt.rows});
        if (is_last) return true;
        time += step;
      }
      length = attempt.next_length;
      target = attempt.next_rows;
    }
    return false;
  }

  /// Repeats the same steps from another start without error control, so that the two results
  /// differ only by the change of the start. `change` is called with the number of the step before
  /// every step.
  void replay(State& state, const std::vector<AcceptedStep<T>>& steps,
              const std::function<void(std::size_t, State&)>& change) {
    for (std::size_t i = 0; i < steps.size(); ++i) {
      change(i, state);
      start_step(state);
      for (int j = 1; j <= steps[i].rows; ++j) add_row(state, steps[i].length, j);
      state = tableau_[0];
    }
  }

  const std::vector<AcceptedStep<T>>& steps() const { return steps_; }
  /// The largest coefficients along the run, at the ends of its steps.
  const GroupSizes& sizes() const { return sizes_; }
  long force_evaluations() const { return evaluations_; }

 private:
  static constexpr int least_rows = 5;  ///< smallest number of rows that is aimed at
  static constexpr int most_rows = 18;

  struct Attempt {
    int rows = 0;  ///< if 0, the step was rejected
    double next_length = 0;
    int next_rows = 0;
  };

  void force(const State& state, std::array<LineSeries<T, N>, most_degrees_of_freedom>& result) {
    ++evaluations_;
    force_of(model_, state.q.data(), result.data());
  }

  /// Roughly the time in which the state changes by its own size.
  double first_length(const State& state, double span) {
    std::array<LineSeries<T, N>, most_degrees_of_freedom> f;
    force(state, f);
    double q = 0, p = 0, slope = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      q = std::max(q, magnitude(state.q[i][0]));
      p = std::max(p, magnitude(state.p[i][0]));
      slope = std::max(slope, magnitude(f[i][0]));
    }
    double length = span;
    if (p > 0) length = std::min(length, 0.3 * model_.mass * q / p);
    if (slope > 0) length = std::min(length, 0.3 * std::sqrt(model_.mass * q / slope));
    return std::min(span, std::max(length, 1e-6 * span));
  }

  void start_step(const State& state) { force(state, start_force_); }

  /// Row j: velocity Verlet with j substeps, then the extrapolation of the rows so far; tableau_[i]
  /// is the element of the newest row that uses rows i + 1 to j.
  void add_row(const State& start, const T& length, int j) {
    State verlet = start;
    const T substep = length / T(j);
    const T half = substep * T(0.5);
    const T drift = substep / T(model_.mass);
    auto f = start_force_;
    for (int i = 0; i < j; ++i) {
      for (std::size_t c = 0; c < n_; ++c) {
        verlet.p[c] += (i == 0 ? half : substep) * f[c];
        verlet.q[c] += drift * verlet.p[c];
      }
      force(verlet, f);
    }
    for (std::size_t c = 0; c < n_; ++c) verlet.p[c] += half * f[c];
    tableau_[static_cast<std::size_t>(j - 1)] = verlet;
    for (int i = j - 1; i >= 1; --i) {
      const T weight = T(i) * T(i) / T(j * j - i * i);
      State& coarse = tableau_[static_cast<std::size_t>(i - 1)];
      const State& fine = tableau_[static_cast<std::size_t>(i)];
      for (std::size_t c = 0; c < n_; ++c) {
        const auto dq = fine.q[c] - coarse.q[c];
        const auto dp = fine.p[c] - coarse.p[c];
        coarse.q[c] = fine.q[c] + weight * dq;
        coarse.p[c] = fine.p[c] + weight * dp;
      }
    }
  }

  /// The last correction for each degree, relative to the largest coefficient, in units of the
  /// tolerance.
  double error() const {
    GroupSizes sizes = sizes_;
    sizes.include(tableau_[0], n_);
    double worst = 0;
    for (int k = 0; k <= N; ++k) {
      const auto [q_size, p_size] = sizes.of_degree(k);
      for (std::size_t c = 0; c < n_; ++c) {
        const double q = magnitude(tableau_[0].q[c][k] - tableau_[1].q[c][k]);
        const double p = magnitude(tableau_[0].p[c][k] - tableau_[1].p[c][k]);
        if (!std::isfinite(q) || !std::isfinite(p)) return HUGE_VAL;
        if (q_size > 0) worst = std::max(worst, q / q_size);
        if (p_size > 0) worst = std::max(worst, p / p_size);
      }
    }
    return worst / tolerance_;
  }

  /// The number of evaluations of the force for rows 1 to j.
  static double work(int j) { return 1 + 0.5 * j * (j + 1); }

  /// Adds rows about the target until the tolerance is met. Then the row and the step of the least
  /// work per unit of time are chosen, as by Hairer, Norsett and Wanner (II.9).
  Attempt try_step(const State& start, const T& step, int target) {
    start_step(start);
    const double length = std::abs(to_double(step));
    std::array<double, most_rows + 2> good_length{}, cost{};
    Attempt attempt;
    int row = 1;
    for (; row <= std::min(target + 1, most_rows); ++row) {
      const auto j = static_cast<std::size_t>(row);
      add_row(start, step, row);
      if (row < std::max(2, target - 2)) continue;
      const double e = std::max(error(), 1e-30);
      good_length[j] =
          length * std::clamp(0.94 * std::pow(0.65 / e, 1.0 / (2 * row - 1)), 0.02, 5.0);
      cost[j] = work(row) / good_length[j];
      if (row >= target - 1 && e <= 1) {
        attempt.rows = row;
        break;
      }
      // One further row reduces the error by about the square of its number.
      if (row == target && e > row * row) break;
    }
    const int last = std::min({row, target + 1, most_rows});
    const auto k = static_cast<std::size_t>(last);
    attempt.next_rows = std::max(last, least_rows);
    attempt.next_length = good_length[k];
    if (last > least_rows && cost[k - 1] > 0 && cost[k - 1] < 0.8 * cost[k]) {
      attempt.next_rows = last - 1;
      attempt.next_length = good_length[k - 1];
    } else if (attempt.rows > 0 && last < most_rows - 1 && cost[k - 1] > 0 &&
               cost[k] < 0.9 * cost[k - 1]) {
      attempt.next_rows = last + 1;
      attempt.next_length = good_length[k] * work(last + 1) / work(last);
    }
    if (attempt.rows == 0) {
      // At the start, a coefficient of high degree is such a high power of the time that few rows
      // do not notice it, however short the step is.
      attempt.next_rows = std::min(last + 1, most_rows - 1);
      attempt.next_length = std::min(attempt.next_length, 0.7 * length);
    }
    return attempt;
  }

  const Model& model_;
  std::size_t n_;
  double tolerance_;
  std::vector<AcceptedStep<T>> steps_;
  GroupSizes sizes_;
  long evaluations_ = 0;
  std::array<LineSeries<T, N>, most_degrees_of_freedom> start_force_;
  std::array<State, most_rows + 1> tableau_;
};

}  // namespace hamjet::attack
