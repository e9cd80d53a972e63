#include "thrust_feedback.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "../../../algebra/state_sums.hpp"
#include "../single_transfer.hpp"
#include "erroneous_flights.hpp"
#include "feedback_costates.hpp"
#include "hamjet/error.hpp"

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

FeedbackInstant instant_of_law(const FeedbackCostates& costates, std::size_t k,
                               const ThrustedFlight& flight, const MetricUnits& units) {
  constexpr std::size_t dimension = ThrustedFlight::states;
  FeedbackInstant instant;
  instant.time = costates.time(k);
  const std::vector<double> from_orbit = state_difference(costates.chief(k), costates.orbit(k));
  const ChiefFrame frame = costates.frame(k);
  const SpacePointer space =
      SeriesSpace::create(dimension, costates.polynomials(k).front().order());
  std::vector<Series<double>> inner;
  for (std::size_t i = 0; i < dimension; ++i) inner.emplace_back(space, from_orbit[i]);
  for (std::size_t j = 0; j < dimension; ++j) {
    RelativeState unit;
    const auto axis = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(j % 3));
    (j < 3 ? unit.position_m : unit.velocity_m_s) = axis;
    const std::vector<double> column = frame.deviation(unit);
    for (std::size_t i = 0; i < dimension; ++i) inner[i][space->linear_index(j)] = column[i];
  }
  for (const double x : flight.end()) inner.emplace_back(space, x);
  const std::vector<Series<double>> velocity_costates =
      substituted(std::span(costates.polynomials(k)).last(3), inner);
  const double unit = units.velocity_m_s() / units.time_s;
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

void fly_by_law(FeedbackCostates& costates, const ThrustedFlight& flight, const MetricUnits& units,
                int panels, FeedbackLaw& law) {
  constexpr std::size_t dimension = ThrustedFlight::states;
  std::vector<double> z = flight.deputy(std::vector<double>(dimension, 0.0));
  ThrustIntegrals integrals;
  for (std::size_t k = 0; k < costates.count(); ++k) {
    const std::vector<double> state(z.begin(), z.begin() + dimension);
    law.instants[k].state = costates.frame(k).relative(state_difference(state, costates.chief(k)));
    z = costates.with_costates(k, state);
    flight.fly_on(z, costates.time(k), costates.time(k + 1),
                  std::max(1, panels / static_cast<int>(costates.count())), integrals);
  }
  const ThrustedFlight::State miss = flight.missing_at(z);
  law.miss_m = miss.head<3>().norm() * units.length_m;
  law.velocity_miss_m_s = miss.tail<3>().norm() * units.velocity_m_s();
  law.energy_m2_s3 = integrals.energy_m2_s3;
  law.change_m_s = integrals.change_m_s;
}

}  // namespace

FeedbackLaw thrust_feedback(const Scene& scene, const ComputedProblem& orbit,
                            const ComputedProblem& problem, const ThrustedFlight& flight,
                            const std::vector<double>& costates, int panels,
                            const ProgressCallback& progress) {
  FeedbackLaw law;
  try {
    const MetricUnits units = metric_units(scene);
    FeedbackCostates feedback(scene, problem, flight);
    for (std::size_t k = 0; k < feedback.count(); ++k) {
      law.instants.push_back(instant_of_law(feedback, k, flight, units));
    }
    fly_by_law(feedback, flight, units, panels, law);
    if (scene.transfer->errors) {
      law.samples = erroneous_flights(scene, orbit, flight, feedback, costates, panels, progress);
    }
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    law.failure = error.what();
  }
  return law;
}

}  // namespace hamjet
