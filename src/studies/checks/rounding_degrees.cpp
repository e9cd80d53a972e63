#include "rounding_degrees.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "../../algebra/raise_to.hpp"
#include "../../integrators/momentum_unit.hpp"
#include "../largest_coefficient.hpp"
#include "error_promise.hpp"
#include "hamjet/detail/dynamics/slice_evaluator.hpp"

namespace hamjet {
namespace {

/// The series of the equations of motion about states.
template <class Real>
class FieldSeries {
 public:
  FieldSeries(const OperationList& list, const SpacePointer& space)
      : space_(*space), evaluator_(list, space, space->order()) {}

  void expand(const std::vector<double>& state, const ClockTime& time) {
    evaluator_.set_time(time.in<Real>());
    for (std::size_t i = 0; i < state.size(); ++i) {
      Real* const input = evaluator_.input(i);
      std::fill(input, input + space_.size(), Real(0));
      input[0] = Real(state[i]);
      input[space_.linear_index(i)] = Real(1);
    }
    evaluator_.evaluate_all();
  }
  const Real* component(std::size_t i) const { return evaluator_.output(i); }

 private:
  const SeriesSpace& space_;
  SliceEvaluator<Real, Real> evaluator_;
};

/// By degree, the largest coefficient of the equations of motion, and its rounding.
struct FieldDegrees {
  std::vector<double> sizes;
  std::vector<double> rounding;
};

FieldDegrees degrees_of_field(const Scene& scene, const DynamicalSystem& system,
                              const RunResult& run) {
  constexpr std::size_t most_points = 64;
  const int exponent = natural_momentum_exponent(is_orbit(scene.system.model), scene.nominal);
  const std::size_t n = system.degrees_of_freedom;
  const SpacePointer space = SeriesSpace::create(system.dimension(), scene.order);
  const OperationList& list = system.vector_field;
  FieldSeries<double> rounded(list, space);
  FieldSeries<Extended> precise(list, space);
  const std::vector<double> none(static_cast<std::size_t>(scene.order) + 1, 0);
  FieldDegrees result{none, none};
  const std::size_t stride = run.nominal.size() / most_points + 1;
  for (std::size_t point = 0; point < run.nominal.size(); point += stride) {
    const ClockTime time = scene.start_time + run.nominal[point].time;
    rounded.expand(run.nominal[point].state, time);
    precise.expand(run.nominal[point].state, time);
    for (std::size_t i = 0; i < 2 * n; ++i) {
      for (std::size_t k = 0; k < space->size(); ++k) {
        const auto exponents = space->exponents(k);
        int binary = i < n ? 0 : -exponent;
        for (std::size_t v = 0; v < exponents.size(); ++v) {
          binary += exponents[v] * exponent_of_variable(v, n, exponent);
        }
        const Extended& right = precise.component(i)[k];
        const double difference = static_cast<double>(Extended(rounded.component(i)[k] - right));
        const double unit = std::ldexp(1.0, binary);
        const auto degree = static_cast<std::size_t>(space->degree(k));
        raise_to(result.sizes[degree], unit * std::abs(static_cast<double>(right)));
        raise_to(result.rounding[degree], unit * std::abs(difference));
      }
    }
  }
  return result;
}

}  // namespace

std::vector<double> defects_of_rounding(const Scene& scene, const DynamicalSystem& system,
                                        const RunResult& run) {
  constexpr double safety = 8;
  constexpr double cancelled = 32;  // roundings of the size itself, which no sum is without
  constexpr double most_of_digits = 1e-6;
  const double double_rounding = rounding_of(Precision::double_precision);
  const FieldDegrees field = degrees_of_field(scene, system, run);
  const FlowJet<Extended> jet = comparable_jet(scene, run);
  const auto variables = static_cast<double>(jet.size());
  const double growth = std::max(1.0, variables * largest_coefficient(jet, 1));
  const double units = rounding_of(scene.precision) / double_rounding;
  std::vector<double> sizes, rounding;
  for (int degree = 0; degree <= scene.order; ++degree) {
    const auto k = static_cast<std::size_t>(degree);
    sizes.push_back(largest_coefficient(jet, degree));
    rounding.push_back(0);
    const bool cancels = field.rounding[k] > cancelled * double_rounding * field.sizes[k];
    if (degree < 2 || !cancels) continue;
    const double found = safety * units * std::abs(scene.duration) * field.rounding[k] *
                         std::pow(growth, degree + 1);
    rounding.back() =
        sizes.back() <= found ? sizes.back() : std::min(found, most_of_digits * sizes.back());
  }
  std::vector<double> result(static_cast<std::size_t>(scene.order), 0);
  for (std::size_t d = 0; d < result.size(); ++d) {
    // Each pair of variables adds a product of derivatives, of as many monomials as meet in it.
    const double products = std::pow(variables, static_cast<double>(d + 1));
    for (std::size_t a = 1; a <= d + 1; ++a) {
      const std::size_t b = d + 2 - a;
      result[d] +=
          products * static_cast<double>(a * b) * (rounding[a] * sizes[b] + sizes[a] * rounding[b]);
    }
  }
  return result;
}

}  // namespace hamjet
