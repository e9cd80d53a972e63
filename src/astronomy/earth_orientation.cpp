#include "hamjet/astronomy/earth_orientation.hpp"

#include <erfa.h>
#include <erfam.h>
#include <fmt/format.h>

#include <algorithm>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

std::string date_text(const Instant& instant) {
  return format_epoch(epoch_of(instant, TimeSystem::utc)).substr(0, 10);
}

EarthOrientation::Day day_of(const EarthOrientationDay& row) {
  const Epoch utc{row.day, 0};
  const Instant start = instant_of(utc, TimeSystem::utc);
  constexpr double tt_minus_tai = ERFA_TTMTAI;
  return {start,
          {row.ut1_minus_utc_s - tai_minus_utc(utc) - tt_minus_tai, row.pole_x_arcsec * ERFA_DAS2R,
           row.pole_y_arcsec * ERFA_DAS2R, row.offset_x_arcsec * ERFA_DAS2R,
           row.offset_y_arcsec * ERFA_DAS2R}};
}

}  // namespace

EarthOrientation::EarthOrientation(std::string name, const std::vector<EarthOrientationDay>& rows)
    : name_(std::move(name)) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && rows[i].day <= rows[i - 1].day) {
      throw Error(ErrorKind::input_output,
                  fmt::format("{}: days out of order, got {} after {}, must ascend", name_,
                              format_epoch({rows[i].day, 0}).substr(0, 10),
                              format_epoch({rows[i - 1].day, 0}).substr(0, 10)));
    }
    if (rows[i].is_predicted && !first_prediction_) first_prediction_ = rows[i].day;
    if (i == 0 || rows[i].day != rows[i - 1].day + std::chrono::days(1)) runs_.emplace_back();
    runs_.back().push_back(day_of(rows[i]));
  }
  std::erase_if(runs_, [](const std::vector<Day>& run) { return run.size() < 2; });
  if (runs_.empty()) {
    throw Error(
        ErrorKind::input_output,
        fmt::format("{}: no Earth orientation, got {} days, must be two or more in succession",
                    name_, rows.size()));
  }
}

std::vector<EarthOrientation::Day> EarthOrientation::between(const Instant& first,
                                                             const Instant& last,
                                                             std::size_t beyond) const {
  for (const std::vector<Day>& run : runs_) {
    if (first < run.front().start || run.back().start < last) continue;
    const auto begin = std::upper_bound(
        run.begin(), run.end(), first,
        [](const Instant& instant, const Day& day) { return instant < day.start; });
    const auto end = std::lower_bound(
        run.begin(), run.end(), last,
        [](const Day& day, const Instant& instant) { return day.start < instant; });
    const auto more = static_cast<std::ptrdiff_t>(beyond);
    const std::ptrdiff_t from = std::max<std::ptrdiff_t>(begin - run.begin() - 1 - more, 0);
    const std::ptrdiff_t to =
        std::min<std::ptrdiff_t>(end - run.begin() + 1 + more, std::ssize(run));
    return {run.begin() + from, run.begin() + to};
  }
  std::string span = date_text(first);
  if (date_text(last) != span) span += " to " + date_text(last);
  throw Error(ErrorKind::input_output,
              fmt::format("{}: no Earth orientation for {}, must be within its dates: {}", name_,
                          span, dates()));
}

std::string EarthOrientation::dates() const {
  constexpr std::size_t most = 4;
  std::string text;
  for (std::size_t i = 0; i < runs_.size() && i < most; ++i) {
    text += fmt::format("{}{} to {}", i > 0 ? ", " : "", date_text(runs_[i].front().start),
                        date_text(runs_[i].back().start));
  }
  if (runs_.size() > most) text += fmt::format(" and {} more", runs_.size() - most);
  return text;
}

std::string EarthOrientation::without_table() {
  return "Without a table of the Earth's orientation UT1 = UTC at the start and the pole does not "
         "move: UT1 - UTC is up to 0.9 s, which turns the Earth by 420 m at the equator, and polar "
         "motion up to 0.6 arcseconds, 19 m";
}

}  // namespace hamjet
