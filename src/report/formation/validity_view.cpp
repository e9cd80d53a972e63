#include "validity_view.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../../formats/relative_frame_text.hpp"
#include "../../text/html_text.hpp"
#include "../../text/quantity_text.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {
namespace {

/// The orders at the last time whose search for a reach ended without an answer.
std::string unsettled_text(const ValidityResult& result) {
  std::vector<int> orders;
  for (const ValidityEntry& entry : result.points.back().entries) {
    if (entry.is_unsettled) orders.push_back(entry.order);
  }
  if (orders.empty()) return "";
  return fmt::format(
      " In order {} the search for a separation that holds ended without an answer: worse deputies "
      "were found again and again, so that 0 m says nothing there.",
      fmt::join(orders, ", "));
}

/// How many domains the set takes that the scene asks about, as a sentence after a space.
std::string domains_text(const ValidityResult& result) {
  if (!result.domains) return "";
  const ValidityDomains& domains = *result.domains;
  const std::string tolerance = length_text(result.scene.validity->tolerance_m);
  const std::string set = fmt::format("{} within {}", counted(domains.deputies, "deputy"),
                                      length_text(domains.separation_m));
  std::string text = fmt::format(" In order {} {} take {}", result.scene.order, set,
                                 counted(domains.count(), "domain"));
  if (!domains.split_across.empty()) {
    text += fmt::format(", split most across {}", domains.split_across);
  }
  if (domains.not_right == 0) {
    return text + fmt::format(", flown to be right to {}.", length_text(domains.miss_m));
  }
  return text +
         fmt::format(", with which {} of them are not right to {}.", domains.not_right, tolerance);
}

}  // namespace

std::string unproved_text(const ValidityResult& result) {
  const std::vector<ValidityEntry>& entries = result.points.back().entries;
  const bool is_one_unproved = std::any_of(
      entries.begin(), entries.end(),
      [](const ValidityEntry& entry) { return entry.proved_m == 0 && !entry.is_unsettled; });
  if (!is_one_unproved) return unsettled_text(result);
  return unsettled_text(result) +
         fmt::format(
             " 0 m: no separation could be proved, because those deputies missed by more than the "
             "tolerance however near they were. The flights themselves are right to {}; a finer "
             "integrator, or a larger tolerance, may prove some.",
             length_text(result.flight_floor_m));
}

std::string validity_verdict(const ValidityResult& result) {
  if (result.points.empty()) return "No time was examined.";
  const ValidityPoint& last = result.points.back();
  std::string text = fmt::format("After {} the polynomial is right to {} up to a separation of ",
                                 time_text(last.time * result.scene.units.time_s),
                                 length_text(result.scene.validity->tolerance_m));
  for (std::size_t k = 0; k < last.entries.size(); ++k) {
    const ValidityEntry& entry = last.entries[k];
    const bool is_last = k + 1 == last.entries.size();
    if (k > 0) text += is_last ? " and " : ", ";
    text += fmt::format("{}{} in order {}", entry.is_at_limit ? "at least " : "",
                        length_text(entry.proved_m), entry.order);
  }
  text += fmt::format(", proved by flying deputies with velocities {}.",
                      velocities_text(result.scene.validity->frame));
  const bool is_one_at_limit =
      std::any_of(last.entries.begin(), last.entries.end(),
                  [](const ValidityEntry& entry) { return entry.is_at_limit; });
  if (is_one_at_limit) text += " At least: nothing further away was tried.";
  return text + unproved_text(result) + domains_text(result);
}

std::vector<std::string> limit_cells(const ReachLimit& limit) {
  // Parts have signs. A part above the whole is made up for by the others, which is said.
  std::string start = fmt::format("{:.1f} by {}", limit.start_degree, limit.start_coordinate);
  const double other_degree = limit.degree - limit.start_degree;
  if (other_degree < -0.05) start += fmt::format(" and {:.1f} by others", other_degree);
  std::string end = fmt::format("{:.0f} % in {}", 100 * limit.end_share, limit.end_coordinate);
  const double other_share = 1 - limit.end_share;
  if (other_share < -0.005) end += fmt::format(" and {:.0f} % in others", 100 * other_share);
  return {fmt::format("{:.1f}", limit.degree), start, end};
}

std::string reach_limit_text(const ValidityResult& result) {
  if (result.points.empty()) return "";
  const ValidityEntry& entry = result.points.back().entries.back();
  if (entry.is_at_wall) {
    return fmt::format(
        "order {} is limited at {} by a wall: a little further some deputies escape, fall or leave "
        "the coordinates",
        entry.order, length_text(entry.proved_m));
  }
  if (!entry.limit) return "";
  const std::vector<std::string> cells = limit_cells(*entry.limit);
  return fmt::format(
      "order {} is limited at {}, where the miss grows as degree {} of the deviation, {}, and {} "
      "at the end",
      entry.order, length_text(entry.proved_m), cells[0], cells[1], cells[2]);
}

}  // namespace hamjet::io
