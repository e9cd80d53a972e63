#include "thrust_feedback.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "../../../algebra/state_sums.hpp"
#include "../../exact_flow.hpp"
#include "../../jets_along_time.hpp"
#include "../formation_problem.hpp"
#include "../single_transfer.hpp"
#include "hamjet/detail/algebra/monomial_values.hpp"
#include "hamjet/error.hpp"
#include "hamjet/maps/generating_function.hpp"

namespace hamjet {
namespace {

/// The values of polynomials at affine functions of other variables. A polynomial has no terms
/// beyond its degree, so that constants in these functions leave nothing out.
std::vector<Series<double>> substituted(std::span<const Series<double>> outer,
                                        const std::vector<Series<double>>& inner) {
  const SeriesSpace& space = outer.front().space();
  const SpacePointer& into = inner.front().space_pointer();
  std::vector<Series<double>> result(outer.size(), Series<double>(into));
  std::vector<Series<double>> monomials(space.size(), Series<double>(into));
  monomials[0] = Series<double>(into, 1.0);
  std::vector<std::uint8_t> lower(space.variables());
  for (std::size_t m = 0; m < space.size(); ++m) {
    if (m > 0) {
      const auto exponents = space.exponents(m);
      std::copy(exponents.begin(), exponents.end(), lower.begin());
      const auto first = std::find_if(lower.begin(), lower.end(), [](auto e) { return e > 0; });
      --*first;
      monomials[m] =
          monomials[space.index(lower)] * inner[static_cast<std::size_t>(first - lower.begin())];
    }
    for (std::size_t i = 0; i < outer.size(); ++i) result[i] += monomials[m] * outer[i][m];
  }
  return result;
}

class ThrustFeedback {
 public:
  ThrustFeedback(const Scene& scene, const ComputedProblem& problem, const ThrustedFlight& flight,
                 int panels)
      : scene_(scene),
        problem_(problem),
        flight_(flight),
        panels_(panels),
        units_(metric_units(scene)),
        frame_(scene.transfer->frame),
        count_(static_cast<std::size_t>(scene.transfer->feedback)) {}

  FeedbackLaw law() {
    FeedbackLaw law;
    try {
      find_costates();
      for (std::size_t k = 0; k < count_; ++k) {
        chiefs_.push_back(flight_.chief_at(time_of(k)));
        orbits_.push_back(flight_.orbit_at(time_of(k)));
      }
      for (std::size_t k = 0; k < count_; ++k) law.instants.push_back(instant(k));
      fly(law);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      law.failure = error.what();
    }
    return law;
  }

 private:
  static constexpr std::size_t states = ThrustedFlight::states;

  double time_of(std::size_t k) const {
    return flight_.time() * static_cast<double>(k) / static_cast<double>(count_);
  }

  /// The costates at every instant as polynomials of the states there and at the end.
  void find_costates() {
    ComputedProblem back = problem_;
    back.nominal = flight_.orbit_end();
    // The orbit coasts; what its costates are after a flight is rounding.
    std::fill(back.nominal.begin() + states, back.nominal.end(), 0.0);
    back.start_time = problem_.start_time + flight_.time();
    std::vector<double> times;
    for (std::size_t k = count_; k-- > 0;) times.push_back(time_of(k) - flight_.time());
    costates_.resize(count_);
    visit_jets(back, symplectic_integrator(scene_), times,
               [&](std::size_t index, const FlowJet<double>& jet) {
                 costates_[count_ - 1 - index] =
                     invert_partially(jet, parse_kind("F1", states)).remaining_final;
               });
  }

  FeedbackInstant instant(std::size_t k) const {
    FeedbackInstant instant;
    instant.time = time_of(k);
    const std::vector<double> from_orbit = state_difference(chiefs_[k], orbits_[k]);
    const ChiefFrame frame(chiefs_[k], units_, frame_);
    const SpacePointer space = SeriesSpace::create(states, problem_.space->order());
    std::vector<Series<double>> inner;
    for (std::size_t i = 0; i < states; ++i) inner.emplace_back(space, from_orbit[i]);
    for (std::size_t j = 0; j < states; ++j) {
      RelativeState unit;
      const auto axis = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(j % 3));
      (j < 3 ? unit.position_m : unit.velocity_m_s) = axis;
      const std::vector<double> column = frame.deviation(unit);
      for (std::size_t i = 0; i < states; ++i) inner[i][space->linear_index(j)] = column[i];
    }
    for (const double x : flight_.end()) inner.emplace_back(space, x);
    const std::vector<Series<double>> velocity_costates =
        substituted(std::span(costates_[k]).last(3), inner);
    const double unit = units_.velocity_m_s() / units_.time_s;
    Eigen::Matrix3d axes;
    for (Eigen::Index j = 0; j < 3; ++j) axes.col(j) = frame.along_axes(Eigen::Vector3d::Unit(j));
    for (Eigen::Index i = 0; i < 3; ++i) {
      Series<double> thrust(space);
      for (Eigen::Index j = 0; j < 3; ++j) {
        thrust -= velocity_costates[static_cast<std::size_t>(j)] * (unit * axes(i, j));
      }
      instant.thrust.push_back(std::move(thrust));
    }
    return instant;
  }

  void fly(FeedbackLaw& law) {
    std::vector<double> z = flight_.deputy(std::vector<double>(states, 0.0));
    ThrustIntegrals integrals;
    MonomialValues values(costates_.front().front().space_pointer());
    const int panels = std::max(1, panels_ / static_cast<int>(count_));
    for (std::size_t k = 0; k < count_; ++k) {
      const double time = time_of(k);
      const std::vector<double> state(z.begin(), z.begin() + states);
      law.instants[k].state =
          ChiefFrame(chiefs_[k], units_, frame_).relative(state_difference(state, chiefs_[k]));
      std::vector<double> ends = state_difference(state, orbits_[k]);
      ends.insert(ends.end(), flight_.end().begin(), flight_.end().end());
      values.set_point(ends);
      for (std::size_t i = 0; i < states; ++i) {
        z[states + i] = values.value(costates_[k][i], problem_.space->order());
      }
      flight_.fly_on(z, time, k + 1 == count_ ? flight_.time() : time_of(k + 1), panels, integrals);
    }
    const ThrustedFlight::State miss = flight_.missing_at(z);
    law.miss_m = miss.head<3>().norm() * units_.length_m;
    law.velocity_miss_m_s = miss.tail<3>().norm() * units_.velocity_m_s();
    law.energy_m2_s3 = integrals.energy_m2_s3;
    law.change_m_s = integrals.change_m_s;
  }

  const Scene& scene_;
  const ComputedProblem& problem_;
  const ThrustedFlight& flight_;
  int panels_;
  MetricUnits units_;
  RelativeFrame frame_;
  std::size_t count_;
  std::vector<std::vector<double>> chiefs_;  ///< at the instants
  std::vector<std::vector<double>> orbits_;  ///< likewise
  std::vector<std::vector<Series<double>>> costates_;
};

}  // namespace

FeedbackLaw thrust_feedback(const Scene& scene, const ComputedProblem& problem,
                            const ThrustedFlight& flight, int panels) {
  return ThrustFeedback(scene, problem, flight, panels).law();
}

}  // namespace hamjet
