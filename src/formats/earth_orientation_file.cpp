#include "hamjet/formats/earth_orientation_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <vector>

#include "../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "number_table.hpp"

namespace hamjet::io {
namespace {

using std::chrono::days;
using std::chrono::sys_days;
using std::chrono::year_month_day;

/// A field by its first and last column, counted from 1 as in the description of the format.
struct Field {
  std::size_t first;
  std::size_t last;
  std::string_view what;
  double most;  ///< no value of the Earth is larger
};

constexpr Field mjd_field = {8, 15, "a modified Julian date", 1e5};
constexpr Field ut1_a = {59, 68, "UT1 - UTC in seconds", 60};
constexpr Field ut1_b = {155, 165, ut1_a.what, ut1_a.most};
constexpr Field pole_x_a = {19, 27, "polar motion in arcseconds", 2};
constexpr Field pole_x_b = {135, 144, pole_x_a.what, pole_x_a.most};
constexpr Field pole_y_a = {38, 46, pole_x_a.what, pole_x_a.most};
constexpr Field pole_y_b = {145, 154, pole_x_a.what, pole_x_a.most};
constexpr Field offset_x_a = {98, 106, "a celestial pole offset in milliarcseconds", 100};
constexpr Field offset_x_b = {166, 175, offset_x_a.what, offset_x_a.most};
constexpr Field offset_y_a = {117, 125, offset_x_a.what, offset_x_a.most};
constexpr Field offset_y_b = {176, 185, offset_x_a.what, offset_x_a.most};
constexpr std::size_t flag_column = 58;  ///< I or P of UT1 - UTC in Bulletin A
constexpr double mas_per_arcsec = 1000;
constexpr int first_mjd = 36934;  ///< 1960-01-01

class Line {
 public:
  Line(const std::string& name, std::size_t number, std::string_view text)
      : name_(name), number_(number), text_(text) {}

  [[noreturn]] void fail(const std::string& problem) const {
    throw Error(ErrorKind::input_output, fmt::format("{}:{}: {}", name_, number_, problem));
  }

  std::string_view columns(std::size_t first, std::size_t last) const {
    return first <= text_.size() ? text_.substr(first - 1, last + 1 - first) : std::string_view();
  }

  /// The number of a field; no value for one that is blank.
  std::optional<double> number(const Field& field) const {
    const std::string_view text = columns(field.first, field.last);
    if (text.find_first_not_of(' ') == std::string_view::npos) return std::nullopt;
    const auto value = finite_number(text);
    if (value && std::abs(*value) <= field.most) return value;
    fail(fmt::format("columns {} to {}: got {}, must be {}, at most {:g}", field.first, field.last,
                     in_quotes(text), field.what, field.most));
  }

  /// Bulletin B's number or, where there is none, Bulletin A's.
  std::optional<double> number(const Field& b, const Field& a) const {
    const auto final_value = number(b);
    return final_value ? final_value : number(a);
  }

  sys_days day() const {
    const auto mjd = number(mjd_field);
    if (!mjd || *mjd < first_mjd || *mjd != std::floor(*mjd)) {
      fail(
          fmt::format("no day of the format finals2000A, got {} in columns 8 to 15, must be a "
                      "modified Julian date, a whole number from {} on, where UTC begins",
                      in_quotes(columns(mjd_field.first, mjd_field.last)), first_mjd));
    }
    const sys_days day = sys_days(std::chrono::year(1858) / 11 / 17) + days(static_cast<int>(*mjd));
    const year_month_day date(day);
    const auto is = [&](std::size_t first, unsigned value) {
      const auto found = finite_number(columns(first, first + 1));
      return found && *found == value;
    };
    const auto year_of_century = static_cast<unsigned>(static_cast<int>(date.year()) % 100);
    if (!is(1, year_of_century) || !is(3, static_cast<unsigned>(date.month())) ||
        !is(5, static_cast<unsigned>(date.day()))) {
      fail(fmt::format(
          "another day than its date, got {} and MJD {}, must be {:02}{:02}{:02} for it",
          in_quotes(columns(1, 6)), *mjd, year_of_century, static_cast<unsigned>(date.month()),
          static_cast<unsigned>(date.day())));
    }
    return day;
  }

 private:
  const std::string& name_;
  std::size_t number_;
  std::string_view text_;
};

}  // namespace

EarthOrientation read_earth_orientation(const std::string& name, std::string_view text) {
  std::vector<EarthOrientationDay> table;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view content = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (content.ends_with('\r')) content.remove_suffix(1);
    if (content.find_first_not_of(' ') == std::string_view::npos) continue;
    const Line line(name, number, content);
    EarthOrientationDay row;
    row.day = line.day();
    const auto ut1 = line.number(ut1_b, ut1_a);
    const auto pole_x = line.number(pole_x_b, pole_x_a);
    const auto pole_y = line.number(pole_y_b, pole_y_a);
    // The file ends with days for which nothing is predicted yet.
    if (!ut1 && !pole_x && !pole_y) continue;
    if (!ut1 || !pole_x || !pole_y) {
      line.fail(
          "a day that lacks UT1 - UTC or polar motion, got blanks, must have both or neither");
    }
    if (!table.empty() && row.day <= table.back().day) {
      line.fail(fmt::format("days out of order, got {} after {}, must ascend",
                            format_epoch({row.day, 0}).substr(0, 10),
                            format_epoch({table.back().day, 0}).substr(0, 10)));
    }
    row.ut1_minus_utc_s = *ut1;
    row.pole_x_arcsec = *pole_x;
    row.pole_y_arcsec = *pole_y;
    row.offset_x_arcsec = line.number(offset_x_b, offset_x_a).value_or(0) / mas_per_arcsec;
    row.offset_y_arcsec = line.number(offset_y_b, offset_y_a).value_or(0) / mas_per_arcsec;
    row.is_predicted = !line.number(ut1_b) && line.columns(flag_column, flag_column) == "P";
    table.push_back(row);
  }
  return {name, table};
}

}  // namespace hamjet::io
