#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "dynamics/operation_count.hpp"
#include "hamjet/detail/dynamics/differentiable_function.hpp"
#include "hamjet/detail/dynamics/slice_evaluator.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"
#include "support/errors.hpp"
#include "support/moving_fields.hpp"
#include "support/random_series.hpp"

namespace hamjet {
namespace {

/// A Hamiltonian in which the time enters as a factor, an addend, a divisor, and inside functions.
DynamicalSystem shaken() {
  return make_system("shaken", 2, [](auto q, auto p, const Expression& t) {
    return square(p[0]) / (2 + t) + square(p[1]) / 2 + cos(t) * q[0] * q[1] +
           exp(q[0] * sin(2 * t)) - t * q[1] + log(2 + t + square(q[1])) + q[0] / (1 + t * t);
  });
}

template <class T, class Real = T>
std::vector<Series<T>> on_series(const OperationList& list, const std::vector<Series<T>>& inputs,
                                 const Real& time) {
  const SpacePointer& space = inputs[0].space_pointer();
  SliceEvaluator<T, Real> evaluator(list, space, space->order());
  evaluator.set_time(T(time));
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    std::copy(inputs[i].coefficients().begin(), inputs[i].coefficients().end(), evaluator.input(i));
  }
  evaluator.evaluate_all();
  std::vector<Series<T>> outputs;
  for (std::size_t o = 0; o < list.outputs().size(); ++o) {
    const T* values = evaluator.output(o);
    outputs.emplace_back(space, std::vector<T>(values, values + space->size()));
  }
  return outputs;
}

/// The same by slices, as implicit methods evaluate.
template <class Real>
std::vector<Series<Real>> by_slices(const OperationList& list,
                                    const std::vector<Series<Real>>& inputs, const Real& time) {
  const SpacePointer& space = inputs[0].space_pointer();
  SliceEvaluator<Real, Real> evaluator(list, space, space->order());
  evaluator.set_time(time);
  for (int d = 0; d <= space->order(); ++d) {
    if (d > 0) evaluator.evaluate_remainder(d);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      for (std::size_t k = space->first(d); k < space->first(d + 1); ++k) {
        evaluator.input(i)[k] = inputs[i][k];
      }
    }
    if (d == 0) {
      evaluator.evaluate_constant_terms();
    } else {
      evaluator.complete(d);
    }
  }
  std::vector<Series<Real>> outputs;
  for (std::size_t o = 0; o < list.outputs().size(); ++o) {
    const Real* values = evaluator.output(o);
    outputs.emplace_back(space, std::vector<Real>(values, values + space->size()));
  }
  return outputs;
}

template <class Real>
void expect_equal_series(const std::vector<Series<Real>>& values,
                         const std::vector<Series<Real>>& expected, double roundings) {
  ASSERT_EQ(values.size(), expected.size());
  const SeriesSpace& space = expected[0].space();
  for (int d = 0; d <= space.order(); ++d) {
    double scale = 0;
    double error = 0;
    for (std::size_t o = 0; o < values.size(); ++o) {
      scale = std::max(scale, test::largest_of_degree(expected[o], d));
      error = test::larger(error, test::largest_of_degree(values[o] - expected[o], d));
    }
    EXPECT_LE(error, roundings * test::epsilon_of<Real>() * scale) << "degree " << d;
  }
}

template <class Real>
std::vector<Series<Real>> sample_state(const SpacePointer& space, const std::vector<double>& about,
                                       unsigned seed) {
  test::RandomNumbers random(seed);
  std::vector<Series<Real>> state;
  for (const double value : about) {
    Series<Real> x = test::random_series<Real>(space, random, {0, 1}, 0.5);
    x[0] = Real(value);
    state.push_back(x);
  }
  return state;
}

// A list at one time is the list recorded with that time as a constant: numbers have no slices.
TEST(TimeInLists, ActsAsANumber) {
  const DynamicalSystem system = shaken();
  ASSERT_FALSE(system.is_autonomous());
  EXPECT_EQ(system.vector_field.inputs(), 5u);
  EXPECT_EQ(system.vector_field.variables(), 4u);
  const auto space = SeriesSpace::create(4, 4);
  for (const double time : {0.0, 0.7}) {
    const auto state = sample_state<double>(space, {0.3, -0.4, 0.2, 0.6}, 11);
    const OperationList frozen = at_time(system.vector_field, time);
    EXPECT_FALSE(frozen.has_time());
    const auto expected = on_series<double>(frozen, state, 0.0);
    expect_equal_series(on_series<double>(system.vector_field, state, time), expected, 1e3);
    expect_equal_series(by_slices<double>(system.vector_field, state, time), expected, 1e3);
  }
}

// The products with numbers form no sums, and a force that is linear at each time is a linear
// system.
TEST(TimeInLists, CostsNoProductsOfSeries) {
  const DynamicalSystem driven = make_system("driven", 1, [](auto q, auto p, const Expression& t) {
    return (2 + cos(t)) * square(p[0]) / 2 + exp(-t) * square(q[0]) / 2 - sin(3 * t) * q[0];
  });
  EXPECT_TRUE(driven.vector_field.is_linear_system());
  EXPECT_EQ(driven.vector_field.nonlinear_operations(), 0u);
  const auto space = SeriesSpace::create(2, 5);
  EXPECT_EQ(series_multiply_adds(driven.vector_field, *space, 5), 0);
}

TEST(TimeInLists, AreLeftOutWhereNothingDependsOnThem) {
  const DynamicalSystem system = make_system("still", 1, [](auto q, auto p, const Expression& t) {
    return square(p[0]) / 2 + square(q[0]) + 0 * t;
  });
  EXPECT_TRUE(system.is_autonomous());
  EXPECT_EQ(system.hamiltonian.inputs(), 2u);
  EXPECT_EQ(system.conserved_quantity(), ConservedQuantity::energy);
}

// The derivatives by z of a function with time, from its closed form.
TEST(TimeInLists, AreNoVariablesOfDerivatives) {
  const OperationList list = record(
      2, [](auto x) { return std::vector<Expression>{x[0] * x[0] * sin(x[1])}; }, true);
  DifferentiableFunction<double> slope(gradient(list));
  EXPECT_EQ(slope.inputs(), 1u);
  EXPECT_EQ(slope.outputs(), 1u);
  const std::vector<double> x = {1.5};
  slope.evaluate(x, 0.3);
  EXPECT_NEAR(slope.value(0), 3 * std::sin(0.3), 1e-15);
  EXPECT_NEAR(slope.derivative(0, 0), 2 * std::sin(0.3), 1e-15);
  DifferentiableFunction<double> matrix(jacobian(list));
  matrix.evaluate(x, 0.3);
  EXPECT_NEAR(matrix.value(0), 3 * std::sin(0.3), 1e-15);
  test::expect_error(ErrorKind::usage, "depends on the time", [&] { matrix.evaluate(x); });
}

TEST(TimeInLists, IsNotAThingAtAllUntilItIsSet) {
  const DynamicalSystem system = shaken();
  SliceEvaluator<double, double> field(system.vector_field, SeriesSpace::create(1, 0), 0);
  for (std::size_t i = 0; i < 4; ++i) *field.input(i) = 0.5;
  field.evaluate_constant_terms();
  EXPECT_TRUE(std::isnan(*field.output(0)));
}

template <class Real>
void expect_fields_as_recorded(int jet_order, double time) {
  const test::MovingFields fields;
  const OperationList with_objects = fields.with_objects().vector_field;
  const OperationList recorded = fields.recorded().vector_field;
  const auto space = SeriesSpace::create(3, jet_order);
  const auto state = sample_state<Real>(space, {0.9, 0.5, -0.6, 0.1, 0.2, 0.3}, 5);
  const auto expected = on_series<Real>(recorded, state, Real(time));
  // Within an order the two arrangements differ by some hundred roundings of terms that are
  // larger than their sum.
  expect_equal_series(on_series<Real>(with_objects, state, Real(time)), expected, 1e4);
  expect_equal_series(by_slices<Real>(with_objects, state, Real(time)), expected, 1e4);
}

// The field of objects is that of the same potential with ordinary operations, whose derivatives
// are those of another algorithm.
TEST(FieldsInLists, AreThoseOfOrdinaryOperations) {
  for (int jet_order = 1; jet_order <= 6; ++jet_order) {
    SCOPED_TRACE(jet_order);
    expect_fields_as_recorded<double>(jet_order, 0.8);
  }
  expect_fields_as_recorded<Extended>(4, -1.3);
}

// Each lane has a position and a time of its own, and none depends on another one.
TEST(FieldsInLists, HaveLanesOfTheirOwn) {
  constexpr int jet_order = 3;
  const OperationList list = test::MovingFields().with_objects().vector_field;
  const auto space = SeriesSpace::create(3, jet_order);
  using P = Pack<double, 4>;
  SliceEvaluator<P, double> together(list, space, jet_order);
  P times;
  std::vector<std::vector<Series<double>>> states;
  for (int lane = 0; lane < 4; ++lane) {
    const double x = 0.1 * lane;
    times.set_lane(lane, 0.5 + x);
    states.push_back(sample_state<double>(space, {0.9 + x, 0.5, -0.6, 0.1, 0.2 - x, 0.3},
                                          static_cast<unsigned>(lane)));
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t k = 0; k < space->size(); ++k) {
        together.input(i)[k].set_lane(lane, states.back()[i][k]);
      }
    }
  }
  together.set_time(times);
  together.evaluate_all();
  for (int lane = 0; lane < 4; ++lane) {
    const auto alone =
        on_series<double>(list, states[static_cast<std::size_t>(lane)], times.lane(lane));
    for (std::size_t o = 0; o < 6; ++o) {
      for (std::size_t k = 0; k < space->size(); ++k) {
        EXPECT_NEAR(together.output(o)[k].lane(lane), alone[o][k],
                    1e-12 * (1 + std::abs(alone[o][k])));
      }
    }
  }
}

// All forces share the monomials of the deviations, so that their number does not depend on that of
// the bodies: in three variables there are 6 + 10 of the degrees 2 and 3, which are below 4.
TEST(FieldsInLists, ShareTheirProducts) {
  const auto products = [](const OperationList& list, int jet_order) {
    const OperationList expanded = expand_fields(list, jet_order);
    return std::count_if(
        expanded.operations().begin(), expanded.operations().end(),
        [](const Operation& o) { return o.code == OperationCode::deviation_product; });
  };
  const test::MovingFields fields;
  const OperationList both = fields.with_objects().second_order->force;
  const OperationList one = fields.turning_body().second_order->force;
  EXPECT_EQ(products(both, 4), 16);
  EXPECT_EQ(products(one, 4), 16);
  EXPECT_EQ(products(both, 1), 0);
  // The sums of the two bodies' forces are one operation for each component.
  const auto is_field = [](const Operation& o) { return o.code == OperationCode::field; };
  const OperationList expanded = expand_fields(both, 4);
  EXPECT_EQ(std::count_if(expanded.operations().begin(), expanded.operations().end(), is_field), 3);
  // Most of the work is that of three products for each component.
  const auto space = SeriesSpace::create(6, 4);
  double whole = 0;
  for (int d = 2; d <= 4; ++d) whole += static_cast<double>(space->products(d).multiply_adds);
  const double count = series_multiply_adds(one, *space, 4);
  EXPECT_GT(count, 9 * whole);
  EXPECT_LT(count, 18 * whole);
}

// A potential that is a polynomial of the position has vanishing coefficients above its degree;
// here a field in two of three coordinates whose third is a constant.
TEST(FieldsInLists, TakeConstantsForCoordinates) {
  const auto field =
      std::make_shared<const test::PointMasses>(std::vector<test::PointMass>(1, {1, {0, 0, 0.5}}));
  const DynamicalSystem plane = make_system("plane", 2, [&](auto q, auto p) {
    return (square(p[0]) + square(p[1])) / 2 + field_value(field, {q[0], q[1], Expression(0.25)});
  });
  const DynamicalSystem recorded = make_system("recorded plane", 2, [&](auto q, auto p) {
    return (square(p[0]) + square(p[1])) / 2 -
           pow(square(q[0]) + square(q[1]) + 0.0625, Expression(-0.5));
  });
  EXPECT_TRUE(plane.is_autonomous());
  const auto space = SeriesSpace::create(4, 5);
  const auto state = sample_state<double>(space, {0.8, 0.6, 0.1, -0.2}, 3);
  expect_equal_series(on_series<double>(plane.vector_field, state, 0.0),
                      on_series<double>(recorded.vector_field, state, 0.0), 1e4);
  EXPECT_EQ(expand_fields(plane.second_order->force, 4).nonlinear_operations(), 3u + 4 + 2);
}

TEST(FieldsInLists, TellTheirWaves) {
  EXPECT_EQ(test::MovingFields().with_objects(7).waves_on_a_circle, 7);
  EXPECT_EQ(test::MovingFields().recorded().waves_on_a_circle, 0);
}

TEST(UniformRotation, IsDeclaredAndTried) {
  const test::MovingFields fields;
  const UniformRotation turn{{{0, 1}}, fields.rate};
  const DynamicalSystem system = with_uniform_rotation(fields.turning_body(), turn);
  EXPECT_EQ(system.conserved_quantity(), ConservedQuantity::jacobi_integral);
  EXPECT_EQ(fields.turning_body().conserved_quantity(), ConservedQuantity::none);
  EXPECT_FALSE(conserved_list(fields.turning_body()));
  test::expect_error(ErrorKind::usage, "changes by", [&] {
    with_uniform_rotation(fields.turning_body(), {{{0, 1}}, 2 * fields.rate});
  });
  test::expect_error(ErrorKind::usage, "changes by",
                     [&] { with_uniform_rotation(fields.with_objects(), turn); });
  // No rotation leaves this system unchanged at a given time.
  test::expect_error(ErrorKind::usage, "changes by", [&] {
    with_rotation(fields.turning_body(), {{0, 1}});
  });
}

}  // namespace
}  // namespace hamjet
