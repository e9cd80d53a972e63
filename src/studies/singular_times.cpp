#include "hamjet/detail/studies/singular_times.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <span>
#include <type_traits>

#include "../algebra/scalar_search.hpp"
#include "../algebra/smallest_singular_value.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

using StateTransition = LinearFlow::StateTransition;

/// The smallest singular value of a block, with the determinant's sign.
double signed_smallest(const Matrix<double>& block) {
  const Eigen::JacobiSVD<Matrix<double>> decomposition(block,
                                                       Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = decomposition.matrixU().determinant() * decomposition.matrixV().determinant();
  return std::copysign(decomposition.singularValues()[block.rows() - 1], sign);
}

/// The function whose zeros are the singular times of a kind, see find_singular_times.
class WatchedValue {
 public:
  explicit WatchedValue(const GeneratingFunctionKind& kind) : kind_(kind) {
    for (std::size_t i = 0; i < kind.degrees_of_freedom(); ++i) {
      rows_.push_back(static_cast<Eigen::Index>(kind.final_variable(i)));
      columns_.push_back(static_cast<Eigen::Index>(kind.initial_variable(i, false)));
    }
  }

  /// Throws Error(numerical) if the flow's matrix is not finite.
  double operator()(const StateTransition& flow) const {
    const double size = flow.norm();
    if (!std::isfinite(size)) {
      throw Error(ErrorKind::numerical, "singular times: the flow's matrix is not finite");
    }
    if (rows_.size() != 3) return signed_smallest(inverted_block(flow, kind_)) / size;
    Eigen::Matrix3d block;
    for (Eigen::Index i = 0; i < 3; ++i) {
      for (Eigen::Index j = 0; j < 3; ++j) {
        block(i, j) =
            flow(rows_[static_cast<std::size_t>(i)], columns_[static_cast<std::size_t>(j)]);
      }
    }
    return signed_smallest_singular_value(block) / size;
  }

 private:
  const GeneratingFunctionKind& kind_;
  std::vector<Eigen::Index> rows_;
  std::vector<Eigen::Index> columns_;
};

/// The watched value that rounding leaves at a zero, at a time where the flow's matrix is
/// `flow`. An ulp in the matrix M_s of each checkpoint, carried to that time by M M_s^-1, adds up
/// to
///
///   u sqrt( sum over s of |M M_s^-1|^2 |M_s|^2 ) / |M| ,
///
/// summed over no more than some sixty of them. M^-1 = -J M^T J of a symplectic matrix.
double rounding_of_zero(const LinearFlow& whole, double time, const StateTransition& flow) {
  constexpr std::size_t most_summed = 64;
  const std::size_t before = whole.checkpoint_before(time) + 1;
  const std::size_t stride = before / most_summed + 1;
  // M M_s^-1 and M J M_s^T have the same norm, because J only exchanges rows and changes signs.
  const StateTransition turned =
      symplectic_unit_times(StateTransition(flow.transpose())).transpose();
  const auto add_all = [&](const auto& fixed) {
    using Fixed = std::remove_cvref_t<decltype(fixed)>;
    const Fixed from = turned;
    double sum = flow.squaredNorm();
    for (std::size_t s = stride; s < before; s += stride) {
      const Eigen::Map<const Fixed> matrix(whole.checkpoint(s).data(), flow.rows(), flow.cols());
      const Fixed carried = from * matrix.transpose();
      sum += static_cast<double>(stride) * carried.squaredNorm() * matrix.squaredNorm();
    }
    return sum;
  };
  const double sum =
      flow.rows() == 6 ? add_all(Eigen::Matrix<double, 6, 6>()) : add_all(StateTransition());
  return std::numeric_limits<double>::epsilon() * std::sqrt(sum) / flow.norm();
}

/// Searches the zeros of one kind's watched value.
class ZeroSearch {
 public:
  ZeroSearch(const LinearFlow& flow, const GeneratingFunctionKind& kind)
      : flow_(flow), kind_(kind), watched_value_(kind) {
    // At the start every block is trivially singular or the identity, so that the search begins
    // after it.
    for (std::size_t i = 1; i < flow.times().size(); ++i) {
      times_.push_back(flow.times()[i]);
      ratios_.push_back(watched_value_(flow.checkpoint(i)));
    }
    for (const std::size_t parts : {std::size_t{8}, std::size_t{4}}) divide(parts);
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

  /// Whether the line through the points `from` and `to` reaches zero within one further step.
  bool leads_to_zero(std::size_t from, std::size_t to) const {
    return (2 * ratios_[to] - ratios_[from]) * ratios_[to] < 0;
  }

  /// Divides the intervals about a change of sign or a minimum, because several zeros may lie close
  /// together.
  void divide(std::size_t parts) {
    std::vector<bool> is_divided(ratios_.size(),
                                 false);  // whether to divide the interval after each point
    for (std::size_t i = 0; i + 1 < ratios_.size(); ++i) {
      // A zero may also lie where the trend from either side reaches zero before the next point.
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

  /// Merges two zeros that rounding cannot distinguish into one, at their middle.
  void merge() {
    std::vector<SingularTime> merged;
    for (SingularTime& zero : found_) {
      if (!merged.empty()) {
        SingularTime& last = merged.back();
        if (std::abs(zero.time - last.time) <= last.resolution + zero.resolution) {
          last = singular_time(0.5 * (last.time + zero.time));
          continue;
        }
      }
      merged.push_back(std::move(zero));
    }
    found_ = std::move(merged);
  }

  double ratio_at(double t) const { return watched_value_(flow_.at(t)); }

  /// SingularTime::resolution: it is doubled until the function differs from zero on both sides.
  double resolution_at(double t, double rounding) const {
    const double longest = std::abs(times_.back()) / static_cast<double>(times_.size());
    double half_width = 16 * std::numeric_limits<double>::epsilon() * std::abs(t);
    while (half_width < longest && std::min(std::abs(ratio_at(t - half_width)),
                                            std::abs(ratio_at(t + half_width))) <= rounding) {
      half_width *= 2;
    }
    return half_width;
  }

  bool is_minimum(std::size_t i) const {
    const double here = ratios_[i];
    const bool same_sign = here * ratios_[i - 1] > 0 && here * ratios_[i + 1] > 0;
    return same_sign && std::abs(here) <= std::abs(ratios_[i - 1]) &&
           std::abs(here) < std::abs(ratios_[i + 1]) && may_reach_zero(i);
  }

  /// The lines through the two points on either side bound a convex function from below. If they
  /// meet well above zero, so does the function, unless the point itself is the zero. A factor of
  /// two allows for deviations from convexity.
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

  /// Golden sections of the magnitude, until the function changes sign, which shows a pair of
  /// zeros, or the interval is exhausted.
  void search_minimum(std::size_t i) {
    const double golden = 0.5 * (3 - std::sqrt(5.0));
    const double sign = ratios_[i] > 0 ? 1 : -1;
    double left = time(i - 1);
    double right = time(i + 1);
    double middle = time(i);
    double lowest = sign * ratios_[i];
    const double resolution = 4 * std::numeric_limits<double>::epsilon() * std::abs(times_.back());
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
    // Beside a zero that the function crosses with a slope, the rounding of the time shows on both
    // sides.
    const double slope = std::max(std::abs(ratios_[i - 1] / (middle - time(i - 1))),
                                  std::abs(ratios_[i + 1] / (time(i + 1) - middle)));
    if (lowest <= rounding_of_zero(flow_, middle, flow_.at(middle)) + resolution * slope)
      add(middle);
  }

  void add_zero(double from, double to) {
    const double value_from = ratio_at(from);
    const double value_to = ratio_at(to);
    add(root_between(
        "singular times", [&](double t) { return ratio_at(t); }, {from, value_from}, {to, value_to},
        51));
  }

  SingularTime singular_time(double t) const {
    const StateTransition matrix = flow_.at(t);
    const Matrix<double> block = inverted_block(matrix, kind_);
    const Eigen::JacobiSVD<Matrix<double>> decomposition(block, Eigen::ComputeThinU);
    const auto& values = decomposition.singularValues();
    const Eigen::Index last = values.size() - 1;
    SingularTime zero{kind_, t};
    const double rounding = rounding_of_zero(flow_, t, matrix);
    zero.resolution = resolution_at(t, rounding);
    // A double zero is found where the smaller value vanishes, slightly beside the zero of the
    // larger one.
    constexpr double roundings = 4;
    zero.directions_lost = std::max(
        1, static_cast<int>((values.array() <= roundings * rounding * matrix.norm()).count()));
    // With one degree of freedom the block's own size is no scale; the flow's size replaces it.
    const double largest = last > 0 ? values[0] : matrix.norm();
    zero.smallest_ratio = values[last] / largest;
    zero.second_ratio = last > 0 ? values[last - 1] / largest : 0;
    zero.direction = decomposition.matrixU().col(last);
    return zero;
  }

  void add(double t) { found_.push_back(singular_time(t)); }

  const LinearFlow& flow_;
  const GeneratingFunctionKind& kind_;
  WatchedValue watched_value_;
  std::vector<double> times_;   ///< checkpoints after the start, and points between
  std::vector<double> ratios_;  ///< watched values at these times
  std::vector<SingularTime> found_;
};

}  // namespace

Matrix<double> inverted_block(const LinearFlow::StateTransition& flow,
                              const GeneratingFunctionKind& kind) {
  const std::size_t n = kind.degrees_of_freedom();
  Matrix<double> block(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
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

TimesWithoutKind times_without_kind(const ComputedProblem& problem, double duration,
                                    const GeneratingFunctionKind& kind,
                                    const std::function<void(double)>& progress) {
  TimesWithoutKind result;
  try {
    const LinearFlow flow(problem, duration, checkpoints_per_revolution, progress);
    for (const SingularTime& zero : find_singular_times(flow, kind)) {
      result.times.push_back(zero.time);
    }
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical && error.kind() != ErrorKind::too_large) throw;
    result.not_searched = error.what();
  }
  return result;
}

}  // namespace hamjet
