#include "thrusted_flight.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <span>

#include "../../../algebra/state_sums.hpp"
#include "../../../dynamics/costate_system.hpp"
#include "../../exact_flow.hpp"
#include "../formation_problem.hpp"
#include "../single_transfer.hpp"
#include "hamjet/algebra/composition.hpp"

namespace hamjet {
namespace {

using ThrustRule = boost::math::quadrature::gauss<double, 8>;

/// Of the derivatives of Newton's method, which flights without them judge.
constexpr double tolerance_of_commands = 1e-11;

}  // namespace

ComputedProblem costate_problem(const ComputedProblem& orbit, int order) {
  constexpr std::size_t states = ThrustedFlight::states;
  ComputedProblem problem = orbit;
  problem.system = costate_system(*orbit.system);
  problem.nominal.resize(2 * states, 0.0);
  problem.degrees_of_freedom.clear();
  problem.components.clear();
  for (std::size_t i = 0; i < 2 * states; ++i) {
    if (i < states) problem.degrees_of_freedom.push_back(i);
    problem.components.push_back(i);
  }
  problem.variables = problem.components;
  problem.space = SeriesSpace::create(2 * states, order);
  problem.is_full_jet = true;
  problem.symmetry = FlowSymmetry::rotation;
  problem.momentum_exponent = 0;
  return problem;
}

ThrustedFlight::ThrustedFlight(const Scene& scene, const ComputedProblem& problem, double time)
    : problem_(problem),
      time_(time),
      units_(metric_units(scene)),
      frame_(scene.transfer->frame),
      chief_system_(system_of_chief(scene, problem)),
      chief_start_(is_like_chief(scene) ? problem.nominal : scene.nominal) {
  orbit_end_ = exact_flow(problem.system, problem.nominal, problem.start_time, time);
  chief_end_ = is_like_chief(scene)
                   ? orbit_end_
                   : exact_flow(chief_system_, chief_start_, problem.start_time, time);
  chief_end_.resize(states);
  const std::vector<double> orbit(orbit_end_.begin(), orbit_end_.begin() + states);
  start_ = ChiefFrame(std::span(problem.nominal).first(states), units_, frame_)
               .deviation(scene.transfer->start);
  end_ = state_sum(scene.transfer->end.deviation(chief_end_, units_, frame_),
                   state_difference(chief_end_, orbit));
}

std::vector<double> ThrustedFlight::deputy(const std::vector<double>& costates,
                                           double share) const {
  std::vector<double> z = problem_.nominal;
  for (std::size_t i = 0; i < states; ++i) {
    z[i] += share * start_[i];
    z[states + i] = costates[i];
  }
  return z;
}

ThrustedFlight::State ThrustedFlight::missing(const std::vector<double>& costates,
                                              double share) const {
  return missing_at(
      exact_flow(problem_.system, deputy(costates, share), problem_.start_time, time_), share);
}

ThrustedFlight::State ThrustedFlight::missing_at(const std::vector<double>& flown,
                                                 double share) const {
  State miss;
  for (std::size_t i = 0; i < states; ++i) {
    miss[static_cast<Eigen::Index>(i)] = flown[i] - orbit_end_[i] - share * end_[i];
  }
  return miss;
}

Eigen::Matrix<double, 6, 6> ThrustedFlight::commanded(const std::vector<double>& costates,
                                                      double share) const {
  const FlowJet<double> jet = linear_jet(problem_.system, deputy(costates, share),
                                         problem_.start_time, time_, tolerance_of_commands);
  return linear_part(jet).topRightCorner(6, 6);
}

void ThrustedFlight::set_misses(EnergyOptimalAnswer& answer, const State& miss) const {
  answer.miss_m = miss.head<3>().norm() * units_.length_m;
  answer.velocity_miss_m_s = miss.tail<3>().norm() * units_.velocity_m_s();
}

ThrustedFlight::State ThrustedFlight::fly(EnergyOptimalAnswer& answer) const {
  const State miss = missing(answer.costates);
  set_misses(answer, miss);
  return miss;
}

Eigen::Vector3d ThrustedFlight::thrust(const std::vector<double>& z) const {
  return -Eigen::Vector3d(z[states + 3], z[states + 4], z[states + 5]) *
         (units_.velocity_m_s() / units_.time_s);
}

Eigen::Vector3d ThrustedFlight::along_frame(const std::vector<double>& chief,
                                            const std::vector<double>& z) const {
  return ChiefFrame(std::span(chief).first(states), units_, frame_).along_axes(thrust(z));
}

void ThrustedFlight::fly_on(std::vector<double>& z, double from, double to, int panels,
                            ThrustIntegrals& integrals) const {
  fly_on(problem_.system, {states + 3}, z, from, to, panels, integrals);
}

void ThrustedFlight::fly_on(const SharedSystem& system, const ThrustPlace& place,
                            std::vector<double>& z, double from, double to, int panels,
                            ThrustIntegrals& integrals) const {
  const double unit = std::abs(place.scale) * units_.velocity_m_s() / units_.time_s;
  double now = from;
  const auto fly_to = [&](double time) {
    z = exact_flow(system, z, problem_.start_time + now, time - now);
    now = time;
    const double* u = z.data() + place.first;
    const double size = Eigen::Vector3d(u[0], u[1], u[2]).norm() * unit;
    integrals.largest_m_s2 = std::max(integrals.largest_m_s2, size);
    return size;
  };
  const double half = (to - from) / panels / 2;
  for (int panel = 0; panel < panels; ++panel) {
    const double middle = from + (2 * panel + 1) * half;
    const auto count = static_cast<int>(ThrustRule::abscissa().size());
    // The nodes of the rule are told from the middle outwards; a flight meets them in order.
    for (int k = -count; k < count; ++k) {
      const auto node = static_cast<std::size_t>(k < 0 ? -k - 1 : k);
      const double size =
          fly_to(middle + std::copysign(ThrustRule::abscissa()[node], k + 0.5) * half);
      const double weight = ThrustRule::weights()[node] * half * units_.time_s;
      integrals.change_m_s += weight * size;
      integrals.energy_m2_s3 += weight * size * size / 2;
    }
  }
  fly_to(to);
}

void ThrustedFlight::measure(EnergyOptimalTransfer& transfer,
                             const std::vector<double>& times) const {
  std::vector<double> z = deputy(transfer.refined->costates);
  transfer.start_thrust_m_s2 = along_frame(problem_.nominal, z);
  ThrustIntegrals integrals;
  integrals.largest_m_s2 = transfer.start_thrust_m_s2.norm();
  for (std::size_t k = 1; k < times.size(); ++k) fly_on(z, times[k - 1], times[k], 1, integrals);
  transfer.energy_m2_s3 = integrals.energy_m2_s3;
  transfer.change_m_s = integrals.change_m_s;
  transfer.largest_m_s2 = integrals.largest_m_s2;
  transfer.end_thrust_m_s2 = along_frame(chief_end_, z);
}

std::vector<ThrustSample> ThrustedFlight::profile(const std::vector<double>& costates,
                                                  int intervals) const {
  std::vector<ThrustSample> samples;
  std::vector<double> chief = chief_start_;
  std::vector<double> z = deputy(costates);
  double now = 0;
  for (int k = 0; k <= intervals; ++k) {
    const double time = k == intervals ? time_ : time_ * k / intervals;
    if (time != now) {
      const ClockTime from = problem_.start_time + now;
      chief = exact_flow(chief_system_, chief, from, time - now);
      z = exact_flow(problem_.system, z, from, time - now);
      now = time;
    }
    samples.push_back({time, along_frame(chief, z)});
  }
  return samples;
}

std::vector<double> ThrustedFlight::chief_at(double time) const {
  std::vector<double> state =
      time == 0 ? chief_start_ : exact_flow(chief_system_, chief_start_, problem_.start_time, time);
  state.resize(states);
  return state;
}

std::vector<double> ThrustedFlight::orbit_at(double time) const {
  std::vector<double> state =
      time == 0 ? problem_.nominal
                : exact_flow(problem_.system, problem_.nominal, problem_.start_time, time);
  state.resize(states);
  return state;
}

}  // namespace hamjet
