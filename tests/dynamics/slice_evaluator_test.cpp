#include "hamjet/detail/dynamics/slice_evaluator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "hamjet/algebra/elementary_functions.hpp"
#include "hamjet/detail/dynamics/expression.hpp"
#include "support/random_series.hpp"

namespace hamjet {
namespace {

constexpr int order = 5;

/// A function that uses every operation code, as a template over its number type.
template <class T, class Number>
std::vector<T> every_operation(const std::vector<T>& x, Number number) {
  const T a = x[0] * x[1] + number(2) * x[2] - number(1);
  const T b = square(x[1]) / (x[0] + x[2]);
  return {exp(a * b * number(0.125)) + log(x[0] + number(2)),
          pow(x[1] + x[2], number(-1.5)) * sin(a) + cos(b) * cos(a),
          sqrt(x[0] + square(x[2])) - pow(x[1], number(-1)),
          pow(square(x[2]) + a * a, number(0.3)) + sin(x[1]),
          x[0] - number(3) * x[2],
          T(x[1])};
}

OperationList recorded() {
  return record(3, [](std::span<const Expression> x) {
    return every_operation(std::vector<Expression>(x.begin(), x.end()),
                           [](double c) { return Expression(c); });
  });
}

template <class T>
std::vector<Series<T>> sample_inputs(const SpacePointer& space) {
  test::RandomNumbers random(61);
  std::vector<Series<T>> inputs;
  for (int i = 0; i < 3; ++i) {
    inputs.push_back(test::random_series<T>(space, random, {0.8, 1.3}, 0.2));
  }
  return inputs;
}

template <class T>
SliceEvaluator<T, double> evaluated(const OperationList& list,
                                    const std::vector<Series<T>>& inputs) {
  SliceEvaluator<T, double> evaluator(list, inputs[0].space_pointer(), order);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    std::copy(inputs[i].coefficients().begin(), inputs[i].coefficients().end(), evaluator.input(i));
  }
  evaluator.evaluate_all();
  return evaluator;
}

TEST(SliceEvaluator, EqualsTheOperatorsOfSeries) {
  const auto space = SeriesSpace::create(3, order);
  const auto inputs = sample_inputs<double>(space);
  const auto expected = every_operation(inputs, [](double c) { return c; });
  const OperationList list = recorded();
  const auto evaluator = evaluated(list, inputs);
  for (std::size_t o = 0; o < expected.size(); ++o) {
    const Series<double> value(
        space, std::vector<double>(evaluator.output(o), evaluator.output(o) + space->size()));
    for (int d = 0; d <= order; ++d) {
      // The two arrangements of one expression differ by dozens of roundings of intermediate slices
      // that are larger than the result by a factor of about ten.
      EXPECT_LE(test::largest_of_degree(value - expected[o], d),
                1e3 * test::epsilon_of<double>() * (1 + test::largest_of_degree(expected[o], d)))
          << "output " << o << ", degree " << d;
    }
  }
}

TEST(SliceEvaluator, RunsEveryLaneAlike) {
  using P = Pack<double, 4>;
  const auto space = SeriesSpace::create(2, order);
  const auto packs = sample_inputs<P>(space);
  const OperationList list = recorded();
  const auto together = evaluated(list, packs);
  for (int lane = 0; lane < 4; ++lane) {
    std::vector<Series<double>> inputs;
    for (const auto& u : packs) {
      inputs.emplace_back(space);
      for (std::size_t k = 0; k < space->size(); ++k) inputs.back()[k] = u[k].lane(lane);
    }
    const auto alone = evaluated(list, inputs);
    for (std::size_t o = 0; o < list.outputs().size(); ++o) {
      for (std::size_t k = 0; k < space->size(); ++k) {
        const double value = alone.output(o)[k];
        EXPECT_NEAR(together.output(o)[k].lane(lane), value, 1e-13 * (1 + std::abs(value)));
      }
    }
  }
}

TEST(SliceEvaluator, SplitsEachSliceIntoRemainderAndLinearPart) {
  const auto space = SeriesSpace::create(3, order);
  const auto inputs = sample_inputs<double>(space);
  const OperationList list = recorded();
  const auto whole = evaluated(list, inputs);
  SliceEvaluator<double, double> split(list, space, order);
  for (std::size_t i = 0; i < 3; ++i) *split.input(i) = inputs[i][0];
  split.evaluate_constant_terms();
  for (int d = 1; d <= order; ++d) {
    // The values in the inputs' slice of this degree must not matter yet.
    for (std::size_t i = 0; i < 3; ++i) {
      std::fill_n(split.input(i) + space->first(d), space->count(d), 1e10);
    }
    split.evaluate_remainder(d);
    for (std::size_t o = 0; o < list.outputs().size(); ++o) {
      for (std::size_t k = space->first(d); k < space->first(d + 1); ++k) {
        const double remainder = split.has_remainder(o, d) ? split.remainder(o)[k] : 0;
        double linear = 0;
        for (std::size_t j = 0; j < 3; ++j) linear += split.output_gradient(o, j) * inputs[j][k];
        EXPECT_NEAR(remainder + linear, whole.output(o)[k], 1e-12 * (1 + std::abs(linear)))
            << "output " << o << ", degree " << d;
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      std::copy_n(&inputs[i][space->first(d)], space->count(d), split.input(i) + space->first(d));
    }
    split.complete(d);
  }
  // The same sums in another order.
  for (std::size_t o = 0; o < list.outputs().size(); ++o) {
    for (std::size_t k = 0; k < space->size(); ++k) {
      const double value = whole.output(o)[k];
      EXPECT_NEAR(split.output(o)[k], value, 1e-12 * (1 + std::abs(value))) << "output " << o;
    }
  }
}

/// Lists of one to seven outputs: some outputs are alike, constant, affine, inputs, or operands of
/// others. Whole numbers are not rounded, and the values are computed by hand: x = 1 + 2 u + v, y =
/// 3 + u - v.
TEST(SliceEvaluator, FormsOutputsOfEveryKindAndNumber) {
  const auto functions = [](auto x, auto y) {
    const auto product = x * y;
    const auto square_of_it = product * product;
    return std::vector{product, square_of_it, product, x + y, y, square_of_it + x, product - y};
  };
  const auto space = SeriesSpace::create(2, 4);
  const auto u = Series<double>::variable(space, 0);
  const auto v = Series<double>::variable(space, 1);
  const std::vector<Series<double>> inputs = {1.0 + 2.0 * u + v, 3.0 + u - v};
  const auto expected = functions(inputs[0], inputs[1]);
  for (std::size_t count = 1; count <= expected.size(); ++count) {
    const OperationList list = record(2, [&](std::span<const Expression> x) {
      auto all = functions(x[0], x[1]);
      all.resize(count);
      all.push_back(Expression(7.0));
      return all;
    });
    SliceEvaluator<double, double> whole(list, space, 4);
    SliceEvaluator<double, double> split(list, space, 4);
    for (std::size_t i = 0; i < 2; ++i) {
      std::copy_n(inputs[i].coefficients().data(), space->size(), whole.input(i));
      *split.input(i) = inputs[i][0];
    }
    whole.evaluate_all();
    split.evaluate_constant_terms();
    for (int d = 1; d <= 4; ++d) {
      split.evaluate_remainder(d);
      for (std::size_t i = 0; i < 2; ++i) {
        std::copy_n(&inputs[i][space->first(d)], space->count(d), split.input(i) + space->first(d));
      }
      split.complete(d);
    }
    for (std::size_t o = 0; o < count; ++o) {
      for (std::size_t k = 0; k < space->size(); ++k) {
        EXPECT_EQ(whole.output(o)[k], expected[o][k]) << count << " outputs, output " << o;
        EXPECT_EQ(split.output(o)[k], expected[o][k]) << count << " outputs, output " << o;
      }
      // The linear coefficients are those of the gradient along x and y.
      EXPECT_EQ(2 * split.output_gradient(o, 0) + split.output_gradient(o, 1), expected[o][1]);
      EXPECT_EQ(split.output_gradient(o, 0) - split.output_gradient(o, 1), expected[o][2]);
    }
    for (std::size_t k = 0; k < space->size(); ++k) {
      EXPECT_EQ(whole.output(count)[k], k == 0 ? 7 : 0);
      EXPECT_EQ(split.output(count)[k], k == 0 ? 7 : 0);
    }
  }
}

/// The derivative of a root at 0 is not finite; outputs that do not depend on the root are as they
/// would be alone.
TEST(SliceEvaluator, AnOutputThatIsNotFiniteLeavesTheOthersAlone) {
  const OperationList list = record(2, [](std::span<const Expression> x) {
    return std::vector{x[0] * x[1], sqrt(x[0]), x[0] + 2 * x[1]};
  });
  const auto space = SeriesSpace::create(2, 3);
  SliceEvaluator<double, double> evaluator(list, space, 3);
  for (std::size_t i = 0; i < 2; ++i) {
    *evaluator.input(i) = static_cast<double>(i);
    evaluator.input(i)[space->linear_index(i)] = 1;
  }
  evaluator.evaluate_all();
  EXPECT_FALSE(std::isfinite(evaluator.output_gradient(1, 0)));
  for (std::size_t k = 0; k < space->size(); ++k) {
    const auto exponents = space->exponents(k);
    const bool is_x = space->degree(k) == 1 && exponents[0] == 1;
    const bool is_y = space->degree(k) == 1 && exponents[1] == 1;
    const bool is_product = space->degree(k) == 2 && exponents[0] == 1;
    EXPECT_EQ(evaluator.output(0)[k], is_x || is_product ? 1 : 0);  // x (1 + y)
    EXPECT_EQ(evaluator.output(2)[k], k == 0 || is_y ? 2 : (is_x ? 1 : 0));
  }
  EXPECT_EQ(evaluator.output_gradient(0, 0), 1);
  EXPECT_EQ(evaluator.output_gradient(2, 1), 2);
}

// A force cos(q) is an output that no operation has as its operand, and the sums of its sine, which is
// needed for the next degree, are made of its slices.
TEST(SliceEvaluator, ThePartnerOfAPairIsCompletedWhereOutputsAreLeft) {
  const OperationList list = record(3, [](std::span<const Expression> x) {
    return std::vector<Expression>{cos(x[0] * x[1]), cosh(x[1] + x[2])};
  });
  const auto inputs = sample_inputs<double>(SeriesSpace::create(3, order));
  const auto expected = evaluated(list, inputs);
  SliceEvaluator<double, double> evaluator(list, inputs[0].space_pointer(), order);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    std::copy(inputs[i].coefficients().begin(), inputs[i].coefficients().end(), evaluator.input(i));
  }
  evaluator.evaluate_constant_terms();
  for (int d = 1; d <= order; ++d) {
    evaluator.evaluate_remainder(d);
    if (d < order) evaluator.complete_intermediates(d);
  }
  evaluator.complete(order);
  const SeriesSpace& space = inputs[0].space();
  for (std::size_t o = 0; o < 2; ++o) {
    for (std::size_t k = space.first(order); k < space.size(); ++k) {
      EXPECT_NEAR(evaluator.output(o)[k], expected.output(o)[k], 1e-13) << o << " " << k;
    }
  }
}

TEST(SliceEvaluator, AffineOutputsHaveNoRemainder) {
  const auto space = SeriesSpace::create(3, order);
  const OperationList list = recorded();
  const SliceEvaluator<double, double> evaluator(list, space, order);
  for (int d = 1; d <= order; ++d) {
    EXPECT_EQ(evaluator.has_remainder(0, d), d >= 2);
    EXPECT_FALSE(evaluator.has_remainder(4, d));
    EXPECT_FALSE(evaluator.has_remainder(5, d));
  }
}

TEST(SliceEvaluator, ALowerWorkingOrderGivesTheBeginning) {
  const auto space = SeriesSpace::create(3, order);
  const auto inputs = sample_inputs<double>(space);
  const OperationList list = recorded();
  const auto whole = evaluated(list, inputs);
  for (int highest = 0; highest < order; ++highest) {
    SliceEvaluator<double, double> part(list, space, highest);
    for (std::size_t i = 0; i < 3; ++i) {
      std::copy_n(inputs[i].coefficients().data(), space->first(highest + 1), part.input(i));
    }
    part.evaluate_all();
    for (std::size_t o = 0; o < list.outputs().size(); ++o) {
      for (std::size_t k = 0; k < space->first(highest + 1); ++k) {
        EXPECT_EQ(part.output(o)[k], whole.output(o)[k]);
      }
    }
  }
}

/// u^a for all the exponents, from one u.
TEST(SliceEvaluator, PowersOfOneValueAreMadeTogether) {
  for (const std::vector<double>& exponents : {std::vector<double>{-2.5, -1, -1.5, -3.5, -2},
                                               {-0.5, -3, -1.5},
                                               {-3, -1, -2},
                                               {-2, -3},
                                               {-4.5},
                                               {-1.5, 0.5, -0.3, -20}}) {
    const OperationList list = record(1, [&](std::span<const Expression> x) {
      std::vector<Expression> powers;
      for (const double a : exponents) powers.push_back(pow(x[0] + 1, Expression(a)));
      return powers;
    });
    SliceEvaluator<double, double> evaluator(list, SeriesSpace::create(1, 0), 0);
    *evaluator.input(0) = 0.37;
    evaluator.evaluate_constant_terms();
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      const double a = exponents[i];
      const double power = std::pow(1.37, a);
      // The bound counts one rounding for each factor, two more for the root and the division, and
      // one for pow.
      const double roundings = (2 * std::abs(a) + 5) * 0.5 * std::numeric_limits<double>::epsilon();
      EXPECT_NEAR(*evaluator.output(i), power, roundings * power) << a;
      const double slope = a * power / 1.37;
      EXPECT_NEAR(evaluator.output_gradient(i, 0), slope, 3 * roundings * std::abs(slope)) << a;
    }
  }
}

}  // namespace
}  // namespace hamjet
