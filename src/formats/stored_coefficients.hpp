#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet::io {

struct OutputFormat;

/// `jet.csv`, which each run has without a request.
extern const OutputFormat csv_format;

/// A number with 36 digits, which bring back the same 113 bits, and with the sign of zero.
std::string extended_digits(const Extended& number);

/// Digits that bring back the same number: 17 for binary64, 36 for 113 bits.
std::string coefficient_digits(const Extended& value, Precision precision);

/// A finite number in the form of jet.csv; no value for any other text.
std::optional<Extended> parse_coefficient(std::string_view text, Precision precision);

/// The content that a file `jet.csv` must have according to its `summary.json`.
struct CoefficientFile {
  std::string name;                     ///< the file's name for messages
  std::vector<std::string_view> names;  ///< names of the model's variables
  std::vector<std::size_t> components;  ///< indices of names
  std::vector<std::size_t> variables;   ///< indices of the names in which the jet is expanded
  int order;
  Precision precision;
};

/// Reads the text of a `jet.csv`: one row for each component and monomial, in any order. Throws
/// Error(input_output), with one line that names file and line, for any other content.
FlowJet<Extended> read_coefficients(const CoefficientFile& file, std::string_view text);

/// Series in the form of `jet.csv`: a row for each series of `jet`, by its name, and each monomial.
/// The exponents stand in the columns e_... of `columns`: that of variable v in column `places[v]`,
/// and 0 in the others.
std::string series_csv(const std::vector<std::string_view>& series,
                       const std::vector<std::string_view>& columns,
                       const std::vector<std::size_t>& places, Precision precision,
                       const FlowJet<Extended>& jet);

/// The text of a `jet.csv`; components and variables are indices of the names of the model's state.
std::string coefficients_csv(const std::vector<std::string_view>& names,
                             const std::vector<std::size_t>& components,
                             const std::vector<std::size_t>& variables, Precision precision,
                             const FlowJet<Extended>& jet);

}  // namespace hamjet::io
