#include "stored_coefficients.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <optional>

#include "../store/text_file.hpp"
#include "../text/scene_message.hpp"
#include "../text/whole_number.hpp"
#include "hamjet/error.hpp"
#include "number_table.hpp"
#include "output_formats.hpp"

namespace hamjet::io {
namespace {

class CoefficientReader {
 public:
  explicit CoefficientReader(const CoefficientFile& file) : file_(file) {}

  FlowJet<Extended> read(std::string_view text) {
    check_header(take_line(text));
    check_length(text);
    space_ = SeriesSpace::create(file_.variables.size(), file_.order);
    jet_.assign(file_.components.size(), Series<Extended>(space_));
    lines_.assign(file_.components.size() * space_->size(), 0);
    while (!text.empty()) {
      ++line_;
      read_row(take_line(text));
    }
    return std::move(jet_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::input_output, fmt::format("{}:{}: {}", file_.name, line_, what));
  }

  void check_header(std::string_view header) const {
    const std::string expected =
        fmt::format("component,e_{},coefficient", fmt::join(file_.names, ",e_"));
    if (header != expected) {
      fail(fmt::format("the header is {}, must be {}", in_quotes(header), in_quotes(expected)));
    }
  }

  /// Checks the number of rows before anything is allocated, because a damaged order could ask for
  /// gigabytes.
  void check_length(std::string_view rows) {
    const double expected =
        static_cast<double>(file_.components.size()) *
        std::round(SeriesSpace::monomial_count(file_.variables.size(), file_.order));
    const auto count = static_cast<double>(std::count(rows.begin(), rows.end(), '\n'));
    if (count == expected && rows.ends_with('\n')) return;
    line_ = 1 + static_cast<std::size_t>(count);
    if (!rows.empty() && !rows.ends_with('\n')) {
      ++line_;
      fail("the line is cut off");
    }
    fail(
        fmt::format("the file ends after {} coefficients, must have {} for order {} in {} "
                    "variables and {} components",
                    count, expected, file_.order, file_.variables.size(), file_.components.size()));
  }

  void read_row(std::string_view line) {
    split_line(line, fields_);
    if (fields_.size() != file_.names.size() + 2) {
      fail(fmt::format("has {} columns, must have {}", fields_.size(), file_.names.size() + 2));
    }
    const std::size_t component = component_of(fields_[0]);
    const std::size_t monomial = monomial_of();
    std::size_t& seen = lines_[component * space_->size() + monomial];
    if (seen != 0) {
      fail(fmt::format("the same coefficient as in line {}, so that another is missing", seen));
    }
    seen = line_;
    const auto number = parse_coefficient(fields_.back(), file_.precision);
    if (!number) {
      fail(fmt::format("coefficient: must be a finite number, got {}", in_quotes(fields_.back())));
    }
    jet_[component][monomial] = *number;
  }

  std::size_t component_of(std::string_view name) const {
    const auto found = std::find_if(file_.components.begin(), file_.components.end(),
                                    [&](std::size_t c) { return file_.names[c] == name; });
    if (found == file_.components.end()) {
      fail(fmt::format("component: must be one of those of summary.json, got {}", in_quotes(name)));
    }
    return static_cast<std::size_t>(found - file_.components.begin());
  }

  std::size_t monomial_of() {
    exponents_.clear();
    int degree = 0;
    for (std::size_t i = 0; i < file_.names.size(); ++i) {
      const auto exponent = whole_number<unsigned>(fields_[i + 1]);
      if (!exponent || *exponent > static_cast<unsigned>(file_.order)) {
        fail(fmt::format("e_{}: must be an exponent of 0 to the order {}, got {}", file_.names[i],
                         file_.order, in_quotes(fields_[i + 1])));
      }
      degree += static_cast<int>(*exponent);
      const bool is_variable =
          std::binary_search(file_.variables.begin(), file_.variables.end(), i);
      if (is_variable) {
        exponents_.push_back(static_cast<std::uint8_t>(*exponent));
      } else if (*exponent != 0) {
        fail(fmt::format("e_{}: must be 0, for the jet is not expanded in {}", file_.names[i],
                         file_.names[i]));
      }
    }
    if (degree > file_.order) {
      fail(fmt::format("the exponents add up to {}, above the order {}", degree, file_.order));
    }
    return space_->index(exponents_);
  }

  const CoefficientFile& file_;
  SpacePointer space_;
  FlowJet<Extended> jet_;
  std::size_t line_ = 1;
  std::vector<std::size_t> lines_;  ///< the line of each coefficient
  std::vector<std::string_view> fields_;
  std::vector<std::uint8_t> exponents_;
};

}  // namespace

std::string extended_digits(const Extended& number) {
  std::string digits = number.str(36, std::ios_base::scientific);
  if (signbit(number) && !digits.starts_with('-')) digits.insert(0, "-");  // -0
  return digits;
}

std::string coefficient_digits(const Extended& value, Precision precision) {
  if (precision == Precision::double_precision) {
    return fmt::format("{:.17g}", static_cast<double>(value));
  }
  return extended_digits(value);
}

std::optional<Extended> parse_coefficient(std::string_view text, Precision precision) {
  if (precision == Precision::extended) return finite_extended_number(text);
  const auto number = whole_number<double>(text);
  if (!number || !std::isfinite(*number)) return std::nullopt;
  return Extended(*number);
}

FlowJet<Extended> read_coefficients(const CoefficientFile& file, std::string_view text) {
  return CoefficientReader(file).read(text);
}

std::string series_csv(const std::vector<std::string_view>& series,
                       const std::vector<std::string_view>& columns,
                       const std::vector<std::size_t>& places, Precision precision,
                       const FlowJet<Extended>& jet) {
  const SeriesSpace& space = jet.at(0).space();
  fmt::memory_buffer out;
  const auto write = std::back_inserter(out);
  fmt::format_to(write, "component");
  for (const auto name : columns) fmt::format_to(write, ",e_{}", name);
  fmt::format_to(write, ",coefficient\n");
  for (std::size_t c = 0; c < jet.size(); ++c) {
    for (std::size_t k = 0; k < space.size(); ++k) {
      std::vector<int> exponents(columns.size(), 0);
      for (std::size_t v = 0; v < space.variables(); ++v) {
        exponents[places[v]] = space.exponents(k)[v];
      }
      fmt::format_to(write, "{}", series[c]);
      for (const int e : exponents) fmt::format_to(write, ",{}", e);
      fmt::format_to(write, ",{}\n", coefficient_digits(jet[c][k], precision));
    }
  }
  return fmt::to_string(out);
}

std::string coefficients_csv(const std::vector<std::string_view>& names,
                             const std::vector<std::size_t>& components,
                             const std::vector<std::size_t>& variables, Precision precision,
                             const FlowJet<Extended>& jet) {
  std::vector<std::string_view> series;
  for (const std::size_t c : components) series.push_back(names[c]);
  return series_csv(series, names, variables, precision, jet);
}

const OutputFormat csv_format = {
    .file = "jet.csv",
    .ending = ".csv",
    .of_jet =
        [](const StoredJet& stored) {
          return coefficients_csv(stored.variable_names(), stored.components, stored.variables,
                                  stored.precision, stored.jet);
        },
    .read_coefficients = read_coefficients,
};

}  // namespace hamjet::io
