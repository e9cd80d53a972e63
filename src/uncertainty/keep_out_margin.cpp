#include "hamjet/uncertainty/keep_out_margin.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "../algebra/scalar_search.hpp"
#include "encounter_flows.hpp"
#include "encounter_trajectories.hpp"
#include "hamjet/algebra/calculus.hpp"
#include "hamjet/error.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"

namespace hamjet {
namespace {

using Position = Eigen::Vector3d;
using Jacobian = Eigen::Matrix<double, 3, 12>;

/// The number of the lowest minima of the linear theory's length that the polynomials follow.
constexpr std::size_t most_minima = 6;
constexpr int most_iterations = 60;
/// The number of looks at an expansion in time, which reaches a part of a revolution.
constexpr std::size_t looks_in_expansion = 16;
constexpr double never = std::numeric_limits<double>::infinity();

/// The shortest xi with |a + M xi| <= 1; no value if there is none. With M = U S V^T and b = U^T a,
/// the solution for the multiplier l is V eta with eta_i = -l s_i b_i / (1 + l s_i^2), where
///
///   sum b_i^2 / (1 + l s_i^2)^2 = 1 .
std::optional<EncounterDeviation> shortest(const Position& a, const Jacobian& m) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> parts(m, Eigen::ComputeThinU | Eigen::ComputeThinV);
  if (parts.info() != Eigen::Success || !a.allFinite()) {
    throw Error(ErrorKind::numerical, "keep-out: the relative position is not finite");
  }
  const Eigen::VectorXd s = parts.singularValues();
  const Eigen::VectorXd b = parts.matrixU().transpose() * a;
  const auto excess = [&](double l) {
    double sum = -1;
    for (Eigen::Index i = 0; i < 3; ++i) sum += std::pow(b[i] / (1 + l * s[i] * s[i]), 2);
    return sum;
  };
  if (excess(0) <= 0) return EncounterDeviation(EncounterDeviation::Zero());
  // Directions whose singular value is below the rounding of the others cannot be used.
  const double least = 1e-13 * s[0];
  double rest = 0;
  for (Eigen::Index i = 0; i < 3; ++i) rest += s[i] > least ? 0 : b[i] * b[i];
  if (rest >= 1 || s[0] == 0) return std::nullopt;
  double low = 0;
  double high = 1 / (s[0] * s[0]);
  while (excess(high) > 0 && std::isfinite(high)) {
    low = high;
    high *= 4;
  }
  if (!std::isfinite(high)) return std::nullopt;
  constexpr int bits = 50;
  const double l = root_between("keep-out", excess, {low, excess(low)}, {high, excess(high)}, bits);
  Eigen::VectorXd eta(3);
  for (Eigen::Index i = 0; i < 3; ++i) eta[i] = -l * s[i] * b[i] / (1 + l * s[i] * s[i]);
  return EncounterDeviation(parts.matrixV() * eta);
}

/// The relative position in units of the ellipsoid's semi-axes, and its derivatives by the twelve
/// numbers.
struct Measured {
  Position position;
  Jacobian slope;
};

class Ellipsoid {
 public:
  Ellipsoid(const EncounterProblem& problem, const Eigen::Vector3d& semi_axes)
      : problem_(&problem), semi_axes_(semi_axes), trajectories_(problem) {}

  /// The matrix from inertial axes into this measure, for the axes of the first spacecraft's mean.
  Eigen::Matrix3d measure(std::span<const double> state) const {
    const ChiefFrame frame(state, {}, RelativeFrame::rtn_inertial);
    Eigen::Matrix3d result;
    for (Eigen::Index i = 0; i < 3; ++i) {
      result.col(i) = frame.along_axes(Eigen::Vector3d::Unit(i)).cwiseQuotient(semi_axes_);
    }
    return result;
  }

  /// The length of the shortest vector at one time. The iteration starts at `xi`, from a time
  /// nearby, and leaves the vector there. Infinity where no vector leads to the ellipsoid. Throws
  /// where the iteration does not settle.
  double length_at(double time, EncounterDeviation& xi) const {
    const std::array<FlowJet<double>, 2> jets = {trajectories_.jet(0, time),
                                                 trajectories_.jet(1, time)};
    for (int k = 0; k < most_iterations; ++k) {
      const Measured now = measured(jets, xi);
      const auto next = shortest(now.position - now.slope * xi, now.slope);
      if (!next) return never;
      const double step = (*next - xi).norm();
      // Half steps after the first ones damp oscillations about the answer.
      xi += (k < 20 ? 1.0 : 0.5) * (*next - xi);
      if (step <= 1e-9 * (1 + xi.norm())) return xi.norm();
      if (!std::isfinite(step)) break;
    }
    throw Error(ErrorKind::numerical,
                "keep-out: the shortest deviation into the ellipsoid was not found, the motion "
                "bends too much within it");
  }

  double linear_length(const EncounterTrajectories& linear, double time) const {
    const FlowJet<double> chief = linear.jet(0, time);
    std::vector<double> state;
    for (const Series<double>& component : chief) state.push_back(component[0]);
    const Eigen::Matrix3d to = measure(state);
    const LinearRelativeState relative = linear.linear(time);
    const auto xi = shortest(to * relative.mean.head(3), to * relative.by_deviation.topRows(3));
    return xi ? xi->norm() : never;
  }

  /// The least ratio of a flight with the full equations, looked at along its own expansions in
  /// time.
  double least_flown_ratio(const EncounterDeviation& xi) const {
    EncounterFlows flows(*problem_);
    // The last is the mean of the first spacecraft, along whose axes the ellipsoid lies.
    constexpr std::array<std::size_t, 3> craft_of = {0, 1, 0};
    std::vector<double> states;
    for (std::size_t lane = 0; lane < craft_of.size(); ++lane) {
      const std::size_t craft = craft_of[lane];
      const UncertainSpacecraft& flown = problem_->spacecraft[craft];
      std::vector<double> state = flown.state;
      if (lane < 2) {
        const auto start = flown.deviated(xi.segment<6>(static_cast<Eigen::Index>(6 * craft)));
        state.assign(start.begin(), start.end());
      }
      const std::array<double, 1> from = {problem_->from};
      if (from[0] != 0) flows.advance(craft, state, problem_->start_time, from);
      states.insert(states.end(), state.begin(), state.end());
    }
    double least = never;
    double left = problem_->to - problem_->from;
    while (left > 0) {
      for (std::size_t lane = 0; lane < TaylorFlow::lanes; ++lane) {
        flows.set_state(lane, problem_->start_time + (problem_->to - left),
                        std::span<const double>(states).subspan(6 * (lane % 3), 6));
      }
      flows.expand();
      const double step = std::min({flows.reach(0, 0), flows.reach(1, 1), flows.reach(0, 2), left});
      const bool is_long = step > 1e-9 * (problem_->to - problem_->from);
      if (!(is_long || flows.ends_at_break(0, 0, step))) {
        throw Error(ErrorKind::numerical,
                    "keep-out: the flight with the told deviation ended in the centre");
      }
      const auto evaluate_at = [&](double time) {
        for (std::size_t lane = 0; lane < 3; ++lane) {
          flows.evaluate(craft_of[lane], lane, time, std::span(states).subspan(6 * lane, 6));
        }
      };
      const auto ratio_at = [&](double time) {
        evaluate_at(time);
        const Eigen::Map<const Eigen::Matrix<double, 6, 3>> flown(states.data());
        const double ratio = (measure(std::span<const double>(states).last(6)) *
                              (flown.col(1) - flown.col(0)).head<3>())
                                 .norm();
        least = std::min(least, ratio);
        return ratio;
      };
      std::array<double, looks_in_expansion + 1> ratios{};
      const auto time_of = [&](std::size_t look) {
        return step * static_cast<double>(look) / static_cast<double>(looks_in_expansion);
      };
      for (std::size_t k = 0; k < ratios.size(); ++k) ratios[k] = ratio_at(time_of(k));
      for (std::size_t k = 0; k < ratios.size(); ++k) {
        const std::size_t before = k == 0 ? 0 : k - 1;
        const std::size_t after = std::min(k + 1, ratios.size() - 1);
        if (ratios[k] > ratios[before] || ratios[k] > ratios[after]) continue;
        // The ratio is flat at its minimum.
        constexpr int bits = 20;
        minimum_between("keep-out", ratio_at, time_of(before), time_of(after), bits);
      }
      evaluate_at(step);
      left = step == left ? 0 : left - step;
    }
    return least;
  }

 private:
  Measured measured(const std::array<FlowJet<double>, 2>& jets,
                    const EncounterDeviation& xi) const {
    std::array<Position, 2> positions;
    Jacobian slope;
    std::vector<double> mean;
    for (const Series<double>& component : jets[0]) mean.push_back(component[0]);
    for (std::size_t craft = 0; craft < 2; ++craft) {
      const auto first = static_cast<Eigen::Index>(6 * craft);
      const Eigen::Matrix<double, 6, 1> x =
          problem_->spacecraft[craft].factor * xi.segment<6>(first);
      const std::span<const double> point(x.data(), 6);
      Eigen::Matrix<double, 3, 6> by_state;
      for (std::size_t row = 0; row < 3; ++row) {
        const auto r = static_cast<Eigen::Index>(row);
        positions[craft][r] = evaluate(jets[craft][row], point);
        for (std::size_t i = 0; i < 6; ++i) {
          by_state(r, static_cast<Eigen::Index>(i)) =
              evaluate(derivative(jets[craft][row], i), point);
        }
      }
      slope.middleCols(first, 6) =
          (craft == 0 ? -1 : 1) * by_state * problem_->spacecraft[craft].factor;
    }
    const Eigen::Matrix3d to = measure(mean);
    return {to * (positions[1] - positions[0]), to * slope};
  }

  const EncounterProblem* problem_;
  Eigen::Vector3d semi_axes_;
  EncounterTrajectories trajectories_;
};

struct Candidate {
  double length;
  double from;
  double time;
  double to;
};

/// Local minima of the linear theory's length, the lowest first.
std::vector<Candidate> linear_minima(const EncounterProblem& problem, const Ellipsoid& ellipsoid) {
  EncounterProblem first_order = problem;
  first_order.order = 1;
  const EncounterTrajectories linear(first_order);
  const std::vector<double> times = linear.times_of_looks();
  std::vector<double> lengths;
  for (const double time : times) lengths.push_back(ellipsoid.linear_length(linear, time));
  std::vector<Candidate> minima;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const std::size_t before = k == 0 ? 0 : k - 1;
    const std::size_t after = std::min(k + 1, times.size() - 1);
    const bool is_least = lengths[k] <= lengths[before] && lengths[k] <= lengths[after];
    if (!is_least || lengths[k] == never) continue;
    // Paths may cross the ellipsoid between two looks, so that the minima are compared by their own
    // values, not by those of the nearest looks.
    Candidate minimum{lengths[k], times[before], times[k], times[after]};
    // The time of a minimum is found to a thousandth of the time between two looks; the values are
    // finite, because parabolas go through them.
    constexpr int bits = 11;
    const double large = 10 * (1 + minimum.length);
    minimum_between(
        "keep-out",
        [&](double share) {
          const double time = minimum.from + share * (minimum.to - minimum.from);
          const double length = ellipsoid.linear_length(linear, time);
          if (length < minimum.length) {
            minimum.length = length;
            minimum.time = time;
          }
          return std::min(length, large);
        },
        0, 1, bits);
    minima.push_back(minimum);
  }
  std::sort(minima.begin(), minima.end(),
            [](const Candidate& a, const Candidate& b) { return a.length < b.length; });
  if (minima.size() > most_minima) minima.resize(most_minima);
  return minima;
}

/// The margin at the minimum of the length over the interval of one candidate.
KeepOutMargin followed(const Ellipsoid& ellipsoid, const Candidate& candidate) {
  KeepOutMargin margin;
  EncounterDeviation xi = EncounterDeviation::Zero();
  const auto look = [&](double time) {
    const double length = ellipsoid.length_at(time, xi);
    if (!margin.deviations || length < *margin.deviations) {
      margin.deviations = length;
      margin.time = time;
      margin.deviation = xi;
    }
    return length;
  };
  look(candidate.time);
  look(candidate.from);
  look(candidate.to);
  xi = margin.deviation;
  // The length is flat at its minimum: half of the digits of the time suffice.
  constexpr int bits = 26;
  const double large = 10 * (1 + candidate.length);
  minimum_between(
      "keep-out", [&](double time) { return std::min(look(time), large); }, candidate.from,
      candidate.to, bits);
  if (*margin.deviations == never) margin.deviations.reset();
  return margin;
}

}  // namespace

KeepOutMargin keep_out_margin(const EncounterProblem& problem, const Eigen::Vector3d& semi_axes) {
  validate(problem);
  if (!(semi_axes.minCoeff() > 0) || !semi_axes.allFinite()) {
    throw Error(ErrorKind::usage, "keep-out: semi-axes must be positive");
  }
  const Ellipsoid ellipsoid(problem, semi_axes);
  KeepOutMargin best;
  for (const Candidate& candidate : linear_minima(problem, ellipsoid)) {
    const KeepOutMargin margin = followed(ellipsoid, candidate);
    const bool is_less =
        margin.deviations && (!best.deviations || *margin.deviations < *best.deviations);
    if (is_less) best = margin;
    // No length is less than 0; an error at other candidates does not matter then.
    if (best.deviations == 0.0) break;
  }
  if (best.deviations) best.flown_ratio = ellipsoid.least_flown_ratio(best.deviation);
  return best;
}

}  // namespace hamjet
