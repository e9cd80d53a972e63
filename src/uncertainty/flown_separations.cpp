#include "flown_separations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "../algebra/scalar_search.hpp"
#include "encounter_flows.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// The number of looks at an expansion of order 24, which reaches a part of a revolution.
constexpr int looks_in_step = 16;
constexpr std::size_t pairs_at_once = TaylorFlow::lanes / 2;
/// A step shorter than this fraction of the window means that the flight runs into the centre.
constexpr double least_part = 1e-9;

/// A pair at a time: the squared distance, and rho.v, which is half of its derivative.
struct Look {
  double square = 0;
  double rate = 0;
};

class Pairs {
 public:
  Pairs(const EncounterProblem& problem, std::span<const EncounterDeviation> deviations)
      : problem_(&problem),
        flows_(problem),
        count_(deviations.size()),
        states_(12 * deviations.size()) {
    for (std::size_t craft = 0; craft < 2; ++craft) {
      std::vector<double> own;
      for (const EncounterDeviation& xi : deviations) {
        const auto start =
            problem.spacecraft[craft].deviated(xi.segment<6>(static_cast<Eigen::Index>(6 * craft)));
        own.insert(own.end(), start.begin(), start.end());
      }
      if (problem.from != 0) {
        flows_.advance(craft, own, problem.start_time, std::vector<double>(count_, problem.from));
      }
      for (std::size_t pair = 0; pair < count_; ++pair) {
        std::copy_n(own.begin() + static_cast<std::ptrdiff_t>(6 * pair), 6,
                    state(2 * pair + craft).begin());
      }
    }
  }

  std::vector<double> least_squares() {
    std::vector<double> least(count_, std::numeric_limits<double>::infinity());
    std::vector<double> left(count_, problem_->to - problem_->from);
    while (std::any_of(left.begin(), left.end(), [](double time) { return time > 0; })) {
      // Lanes without a state of their own repeat the first one, so that their numbers are finite.
      for (std::size_t lane = 0; lane < TaylorFlow::lanes; ++lane) {
        const std::size_t own = lane < 2 * count_ ? lane : 0;
        flows_.set_state(lane, problem_->start_time + (problem_->to - left[own / 2]), state(own));
      }
      flows_.expand();
      for (std::size_t pair = 0; pair < count_; ++pair) {
        if (left[pair] > 0) left[pair] -= advance(pair, left[pair], least[pair]);
      }
    }
    return least;
  }

 private:
  std::span<double> state(std::size_t lane) { return std::span(states_).subspan(6 * lane, 6); }

  Look look(std::size_t pair, double time) const {
    std::array<double, 6> first{};
    std::array<double, 6> second{};
    flows_.evaluate(0, 2 * pair, time, first);
    flows_.evaluate(1, 2 * pair + 1, time, second);
    Look result;
    for (std::size_t i = 0; i < 3; ++i) {
      const double rho = second[i] - first[i];
      result.square += rho * rho;
      result.rate += rho * (second[i + 3] - first[i + 3]);
    }
    return result;
  }

  /// Advances as far as the expansions of both spacecraft reach, and returns the time advanced.
  double advance(std::size_t pair, double left, double& least) {
    const double step = std::min({flows_.reach(0, 2 * pair), flows_.reach(1, 2 * pair + 1), left});
    const bool is_long = step > least_part * (problem_->to - problem_->from);
    if (!(is_long || flows_.ends_at_break(0, 2 * pair, step))) {
      throw Error(ErrorKind::numerical,
                  "encounter: a flight with a random deviation ended in the centre; the covariance "
                  "is too large for its orbit");
    }
    Look before = look(pair, 0);
    least = std::min(least, before.square);
    for (int k = 1; k <= looks_in_step; ++k) {
      const double from = step * (k - 1) / looks_in_step;
      const double to = k == looks_in_step ? step : step * k / looks_in_step;
      const Look after = look(pair, to);
      least = std::min(least, after.square);
      if (before.rate < 0 && after.rate > 0) {
        // The distance is flat at its minimum: half of the digits of the time suffice, and any time
        // of the bracket lies on the flight.
        constexpr int bits = 40;
        const double time = root_between(
            "encounter", [&](double at) { return look(pair, at).rate; }, {from, before.rate},
            {to, after.rate}, bits);
        least = std::min(least, look(pair, time).square);
      }
      before = after;
    }
    for (std::size_t craft = 0; craft < 2; ++craft) {
      flows_.evaluate(craft, 2 * pair + craft, step, state(2 * pair + craft));
    }
    return step == left ? left : step;
  }

  const EncounterProblem* problem_;
  EncounterFlows flows_;
  std::size_t count_;
  std::vector<double> states_;  ///< for each pair both states, six numbers each
};

}  // namespace

std::vector<double> flown_separations(const EncounterProblem& problem,
                                      std::span<const EncounterDeviation> deviations) {
  std::vector<double> result;
  for (std::size_t first = 0; first < deviations.size(); first += pairs_at_once) {
    const auto block =
        deviations.subspan(first, std::min(pairs_at_once, deviations.size() - first));
    for (const double square : Pairs(problem, block).least_squares()) {
      if (!std::isfinite(square)) {
        throw Error(ErrorKind::numerical, "encounter: the separation of a flight is not finite");
      }
      result.push_back(std::sqrt(square));
    }
  }
  return result;
}

double flown_separation_of_means(const EncounterProblem& problem) {
  const std::array<EncounterDeviation, 1> none = {EncounterDeviation::Zero()};
  return flown_separations(problem, none)[0];
}

std::vector<std::size_t> nearest_to(double wanted, std::span<const double> separations,
                                    std::size_t count) {
  std::vector<std::size_t> places(separations.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  const auto end =
      places.begin() + static_cast<std::ptrdiff_t>(std::min(count, separations.size()));
  std::partial_sort(places.begin(), end, places.end(), [&](std::size_t one, std::size_t other) {
    return std::abs(separations[one] - wanted) < std::abs(separations[other] - wanted);
  });
  places.erase(end, places.end());
  return places;
}

double difference_near(double wanted, double told, double flown) {
  const double farthest = farthest_told * wanted;
  return std::abs(std::min(flown, farthest) - std::min(told, farthest));
}

}  // namespace hamjet
