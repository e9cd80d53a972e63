#include "dace_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "../text/scene_message.hpp"
#include "dace_columns.hpp"
#include "hamjet/error.hpp"
#include "jet_description.hpp"
#include "output_formats.hpp"

namespace hamjet::io {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ErrorKind::input_output, "DACE text: " + what);
}

bool is_written(double coefficient) { return coefficient != 0 || std::signbit(coefficient); }

void write_polynomial(fmt::memory_buffer& out, const Series<Extended>& polynomial) {
  const auto write = std::back_inserter(out);
  const SeriesSpace& space = polynomial.space();
  std::size_t rows = 0;
  for (std::size_t k = 0; k < space.size(); ++k) {
    const auto coefficient = static_cast<double>(polynomial[k]);
    if (!std::isfinite(coefficient)) refuse("a coefficient is beyond double precision");
    if (!is_written(coefficient)) continue;
    if (++rows > dace::most_rows) {
      refuse(fmt::format("more than {} coefficients of one polynomial do not fit its columns",
                         dace::most_rows));
    }
    if (rows == 1) fmt::format_to(write, "{}\n", dace::header);
    fmt::format_to(write, "{:6}  {:24.16e}{:4} ", rows, coefficient, space.degree(k));
    for (const auto exponent : space.exponents(k)) fmt::format_to(write, " {:2}", exponent);
    fmt::format_to(write, "\n");
  }
  if (rows == 0) fmt::format_to(write, "{}\n", dace::zero);
  fmt::format_to(write, "{}\n", dace::end);
}

FlowJet<Extended> read_dace_coefficients(const CoefficientFile& file, std::string_view text) {
  // Zero coefficients have no rows, so that a damaged order could ask for gigabytes of zeros.
  constexpr double most_zeros = 1000;
  const double terms = SeriesSpace::monomial_count(file.variables.size(), file.order);
  if (terms > most_zeros * static_cast<double>(text.size() + 1)) {
    throw Error(ErrorKind::input_output,
                fmt::format("{}: has far fewer coefficients than order {} in {} variables has",
                            file.name, file.order, file.variables.size()));
  }
  const auto space = SeriesSpace::create(file.variables.size(), file.order);
  const auto polynomials = read_dace_text(file.name, text, space);
  if (polynomials.size() != file.components.size()) {
    throw Error(ErrorKind::input_output,
                fmt::format("{}: has {} polynomials, must have {}", file.name, polynomials.size(),
                            file.components.size()));
  }
  FlowJet<Extended> jet;
  for (const Series<double>& polynomial : polynomials) {
    Series<Extended>& series = jet.emplace_back(space);
    std::copy(polynomial.coefficients().begin(), polynomial.coefficients().end(),
              series.coefficients().begin());
  }
  return jet;
}

}  // namespace

std::string dace_text(const std::vector<Series<Extended>>& polynomials,
                      const std::vector<std::string>& notes) {
  fmt::memory_buffer out;
  const auto write = std::back_inserter(out);
  fmt::format_to(write, "[[[ {} vector\n", polynomials.size());
  for (const Series<Extended>& polynomial : polynomials) {
    if (polynomial.space().variables() > dace::most_variables) {
      refuse(fmt::format("{} variables do not fit its lines, at most {} do",
                         polynomial.space().variables(), dace::most_variables));
    }
    write_polynomial(out, polynomial);
  }
  fmt::format_to(write, "]]]\n");
  for (const std::string& note : notes) {
    fmt::format_to(write, "# {}\n", printable(note, std::string::npos));
  }
  return fmt::to_string(out);
}

const OutputFormat dace_format = {
    .name = "dace",
    .help = "text of DACE",
    .file = "jet.dace",
    .ending = ".dace",
    .digits = 17,
    .of_jet =
        [](const StoredJet& stored) {
          return dace_text(stored.jet, jet_notes(stored, stored.order()));
        },
    .read_coefficients = read_dace_coefficients,
    .read_polynomials = read_dace_text,
};

}  // namespace hamjet::io
