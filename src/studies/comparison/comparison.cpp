#include "hamjet/studies/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "../reference.hpp"
#include "compared_order.hpp"
#include "convergence_fit.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// A reference with a larger uncertainty than this cannot judge double precision.
constexpr double largest_uncertainty = 1e-13;

/// A default series ends once this many refinements in a row have not reduced an error that is
/// already small.
constexpr int fruitless_refinements = 2;
constexpr double near_round_off = 1e-11;

/// Fraction of the time budget that the fits of one series may take at one degree.
constexpr double fit_budget = 0.1;

/// Thrown if an integration takes longer than the remaining time budget.
struct TooSlow {
  double seconds;
};

/// Whether a run that was read from a file is complete for this order; otherwise it is run again.
bool is_sound(const ComparedRun& run) {
  if (!run.left_out.empty()) return false;
  if (!run.failure.empty()) return true;
  const auto is_size = [](double x) { return std::isfinite(x) && x >= 0; };
  return run.error_by_degree.size() == static_cast<std::size_t>(run.order) + 1 &&
         run.statistics.steps > 0 &&
         std::all_of(run.error_by_degree.begin(), run.error_by_degree.end(), is_size) &&
         std::all_of(run.seconds.begin(), run.seconds.end(), is_size);
}

/// The finished runs of an earlier comparison, while a new one takes them over. Runs that the new
/// comparison did not reach are put back at the end, so that an interruption loses none.
class FinishedRuns {
 public:
  explicit FinishedRuns(std::vector<ComparedRun>& runs) : runs_(runs) {
    for (ComparedRun& run : runs) {
      if (is_sound(run)) finished_.emplace(key(run.order, run.settings.label), std::move(run));
    }
    runs.clear();
  }
  ~FinishedRuns() {
    for (auto& [name, run] : finished_) runs_.push_back(std::move(run));
  }
  FinishedRuns(const FinishedRuns&) = delete;
  FinishedRuns& operator=(const FinishedRuns&) = delete;

  std::optional<ComparedRun> take(int order, const std::string& label) {
    auto node = finished_.extract(key(order, label));
    if (node.empty()) return std::nullopt;
    return std::move(node.mapped());
  }
  /// Discards the earlier runs that are left, once the comparison has reached all that it needs.
  void drop_the_rest() { finished_.clear(); }

 private:
  static std::string key(int order, const std::string& label) {
    return fmt::format("{} {}", order, label);
  }

  std::vector<ComparedRun>& runs_;
  std::map<std::string, ComparedRun> finished_;
};

/// One comparison. All integrations are judged first, and then timed in turns.
class Comparison {
 public:
  Comparison(const Scene& scene, const ComparisonOptions& options, ComparisonResult& result)
      : scene_(scene),
        options_(options),
        result_(result),
        series_(options.series.empty() ? candidate_series(scene) : options.series) {}

  void run() {
    find_reference();
    ComparedOrder& order = at_order(scene_.order);
    result_.separation_points = order.points().size();
    judge_all(order);
    watch_all(order);
    judge_costs();
    time_all();
    fit_orders();
    result_.is_complete = true;
  }

 private:
  void report(const std::string& task, double fraction) const {
    if (options_.progress) options_.progress(task, fraction);
  }

  void save() const {
    if (options_.checkpoint) options_.checkpoint();
  }

  std::vector<int> cost_orders() const {
    std::vector<int> orders = scene_.comparison.orders;
    if (orders.empty()) {
      for (int d = 1; d <= scene_.order; ++d) orders.push_back(d);
    }
    std::sort(orders.begin(), orders.end());
    orders.erase(std::unique(orders.begin(), orders.end()), orders.end());
    return orders;
  }

  /// Takes the reference from the store, or computes and stores it.
  void find_reference() {
    Scene scene = scene_;
    scene.order = std::max(scene_.order, cost_orders().back());
    const ComputedProblem problem = make_problem(scene);
    const std::string key = reference_key(scene, scene.order);
    std::optional<ReferenceResult> found;
    if (options_.references != nullptr) found = options_.references->load(key, problem.space);
    result_.is_reference_cached = found.has_value();
    if (!found) {
      try {
        found = compute_reference(problem, scene.duration,
                                  scene.reference.value_or(ReferenceSettings{}), scene.precision,
                                  [&](double done) { report("reference", done); });
      } catch (const Error& error) {
        throw Error(error.kind(), fmt::format("reference: {}", error.what()));
      }
    }
    const double uncertainty = found->largest_uncertainty();
    if (!(uncertainty <= largest_uncertainty)) {
      throw Error(ErrorKind::numerical,
                  fmt::format("reference: its two runs differ by {:.2g} relative to the largest "
                              "coefficient of a degree, at most {:.0e} can judge double precision; "
                              "a smaller reference.tolerance or a shorter duration may agree",
                              uncertainty, largest_uncertainty));
    }
    if (options_.references != nullptr && !result_.is_reference_cached) {
      options_.references->save(key, *found);
    }
    result_.reference = std::move(*found);
    if (problem.is_full_jet) choose_kind(problem);
  }

  /// Chooses the kind whose exactness is reported. The linear part alone decides, so that the
  /// reference's order does not matter.
  void choose_kind(const ComputedProblem& problem) {
    const std::vector<Series<Extended>>& jet = result_.reference.jet;
    const bool is_named = scene_.kinds && scene_.kinds->front() != "auto";
    result_.kind = is_named ? parse_kind(scene_.kinds->front(), problem.degrees_of_freedom.size())
                            : best_conditioned_kind(jet, problem.momentum_exponent);
    result_.kind_condition =
        condition_number(inverted_block(jet, *result_.kind, problem.momentum_exponent));
  }

  ComparedOrder& at_order(int order) {
    auto& place = orders_[order];
    if (!place) {
      place = std::make_unique<ComparedOrder>(scene_, order, result_.reference, result_.kind);
    }
    return *place;
  }

  /// Seconds that the runs of one series may take together.
  double allowance() const {
    const double integrations = scene_.comparison.repeats + 1;
    return scene_.comparison.time_budget_s / static_cast<double>(series_.size()) / integrations;
  }

  void judge_all(ComparedOrder& order) {
    FinishedRuns finished(result_.runs);
    for (std::size_t i = 0; i < series_.size(); ++i) judge_series(order, i, finished);
    finished.drop_the_rest();
  }

  /// Judges a series from coarse to fine, as long as the error falls and time is left.
  void judge_series(ComparedOrder& order, std::size_t index, FinishedRuns& finished) {
    const CandidateSeries& series = series_[index];
    double left = allowance();
    double last_seconds = 0;
    double smallest = std::numeric_limits<double>::infinity();
    int fruitless = 0;
    for (std::size_t k = 0; k < series.candidates.size(); ++k) {
      const Candidate& candidate = series.candidates[k];
      const double expected = last_seconds * cost_ratio(series, k);
      ComparedRun run;
      if (expected > left) {
        run = left_out(candidate, series.name, order.problem().space->order(), expected);
      } else {
        run = judge(order, candidate, series.name, left, finished,
                    (static_cast<double>(index) +
                     static_cast<double>(k) / static_cast<double>(series.candidates.size())) /
                        static_cast<double>(series_.size()));
      }
      const bool is_left_out = !run.left_out.empty();
      const bool is_finished = run.is_finished();
      if (is_finished) {
        last_seconds = run.statistics.wall_seconds;
        left -= last_seconds;
        fruitless = run.largest_error() < 0.5 * smallest ? 0 : fruitless + 1;
        smallest = std::min(smallest, run.largest_error());
      }
      result_.runs.push_back(std::move(run));
      save();
      if (!series.stops_at_round_off) continue;
      if (is_left_out) return;
      if (fruitless >= fruitless_refinements && smallest < near_round_off) return;
    }
  }

  /// How much longer the k-th candidate is expected to take than the one before it.
  static double cost_ratio(const CandidateSeries& series, std::size_t k) {
    if (k == 0) return 1;
    const auto& before = series.candidates[k - 1].settings;
    const auto& now = series.candidates[k].settings;
    if (before.step_canonical && now.step_canonical) {
      return *before.step_canonical / *now.step_canonical;
    }
    return 1;
  }

  static ComparedRun left_out(const Candidate& candidate, const std::string& series, int order,
                              double seconds) {
    ComparedRun run;
    run.settings = candidate.settings;
    run.series = series;
    run.order = order;
    run.left_out = fmt::format(
        "would take more than {:.2g} s a run, which compare.time_budget_s "
        "does not leave; finer ones likewise",
        seconds);
    return run;
  }

  ComparedRun judge(ComparedOrder& order, const Candidate& candidate, const std::string& series,
                    double allowed_seconds, FinishedRuns& finished, double done) {
    const int degree = order.problem().space->order();
    if (auto earlier = finished.take(degree, candidate.settings.label)) return std::move(*earlier);
    report("judging runs", done);
    try {
      return order.judge(candidate, series, [&](double seconds) {
        report("judging runs", done);
        if (seconds > allowed_seconds) throw TooSlow{seconds};
      });
    } catch (const TooSlow& slow) {
      return left_out(candidate, series, degree, slow.seconds);
    }
  }

  void watch_all(ComparedOrder& order) {
    std::set<std::string> watched;
    for (const RunAlongTime& run : result_.along_time) watched.insert(run.label);
    TimesWithoutKind singular;
    if (result_.kind && watched.size() < scene_.integrators.size()) {
      singular = times_without_kind(order.problem(), scene_.duration, *result_.kind,
                                    [&](double done) { report("singular times", done); });
    }
    for (const IntegratorSettings& settings : scene_.integrators) {
      if (watched.contains(settings.label)) continue;
      result_.along_time.push_back(order.watch(
          settings, singular, [&](double done) { report("along time: " + settings.label, done); }));
      save();
    }
  }

  /// At all orders, judges the candidate of each method that reaches the wanted error with the
  /// least work.
  void judge_costs() {
    FinishedRuns finished(result_.cost_runs);
    std::map<IntegrationMethod, const ComparedRun*> cheapest;
    for (const ComparedRun& run : result_.runs) {
      if (!run.is_finished() || !(run.error_at_formation_m <= scene_.comparison.wanted_error_m)) {
        continue;
      }
      const ComparedRun*& best = cheapest[run.settings.method];
      if (best == nullptr || work(run) < work(*best)) best = &run;
    }
    for (const auto& [method, run] : cheapest) {
      for (const int order : cost_orders()) {
        result_.cost_runs.push_back(judge(at_order(order), candidate_of(*run), run->series,
                                          scene_.comparison.time_budget_s, finished, 1));
        save();
      }
    }
    finished.drop_the_rest();
  }

  /// Fits orders to the nominal and to the highest degree that is not zero; in extended precision
  /// if double precision has no steps at which theory holds.
  void fit_orders() {
    result_.fits.clear();
    const std::set<int> degrees = {
        0, working_order(*at_order(scene_.order).problem().system, scene_.order)};
    for (const CandidateSeries& series : series_) {
      if (series.order == 0) continue;
      for (const int degree : degrees) {
        auto fit = fit_convergence(result_, series, degree);
        if (!fit || !fit->agrees()) {
          auto finer = fit_extended_convergence(
              result_, series, degree, fit_budget * scene_.comparison.time_budget_s,
              [&](double done) { report("order of convergence of " + series.name, done); });
          if (finer) fit = std::move(finer);
        }
        if (fit) result_.fits.push_back(std::move(*fit));
      }
    }
  }

  static double work(const ComparedRun& run) {
    // A linear system has no products of series.
    return run.multiply_adds > 0 ? run.multiply_adds
                                 : static_cast<double>(run.statistics.vector_field_evaluations);
  }

  Candidate candidate_of(const ComparedRun& run) const {
    for (const CandidateSeries& series : series_) {
      for (const Candidate& candidate : series.candidates) {
        if (candidate.settings.label == run.settings.label) return candidate;
      }
    }
    return {run.settings};
  }

  void time_all() {
    std::vector<ComparedRun*> runs;
    for (ComparedRun& run : result_.runs) runs.push_back(&run);
    for (ComparedRun& run : result_.cost_runs) runs.push_back(&run);
    const int repeats = scene_.comparison.repeats;
    for (int round = 0; round < repeats; ++round) {
      for (std::size_t k = 0; k < runs.size(); ++k) {
        ComparedRun& run = *runs[k];
        if (!run.is_finished() || run.seconds.size() > static_cast<std::size_t>(round)) continue;
        const double done = (round + static_cast<double>(k) / static_cast<double>(runs.size())) /
                            static_cast<double>(repeats);
        report("timing", done);
        at_order(run.order).time(candidate_of(run), run, [&] { report("timing", done); });
        save();
      }
    }
  }

  const Scene& scene_;
  const ComparisonOptions& options_;
  ComparisonResult& result_;
  std::vector<CandidateSeries> series_;
  std::map<int, std::unique_ptr<ComparedOrder>> orders_;
};

void require_comparable(const Scene& scene) {
  if (scene.precision != Precision::double_precision) {
    throw Error(ErrorKind::scene,
                "precision: integrators are compared in double precision, got \"extended\", must "
                "be \"double\"");
  }
  if (!scene.separation) {
    throw Error(ErrorKind::scene,
                "formation: missing, must give the separation at which errors are stated, for "
                "example separation_km = 1 (separation_m for models without an orbit)");
  }
  if (scene.duration == 0) {
    throw Error(ErrorKind::scene,
                "jet: the duration is 0, at which every integrator gives the identity; to compare "
                "integrators it must be another");
  }
}

}  // namespace

void compare(const Scene& scene, const ComparisonOptions& options, ComparisonResult& result) {
  require_comparable(scene);
  result.scene = scene;
  result.is_complete = false;
  Comparison(scene, options, result).run();
}

}  // namespace hamjet
