#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>

#include "../store/text_file.hpp"
#include "../text/scene_message.hpp"
#include "dace_columns.hpp"
#include "dace_text.hpp"
#include "hamjet/error.hpp"

namespace hamjet::io {
namespace {

/// The largest number of coefficients if the text itself determines the numbers of variables and
/// orders.
constexpr double most_coefficients = 1e5;

struct Term {
  std::vector<std::uint8_t> exponents;
  double coefficient;
  std::size_t line;
};
using Terms = std::vector<Term>;

std::string_view without_blanks_before(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  return text;
}

template <class Number>
std::optional<Number> number_in(std::string_view columns) {
  const std::string_view text = without_blanks_before(columns);
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (text.empty() || error != std::errc() || rest != end) return std::nullopt;
  return number;
}

class DaceReader {
 public:
  /// `space` may be null.
  DaceReader(const std::string& name, std::string_view text, const SeriesSpace* space)
      : name_(name), rest_(text), space_(space), columns_(space ? space->variables() : 0) {}

  std::vector<Terms> read() {
    next_line();
    const bool is_vector = line_.starts_with("[[[");
    const std::size_t count = is_vector ? vector_size() : 0;
    if (is_vector) next_line();
    std::vector<Terms> polynomials;
    while (is_vector ? polynomials.size() < count : !at_end_) {
      polynomials.push_back(read_polynomial());
      next_line();
    }
    if (is_vector) {
      if (at_end_ || line_ != "]]]") {
        fail(fmt::format("must be ]]] after {} polynomials, got {}", count, shown()));
      }
      next_line();
      require_notes();
    }
    if (polynomials.empty()) fail("the file holds no polynomial");
    return polynomials;
  }

  /// The number of variables in the rows; 0 if there are no rows.
  std::size_t variables() const { return columns_; }

  [[noreturn]] void fail(const std::string& what) const { fail(line_number_, what); }
  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    throw Error(ErrorKind::input_output, fmt::format("{}:{}: {}", name_, line, what));
  }

 private:
  /// Takes the next line that is not blank. Blanks at the end of a line are ignored, because DACE
  /// pads lines.
  void next_line() {
    do {
      at_end_ = rest_.empty();
      line_ = take_line(rest_);
      ++line_number_;
      line_ = line_.substr(0, line_.find_last_not_of(' ') + 1);
    } while (line_.empty() && !at_end_);
  }

  std::string shown() const { return at_end_ ? "the end of the file" : in_quotes(line_); }

  std::size_t vector_size() const {
    const std::string_view word = without_blanks_before(line_.substr(3));
    const auto size = number_in<std::size_t>(word.substr(0, word.find(' ')));
    // A polynomial takes at least two lines, so that the size is bounded by the text.
    if (!size || *size == 0 || *size > rest_.size()) {
      fail(fmt::format("must be [[[ with the number of polynomials, got {}", in_quotes(line_)));
    }
    return *size;
  }

  void require_notes() {
    for (; !at_end_; next_line()) {
      if (!line_.starts_with('#')) {
        fail(fmt::format("nothing but notes, which begin with #, may follow ]]], got {}", shown()));
      }
    }
  }

  bool is_end_of_polynomial() const {
    return line_.size() >= 35 && line_.find_first_not_of('-') == std::string_view::npos;
  }

  Terms read_polynomial() {
    Terms terms;
    const bool is_zero = !at_end_ && line_ == dace::zero;
    if (!is_zero && (at_end_ || line_ != dace::header)) {
      fail(fmt::format("must be the head of a polynomial of DACE, {}, got {}",
                       in_quotes(dace::header), shown()));
    }
    for (next_line(); !is_end_of_polynomial(); next_line()) {
      if (at_end_) fail("the polynomial is cut off: no line of dashes ends it");
      if (is_zero) fail(fmt::format("must be the line of dashes, got {}", shown()));
      terms.push_back(read_term(terms.size() + 1));
    }
    return terms;
  }

  Term read_term(std::size_t row) {
    check_columns();
    const auto number = number_in<std::size_t>(line_.substr(0, dace::number_width));
    if (number != row) {
      fail(fmt::format("the number of the row must be {}, got {}", row,
                       in_quotes(line_.substr(0, dace::number_width))));
    }
    const std::string_view text = line_.substr(dace::coefficient_begin, dace::coefficient_width);
    const auto coefficient = number_in<double>(text);
    if (!coefficient || !std::isfinite(*coefficient)) {
      fail(fmt::format("COEFFICIENT: must be a finite number, got {}", in_quotes(text)));
    }
    Term term{read_exponents(), *coefficient, line_number_};
    check_degree(term);
    return term;
  }

  void check_columns() {
    constexpr std::size_t shortest = dace::exponents_begin + dace::exponent_width;
    const std::size_t width = line_.size() - std::min(line_.size(), dace::exponents_begin);
    if (line_.size() < shortest || width % dace::exponent_width != 0) {
      fail(fmt::format("has {} columns, must have {} and 3 for each variable", line_.size(),
                       dace::exponents_begin));
    }
    const std::size_t variables = width / dace::exponent_width;
    if (columns_ == 0) columns_ = variables;
    if (variables != columns_ || variables > dace::most_variables) {
      fail(fmt::format("has the exponents of {} variables, must be {}", variables,
                       std::min(columns_, dace::most_variables)));
    }
    const auto is_blank = [&](std::size_t column) { return line_[column] == ' '; };
    bool is_good = is_blank(6) && is_blank(7) && is_blank(dace::exponents_begin - 1);
    for (std::size_t i = 0; i < variables; ++i) {
      is_good = is_good && is_blank(dace::exponents_begin + i * dace::exponent_width);
    }
    if (!is_good) fail(fmt::format("is not in the columns of DACE: {}", in_quotes(line_)));
  }

  std::vector<std::uint8_t> read_exponents() const {
    std::vector<std::uint8_t> exponents;
    for (std::size_t i = 0; i < columns_; ++i) {
      const std::string_view text =
          line_.substr(dace::exponents_begin + i * dace::exponent_width, dace::exponent_width);
      const auto exponent = number_in<std::uint8_t>(text);
      if (!exponent) {
        fail(fmt::format("EXPONENTS: must be a number for variable {}, got {}", i + 1,
                         in_quotes(text)));
      }
      exponents.push_back(*exponent);
    }
    return exponents;
  }

  void check_degree(const Term& term) const {
    unsigned sum = 0;
    for (const std::uint8_t exponent : term.exponents) sum += exponent;
    const std::string_view text = line_.substr(dace::degree_begin, dace::degree_width);
    if (number_in<unsigned>(text) != sum) {
      fail(
          fmt::format("ORDER: must be {}, the sum of the exponents, got {}", sum, in_quotes(text)));
    }
    const int order = space_ ? space_->order() : 60;
    if (sum > static_cast<unsigned>(order)) {
      fail(fmt::format("ORDER: {} is above the order {}", sum, order));
    }
  }

  const std::string& name_;
  std::string_view rest_;
  const SeriesSpace* space_;
  std::size_t columns_;  ///< number of columns of exponents
  std::string_view line_;
  std::size_t line_number_ = 0;
  bool at_end_ = false;
};

std::vector<Series<double>> series_of(const DaceReader& reader,
                                      const std::vector<Terms>& polynomials,
                                      const SpacePointer& space) {
  std::vector<Series<double>> result(polynomials.size(), Series<double>(space));
  std::vector<std::size_t> lines;
  for (std::size_t i = 0; i < polynomials.size(); ++i) {
    lines.assign(space->size(), 0);
    for (const Term& term : polynomials[i]) {
      const std::size_t k = space->index(term.exponents);
      if (lines[k] != 0) {
        reader.fail(term.line, fmt::format("the same exponents as in line {}", lines[k]));
      }
      lines[k] = term.line;
      result[i][k] = term.coefficient;
    }
  }
  return result;
}

}  // namespace

std::vector<Series<double>> read_dace_text(const std::string& name, std::string_view text,
                                           const SpacePointer& space) {
  DaceReader reader(name, text, space.get());
  const std::vector<Terms> polynomials = reader.read();
  return series_of(reader, polynomials, space);
}

std::vector<Series<double>> read_dace_text(const std::string& name, std::string_view text) {
  DaceReader reader(name, text, nullptr);
  const std::vector<Terms> polynomials = reader.read();
  if (reader.variables() == 0) {
    reader.fail("all polynomials are zero, which does not tell the number of variables");
  }
  int order = 1;
  for (const Terms& terms : polynomials) {
    for (const Term& term : terms) {
      int degree = 0;
      for (const std::uint8_t exponent : term.exponents) degree += exponent;
      order = std::max(order, degree);
    }
  }
  const double count = SeriesSpace::monomial_count(reader.variables(), order) *
                       static_cast<double>(polynomials.size());
  if (count > most_coefficients) {
    throw Error(
        ErrorKind::too_large,
        fmt::format("{}: order {} in {} variables and {} polynomials are {:.3g} "
                    "coefficients, more than {:.0e}",
                    name, order, reader.variables(), polynomials.size(), count, most_coefficients));
  }
  return series_of(reader, polynomials, SeriesSpace::create(reader.variables(), order));
}

}  // namespace hamjet::io
