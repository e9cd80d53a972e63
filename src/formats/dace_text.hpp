#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/algebra/truncated_power_series.hpp"

// The text of DACE (https://github.com/dacelib/dace), the Differential Algebra Computational
// Engine, for a vector of polynomials: core/daceio.c, functions daceWrite and daceRead, and
// interfaces/cxx/include/dace/AlgebraicVector_t.h, operators << and >>:
//
//   [[[ 2 vector
//        I  COEFFICIENT              ORDER EXPONENTS
//        1    1.0000000000000000e+00   1   1  0
//        2   -1.6666666666666666e-01   3   3  0
//   ------------------------------------------------
//           ALL COEFFICIENTS ZERO
//   ------------------------------------------------
//   ]]]
//
// DACE reads a row by its columns: 6 for its number, 2 blanks, 24 for the coefficient, 4 for the
// degree, a blank, and 3 for each exponent. The coefficient has 17 significant digits, which bring
// back every double bit by bit. Lines end before column 140, so that there are at most 34
// variables. The format has no place for names, units or more digits; DACE reads nothing behind the
// line ]]].
//
// DACE prints one blank line more behind each polynomial of a vector, but its operator >> takes
// that line for the head of the next polynomial (error 32). The blank line is left out here, so
// that DACE can read the text; when reading, it is accepted.

namespace hamjet::io {

struct OutputFormat;

/// `jet.dace` of each run; the reader of jets takes its coefficients together with a
/// `summary.json`.
extern const OutputFormat dace_format;

/// The text of polynomials, with each coefficient rounded to double precision; coefficients that
/// are +0 are left out, as in DACE. The lines of `notes` follow behind the end, each after a #.
/// Throws Error(input_output) for content that the text cannot hold: more than 34 variables, more
/// than 999999 coefficients of one polynomial, a coefficient beyond double precision.
std::string dace_text(const std::vector<Series<Extended>>& polynomials,
                      const std::vector<std::string>& notes = {});

/// Reads the text of polynomials in the variables and up to the order of `space`. The lines [[[ and
/// ]]] may be there or, as for a single polynomial, absent. `name` is the file's name for messages.
/// Throws Error(input_output), with one line that names file and line, for any other text. Content
/// that DACE would add up, cut off or skip is refused as well, for example a repeated coefficient,
/// or a degree that is not the sum of the exponents.
std::vector<Series<double>> read_dace_text(const std::string& name, std::string_view text,
                                           const SpacePointer& space);

/// Reads the text of polynomials in as many variables as its rows have, up to the highest degree in
/// it (at least 1); otherwise as with `space`. It also throws Error(input_output) if there is no
/// row, which would give the number of variables, and Error(too_large) for more than 1e5
/// coefficients.
std::vector<Series<double>> read_dace_text(const std::string& name, std::string_view text);

}  // namespace hamjet::io
