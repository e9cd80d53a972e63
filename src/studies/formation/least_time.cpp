#include "least_time.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "../../algebra/scalar_search.hpp"

namespace hamjet {

void TransferSearch::begin_at(double time) {
  if (time != propagation_.time()) propagation_.advance_to(time);
}

TransferPoint TransferSearch::at(double time) {
  ++count_;
  JetPropagation from_here = propagation_;
  const FlowJet<double> jet = from_here.advance_to(time);
  seconds_ += from_here.statistics().wall_seconds - propagation_.statistics().wall_seconds;
  points_.forget_last_kind();
  return points_.answer(points_.choose_kind(time, jet, {ends_}), jet, ends_);
}

namespace {

struct Span {
  double first = 0;
  double last = 0;
};

double change_or_infinity(const TransferPoint& point) {
  return point.is_candidate() ? point.change_m_s() : std::numeric_limits<double>::infinity();
}

/// The spans between the neighbours of the lowest listed answers, moving away from 0.
std::vector<Span> lowest_spans(const TransferResult& result) {
  constexpr std::size_t most_spans = 3;
  const std::vector<double>& times = result.scene.transfer->times;
  std::vector<double> changes;
  for (const TransferPoint& point : result.points) changes.push_back(change_or_infinity(point));
  const std::size_t last = changes.size() - 1;
  std::vector<std::size_t> minima;
  for (std::size_t i = 0; i <= last; ++i) {
    const bool is_least =
        (i == 0 || changes[i] <= changes[i - 1]) && (i == last || changes[i] <= changes[i + 1]);
    if (std::isfinite(changes[i]) && is_least) minima.push_back(i);
  }
  std::stable_sort(minima.begin(), minima.end(),
                   [&](std::size_t a, std::size_t b) { return changes[a] < changes[b]; });
  if (minima.size() > most_spans) minima.resize(most_spans);
  std::sort(minima.begin(), minima.end());
  std::vector<Span> spans;
  for (const std::size_t i : minima) {
    spans.push_back({times[i > 0 ? i - 1 : 0], times[std::min(i + 1, last)]});
  }
  return spans;
}

/// Searches the least answer of one span.
class SpanMinimum {
 public:
  SpanMinimum(TransferSearch& search, const Span& span, double least)
      : search_(search), span_(span), least_(least) {
    search.begin_at(span.first);
  }

  /// The answer, if it is lower than the least one known before.
  std::optional<TransferPoint> find() {
    constexpr int parts = 12;
    // A minimum that is above the least of the grid by this factor is not worth refining.
    constexpr double worth_refining = 1.1;
    double lowest = std::numeric_limits<double>::infinity();
    int place = 0;
    for (int k = 1; k < parts; ++k) {
      const double change = change_at(inner_time(k, parts));
      if (change < lowest) {
        lowest = change;
        place = k;
      }
    }
    if (!(lowest <= worth_refining * least_)) return found_;
    // If there is no answer, the change is replaced by a large but finite number, because parabolas
    // go through it.
    const double large = 2 * std::max(lowest, least_);
    constexpr std::uintmax_t most_answers = 40;
    constexpr int bits = 20;
    minimum_between(
        "between the times", [&](double time) { return std::min(change_at(time), large); },
        inner_time(place - 1, parts), inner_time(place + 1, parts), bits, most_answers);
    return found_;
  }

 private:
  double inner_time(int k, int parts) const {
    return span_.first + (span_.last - span_.first) * k / parts;
  }

  double change_at(double time) {
    TransferPoint point = search_.at(time);
    const double change = change_or_infinity(point);
    if (change < least_) {
      least_ = change;
      found_ = std::move(point);
    }
    return change;
  }

  TransferSearch& search_;
  const Span& span_;
  double least_;
  std::optional<TransferPoint> found_;
};

}  // namespace

void find_least_between(TransferResult& result, TransferPoints& points,
                        const IntegratorSettings& integrator, const RelativeTransfer& ends,
                        const ProgressCallback& progress) {
  const auto listed = result.best_point();
  if (!listed || result.points.size() < 2) return;
  TransferSearch search(points, integrator, ends);
  double least = result.points[*listed].change_m_s();
  const std::vector<Span> spans = lowest_spans(result);
  for (std::size_t k = 0; k < spans.size(); ++k) {
    if (progress) {
      progress("between the times", static_cast<double>(k) / static_cast<double>(spans.size()));
    }
    if (auto found = SpanMinimum(search, spans[k], least).find()) {
      least = found->change_m_s();
      result.least_between = std::move(found);
    }
  }
  result.times_between += search.count();
  result.seconds.propagation += search.propagation_seconds();
}

}  // namespace hamjet
