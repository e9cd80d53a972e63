#include "transfer_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../../text/html_text.hpp"
#include "burn_view.hpp"
#include "drift_view.hpp"
#include "fuel_view.hpp"
#include "hamjet/error.hpp"
#include "impulse_view.hpp"
#include "thrust_view.hpp"
#include "waypoint_view.hpp"

namespace hamjet::io {
namespace {

bool is_answer(const TransferAnswer& answer) { return answer.failure.empty(); }

void add_statistics(std::string name, std::vector<double> misses,
                    std::vector<MissStatistics>& statistics) {
  if (misses.empty()) return;
  std::sort(misses.begin(), misses.end());
  const std::size_t half = misses.size() / 2;
  const double median =
      misses.size() % 2 == 1 ? misses[half] : (misses[half - 1] + misses[half]) / 2;
  statistics.push_back({std::move(name), misses.size(), median, misses.back()});
}

}  // namespace

const TransferAnswer* shown_answer(const TransferPoint& point) {
  return point.has_answer() ? &point.best() : nullptr;
}

std::string answer_name(const TransferPoint& point) {
  const TransferAnswer* answer = shown_answer(point);
  if (answer == nullptr) return "";
  return point.is_refined() ? "refined" : fmt::format("order {}", answer->order);
}

const TransferAnswer* answer_of_order(const TransferPoint& point, int order) {
  for (const TransferAnswer& answer : point.answers) {
    if (answer.order == order && is_answer(answer)) return &answer;
  }
  return nullptr;
}

std::string failure_text(const TransferPoint& point) {
  std::vector<std::string> failures;
  if (!point.failure.empty()) failures.push_back(point.failure);
  for (const TransferAnswer& answer : point.answers) {
    if (!is_answer(answer)) {
      failures.push_back(fmt::format("order {}: {}", answer.order, answer.failure));
    }
  }
  if (point.refined && !is_answer(*point.refined)) failures.push_back(point.refined->failure);
  return fmt::format("{}", fmt::join(failures, "; "));
}

TransferCounts count_points(const TransferResult& result) {
  TransferCounts counts;
  counts.times = result.points.size();
  for (const TransferPoint& point : result.points) {
    const bool is_answered = shown_answer(point) != nullptr;
    const bool is_away = !point.is_near_singular;
    const bool has_failed_refinement = point.refined && !point.is_refined();
    counts.compared += point.is_candidate();
    counts.answered += is_answered;
    counts.near_singular += point.is_near_singular;
    counts.beyond_tolerance += is_answered && point.is_beyond_tolerance;
    const bool is_beyond = is_answered && point.is_beyond_tolerance && is_away;
    counts.beyond_tolerance_away += is_beyond;
    counts.corrected_away += is_beyond && point.is_refined();
    counts.unanswered_away += !is_answered && is_away;
    counts.refined += point.is_refined();
    counts.refinement_failed += has_failed_refinement;
    counts.refinement_failed_away += has_failed_refinement && is_away;
    counts.over_impulse += point.is_proved() && point.exceeds_impulse;
    counts.kept_out += point.is_proved() && !point.exceeds_impulse && point.enters_keep_out();
    counts.below_surface += point.is_proved() && !point.exceeds_impulse &&
                            !point.enters_keep_out() && point.is_below_surface;
  }
  return counts;
}

std::vector<TransferOutcome> transfer_outcomes(const TransferResult& result) {
  const TransferCounts counts = count_points(result);
  const std::string tolerance = length_text(result.scene.transfer->tolerance_m);
  std::string compared = "with an answer within " + tolerance;
  if (counts.corrected_away > 0) {
    compared += fmt::format(", {} of them only after correction by flying", counts.corrected_away);
  }
  std::vector<TransferOutcome> outcomes = {
      {counts.compared, compared},
      {counts.near_singular, "nearer to a singularity than the margin"},
      {counts.beyond_tolerance_away - counts.corrected_away,
       fmt::format("missing by more than {}, which flying did not correct", tolerance)},
      {counts.unanswered_away, "without an answer"},
      {counts.over_impulse, "with an impulse larger than largest_impulse_m_s"},
      {counts.kept_out, "through the ellipsoid keep_out_m"},
      {counts.below_surface, "below the surface on their way"}};
  std::erase_if(outcomes, [](const TransferOutcome& outcome) { return outcome.count == 0; });
  return outcomes;
}

std::vector<MissStatistics> miss_statistics(const TransferResult& result) {
  std::vector<MissStatistics> statistics;
  for (int order = 1; order <= result.scene.order; ++order) {
    std::vector<double> misses;
    for (const TransferPoint& point : result.points) {
      const TransferAnswer* answer = answer_of_order(point, order);
      if (answer != nullptr && !point.is_near_singular) misses.push_back(answer->miss_m);
    }
    add_statistics(fmt::format("order {}", order), std::move(misses), statistics);
  }
  std::vector<double> refined;
  for (const TransferPoint& point : result.points) {
    if (point.is_refined() && !point.is_near_singular) {
      refined.push_back(point.refined->miss_m);
    }
  }
  add_statistics("refined", std::move(refined), statistics);
  return statistics;
}

std::optional<std::size_t> costliest_point(const TransferResult& result) {
  std::optional<std::size_t> costliest;
  double most = 0;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const TransferAnswer* answer = shown_answer(result.points[i]);
    if (answer == nullptr || result.points[i].is_near_singular) continue;
    if (costliest && !(answer->total_change_m_s() > most)) continue;
    costliest = i;
    most = answer->total_change_m_s();
  }
  return costliest;
}

std::string hamilton_jacobi_text(const TransferResult& result) {
  const auto residual = largest_hamilton_jacobi_residual(result);
  if (!residual) return "";
  std::string text = fmt::format("{:.1e} at worst, at the transfers' own ends", *residual);
  if (result.hamilton_jacobi_floor) {
    text +=
        fmt::format(" (an ulp in the coefficients makes {:.1e})", *result.hamilton_jacobi_floor);
  }
  return text;
}

std::optional<double> largest_hamilton_jacobi_residual(const TransferResult& result) {
  std::optional<double> largest;
  for (const TransferPoint& point : result.points) {
    const std::optional<double>& residual = point.hamilton_jacobi_residual;
    if (residual) largest = std::max(largest.value_or(*residual), *residual);
  }
  return largest;
}

namespace {

/// Says if the least change is at an end of the times searched, beyond which it may fall further.
std::string edge_text(const TransferResult& result, std::size_t best) {
  const bool is_first = best == 0;
  if (result.points.size() < 2 || (!is_first && best + 1 < result.points.size())) return "";
  return fmt::format(
      " That is the {} of the times searched: beyond it the change may fall further, which {} "
      "times would show.",
      is_first ? "first" : "last", is_first ? "shorter" : "longer");
}

/// What may answer the times that have no answer within the tolerance.
std::string remedy_text(const TransferResult& result, const TransferCounts& counts) {
  std::string text;
  if (counts.beyond_tolerance_away > counts.corrected_away) {
    text += " A higher jet.order reaches further and may answer those beyond the tolerance.";
  }
  if (counts.unanswered_away > 0) {
    text += fmt::format(
        " Why a time has no answer is in the column failure; {}.",
        result.scene.transfer->kind == "auto" || result.coordinates != JetCoordinates::cartesian
            ? "one a little earlier or later may have one"
            : "the kind auto may have one");
  }
  return text;
}

/// The times that cannot be the least, by their outcome.
std::string left_out(const TransferResult& result) {
  std::vector<std::string> reasons;
  for (const TransferOutcome& outcome : transfer_outcomes(result)) {
    reasons.push_back(fmt::format("{} {}", outcome.count, outcome.text));
  }
  if (count_points(result).compared > 0) reasons.erase(reasons.begin());
  return fmt::format("{}", fmt::join(reasons, ", "));
}

/// Which times the least change leaves out, and why.
std::string left_out_text(const TransferResult& result) {
  const TransferCounts counts = count_points(result);
  if (counts.compared == counts.times) return "";
  return fmt::format(
      " Of {} times it compares {} and leaves out {}, which transfers.csv has, "
      "marked.{}",
      counts.times, counts.compared, left_out(result), remedy_text(result, counts));
}

std::string between_text(const TransferResult& result) {
  if (result.times_between == 0) {
    return result.points.size() > 1 ? " Between the listed times nothing was searched." : "";
  }
  // How many times it took depends on the last digit, and stands in the summary.
  const std::string searched = "Between the listed times, about the lowest of them,";
  if (!result.least_between) return fmt::format(" {} nothing less was found.", searched);
  const TransferPoint& point = *result.least_between;
  return fmt::format(" {} the least is {} in {}, flown with a miss of {}.", searched,
                     velocity_text(point.best().total_change_m_s()),
                     time_text(point.time * result.scene.units.time_s),
                     miss_text(point.best().miss_m, result.flight_floor_m));
}

/// The spans of time within the budget.
std::string budget_text(const TransferResult& result) {
  const std::optional<double>& budget = result.scene.transfer->budget_m_s;
  if (!budget) return "";
  if (result.budget_windows.empty()) {
    return fmt::format(" No time was found that takes {} or less.", velocity_text(*budget));
  }
  std::vector<std::string> spans;
  const double unit = result.scene.units.time_s;
  for (const BudgetWindow& window : result.budget_windows) {
    spans.push_back(fmt::format("{} to {}{}{}", time_text(window.first * unit),
                                time_text(window.last * unit),
                                window.begins_before ? " (from the first time searched)" : "",
                                window.ends_after ? " (to the last time searched)" : ""));
  }
  return fmt::format(" {} or less suffices for two impulses in {} of time: {}.",
                     velocity_text(*budget), counted(spans.size(), "span"), fmt::join(spans, "; "));
}

}  // namespace

std::string transfer_verdict(const TransferResult& result) {
  const std::optional<std::size_t> best = result.best_point();
  std::string further;
  for (const std::string& one :
       {optimal_impulses_verdict(result), waypoint_verdict(result), coasting_verdict(result),
        revolutions_verdict(result), thrust_verdict(result), fuel_verdict(result),
        burns_verdict(result)}) {
    if (!one.empty()) further += " " + one;
  }
  if (!best) {
    const TransferCounts counts = count_points(result);
    return fmt::format(
               "No velocity change can be named: of {} {}, which transfers.csv has, marked.{}",
               counted(counts.times, "transfer time"), left_out(result),
               remedy_text(result, counts)) +
           further;
  }
  const TransferPoint& point = result.points[*best];
  const TransferAnswer& answer = *shown_answer(point);
  std::string text = fmt::format(
      "The least velocity change found{} is {}, for a transfer time of {}: flown with the full "
      "equations of motion the deputy misses its place by {}",
      result.points.size() > 1 ? " at the listed times" : "",
      velocity_text(answer.total_change_m_s()), time_text(point.time * result.scene.units.time_s),
      miss_text(answer.miss_m, result.flight_floor_m));
  const bool is_corrected = answer_name(point) == "refined" && point.refinement_flights > 0;
  if (is_corrected && point.has_answer()) {
    text += fmt::format(" after refinement ({} by order {} alone)",
                        length_text(point.answers.back().miss_m), point.answers.back().order);
  }
  const TransferAnswer* linear = answer_of_order(point, 1);
  if (linear != nullptr && result.scene.order > 1) {
    text += fmt::format(", with the linear answer by {}", length_text(linear->miss_m));
  }
  text += ".";
  const std::string drift = drift_text(result.scene, point.drift, point.arrived,
                                       result.scene.transfer->frame, " at its end");
  return text + edge_text(result, *best) + left_out_text(result) + between_text(result) +
         budget_text(result) + (drift.empty() ? "" : " " + drift) + further;
}

std::string transfer_failure(const TransferResult& result) {
  const int code = exit_code(result);
  if (code == 0) return "";
  if (code == static_cast<int>(ErrorKind::numerical)) {
    const std::string reason = result.points.empty() ? "" : failure_text(result.points.front());
    return fmt::format("no transfer time has an answer; at the first of {}: {}",
                       result.points.size(), reason);
  }
  if (const std::string failure = optimal_impulses_failure(result); !failure.empty()) {
    return "optimal impulses: " + failure;
  }
  if (result.optimal && !result.optimal->is_proved()) {
    return "optimal impulses: the solver failed for a transfer time, and the least may be there";
  }
  if (const std::string failure = waypoint_failure(result); !failure.empty()) {
    return "waypoints: " + failure;
  }
  if (const std::string failure = coasting_failure(result); !failure.empty()) {
    return "drifting first: " + failure;
  }
  if (const std::string failure = revolutions_failure(result); !failure.empty()) {
    return "other revolutions: " + failure;
  }
  if (const std::string failure = thrust_failure(result); !failure.empty()) {
    return "energy-optimal thrust: " + failure;
  }
  if (const std::string failure = fuel_failure(result); !failure.empty()) {
    return "fuel-optimal thrust: " + failure;
  }
  if (const std::string failure = burns_failure(result); !failure.empty()) {
    return "burns: " + failure;
  }
  const TransferCounts counts = count_points(result);
  const std::size_t forbidden = counts.over_impulse + counts.kept_out + counts.below_surface;
  if (counts.compared == 0 && forbidden > 0) {
    return fmt::format(
        "no transfer is as the scene allows: of {} that are proved {} have an impulse larger than "
        "largest_impulse_m_s, {} go through the ellipsoid keep_out_m, and {} pass below the "
        "surface",
        forbidden, counts.over_impulse, counts.kept_out, counts.below_surface);
  }
  if (has_failed(result.checks)) return "";
  return fmt::format(
      "strict: of {} transfer times away from singularities {} have no answer, {} miss by more "
      "than {}, and the refinement of {} failed",
      counts.times - counts.near_singular, counts.unanswered_away, counts.beyond_tolerance_away,
      length_text(result.scene.transfer->tolerance_m), counts.refinement_failed_away);
}

std::string miss_text(double miss_m, double flight_floor_m) {
  return miss_m < flight_floor_m ? "less than " + length_text(flight_floor_m) : length_text(miss_m);
}

std::string singular_time_text(const SingularTime& singular, double unit_s, int most_decimals) {
  const double resolution_s = singular.resolution * unit_s;
  const double digits = resolution_s > 0 ? std::floor(-std::log10(resolution_s)) : most_decimals;
  const int decimals =
      static_cast<int>(std::clamp(digits, 0.0, static_cast<double>(most_decimals)));
  std::string text = fmt::format("{:.{}f}", singular.time * unit_s, decimals);
  if (singular.directions_lost > 1) {
    text += fmt::format(" (double, or a pair closer than {:.1g} s)", 2 * resolution_s);
  }
  return text;
}

std::string time_text(double seconds) {
  const std::string days = days_behind(seconds);
  if (!days.empty() || std::abs(seconds) < 60) return fmt::format("{:.6g} s{}", seconds, days);
  return fmt::format("{:.6g} s ({:.1f} min)", seconds, seconds / 60);
}

std::string velocity_text(double metres_per_second) {
  return fmt::format("{:.4g} m/s", metres_per_second);
}

}  // namespace hamjet::io
