#include "jets_about_time.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "../../dynamics/list_about_time.hpp"
#include "hamjet/algebra/calculus.hpp"
#include "hamjet/detail/dynamics/slice_evaluator.hpp"

namespace hamjet {
namespace {

/// The place, in a space with one more variable, of a monomial times a power of that variable.
std::size_t place_of(const SeriesSpace& space, std::span<const std::uint8_t> monomial, int power) {
  std::vector<std::uint8_t> exponents(monomial.begin(), monomial.end());
  exponents.push_back(static_cast<std::uint8_t>(power));
  return space.index(exponents);
}

}  // namespace

// Picard's iteration, z(s) = z(0) + integral of f(z(s), t + s) from 0 to s, makes one more power of
// s right each time. Interpolation between jets at times about t is no substitute: its nodes must
// resolve the shortest waves of the field, and the closer they are, the more the errors of the
// integrations count in the higher powers.
std::vector<FlowJet<double>> jets_about_time(const DynamicalSystem& system, const ClockTime& time,
                                             const FlowJet<double>& jet) {
  const SeriesSpace& own = jet[0].space();
  const int order = own.order();
  const std::size_t later = own.variables();  // the variable s
  const SpacePointer space = SeriesSpace::create(later + 1, order);
  FlowJet<double> start(jet.size(), Series<double>(space));
  for (std::size_t k = 0; k < own.size(); ++k) {
    const std::size_t place = place_of(*space, own.exponents(k), 0);
    for (std::size_t c = 0; c < jet.size(); ++c) start[c][place] = jet[c][k];
  }
  const OperationList field = about_time(system.vector_field, time.in<Extended>(), order);
  SliceEvaluator<double, double> evaluator(field, space, order);
  evaluator.input(jet.size())[space->linear_index(later)] = 1;
  FlowJet<double> flow = start;
  for (int k = 1; k <= order; ++k) {
    for (std::size_t c = 0; c < jet.size(); ++c) {
      std::copy_n(flow[c].coefficients().data(), space->size(), evaluator.input(c));
    }
    evaluator.evaluate_all();
    Series<double> rate(space);
    for (std::size_t c = 0; c < jet.size(); ++c) {
      std::copy_n(evaluator.output(c), space->size(), rate.coefficients().data());
      flow[c] = start[c] + integral(rate, later);
    }
  }
  std::vector<FlowJet<double>> result(static_cast<std::size_t>(order) + 1);
  for (int power = 0; power <= order; ++power) {
    FlowJet<double>& target = result[static_cast<std::size_t>(power)];
    target.assign(jet.size(), Series<double>(jet[0].space_pointer()));
    for (std::size_t k = 0; k < own.first(order - power + 1); ++k) {
      const std::size_t place = place_of(*space, own.exponents(k), power);
      for (std::size_t c = 0; c < jet.size(); ++c) target[c][k] = flow[c][place];
    }
  }
  return result;
}

}  // namespace hamjet
