#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

#include "hamjet/algebra/calculus.hpp"
#include "hamjet/detail/dynamics/expression.hpp"
#include "support/errors.hpp"
#include "support/flow.hpp"
#include "support/random_series.hpp"

namespace hamjet {
namespace {

using Inputs = std::span<const Expression>;
using Outputs = std::vector<Expression>;

std::size_t operations_of(const OperationList& list) {
  return list.operations().size() - list.inputs();
}

/// Uses every operation code once, on three inputs near one.
Outputs every_operation(Inputs x) {
  const Expression a = x[0] * x[1] + 2 * x[2] - 1;
  const Expression b = square(x[1]) / (x[0] + x[2]);
  return {exp(a * b / 8) + log(x[0] + 2), pow(x[1] + x[2], Expression(-1.5)) * sin(a) + cos(b),
          sqrt(x[0] + square(x[2])) - 1 / x[1] + atan2(x[0], x[1]) * x[2],
          pow(x[2], Expression(0.3)) * cos(a) + 4 + tanh(a)};
}

TEST(Recording, HoldsEveryOperationCode) {
  const OperationList list = record(3, every_operation);
  std::vector<bool> seen(13, false);
  for (const Operation& o : list.operations()) seen[static_cast<std::size_t>(o.code)] = true;
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_TRUE(seen[i]) << "code " << i;
}

TEST(Recording, FoldsZerosOnesAndConstants) {
  const auto count = [](auto f) { return operations_of(record(2, f)); };
  EXPECT_EQ(count([](Inputs x) { return Outputs{x[0] * 1 + 0}; }), 0u);
  EXPECT_EQ(count([](Inputs x) { return Outputs{pow(x[0], Expression(1))}; }), 0u);
  EXPECT_EQ(count([](Inputs x) { return Outputs{-(-x[0])}; }), 0u);
  EXPECT_EQ(count([](Inputs x) { return Outputs{x[0] + x[1] - x[1]}; }), 0u);
  // A vanishing factor removes everything that depends on it: one constant is left.
  const OperationList zero = record(2, [](Inputs x) { return Outputs{0 * exp(x[0]) * x[1]}; });
  EXPECT_EQ(operations_of(zero), 1u);
  EXPECT_TRUE(output_vanishes(zero, 0));
  EXPECT_EQ(test::evaluate_list(record(1,
                                       [](Inputs) {
                                         return Outputs{sin(Expression(0)) + exp(Expression(0)) +
                                                        Expression(3) / 4};
                                       }),
                                std::vector<double>{7})[0],
            1.75);
}

TEST(Recording, RecordsEqualOperationsOnce) {
  // (x y)^2 + (y x)^2 is one product, one square and one sum; x x is a square.
  EXPECT_EQ(operations_of(record(
                2, [](Inputs x) { return Outputs{square(x[0] * x[1]) + square(x[1] * x[0])}; })),
            3u);
  const OperationList list = record(1, [](Inputs x) { return Outputs{x[0] * x[0]}; });
  EXPECT_EQ(list.operations()[1].code, OperationCode::square);
  // Sine and cosine of one argument are one pair.
  EXPECT_EQ(operations_of(record(1,
                                 [](Inputs x) {
                                   return Outputs{sin(x[0]) + cos(x[0]), cos(x[0])};
                                 })),
            3u);
}

// Identities of the functions that are made of others, at all degrees: tan(atan x) = x and the like,
// sinh and cosh by the exponential function, and the angle of a point in each quadrant.
TEST(Recording, HasTheFunctionsMadeOfOthers) {
  const auto space = SeriesSpace::create(2, 6);
  const OperationList identities = record(2, [](Inputs z) {
    const Expression x = z[0], y = z[1];
    const Expression r = sqrt(x * x + y * y), angle = atan2(y, x);
    return Outputs{tan(atan(x)) - x,
                   sin(asin(x / r)) - x / r,
                   cos(acos(x / r)) - x / r,
                   asin(x / r) + acos(x / r) - acos(Expression(0)),
                   r * cos(angle) - x,
                   r * sin(angle) - y,
                   sinh(x) - (exp(x) - exp(-x)) / 2,
                   cosh(x) - (exp(x) + exp(-x)) / 2,
                   tanh(x) - 1 + 2 / (exp(2 * x) + 1)};
  });
  for (const double x : {0.75, -0.75}) {
    for (const double y : {0.5, -0.5}) {
      const auto values = evaluate_on_series(
          identities, std::vector{Series<Extended>::variable(space, 0, Extended(x)),
                                  Series<Extended>::variable(space, 1, Extended(y))});
      for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_LE(test::largest_coefficient(values[i]), 1e-28) << "identity " << i << " at " << x;
      }
    }
  }
}

TEST(Recording, FoldsTheFunctionsOfConstants) {
  const auto value = [](const Expression& e) {
    EXPECT_TRUE(e.is_constant());
    return static_cast<double>(e.constant());
  };
  EXPECT_DOUBLE_EQ(value(atan2(Expression(1), Expression(-1))), 3 * std::acos(-1.0) / 4);
  EXPECT_DOUBLE_EQ(value(acos(Expression(-1))), std::acos(-1.0));
  EXPECT_DOUBLE_EQ(value(sinh(Expression(1))), std::sinh(1.0));
  EXPECT_DOUBLE_EQ(value(cosh(Expression(1))), std::cosh(1.0));
  EXPECT_DOUBLE_EQ(value(tan(Expression(1))), std::tan(1.0));
  // On the negative x axis, where the angle jumps and its derivatives do not: d angle / dy = 1/x.
  const OperationList list = record(2, [](Inputs z) { return Outputs{atan2(z[1], z[0])}; });
  const auto slopes = test::evaluate_list(gradient(list), std::vector<double>{-2, 0});
  EXPECT_DOUBLE_EQ(slopes[0], 0);
  EXPECT_DOUBLE_EQ(slopes[1], -0.5);
}

TEST(Recording, DropsWhatNoOutputNeeds) {
  EXPECT_EQ(operations_of(record(2,
                                 [](Inputs x) {
                                   const Expression unused = exp(x[0] * x[1]);
                                   (void)unused;
                                   return Outputs{x[0] + x[1]};
                                 })),
            1u);
}

TEST(Recording, ZonalGravityCostsLessWithEachTermLeftOut) {
  const auto sizes = [](const ZonalGravity& field) {
    const auto system = zonal_gravity(field);
    return std::vector<std::size_t>{
        operations_of(system.hamiltonian), operations_of(system.vector_field),
        operations_of(system.second_order->force), system.vector_field.nonlinear_operations()};
  };
  const auto both = sizes({.mu = 1, .radius = 0.9, .J = {{2, 1e-3}, {3, 2e-6}}});
  const auto J2_alone = sizes({.mu = 1, .radius = 0.9, .J = {{2, 1e-3}}});
  const auto J3_alone = sizes({.mu = 1, .radius = 0.9, .J = {{3, 2e-6}}});
  const auto neither = sizes({.mu = 1, .radius = 0.9});
  for (std::size_t i = 0; i < both.size(); ++i) {
    EXPECT_GT(both[i], J2_alone[i]) << i;
    EXPECT_GT(J2_alone[i], neither[i]) << i;
    EXPECT_GT(J3_alone[i], neither[i]) << i;
  }
  // An absent coefficient and a zero coefficient give the same list.
  EXPECT_EQ(neither, sizes({}));
}

TEST(Recording, RefusesVariableExponentsTwoRecordingsAndDivisionByZero) {
  test::expect_error(ErrorKind::usage, "exponent",
                     [] { record(2, [](Inputs x) { return Outputs{pow(x[0], x[1])}; }); });
  test::expect_error(ErrorKind::usage, "division by zero",
                     [] { record(1, [](Inputs x) { return Outputs{x[0] / 0}; }); });
  Recorder a(1);
  Recorder b(1);
  // The two inputs have the same number, so a mix-up would pass for a square.
  test::expect_error(ErrorKind::usage, "two recordings", [&] { (void)(a.input(0) + b.input(0)); });
  test::expect_error(ErrorKind::usage, "two recordings", [&] { (void)(a.input(0) * b.input(0)); });
}

TEST(OperationList, KnowsDependenciesAndAffineValues) {
  const OperationList list = record(3, [](Inputs x) {
    return Outputs{x[0] + 2 * x[2] - 1, x[1] * x[2], Expression(3)};
  });
  EXPECT_EQ(list.dependencies(list.outputs()[0]), 0b101u);
  EXPECT_EQ(list.dependencies(list.outputs()[1]), 0b110u);
  EXPECT_EQ(list.dependencies(list.outputs()[2]), 0u);
  EXPECT_TRUE(list.is_affine(list.outputs()[0]));
  EXPECT_FALSE(list.is_affine(list.outputs()[1]));
  EXPECT_FALSE(list.is_linear_system());
  EXPECT_EQ(list.nonlinear_operations(), 1u);
}

TEST(Jacobian, EqualsDifferenceQuotientsAndGradients) {
  const OperationList list = record(3, every_operation);
  const OperationList derivatives = jacobian(list);
  test::RandomNumbers random(41);
  const Extended h = Extended(1) / Extended(1ull << 40);
  for (int trial = 0; trial < 5; ++trial) {
    std::vector<Extended> x;
    for (int i = 0; i < 3; ++i) x.push_back(random.uniform(0.7, 1.4));
    const auto values = test::evaluate_list(derivatives, x);
    for (std::size_t j = 0; j < 3; ++j) {
      auto up = x;
      auto down = x;
      up[j] += h;
      down[j] -= h;
      const auto above = test::evaluate_list(list, up);
      const auto below = test::evaluate_list(list, down);
      for (std::size_t o = 0; o < 4; ++o) {
        // Central differences: h^2 f'''/6 = 1e-25 times third derivatives below 1e3, and
        // epsilon / h = 2e-22 of rounding.
        const Extended quotient = (above[o] - below[o]) / (2 * h);
        EXPECT_LE(std::abs(static_cast<double>(Extended(values[o * 3 + j] - quotient))), 2e-20);
      }
    }
    // Reverse accumulation gives the same as forward accumulation.
    for (std::size_t o = 0; o < 4; ++o) {
      const OperationList one = record(3, [&](Inputs z) { return Outputs{every_operation(z)[o]}; });
      const auto slopes = test::evaluate_list(gradient(one), x);
      for (std::size_t j = 0; j < 3; ++j) {
        EXPECT_LE(std::abs(static_cast<double>(Extended(slopes[j] - values[o * 3 + j]))), 1e-31);
      }
    }
  }
}

TEST(Gradient, EqualsTheDerivativeOfTheSeries) {
  const auto space = SeriesSpace::create(3, 5);
  std::vector<Series<Extended>> x;
  for (std::size_t i = 0; i < 3; ++i)
    x.push_back(Series<Extended>::variable(space, i, Extended(8 + i) / 8));
  const OperationList list = record(3, [](Inputs z) { return Outputs{every_operation(z)[1]}; });
  const std::vector<Series<Extended>>& inputs = x;
  const auto value = evaluate_on_series(list, inputs)[0];
  const auto slopes = evaluate_on_series(gradient(list), inputs);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LE(test::largest_coefficient(derivative(value, i) - slopes[i], 4),
              1e-30 * (1 + test::largest_coefficient(value)));
  }
}

TEST(Gradient, RefusesSeveralOutputs) {
  test::expect_error(ErrorKind::usage, "one output", [] { gradient(record(3, every_operation)); });
}

TEST(Replay, RefusesAnotherNumberOfInputs) {
  const OperationList list = record(3, every_operation);
  test::expect_error(ErrorKind::usage, "wrong number of inputs",
                     [&] { record(2, [&](Inputs x) { return replay(list, x); }); });
}

}  // namespace
}  // namespace hamjet
