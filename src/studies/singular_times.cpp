#include "hamjet/studies/singular_times.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>

#include "exact_flow.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"

namespace hamjet {
namespace {

using StateTransition = LinearFlow::StateTransition;

/// A linear flow from a state, and the state that it reaches.
struct LinearArc {
  std::vector<double> state;
  StateTransition matrix;
};

LinearArc linear_arc(const DynamicalSystem& system, const SpacePointer& space,
                     const std::vector<double>& start, double duration) {
  const FlowProblem<double> flow{&system, space, {0, 1, 2, 3, 4, 5}, start, duration};
  GaussSettings settings;
  settings.tolerance = 1e-14;
  IntegrationStatistics statistics;
  const FlowJet<double> jet = integrate_gauss<double>(flow, settings, statistics);
  return {nominal_of(jet), linear_part(std::span<const Series<double>>(jet))};
}

/// The smallest singular value over the largest, with the determinant's sign.
double signed_ratio(const Eigen::Matrix3d& block) {
  const Eigen::Vector3d values = Eigen::JacobiSVD<Eigen::Matrix3d>(block).singularValues();
  return std::copysign(values[2] / values[0], block.determinant());
}

/// Looks for the zeros of one kind's signed ratio.
class ZeroSearch {
 public:
  ZeroSearch(const LinearFlow& flow, const GeneratingFunctionKind& kind)
      : flow_(flow), kind_(kind) {
    // At the start every block is trivially singular or the identity.
    for (std::size_t i = 1; i < flow.times().size(); ++i) {
      times_.push_back(flow.times()[i]);
      ratios_.push_back(signed_ratio(inverted_block(flow.checkpoint(i), kind)));
    }
    for (const std::size_t parts : {8, 4}) divide(parts);
  }

  std::vector<SingularTime> run() {
    for (std::size_t i = 0; i < ratios_.size(); ++i) {
      if (ratios_[i] == 0) {
        add(times_[i]);
      } else if (i + 1 < ratios_.size() && ratios_[i] * ratios_[i + 1] < 0) {
        add_zero(time(i), time(i + 1));
      }
      if (i > 0 && i + 1 < ratios_.size() && is_minimum(i)) search_minimum(i);
    }
    std::sort(found_.begin(), found_.end(),
              [](const auto& a, const auto& b) { return std::abs(a.time) < std::abs(b.time); });
    merge();
    return std::move(found_);
  }

 private:
  double time(std::size_t i) const { return times_[i]; }

  /// Whether the line through a point and the next one is beyond zero at the one after.
  bool leads_to_zero(std::size_t from, std::size_t to) const {
    return (2 * ratios_[to] - ratios_[from]) * ratios_[to] < 0;
  }

  /// Divides the intervals about a change of sign or a minimum: several zeros may lie close.
  void divide(std::size_t parts) {
    std::vector<bool> is_divided(ratios_.size(), false);  // the interval behind each point
    for (std::size_t i = 0; i + 1 < ratios_.size(); ++i) {
      // Or where the trend of either side leads to zero before the next point.
      const bool has_zero = ratios_[i] * ratios_[i + 1] < 0 || (i > 0 && leads_to_zero(i - 1, i)) ||
                            (i + 2 < ratios_.size() && leads_to_zero(i + 2, i + 1));
      if (!has_zero && !(i > 0 && is_minimum(i))) continue;
      if (i > 0) is_divided[i - 1] = true;
      is_divided[i] = true;
      if (has_zero && i + 2 < ratios_.size()) is_divided[i + 1] = true;
    }
    std::vector<double> times;
    std::vector<double> ratios;
    for (std::size_t i = 0; i < ratios_.size(); ++i) {
      times.push_back(times_[i]);
      ratios.push_back(ratios_[i]);
      for (std::size_t k = 1; is_divided[i] && k < parts; ++k) {
        const double part = static_cast<double>(k) / static_cast<double>(parts);
        times.push_back(times_[i] + part * (times_[i + 1] - times_[i]));
        ratios.push_back(ratio_at(times.back()));
      }
    }
    times_ = std::move(times);
    ratios_ = std::move(ratios);
  }

  /// Two zeros nearer than the square root of round-off are one double zero, or one seen twice.
  void merge() {
    constexpr double nearest = 1e-6;
    std::vector<SingularTime> merged;
    for (SingularTime& zero : found_) {
      if (!merged.empty()) {
        SingularTime& last = merged.back();
        if (std::abs(zero.time - last.time) < nearest * std::max(1.0, std::abs(zero.time))) {
          last.time = 0.5 * (last.time + zero.time);
          continue;
        }
      }
      merged.push_back(std::move(zero));
    }
    found_ = std::move(merged);
  }

  double ratio_at(double t) const { return signed_ratio(inverted_block(flow_.at(t), kind_)); }

  bool is_minimum(std::size_t i) const {
    const double here = ratios_[i];
    const bool same_sign = here * ratios_[i - 1] > 0 && here * ratios_[i + 1] > 0;
    return same_sign && std::abs(here) <= std::abs(ratios_[i - 1]) &&
           std::abs(here) < std::abs(ratios_[i + 1]) && may_reach_zero(i);
  }

  /// The lines through the two points on either side bound a convex function from below: where they
  /// meet well above zero, so does it, unless the point is the zero. A factor of two stands for
  /// what is not convex.
  bool may_reach_zero(std::size_t i) const {
    if (i < 2 || i + 2 >= ratios_.size()) return true;
    const auto size = [&](std::size_t k) { return std::abs(ratios_[k]); };
    const auto distance = [&](std::size_t k, std::size_t l) {
      return std::abs(times_[l] - times_[k]);
    };
    const double fall_left = (size(i - 2) - size(i - 1)) / distance(i - 2, i - 1);
    const double fall_right = (size(i + 2) - size(i + 1)) / distance(i + 1, i + 2);
    if (!(fall_left > 0) || !(fall_right > 0)) return true;
    const double meeting = (size(i - 1) - size(i + 1) + fall_right * distance(i - 1, i + 1)) /
                           (fall_left + fall_right);
    return size(i - 1) - fall_left * meeting < 0.5 * size(i) ||
           size(i) < 0.25 * std::min(size(i - 1), size(i + 1));
  }

  /// Golden sections of the magnitude until it changes sign, which shows a pair of zeros, or has
  /// nowhere to go.
  void search_minimum(std::size_t i) {
    const double golden = 0.5 * (3 - std::sqrt(5.0));
    const double sign = ratios_[i] > 0 ? 1 : -1;
    double left = time(i - 1);
    double right = time(i + 1);
    double middle = time(i);
    double lowest = sign * ratios_[i];
    const double resolution = 1e-13 * std::abs(times_.back());
    while (std::abs(right - left) > resolution) {
      const bool is_right_longer = std::abs(right - middle) > std::abs(middle - left);
      const double trial = middle + golden * ((is_right_longer ? right : left) - middle);
      const double value = sign * ratio_at(trial);
      if (value < 0) {
        add_zero(time(i - 1), trial);
        add_zero(trial, time(i + 1));
        return;
      }
      if (value < lowest) {
        (is_right_longer ? left : right) = middle;
        middle = trial;
        lowest = value;
      } else {
        (is_right_longer ? right : left) = trial;
      }
    }
    if (lowest < double_zero) add(middle);
  }

  void add_zero(double from, double to) {
    const double value_from = ratio_at(from);
    const double value_to = ratio_at(to);
    if (value_from == 0) return add(from);
    if (value_to == 0) return add(to);
    std::uintmax_t most_iterations = 100;
    const auto bracket = boost::math::tools::toms748_solve(
        [&](double t) { return ratio_at(t); }, std::min(from, to), std::max(from, to),
        from < to ? value_from : value_to, from < to ? value_to : value_from,
        boost::math::tools::eps_tolerance<double>(51), most_iterations);
    add(0.5 * (bracket.first + bracket.second));
  }

  /// Along R, T, N at a time, if there is an orbital plane.
  std::optional<Eigen::Vector3d> along_rtn(double t, const Eigen::Vector3d& direction) const {
    try {
      const ChiefFrame frame(flow_.chief(t), MetricUnits{}, RelativeFrame::rtn_inertial);
      return frame.along_axes(direction);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      return std::nullopt;
    }
  }

  void add(double t) {
    const Eigen::Matrix3d block = inverted_block(flow_.at(t), kind_);
    const Eigen::JacobiSVD<Eigen::Matrix3d> decomposition(block, Eigen::ComputeFullU);
    const Eigen::Vector3d& values = decomposition.singularValues();
    const Eigen::Vector3d direction = decomposition.matrixU().col(2);
    found_.push_back({kind_, t, values[2] / values[0], values[1] / values[0], direction,
                      along_rtn(t, direction)});
  }

  const LinearFlow& flow_;
  const GeneratingFunctionKind& kind_;
  std::vector<double> times_;   ///< of the checkpoints, the start left out, and between
  std::vector<double> ratios_;  ///< then
  std::vector<SingularTime> found_;
};

}  // namespace

LinearFlow::LinearFlow(const ComputedProblem& problem, double duration, double per_revolution,
                       const std::function<void(double)>& progress)
    : problem_(&problem), space_(SeriesSpace::create(6, 1)) {
  constexpr std::size_t most_checkpoints = 100000;
  if (problem.system.dimension() != 6 || !(per_revolution > 0)) {
    throw Error(ErrorKind::usage, "linear flow: an orbit and a number of checkpoints are needed");
  }
  times_.push_back(0);
  states_.push_back(problem.nominal);
  matrices_.push_back(StateTransition::Identity());
  while (times_.back() != duration) {
    const std::vector<double>& q = states_.back();
    const double r = std::hypot(q[0], q[1], q[2]);
    const double step = 2 * std::numbers::pi * std::pow(r, 1.5) / per_revolution;
    const double left = std::abs(duration - times_.back());
    const double time =
        left <= 1.01 * step ? duration : times_.back() + std::copysign(step, duration);
    LinearArc arc = linear_arc(problem.system, space_, q, time - times_.back());
    matrices_.push_back(arc.matrix * matrices_.back());
    states_.push_back(std::move(arc.state));
    times_.push_back(time);
    if (times_.size() > most_checkpoints) {
      throw Error(ErrorKind::too_large,
                  fmt::format("singular times: the span takes more than {} checkpoints, some {} "
                              "revolutions; a shorter one is needed",
                              most_checkpoints,
                              std::lround(static_cast<double>(most_checkpoints) / per_revolution)));
    }
    if (progress) progress(time / duration);
  }
}

std::size_t LinearFlow::checkpoint_before(double time) const {
  const auto behind = std::upper_bound(times_.begin(), times_.end(), time, [](double a, double b) {
    return std::abs(a) < std::abs(b);
  });
  return behind == times_.begin() ? 0 : static_cast<std::size_t>(behind - times_.begin()) - 1;
}

std::vector<double> LinearFlow::chief(double time) const {
  const std::size_t before = checkpoint_before(time);
  return exact_flow(problem_->system, states_[before], time - times_[before]);
}

LinearFlow::StateTransition LinearFlow::at(double time) const {
  const std::size_t before = checkpoint_before(time);
  if (time == times_[before]) return matrices_[before];
  return linear_arc(problem_->system, space_, states_[before], time - times_[before]).matrix *
         matrices_[before];
}

Eigen::Matrix3d inverted_block(const LinearFlow::StateTransition& flow,
                               const GeneratingFunctionKind& kind) {
  Eigen::Matrix3d block;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      block(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          flow(static_cast<Eigen::Index>(kind.final_variable(i)),
               static_cast<Eigen::Index>(kind.initial_variable(j, false)));
    }
  }
  return block;
}

std::vector<SingularTime> find_singular_times(const LinearFlow& flow,
                                              const GeneratingFunctionKind& kind) {
  return ZeroSearch(flow, kind).run();
}

}  // namespace hamjet
