#include "bounded_family.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hamjet/algebra/calculus.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// How many times a window has, besides its start.
constexpr int most_parts = 50;

}  // namespace

BoundedFamily::BoundedFamily(const ZonalGravity& field, const SixNumbers<double>& chief, int order,
                             int revolutions, const GaussSettings& gauss, const Progress& progress)
    : section_(field, ChartName::nodal, chief),
      period_(first_return<double>(field, chief, 0, gauss).flight.time[0]),
      mean_period_(SeriesSpace::create(nodal_variables, order)),
      mean_node_(mean_period_.space_pointer()) {
  const SpacePointer& space = mean_period_.space_pointer();
  const int each = (revolutions + most_parts - 1) / most_parts;
  const int parts = (revolutions + each - 1) / each;
  double squares = 0;
  for (int k = 0; k <= parts; ++k) squares += std::pow(k - 0.5 * parts, 2);
  FlowBoxPropagation<double> propagation(field, ChartName::nodal, chief, order, gauss);
  times_ = {0};
  for (int k = 1; k <= parts; ++k) {
    times_.push_back(k * each * period_);
    const NodalFlight<double> flight = nodal_flight(propagation.advance_to(times_.back()));
    // At the window's start nothing depends on u.
    const double weight = (k - 0.5 * parts) / (each * squares);
    mean_period_ += flight.time * weight;
    mean_node_ += flight.node * weight;
    if (progress) progress(static_cast<double>(k) / parts);
  }
  const auto variable = [&](std::size_t i) { return Series<double>::variable(space, i); };
  const std::vector<Series<double>> rates = without_constants(std::vector<Series<double>>{
      mean_period_, variable(q_variable), mean_node_, variable(p_variable)});
  const auto slope = [&](const Series<double>& series, NodalVariable v) {
    return series[space->linear_index(v)];
  };
  const double determinant =
      slope(mean_period_, energy_variable) * slope(mean_node_, momentum_variable) -
      slope(mean_period_, momentum_variable) * slope(mean_node_, energy_variable);
  // The node moves by the order of J2 a revolution, and so do its differences.
  constexpr double least = 1e-9;
  if (!(std::abs(determinant) * section_.chief()[3] > least * period_)) {
    throw Error(ErrorKind::numerical,
                "bounded: the node's drift does not depend on the orbit's inclination here; all "
                "orbits of one energy stay together, as they do without J2");
  }
  of_pair_ = inverse(rates);
}

BoundedFamily::Member BoundedFamily::member(double q, double p, int degree) const {
  const SpacePointer space = SeriesSpace::create(nodal_variables, std::min(degree, order()));
  std::array<double, nodal_variables> point = {};
  point[q_variable] = q;
  point[p_variable] = p;
  Member member;
  member.energy = evaluate<double>(in_space(of_pair_[energy_variable], space), point);
  member.momentum = evaluate<double>(in_space(of_pair_[momentum_variable], space), point);
  member.state = state_of(q, p, member.energy, member.momentum);
  return member;
}

SixNumbers<double> BoundedFamily::state_of(double q, double p, double energy,
                                           double momentum) const {
  SixNumbers<double> z = section_.chief();
  z[q_place] += q;
  z[p_place] += p;
  z[momentum_place] += momentum;
  // G of Kepler's ellipse, which the harmonics move by their own size, a thousandth.
  const double L = z[3] * std::sqrt(section_.energy() / section_.energy_of(energy));
  const double G = L - (z[q_place] * z[q_place] + z[p_place] * z[p_place]) / 2;
  if (!(std::abs(z[momentum_place]) < G)) {
    throw Error(ErrorKind::numerical,
                "bounded: to drift as the chief does with this difference in eccentricity, its "
                "inclination would have to be below 0");
  }
  return section_.state(section_.energy_of(energy), z);
}

}  // namespace hamjet
