#include "budget_windows.hpp"

#include <algorithm>
#include <cmath>

namespace hamjet {
namespace {

struct KnownTime {
  double time = 0;
  bool is_within = false;
};

bool is_within(const TransferPoint& point, double budget_m_s) {
  return point.is_candidate() && point.change_m_s() <= budget_m_s;
}

/// The last time, going from `from` towards `to`, at which `is_within` has the same value as at
/// `from`.
double edge(TransferSearch& search, const KnownTime& from, const KnownTime& to, double budget_m_s) {
  constexpr int halvings = 12;
  search.begin_at(from.time);
  double same = from.time, other = to.time;
  for (int k = 0; k < halvings; ++k) {
    const double middle = (same + other) / 2;
    (is_within(search.at(middle), budget_m_s) == from.is_within ? same : other) = middle;
  }
  return from.is_within ? same : other;
}

}  // namespace

std::vector<BudgetWindow> find_budget_windows(TransferResult& result, TransferPoints& points,
                                              const IntegratorSettings& integrator,
                                              const RelativeTransfer& ends,
                                              const ProgressCallback& progress) {
  const double budget = *result.scene.transfer->budget_m_s;
  std::vector<KnownTime> known;
  for (const TransferPoint& point : result.points) {
    known.push_back({point.time, is_within(point, budget)});
  }
  if (result.least_between) {
    known.push_back({result.least_between->time, is_within(*result.least_between, budget)});
  }
  std::sort(known.begin(), known.end(), [](const KnownTime& a, const KnownTime& b) {
    return std::abs(a.time) < std::abs(b.time);
  });
  TransferSearch search(points, integrator, ends);
  std::vector<BudgetWindow> windows;
  for (std::size_t k = 0; k < known.size(); ++k) {
    if (progress) {
      progress("budget", static_cast<double>(k) / static_cast<double>(known.size()));
    }
    const KnownTime& here = known[k];
    const bool was_within = k > 0 && known[k - 1].is_within;
    if (here.is_within && !was_within) {
      const double first = k > 0 ? edge(search, known[k - 1], here, budget) : here.time;
      windows.push_back({first, here.time, k == 0, false});
    }
    if (here.is_within) {
      const bool is_last = k + 1 == known.size();
      windows.back().last = here.time;
      windows.back().ends_after = is_last;
      if (!is_last && !known[k + 1].is_within) {
        windows.back().last = edge(search, here, known[k + 1], budget);
      }
    }
  }
  result.times_between += search.count();
  result.seconds.propagation += search.propagation_seconds();
  return windows;
}

}  // namespace hamjet
