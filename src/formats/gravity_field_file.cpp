#include "hamjet/formats/gravity_field_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <tuple>

#include "../dynamics/fields/spherical_harmonic_coefficients.hpp"
#include "../store/text_file.hpp"
#include "../text/scene_message.hpp"
#include "../text/whole_number.hpp"
#include "gravity_coefficient.hpp"
#include "hamjet/algebra/extended.hpp"
#include "hamjet/error.hpp"

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

std::optional<int> natural_in(std::string_view word) {
  const auto number = whole_number<int>(word);
  return number && *number >= 0 ? number : std::nullopt;
}

class Reader {
 public:
  Reader(const std::string& name, std::string_view text, const ZonalChoice& choice)
      : file_{name}, text_(text), epoch_(choice.epoch) {
    for (int n = ZonalCoefficients::lowest; n <= choice.highest; ++n) wanted_.push_back(n);
    if (!choice.degrees.empty()) wanted_ = choice.degrees;
  }

  Reader(const std::string& name, std::string_view text, const HarmonicChoice& choice)
      : file_{name},
        text_(text),
        epoch_(choice.epoch),
        degree_(choice.degree),
        order_(choice.order) {
    for (int n = ZonalCoefficients::lowest; n <= std::min(degree_, ZonalCoefficients::highest);
         ++n) {
      wanted_.push_back(n);
    }
  }

  HarmonicField read_harmonics() {
    HarmonicField result = {read(), {}};
    result.coefficients = std::make_shared<SphericalHarmonicCoefficients>(degree_, order_);
    for (int n = 2; n <= degree_; ++n) {
      for (int m = 0; m <= std::min(n, order_); ++m) {
        const Extended norm = norm_of(n, m);
        const auto value = [&](Harmonic which) {
          const auto found = harmonics_.find({n, m, which});
          if (found == harmonics_.end()) {
            fail(fmt::format("the file ends without {}, which is asked for; its max_degree is {}",
                             GravityCoefficient(n, m, which).name(), field_.max_degree));
          }
          return static_cast<double>(Extended(found->second.at(file_, field_.epoch) / norm));
        };
        result.coefficients->C(n, m) = value(Harmonic::cosine);
        if (m > 0) result.coefficients->S(n, m) = value(Harmonic::sine);
      }
    }
    return result;
  }

  GravityField read() {
    read_header();
    while (next_line()) {
      if (!words_.empty()) read_record();
    }
    for (const int n : wanted_) {
      if (!coefficients_.contains(n)) {
        fail(fmt::format("the file ends without C({},0), which is asked for; its max_degree is {}",
                         n, field_.max_degree));
      }
    }
    find_epoch();
    for (const int n : wanted_) field_.J[n] = J_of(n);
    take_origin();
    return field_;
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const { file_.fail_at(line_, problem); }

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
      // The text before begin_of_head is prose, in which a line may begin with a keyword.
      if (words_[0].starts_with("begin_of_head")) header_.clear();
      static constexpr std::array keywords = {
          "product_type", "modelname",  "product_name", "earth_gravity_constant",
          "norm",         "max_degree", "tide_system",  "gravity_constant",
          "radius",       "format"};
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
    format_ = expect_value("format", {"icgem1.0", "icgem2.0"}) == "icgem2.0"
                  ? GravityFormat::icgem2
                  : GravityFormat::icgem1;
    field_.mu_km3_s2 = positive({"earth_gravity_constant", "gravity_constant"}, 1000000000);
    field_.radius_km = positive({"radius"}, 1000);
    const auto degree = header_.find("max_degree");
    if (degree == header_.end()) file_.fail_at(end_of_head_, "the header has no max_degree");
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

  /// The value of a keyword, which must be one of `right`; without the keyword, the first of these.
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

  /// The positive value of a keyword that has several names, divided by `divisor`, which converts
  /// it to kilometres.
  double positive(const std::vector<std::string_view>& keywords, int divisor) {
    for (const std::string_view keyword : keywords) {
      const auto found = header_.find(keyword);
      if (found == header_.end()) continue;
      line_ = found->second.line;
      const auto number = gravity_number(found->second.value);
      const double converted = number ? static_cast<double>(Extended(*number / divisor)) : 0;
      if (!(converted > 0) || !std::isnormal(converted)) {
        fail(fmt::format("{}: must be a positive number, got {}", keyword,
                         in_quotes(found->second.value)));
      }
      return converted;
    }
    file_.fail_at(end_of_head_, fmt::format("the header has no {}", fmt::join(keywords, " or ")));
  }

  void read_record() {
    const auto& keys = gravity_record_keys();
    const std::string_view key = words_[0];
    const bool is_constant = key == keys.front();
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
      fail(
          fmt::format("unknown key {}, must be one of: {}", in_quotes(key), fmt::join(keys, ", ")));
    }
    const std::size_t columns = words_.size();
    if (is_constant ? columns != 5 && columns != 7 && columns != 9 : columns < 5) {
      fail(fmt::format("{}: has {} columns, must have {}", key, columns,
                       is_constant ? "5 (key, degree, order, C, S), or 7 or 9 with "
                                     "standard deviations"
                                   : "5 or more"));
    }
    const auto degree = natural_in(words_[1]);
    const auto order = natural_in(words_[2]);
    if (!degree || !order || *order > *degree || *degree > field_.max_degree) {
      fail(
          fmt::format("{}: degree and order must be natural numbers, the order at most the degree "
                      "and that at most the max_degree of {}, got {} and {}",
                      key, field_.max_degree, in_quotes(words_[1]), in_quotes(words_[2])));
    }
    if (*degree == 0) return check_constant_mass();
    if (*degree <= degree_ && *order <= order_) take_harmonics(*degree, *order);
    if (*order != 0) return;
    if (*degree > 1 && std::find(wanted_.begin(), wanted_.end(), *degree) == wanted_.end()) return;
    coefficients_.try_emplace(*degree, *degree).first->second.add(file_, line_, words_, format_);
  }

  void take_harmonics(int degree, int order) {
    if (degree == 1) {
      if (order == 0 ||
          (gravity_number(words_[3]) == Extended(0) && gravity_number(words_[4]) == Extended(0))) {
        return;
      }
      fail(fmt::format(
          "C(1,1) and S(1,1): must be 0, for the origin must be on the axis, got {} and "
          "{}",
          in_quotes(words_[3]), in_quotes(words_[4])));
    }
    for (const Harmonic which : {Harmonic::cosine, Harmonic::sine}) {
      if (which == Harmonic::sine && order == 0) continue;
      harmonics_.try_emplace({degree, order, which}, degree, order, which)
          .first->second.add(file_, line_, words_, format_);
    }
  }

  /// What a coefficient of the file is a multiple of: 1, or 1/N with the norm N of full
  /// normalisation, N^2 = (2 - delta_m0) (2n + 1) (n - m)!/(n + m)!.
  Extended norm_of(int n, int m) const {
    if (is_normalized_) return Extended(1);
    Extended squared = Extended(m == 0 ? 1 : 2) * (2 * n + 1);
    for (int k = n - m + 1; k <= n + m; ++k) squared /= k;
    return sqrt(squared);
  }

  /// C(0,0) must be 1 and constant, because the mass is given by the gravity constant.
  void check_constant_mass() const {
    const bool is_value = words_[0] == "gfc" || words_[0] == "gfct";
    const int right = is_value ? 1 : 0;
    if (gravity_number(words_[3]) == Extended(right)) return;
    fail(fmt::format("C(0,0): must be 1{}, got {}", is_value ? "" : " at all times",
                     is_value ? in_quotes(words_[3])
                              : fmt::format("a term {} of {}", words_[0], in_quotes(words_[3]))));
  }

  /// Asks for the epoch, once, if one of the coefficients varies with time.
  void find_epoch() {
    const auto varies = [](const auto& entry) { return entry.second.varies(); };
    const bool is_needed = std::any_of(coefficients_.begin(), coefficients_.end(), varies) ||
                           std::any_of(harmonics_.begin(), harmonics_.end(), varies);
    if (is_needed && epoch_) field_.epoch = epoch_();
  }

  /// J_n = -C_n0, not normalised, from the coefficient that was read.
  double J_of(int degree) const {
    const GravityCoefficient& coefficient = coefficients_.at(degree);
    const Extended norm = is_normalized_ ? Extended(sqrt(Extended(2 * degree + 1))) : Extended(1);
    const auto J = static_cast<double>(Extended(-norm * coefficient.at(file_, field_.epoch)));
    if (!(std::abs(J) <= 1)) {
      file_.fail_at(coefficient.line(),
                    fmt::format("C({},0): out of range, got J{} = {:.6g}, must be from -1 to 1",
                                degree, degree, J));
    }
    return J;
  }

  /// A mass whose centre lies at z on the axis attracts with
  ///   mu / |r - z e| = mu / r (1 + z sin(latitude) / r + ...) ;
  /// the term of degree 1 is mu / r C10 R sin(latitude) / r, where C10 is not normalised.
  void take_origin() {
    const auto first = coefficients_.find(1);
    if (first == coefficients_.end()) return;
    if (first->second.varies() && !field_.epoch) {
      field_.origin_offset_km.reset();
      return;
    }
    field_.origin_offset_km = -J_of(1) * field_.radius_km;
  }

  struct HeaderLine {
    std::string value;
    int line;
  };

  NamedFile file_;
  std::string_view text_;
  std::function<std::optional<Epoch>()> epoch_;
  GravityFormat format_ = GravityFormat::icgem1;
  std::vector<int> wanted_;
  int line_ = 0;
  int end_of_head_ = 0;  ///< its line
  std::vector<std::string_view> words_;
  std::map<std::string, HeaderLine, std::less<>> header_;
  bool is_normalized_ = true;
  /// C(1,0) and the coefficients that are asked for.
  std::map<int, GravityCoefficient> coefficients_;
  int degree_ = -1;  ///< of the harmonics that are asked for; -1 if none are
  int order_ = -1;
  std::map<std::tuple<int, int, Harmonic>, GravityCoefficient> harmonics_;
  GravityField field_;
};

}  // namespace

GravityField parse_gravity_field(const std::string& name, std::string_view text,
                                 const ZonalChoice& choice) {
  return Reader(name, text, choice).read();
}

HarmonicField parse_harmonic_field(const std::string& name, std::string_view text,
                                   const HarmonicChoice& choice) {
  return Reader(name, text, choice).read_harmonics();
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
