#include "formats/dace_text.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "../scene/scene_samples.hpp"

// Text that DACE has printed is read; what is written has its columns and comes back bit by bit.

namespace hamjet::io {
namespace {

// Printed by DACE 2: y = sin(x) of order 20, from the README of DACE.jl
// (https://github.com/a-ev/DACE.jl, examples/sine.jl).
constexpr const char* sine = R"(     I  COEFFICIENT              ORDER EXPONENTS
     1    1.0000000000000000e+00   1   1
     2   -1.6666666666666666e-01   3   3
     3    8.3333333333333332e-03   5   5
     4   -1.9841269841269841e-04   7   7
     5    2.7557319223985893e-06   9   9
     6   -2.5052108385441720e-08  11  11
     7    1.6059043836821616e-10  13  13
     8   -7.6471637318198174e-13  15  15
     9    2.8114572543455210e-15  17  17
    10   -8.2206352466243310e-18  19  19
------------------------------------------------
)";

// The columns follow core/daceio.c of DACE: "%6u  %24.16e%4u " and " %2u" for each exponent.
constexpr const char* two_polynomials = R"([[[ 2 vector
     I  COEFFICIENT              ORDER EXPONENTS
     1    1.5000000000000000e+00   0   0  0
     2   -2.0000000000000000e+00   1   0  1
     3    1.0000000000000001e-01   3   2  1
------------------------------------------------
        ALL COEFFICIENTS ZERO
------------------------------------------------
]]]
)";

std::vector<Series<Extended>> extended(const std::vector<Series<double>>& polynomials) {
  std::vector<Series<Extended>> result;
  for (const auto& polynomial : polynomials) {
    auto& series = result.emplace_back(polynomial.space_pointer());
    for (std::size_t k = 0; k < polynomial.size(); ++k) series[k] = Extended(polynomial[k]);
  }
  return result;
}

TEST(DaceTextTest, ReadsWhatDacePrinted) {
  const auto polynomials = read_dace_text("sine.dace", sine);
  ASSERT_EQ(polynomials.size(), 1U);
  ASSERT_EQ(polynomials[0].order(), 19);
  ASSERT_EQ(polynomials[0].space().variables(), 1U);
  Extended factorial = 1;
  for (int k = 0; k < 20; ++k) {
    if (k > 0) factorial *= k;
    // The expected value is the closed form; DACE's own recurrence is wrong by a unit in the last
    // place for some terms.
    const double right = k % 2 == 0 ? 0 : static_cast<double>((k % 4 == 1 ? 1 : -1) / factorial);
    EXPECT_NEAR(polynomials[0][static_cast<std::size_t>(k)], right, 4e-16 * std::abs(right)) << k;
  }
  // Written again, the text is identical to DACE's.
  EXPECT_EQ(dace_text(extended(polynomials)), std::string("[[[ 1 vector\n") + sine + "]]]\n");
}

TEST(DaceTextTest, HasTheColumnsOfDace) {
  const auto space = SeriesSpace::create(2, 3);
  std::vector<Series<Extended>> polynomials(2, Series<Extended>(space));
  polynomials[0][0] = 1.5;
  polynomials[0][space->index(std::vector<std::uint8_t>{0, 1})] = -2;
  polynomials[0][space->index(std::vector<std::uint8_t>{2, 1})] = 0.1;
  EXPECT_EQ(dace_text(polynomials), two_polynomials);
  EXPECT_EQ(dace_text(polynomials, {"one\ntwo"}), std::string(two_polynomials) + "# one\\x0atwo\n");
}

TEST(DaceTextTest, ComesBackBitByBit) {
  using Limits = std::numeric_limits<double>;
  const auto space = SeriesSpace::create(3, 4);
  std::vector<Series<double>> polynomials(3, Series<double>(space));
  const double extremes[] = {-0.0,           0.0,           Limits::denorm_min(),
                             -Limits::min(), Limits::max(), -Limits::max(),
                             1 / 3.0,        -2 / 3.0,      std::nextafter(1.0, 2.0)};
  std::copy(std::begin(extremes), std::end(extremes), polynomials[0].coefficients().begin());
  std::uint64_t bits = 1;
  for (double& coefficient : polynomials[1].coefficients()) {
    do {
      bits = bits * 6364136223846793005U + 1442695040888963407U;
      coefficient = std::bit_cast<double>(bits);
    } while (!std::isfinite(coefficient));
  }
  const std::string text = dace_text(extended(polynomials), {"a note", "another"});
  const auto again = read_dace_text("again", text, space);
  ASSERT_EQ(again.size(), polynomials.size());
  for (std::size_t i = 0; i < again.size(); ++i) {
    for (std::size_t k = 0; k < space->size(); ++k) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(again[i][k]),
                std::bit_cast<std::uint64_t>(polynomials[i][k]))
          << i << " " << k;
    }
  }
}

TEST(DaceTextTest, BlankLinesBetweenPolynomialsAsDacePrintsThem) {
  const std::string printed =
      changed(changed(two_polynomials, "---\n  ", "---\n\n  "), "---\n]]]", "---\n\n]]]");
  const auto polynomials = read_dace_text("printed", printed);
  ASSERT_EQ(polynomials.size(), 2U);
  EXPECT_EQ(polynomials[0].constant(), 1.5);
  EXPECT_EQ(polynomials[1].constant(), 0);
}

TEST(DaceTextTest, WhatTheTextCannotHold) {
  const std::vector<Series<Extended>> wide(1, Series<Extended>(SeriesSpace::create(35, 1)));
  expect_error([&] { dace_text(wide); }, ErrorKind::input_output, {"35 variables", "at most 34"},
               "wide");
  const std::vector<Series<Extended>> large(
      1, Series<Extended>(SeriesSpace::create(1, 1), Extended("1e400")));
  expect_error([&] { dace_text(large); }, ErrorKind::input_output, {"beyond double precision"},
               "large");
}

void expect_refused(const std::string& from, const std::string& to,
                    std::vector<std::string> words) {
  const std::string text = changed(two_polynomials, from, to);
  words.insert(words.begin(), "jet.dace:");
  const auto space = SeriesSpace::create(2, 3);
  expect_error([&] { read_dace_text("jet.dace", text, space); }, ErrorKind::input_output, words,
               to);
  expect_error([&] { read_dace_text("jet.dace", text); }, ErrorKind::input_output, {"jet.dace:"},
               to);
}

TEST(DaceTextTest, DamagedText) {
  expect_refused("[[[ 2", "[[[ 3", {":9:", "head of a polynomial"});
  expect_refused("[[[ 2", "[[[ 1", {":7:", "must be ]]] after 1 polynomials"});
  expect_refused("[[[ 2", "[[[ x", {":1:", "number of polynomials"});
  expect_refused("[[[ 2", "[[[ 99999999999", {":1:", "number of polynomials"});
  expect_refused("]]]\n", "", {":9:", "end of the file"});
  expect_refused("]]]", "]]", {":9:", "must be ]]]"});
  expect_refused("]]]\n", "]]]\nmore\n", {":10:", "nothing but notes"});
  expect_refused("EXPONENTS", "EXPONENT", {":2:", "head of a polynomial"});
  // The header of COSY INFINITY.
  expect_refused("COEFFICIENT              O", "COEFFICIENT            O", {":2:", "head"});
  expect_refused("-------\n  ", "-------\n  more\n  ", {":7:"});
  expect_refused("ZERO\n", "ZERO\n     1    1.5000000000000000e+00   0   0  0\n",
                 {":8:", "line of dashes"});
  expect_refused("     2  ", "     3  ", {":4:", "number of the row must be 2"});
  expect_refused("   1   0  1", "   1   0", {":4:", "exponents of 1 variables, must be 2"});
  expect_refused("   1   0  1", "   1   0  1  0", {":4:", "exponents of 3 variables"});
  expect_refused("   3   2  1", "   3   2 1", {":5:", "columns"});
  expect_refused("   3   2  1", "   3   2 ,1", {":5:", "EXPONENTS", "variable 2"});
  expect_refused("   3   2  1", "   3   2 -1", {":5:", "EXPONENTS"});
  expect_refused("   3   2  1", "   2   2  1", {":5:", "ORDER: must be 3"});
  expect_refused("   3   2  1", "       2  1", {":5:", "ORDER: must be 3"});
  expect_refused("   1   0  1", "   0   0  0", {":4:", "same exponents as in line 3"});
  for (const char* bad :
       {"                     nan", "                     inf", "                        ",
        "  1.00000000000000x1e-01", "  1.0000000000000001e999", "  0x1.0000000000000p+001"}) {
    expect_refused("  1.0000000000000001e-01", bad, {":5:", "COEFFICIENT"});
  }
  const auto space = SeriesSpace::create(2, 2);
  expect_error([&] { read_dace_text("jet.dace", two_polynomials, space); }, ErrorKind::input_output,
               {"jet.dace:5: ORDER: 3 is above the order 2"}, "order");
  for (const std::string text : {"", "\n\n", "[[[ 2 vector\n", "     I  COEFFICIENT"}) {
    expect_error([&] { read_dace_text("jet.dace", text, space); }, ErrorKind::input_output,
                 {"jet.dace:"}, "cut: " + text);
  }
}

TEST(DaceTextTest, CutAnywhere) {
  const std::string text = two_polynomials;
  const auto space = SeriesSpace::create(2, 3);
  // The text is whole without its last line end.
  for (std::size_t length = 0; length + 1 < text.size(); ++length) {
    expect_error([&] { read_dace_text("jet.dace", text.substr(0, length), space); },
                 ErrorKind::input_output, {"jet.dace:"}, std::to_string(length));
  }
}

TEST(DaceTextTest, AnOrderThatWouldFillTheMemory) {
  std::string text =
      "     I  COEFFICIENT              ORDER EXPONENTS\n"
      "     1    1.0000000000000000e+00  60  60  0  0  0  0  0  0  0\n"
      "------------------------------------------------\n";
  expect_error([&] { read_dace_text("jet.dace", text); }, ErrorKind::too_large,
               {"jet.dace: order 60 in 8 variables"}, "large");
}

}  // namespace
}  // namespace hamjet::io
