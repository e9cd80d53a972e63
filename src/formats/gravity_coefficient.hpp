#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/astronomy/epoch.hpp"

// A coefficient of a gravity field file, which may vary with time. Source: F. Barthelmes, C.
// Förste, The ICGEM-format, GFZ Potsdam (2011), and its version 2.0, in which every record of a
// coefficient that varies has an interval of validity.

namespace hamjet::io {

/// A file to whose lines messages refer.
struct NamedFile {
  std::string name;  ///< printable name

  /// Throws Error(input_output) with `name:line: problem`.
  [[noreturn]] void fail_at(int line, const std::string& problem) const;
};

enum class GravityFormat { icgem1, icgem2 };

/// A number with an exponent in the notation of C or Fortran, if it is finite in double precision
/// too.
std::optional<Extended> gravity_number(std::string_view word);

/// The keys of the records of coefficients. The first key is for constant coefficients, all others
/// for coefficients that vary with time.
const std::vector<std::string_view>& gravity_record_keys();

/// The coefficient C(n,m) or S(n,m) as its file gives it, normalised or not, collected record by
/// record.
class GravityCoefficient {
 public:
  GravityCoefficient(char letter, int degree, int order)
      : letter_(letter), degree_(degree), order_(order) {}

  /// Takes a record: a line of the file as words, of which at least five are there. Throws
  /// Error(input_output) for another number of columns than the key has in this format, for a word
  /// that is not a number, date or period where one must be, for an empty interval, and for a
  /// second constant.
  void add(const NamedFile& file, int line, const std::vector<std::string_view>& words,
           GravityFormat format);

  /// "C(2,0)".
  std::string name() const;
  bool varies() const;
  /// The line of the record that gives the value, or the first one.
  int line() const;

  /// The value. At time t, in Julian years of 365.25 days, it is
  ///   gfct + trnd (t - t0) + asin sin(2 pi (t - t0) / T) + acos cos(2 pi (t - t0) / T) + ...
  /// In format 1.0, t0 is that of gfct, and the formula always holds; in format 2.0 each record has
  /// its own t0 and holds from t0 to before t1. Time systems are not distinguished: they differ by
  /// about a minute, 2e-6 years, in which no known digit changes. Throws Error(input_output) if a
  /// coefficient varies and there is no epoch, or if at the epoch no value, two values, or one term
  /// twice hold.
  Extended at(const NamedFile& file, const std::optional<Epoch>& epoch) const;

 private:
  enum class Kind { constant, value, trend, sine, cosine };

  struct Record {
    Kind kind = Kind::constant;
    std::string key;
    int line = 0;
    Extended amplitude;
    std::optional<Epoch> start;  ///< t0
    std::optional<Epoch> end;    ///< t1
    Extended period_years;       ///< period of sine and cosine

    bool is_value() const { return kind == Kind::constant || kind == Kind::value; }
    bool holds_at(const Epoch& epoch) const { return !end || (*start <= epoch && epoch < *end); }
    bool is_same_term(const Record& other) const {
      return (is_value() && other.is_value()) ||
             (kind == other.kind && period_years == other.period_years);
    }
  };

  static Kind kind_of(std::string_view key);
  const Record& value_at(const NamedFile& file, const std::vector<const Record*>& in_force,
                         const Epoch& epoch) const;
  Extended contribution(const NamedFile& file, const Record& record, const Record& value,
                        const Epoch& epoch) const;

  char letter_;
  int degree_;
  int order_;
  std::vector<Record> records_;
};

}  // namespace hamjet::io
