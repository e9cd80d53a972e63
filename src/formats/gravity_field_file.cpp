#include "hamjet/formats/gravity_field_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>

#include "../store/text_file.hpp"
#include "../text/scene_message.hpp"
#include "../text/whole_number.hpp"
#include "hamjet/algebra/extended.hpp"
#include "hamjet/error.hpp"
#include "number_table.hpp"

namespace hamjet::io {
namespace {

/// The words of a line.
std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::string_view blanks = " \t\r\f\v";
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t first = line.find_first_not_of(blanks);
    if (first == std::string_view::npos) return words;
    line.remove_prefix(first);
    words.push_back(line.substr(0, line.find_first_of(blanks)));
    line.remove_prefix(words.back().size());
  }
}

/// A number with an exponent of C or of Fortran.
std::optional<Extended> number_in(std::string_view word) {
  std::string text(word);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == 'D' || c == 'd' || c == 'E'; }, 'e');
  // The number must be within double precision too, in which scenes have their numbers.
  if (!finite_number(text)) return std::nullopt;
  if (text.starts_with('+')) text.erase(0, 1);
  return finite_extended_number(text);
}

std::optional<int> natural_in(std::string_view word) {
  const auto number = whole_number<int>(word);
  return number && *number >= 0 ? number : std::nullopt;
}

class Reader {
 public:
  Reader(const std::string& name, std::string_view text, const ZonalChoice& choice)
      : name_(name), text_(text) {
    for (int n = ZonalCoefficients::lowest; n <= choice.highest; ++n) wanted_.push_back(n);
    if (!choice.degrees.empty()) wanted_ = choice.degrees;
  }

  GravityField read() {
    read_header();
    while (next_line()) {
      if (!words_.empty()) read_record();
    }
    for (const int n : wanted_) {
      if (!line_of_.contains(n)) {
        fail(fmt::format("the file ends without C({},0), which is asked for; its max_degree is {}",
                         n, field_.max_degree));
      }
    }
    return field_;
  }

 private:
  [[noreturn]] void fail_at(int line, const std::string& problem) const {
    throw Error(ErrorKind::input_output, fmt::format("{}:{}: {}", name_, line, problem));
  }
  [[noreturn]] void fail(const std::string& problem) const { fail_at(line_, problem); }

  /// Takes the words of the next line; false at the end.
  bool next_line() {
    if (text_.empty()) return false;
    ++line_;
    words_ = words_of(take_line(text_));
    return true;
  }

  void read_header() {
    while (true) {
      if (!next_line()) {
        line_ = std::max(line_, 1);
        fail("the header has no end_of_head: no gravity field of ICGEM, or cut off");
      }
      if (words_.empty()) continue;
      if (words_[0].starts_with("end_of_head")) break;
      // Before begin_of_head there is prose, in which a line may begin with a keyword.
      if (words_[0].starts_with("begin_of_head")) header_.clear();
      static constexpr std::array keywords = {
          "product_type", "modelname",  "product_name", "earth_gravity_constant",
          "norm",         "max_degree", "tide_system",  "gravity_constant",
          "radius"};
      if (std::find(keywords.begin(), keywords.end(), words_[0]) == keywords.end()) continue;
      if (words_.size() < 2) fail(fmt::format("{}: has no value", words_[0]));
      const auto [first, is_new] =
          header_.emplace(words_[0], HeaderLine{std::string(words_[1]), line_});
      if (!is_new) {
        fail(fmt::format("{}: is there twice, first in line {}", words_[0], first->second.line));
      }
    }
    interpret_header();
  }

  void interpret_header() {
    end_of_head_ = line_;
    expect_value("product_type", {"gravity_field"});
    is_normalized_ = expect_value("norm", {"fully_normalized", "unnormalized"}) != "unnormalized";
    field_.mu_km3_s2 = positive({"earth_gravity_constant", "gravity_constant"}, 1000000000);
    field_.radius_km = positive({"radius"}, 1000);
    const auto degree = header_.find("max_degree");
    if (degree == header_.end()) fail_at(end_of_head_, "the header has no max_degree");
    line_ = degree->second.line;
    const auto max_degree = natural_in(degree->second.value);
    if (!max_degree) {
      fail(fmt::format("max_degree: must be a natural number, got {}",
                       in_quotes(degree->second.value)));
    }
    field_.max_degree = *max_degree;
    field_.model_name = value_of("modelname").value_or(value_of("product_name").value_or(""));
    field_.tide_system = value_of("tide_system").value_or("unknown");
    line_ = end_of_head_;
  }

  std::optional<std::string> value_of(std::string_view keyword) const {
    const auto found = header_.find(keyword);
    return found == header_.end() ? std::nullopt : std::optional(printable(found->second.value));
  }

  /// The keyword's value, which must be one of `right`; the first of them if the keyword is not
  /// there.
  std::string expect_value(std::string_view keyword, const std::vector<std::string_view>& right) {
    const auto found = header_.find(keyword);
    if (found == header_.end()) return std::string(right[0]);
    line_ = found->second.line;
    const std::string& value = found->second.value;
    if (std::find(right.begin(), right.end(), value) == right.end()) {
      fail(fmt::format("{}: must be {}, got {}", keyword, fmt::join(right, " or "),
                       in_quotes(value)));
    }
    return value;
  }

  /// The positive value of a keyword that has several names, divided by `divisor` to be in
  /// kilometres.
  double positive(const std::vector<std::string_view>& keywords, int divisor) {
    for (const std::string_view keyword : keywords) {
      const auto found = header_.find(keyword);
      if (found == header_.end()) continue;
      line_ = found->second.line;
      const auto number = number_in(found->second.value);
      const double converted = number ? static_cast<double>(Extended(*number / divisor)) : 0;
      if (!(converted > 0)) {
        fail(fmt::format("{}: must be a positive number, got {}", keyword,
                         in_quotes(found->second.value)));
      }
      return converted;
    }
    fail_at(end_of_head_, fmt::format("the header has no {}", fmt::join(keywords, " or ")));
  }

  void read_record() {
    static constexpr std::array variable = {"gfct", "trnd", "dot", "asin", "acos"};
    const std::string_view key = words_[0];
    const bool is_variable = std::find(variable.begin(), variable.end(), key) != variable.end();
    if (!is_variable && key != "gfc") {
      fail(fmt::format("unknown key {}, must be gfc", in_quotes(key)));
    }
    const std::size_t columns = words_.size();
    if (is_variable ? columns < 5 : columns != 5 && columns != 7 && columns != 9) {
      fail(fmt::format("{}: has {} columns, must have {}", key, columns,
                       is_variable ? "5 or more"
                                   : "5 (key, degree, order, C, S), or 7 or 9 with "
                                     "standard deviations"));
    }
    const auto degree = natural_in(words_[1]);
    const auto order = natural_in(words_[2]);
    if (!degree || !order || *order > *degree || *degree > field_.max_degree) {
      fail(
          fmt::format("{}: degree and order must be natural numbers, the order at most the degree "
                      "and that at most the max_degree of {}, got {} and {}",
                      key, field_.max_degree, in_quotes(words_[1]), in_quotes(words_[2])));
    }
    if (*order != 0) return;
    const bool is_value = key == "gfc" || key == "gfct";
    if (is_value && *degree == 0 && coefficient(0) != 1) {
      fail(fmt::format("C(0,0): must be 1, got {}", in_quotes(words_[3])));
    }
    if (is_value && *degree == 1 && coefficient(1) != 0) {
      fail(fmt::format("C(1,0): must be 0, got {}: the origin must be the centre of mass",
                       in_quotes(words_[3])));
    }
    if (std::find(wanted_.begin(), wanted_.end(), *degree) == wanted_.end()) return;
    if (is_variable) {
      fail(
          fmt::format("{}: C({},0) varies with time, and a scene's field is constant: give J{} in "
                      "the scene with its value at your epoch, or take a static model",
                      key, *degree, *degree));
    }
    const auto [first, is_new] = line_of_.emplace(*degree, line_);
    if (!is_new)
      fail(fmt::format("C({},0) is there twice, first in line {}", *degree, first->second));
    take(*degree);
  }

  Extended coefficient(int degree) const {
    const auto number = number_in(words_[3]);
    if (!number) {
      fail(fmt::format("C({},0): must be a finite number, got {}", degree, in_quotes(words_[3])));
    }
    return *number;
  }

  void take(int degree) {
    const Extended norm = is_normalized_ ? Extended(sqrt(Extended(2 * degree + 1))) : Extended(1);
    const auto J = static_cast<double>(Extended(-norm * coefficient(degree)));
    if (!(std::abs(J) <= 1)) {
      fail(fmt::format("C({},0): out of range, got {}, which is J{} = {:.6g}, must be from -1 to 1",
                       degree, in_quotes(words_[3]), degree, J));
    }
    field_.J[degree] = J;
  }

  struct HeaderLine {
    std::string value;
    int line;
  };

  std::string name_;
  std::string_view text_;
  std::vector<int> wanted_;
  int line_ = 0;
  int end_of_head_ = 0;  ///< its line
  std::vector<std::string_view> words_;
  std::map<std::string, HeaderLine, std::less<>> header_;
  bool is_normalized_ = true;
  std::map<int, int> line_of_;  ///< the line of each coefficient that was taken
  GravityField field_;
};

}  // namespace

GravityField parse_gravity_field(const std::string& name, std::string_view text,
                                 const ZonalChoice& choice) {
  return Reader(name, text, choice).read();
}

GravityField read_gravity_field(const std::filesystem::path& file, const ZonalChoice& choice) {
  const FileContent content = read_regular_file(file, largest_gravity_field_bytes);
  if (!content.problem.empty()) {
    throw_no_content(file, content,
                     content.is_too_large ? ErrorKind::too_large : ErrorKind::input_output,
                     fmt::format("{}: the gravity field cannot be read: {}", printable_path(file),
                                 content.problem));
  }
  return parse_gravity_field(printable_path(file), content.text, choice);
}

}  // namespace hamjet::io
