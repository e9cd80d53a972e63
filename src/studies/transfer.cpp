#include "hamjet/studies/transfer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "exact_flow.hpp"
#include "formation_problem.hpp"
#include "hamjet/error.hpp"
#include "jets_along_time.hpp"
#include "kind_choice.hpp"
#include "single_transfer.hpp"

namespace hamjet {
namespace {

/// Adds the time of its life to a sum of seconds.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() {
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Checkpoints of the linear flow in one revolution (2 pi canonical at the initial distance).
constexpr double checkpoints_per_turn = 240;

/// One study at work.
class TransferStudy {
 public:
  TransferStudy(const Scene& scene, const ProgressCallback& progress)
      : scene_(scene),
        settings_(*scene.transfer),
        progress_(progress),
        problem_(make_problem(scene, available_memory())),
        kinds_(all_kinds(3)) {
    result_.scene = scene;
    result_.conditions.kinds = kinds_;
  }

  TransferResult run() {
    find_singular_times();
    const IntegratorSettings& integrator = symplectic_integrator(scene_);
    result_.integrator = integrator.label;
    result_.statistics =
        visit_jets(problem_, integrator, settings_.times,
                   [&](std::size_t index, const FlowJet<double>& jet) { visit(index, jet); });
    result_.seconds.propagation = result_.statistics.wall_seconds;
    return std::move(result_);
  }

 private:
  void report(const std::string& task, double fraction) const {
    if (progress_) progress_(task, fraction);
  }

  void find_singular_times() {
    const Stopwatch watch(result_.seconds.singularities);
    const double span = settings_.times.back();
    // A little longer, so that what lies right behind the last time is seen too.
    const double searched = span + std::copysign(settings_.singular_margin, span);
    const auto intervals = static_cast<std::size_t>(
        std::ceil(checkpoints_per_turn * std::abs(searched) / (2 * std::numbers::pi)));
    const LinearFlow flow(problem_, searched, std::max<std::size_t>(intervals, 16),
                          [&](double done) { report("linear flow", done); });
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      report("singular times", static_cast<double>(k) / static_cast<double>(kinds_.size()));
      for (SingularTime& found : hamjet::find_singular_times(flow, kinds_[k])) {
        result_.singular_times.push_back(std::move(found));
      }
    }
    position_times_ = result_.position_singularities();
  }

  void visit(std::size_t index, const FlowJet<double>& jet) {
    report("transfers", static_cast<double>(index) / static_cast<double>(settings_.times.size()));
    TransferPoint point;
    point.time = settings_.times[index];
    mark_singularity(point);
    try {
      if (const auto kind = choose_kind(jet, point)) answer(*kind, jet, point);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      point.failure = error.what();
    }
    if (index + 1 == settings_.times.size()) measure_floor(jet);
    result_.points.push_back(std::move(point));
  }

  void mark_singularity(TransferPoint& point) const {
    for (const SingularTime& singular : position_times_) {
      const double distance = std::abs(singular.time - point.time);
      point.singular_distance = std::min(point.singular_distance.value_or(distance), distance);
    }
    point.is_near_singular =
        point.singular_distance && *point.singular_distance < settings_.singular_margin;
  }

  /// The conditions of all kinds at this time, and the kind to use.
  std::optional<GeneratingFunctionKind> choose_kind(const FlowJet<double>& jet,
                                                    TransferPoint& point) {
    const std::span<const Series<double>> map(jet);
    const LinearFlow::StateTransition flow = linear_part(map);
    std::vector<double> conditions;
    for (const GeneratingFunctionKind& kind : kinds_) {
      conditions.push_back(condition_number<double>(inverted_block(flow, kind)));
    }
    point.position_condition = conditions.front();
    std::optional<GeneratingFunctionKind> kind;
    if (settings_.kind == "auto") {
      const double largest = largest_condition(std::numeric_limits<double>::epsilon());
      if (const auto index = choice_.choose(conditions, largest)) kind = kinds_[*index];
    } else {
      kind = parse_kind(settings_.kind, 3);
    }
    result_.conditions.times.push_back(point.time);
    result_.conditions.values.push_back(std::move(conditions));
    if (!kind) point.failure = "no kind of generating function exists at this time";
    return kind;
  }

  void answer(const GeneratingFunctionKind& kind, const FlowJet<double>& jet,
              TransferPoint& point) {
    point.kind = kind;
    PartialInversion<double> inversion;
    {
      const Stopwatch watch(result_.seconds.inversion);
      inversion = invert_partially<double>(std::span<const Series<double>>(jet), kind);
    }
    point.condition = inversion.condition;
    const std::vector<double> chief_end = nominal_of(jet);
    const SingleTransfer transfer(scene_, problem_, point.time, chief_end, settings_.start,
                                  settings_.end);
    std::vector<BoundaryMomenta> momenta;
    {
      const Stopwatch watch(result_.seconds.solution);
      PositionBoundaryValues boundary(inversion);
      for (int order = 1; order <= scene_.order; ++order) {
        momenta.emplace_back();
        record(point, order, [&] {
          momenta.back() = transfer.solve(boundary, order);
          return transfer.answer(momenta.back(), order);
        });
      }
    }
    const Stopwatch watch(result_.seconds.proof);
    for (std::size_t k = 0; k < momenta.size(); ++k) {
      if (!point.answers[k].failure.empty()) continue;
      TransferAnswer answer = std::move(point.answers[k]);
      point.answers[k] = attempt(answer.order, [&] {
        answer.miss_m = transfer.miss_m(transfer.fly(momenta[k].initial));
        return answer;
      });
    }
    const TransferAnswer& last = point.answers.back();
    point.is_beyond_tolerance = !last.failure.empty() || !(last.miss_m <= settings_.tolerance_m);
    if (settings_.refine && last.failure.empty()) {
      point.refined = transfer.refine(jet, momenta.back(), point.refinement_flights);
    }
  }

  /// The answer that `work` gives, or its numerical failure.
  template <class Work>
  static TransferAnswer attempt(int order, const Work& work) {
    try {
      return work();
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      TransferAnswer failed;
      failed.order = order;
      failed.failure = error.what();
      return failed;
    }
  }
  template <class Work>
  static void record(TransferPoint& point, int order, const Work& work) {
    point.answers.push_back(attempt(order, work));
  }

  void measure_floor(const FlowJet<double>& jet) {
    const Stopwatch watch(result_.seconds.proof);
    const std::vector<double> flown =
        exact_flow(problem_.system, problem_.nominal, settings_.times.back());
    result_.flight_floor_m =
        std::hypot(flown[0] - jet[0][0], flown[1] - jet[1][0], flown[2] - jet[2][0]) *
        metric_units(scene_).length_m;
  }

  const Scene& scene_;
  const TransferSettings& settings_;
  const ProgressCallback& progress_;
  ComputedProblem problem_;
  std::vector<GeneratingFunctionKind> kinds_;
  KindChoice choice_;
  std::vector<SingularTime> position_times_;
  TransferResult result_;
};

}  // namespace

std::optional<std::size_t> TransferResult::best_point() const {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TransferPoint& point = points[i];
    if (!point.has_answer() || point.is_near_singular || !point.best().failure.empty()) continue;
    if (point.is_beyond_tolerance && !point.refined) continue;
    if (!best || point.best().total_change_m_s() < points[*best].best().total_change_m_s()) {
      best = i;
    }
  }
  return best;
}

std::vector<SingularTime> TransferResult::position_singularities() const {
  const GeneratingFunctionKind f1 = parse_kind("F1", 3);
  std::vector<SingularTime> found;
  for (const SingularTime& singular : singular_times) {
    if (singular.kind == f1) found.push_back(singular);
  }
  return found;
}

TransferResult study_transfer(const Scene& scene, const ProgressCallback& progress) {
  require_formation_problem(scene, scene.transfer.has_value(), "transfer");
  return TransferStudy(scene, progress).run();
}

int exit_code(const TransferResult& result) {
  bool has_answer = false;
  bool has_fault = false;
  for (const TransferPoint& point : result.points) {
    has_answer = has_answer || point.has_answer();
    if (point.is_near_singular) continue;
    has_fault = has_fault || !point.has_answer() || point.is_beyond_tolerance ||
                !point.best().failure.empty();
  }
  if (!has_answer) return static_cast<int>(ErrorKind::numerical);
  return result.scene.transfer->strict && has_fault ? static_cast<int>(ErrorKind::check_failed) : 0;
}

RelativeTrajectory fly_relative(const TransferResult& result, std::size_t point, int count) {
  const Scene& scene = result.scene;
  const ComputedProblem problem = make_problem(scene, available_memory());
  const TransferPoint& transfer = result.points[point];
  const MetricUnits units = metric_units(scene);
  const RelativeFrame frame = scene.transfer->frame;
  RelativeState start = scene.transfer->start;
  start.velocity_m_s += transfer.best().start_change_m_s;
  std::vector<double> chief = problem.nominal;
  std::vector<double> deputy = chief;
  const auto deviation = ChiefFrame(chief, units, frame).deviation(start);
  for (std::size_t i = 0; i < deputy.size(); ++i) deputy[i] += deviation[i];
  RelativeTrajectory trajectory;
  for (int k = 0; k <= count; ++k) {
    if (k > 0) {
      chief = exact_flow(problem.system, chief, transfer.time / count);
      deputy = exact_flow(problem.system, deputy, transfer.time / count);
    }
    std::vector<double> difference;
    for (std::size_t i = 0; i < deputy.size(); ++i) difference.push_back(deputy[i] - chief[i]);
    trajectory.times.push_back(transfer.time * k / count);
    trajectory.states.push_back(ChiefFrame(chief, units, frame).relative(difference));
  }
  return trajectory;
}

}  // namespace hamjet
