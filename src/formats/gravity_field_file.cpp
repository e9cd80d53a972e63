#include "hamjet/formats/gravity_field_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <utility>

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

/// Degree and order.
using Harmonic = std::pair<int, int>;

/// Reads header and records, and keeps the coefficients that are wanted and those of degree 1.
class Reader {
 public:
  using GetEpoch = std::function<std::optional<Epoch>()>;

  Reader(const std::string& name, std::string_view text, GetEpoch epoch)
      : file_{name}, text_(text), get_epoch_(std::move(epoch)) {}

  void read(const std::vector<Harmonic>& wanted) {
    wanted_ = {wanted.begin(), wanted.end()};
    for (const auto& [n, m] : wanted) highest_order_ = std::max(highest_order_, m);
    read_header();
    while (next_line()) {
      if (!words_.empty()) read_record();
    }
    for (const auto& [n, m] : wanted) {
      if (!coefficients_.contains({n, m})) {
        fail(fmt::format("the file ends without C({},{}), which is asked for; its max_degree is {}",
                         n, m, model_.max_degree));
      }
    }
    find_epoch();
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

  const GravityModel& model() const { return model_; }

  /// J_n = -C_n0, not normalised.
  double J_of(int degree) const {
    const GravityCoefficient& coefficient = coefficients_.at({degree, 0}).C;
    const Extended norm = is_normalized_ ? norm_of({degree, 0}) : Extended(1);
    const auto J = static_cast<double>(Extended(-norm * coefficient.at(file_, model_.epoch)));
    if (!(std::abs(J) <= 1)) {
      file_.fail_at(coefficient.line(),
                    fmt::format("C({},0): out of range, got J{} = {:.6g}, must be from -1 to 1",
                                degree, degree, J));
    }
    return J;
  }

  /// The normalised C or S, `added` to it.
  double normalised(const Harmonic& harmonic, char letter, double added = 0) const {
    const Pair& pair = coefficients_.at(harmonic);
    const GravityCoefficient& coefficient = letter == 'C' ? pair.C : pair.S;
    const Extended norm = is_normalized_ ? Extended(1) : norm_of(harmonic);
    const auto value =
        static_cast<double>(Extended(coefficient.at(file_, model_.epoch) / norm + Extended(added)));
    if (!(std::abs(value) <= 1)) {
      file_.fail_at(coefficient.line(),
                    fmt::format("{}: out of range, got {:.6g}, must be from -1 to 1",
                                coefficient.name(), value));
    }
    return value;
  }

  bool has(const Harmonic& harmonic) const { return coefficients_.contains(harmonic); }
  /// Whether it varies with time while there is no epoch.
  bool is_unknown(const Harmonic& harmonic) const {
    const auto found = coefficients_.find(harmonic);
    return found != coefficients_.end() && !model_.epoch &&
           (found->second.C.varies() || found->second.S.varies());
  }

  /// The tide system of the file, where it or the user says it.
  TideSystem tide_system(const std::optional<TideSystem>& said) const {
    const auto found = header_.find("tide_system");
    const int line = found == header_.end() ? end_of_head_ : found->second.line;
    for (const TideSystem system : {TideSystem::tide_free, TideSystem::zero_tide}) {
      if (model_.tide_system != tide_system_name(system)) continue;
      if (said && *said != system) {
        file_.fail_at(line, fmt::format("tide_system: the file is {}, must not be said to be {}",
                                        model_.tide_system, tide_system_name(*said)));
      }
      return system;
    }
    if (said) return *said;
    file_.fail_at(line, fmt::format("tide_system: must be tide_free or zero_tide, or it must be "
                                    "said which of them the file is, got {}",
                                    in_quotes(model_.tide_system)));
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

  void interpret_header() {
    end_of_head_ = line_;
    expect_value("product_type", {"gravity_field"});
    is_normalized_ = expect_value("norm", {"fully_normalized", "unnormalized"}) != "unnormalized";
    format_ = expect_value("format", {"icgem1.0", "icgem2.0"}) == "icgem2.0"
                  ? GravityFormat::icgem2
                  : GravityFormat::icgem1;
    model_.mu_km3_s2 = positive({"earth_gravity_constant", "gravity_constant"}, 1000000000);
    model_.radius_km = positive({"radius"}, 1000);
    const auto degree = header_.find("max_degree");
    if (degree == header_.end()) file_.fail_at(end_of_head_, "the header has no max_degree");
    line_ = degree->second.line;
    const auto max_degree = natural_in(degree->second.value);
    if (!max_degree) {
      fail(fmt::format("max_degree: must be a natural number, got {}",
                       in_quotes(degree->second.value)));
    }
    model_.max_degree = *max_degree;
    model_.model_name = value_of("modelname").value_or(value_of("product_name").value_or(""));
    model_.tide_system = value_of("tide_system").value_or("unknown");
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
    if (!degree || !order || *order > *degree || *degree > model_.max_degree) {
      fail(
          fmt::format("{}: degree and order must be natural numbers, the order at most the degree "
                      "and that at most the max_degree of {}, got {} and {}",
                      key, model_.max_degree, in_quotes(words_[1]), in_quotes(words_[2])));
    }
    const Harmonic harmonic(*degree, *order);
    if (*degree == 0) return check_constant_mass();
    const bool is_origin = *degree == 1 && *order <= highest_order_;
    if (!is_origin && !wanted_.contains(harmonic)) return;
    const auto [n, m] = harmonic;
    Pair& pair = coefficients_
                     .try_emplace(harmonic, Pair{GravityCoefficient('C', n, m),
                                                 GravityCoefficient('S', n, m)})
                     .first->second;
    pair.C.add(file_, line_, words_, format_);
    // What stands in the place of S(n,0) multiplies sin(0).
    if (m > 0) pair.S.add(file_, line_, words_, format_);
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
    const bool is_needed = std::any_of(
        coefficients_.begin(), coefficients_.end(),
        [](const auto& entry) { return entry.second.C.varies() || entry.second.S.varies(); });
    if (is_needed && get_epoch_) model_.epoch = get_epoch_();
  }

  /// By which a coefficient is multiplied to be one of Legendre functions that are not normalised.
  static Extended norm_of(const Harmonic& harmonic) {
    const auto [n, m] = harmonic;
    Extended square = (m == 0 ? 1 : 2) * (2 * n + 1);
    for (int j = n - m + 1; j <= n + m; ++j) square /= j;
    return sqrt(square);
  }

  struct Pair {
    GravityCoefficient C;
    GravityCoefficient S;
  };

  struct HeaderLine {
    std::string value;
    int line;
  };

  NamedFile file_;
  std::string_view text_;
  GetEpoch get_epoch_;
  GravityFormat format_ = GravityFormat::icgem1;
  std::set<Harmonic> wanted_;
  int highest_order_ = 0;  ///< the highest order of the wanted coefficients
  int line_ = 0;
  int end_of_head_ = 0;  ///< the line at which the head ends
  std::vector<std::string_view> words_;
  std::map<std::string, HeaderLine, std::less<>> header_;
  bool is_normalized_ = true;
  std::map<Harmonic, Pair> coefficients_;
  GravityModel model_;
};

std::string content_of(const std::filesystem::path& file) {
  FileContent content = read_regular_file(file, largest_gravity_field_bytes);
  if (!content.problem.empty()) {
    throw_no_content(file, content,
                     content.is_too_large ? ErrorKind::too_large : ErrorKind::input_output,
                     fmt::format("{}: the gravity field cannot be read: {}", printable_path(file),
                                 content.problem));
  }
  return std::move(content.text);
}

}  // namespace

GravityModel parse_gravity_model(const std::string& name, std::string_view text) {
  Reader reader(name, text, {});
  reader.read_header();
  return reader.model();
}

GravityField parse_gravity_field(const std::string& name, std::string_view text,
                                 const ZonalChoice& choice) {
  std::vector<int> degrees = choice.degrees;
  if (degrees.empty()) {
    for (int n = ZonalCoefficients::lowest; n <= choice.highest; ++n) degrees.push_back(n);
  }
  std::vector<Harmonic> wanted;
  for (const int n : degrees) wanted.emplace_back(n, 0);
  Reader reader(name, text, choice.epoch);
  reader.read(wanted);
  GravityField field{reader.model(), {}};
  for (const int n : degrees) field.J[n] = reader.J_of(n);
  // A mass whose centre lies at z on the axis attracts with
  //   mu / |r - z e| = mu / r (1 + z sin(latitude) / r + ...) ;
  // the term of degree 1 is mu / r C10 R sin(latitude) / r, where C10 is not normalised.
  if (reader.is_unknown({1, 0})) {
    field.origin_offset_km.reset();
  } else if (reader.has({1, 0})) {
    field.origin_offset_km = -reader.J_of(1) * field.radius_km;
  }
  return field;
}

std::string_view tide_system_name(TideSystem system) {
  return system == TideSystem::tide_free ? "tide_free" : "zero_tide";
}

HarmonicField parse_harmonic_field(const std::string& name, std::string_view text,
                                   const HarmonicChoice& choice) {
  if (choice.degree < 2 || choice.order < 0 || choice.order > choice.degree) {
    throw Error(ErrorKind::usage,
                fmt::format("the degree of a gravity field must be 2 or more, and its order from 0 "
                            "to that, got {} and {}",
                            choice.degree, choice.order));
  }
  std::vector<Harmonic> wanted;
  for (int n = 2; n <= choice.degree; ++n) {
    for (int m = 0; m <= std::min(n, choice.order); ++m) wanted.emplace_back(n, m);
  }
  Reader reader(name, text, choice.epoch);
  reader.read(wanted);
  HarmonicField field{reader.model()};
  const TideSystem of_file = reader.tide_system(choice.tide_system_of_file);
  field.tide = choice.tide_system.value_or(of_file);
  if (field.tide != of_file) {
    field.added_to_C20 =
        field.tide == TideSystem::zero_tide ? permanent_tide_C20 : -permanent_tide_C20;
  }
  field.coefficients = SphericalHarmonicCoefficients(choice.degree, choice.order);
  for (const Harmonic& harmonic : wanted) {
    const auto [n, m] = harmonic;
    const bool is_C20 = n == 2 && m == 0;
    field.coefficients.C(n, m) = reader.normalised(harmonic, 'C', is_C20 ? field.added_to_C20 : 0);
    if (m > 0) field.coefficients.S(n, m) = reader.normalised(harmonic, 'S');
  }
  if (reader.is_unknown({1, 0}) || reader.is_unknown({1, 1})) {
    field.origin_offset_km.reset();
    return field;
  }
  const double unit = std::sqrt(3) * field.radius_km;
  auto& offset = *field.origin_offset_km;
  if (reader.has({1, 0})) offset[2] = unit * reader.normalised({1, 0}, 'C');
  if (reader.has({1, 1})) {
    offset[0] = unit * reader.normalised({1, 1}, 'C');
    offset[1] = unit * reader.normalised({1, 1}, 'S');
  }
  return field;
}

HarmonicField read_harmonic_field(const std::filesystem::path& file, const HarmonicChoice& choice) {
  return parse_harmonic_field(printable_path(file), content_of(file), choice);
}

GravityField read_gravity_field(const std::filesystem::path& file, const ZonalChoice& choice) {
  return parse_gravity_field(printable_path(file), content_of(file), choice);
}

}  // namespace hamjet::io
