#include "canonical_transformation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../../algebra/raise_to.hpp"
#include "../../maps/discrete_hamilton_jacobi.hpp"
#include "../../maps/symplectic_powers.hpp"
#include "../../maps/transformed_midpoint.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/midpoint.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {
namespace {

constexpr long most_stored_points = 20000;

double step_count(const CanonicalTransformationStudy& study, double step) {
  // A step that divides the duration up to round-off counts as dividing it.
  return std::max(1.0, std::ceil(study.duration / step * (1 - 1e-12)));
}

void validate(const CanonicalTransformationStudy& study) {
  const auto is_positive = [](double x) { return std::isfinite(x) && x > 0; };
  if (!is_positive(study.duration) || study.steps.empty() ||
      !std::all_of(study.steps.begin(), study.steps.end(), is_positive)) {
    throw Error(ErrorKind::usage,
                "canonical transformation: duration and step sizes must be above 0, and there must "
                "be a step size");
  }
  double count = 0;
  for (const double step : study.steps) count += step_count(study, step);
  if (!(count <= largest_transformed_step_count)) {
    throw Error(ErrorKind::too_large,
                fmt::format("canonical transformation: {:.3g} steps, at most {:.0e} are taken; a "
                            "shorter duration or larger steps would do",
                            count, largest_transformed_step_count));
  }
}

std::vector<double> numbers(const Vector<double>& v) { return {v.begin(), v.end()}; }

void raise(std::optional<double>& largest, double value) {
  if (!largest || !(value <= *largest)) largest = value;
}

/// The run of one step size: the same steps in both coordinates, side by side.
class Run {
 public:
  Run(const CanonicalTransformationStudy& study, const DynamicalSystem& system, double requested)
      : study_(study),
        original_(system),
        hamiltonian_(system),
        state_(Eigen::Map<const Vector<double>>(study.nominal.data(),
                                                static_cast<Eigen::Index>(study.nominal.size()))) {
    const double count = step_count(study, requested);
    result_.requested_step = requested;
    result_.steps = static_cast<long>(count);
    result_.step = study.duration / count;
    result_.stored_interval = (result_.steps + most_stored_points - 1) / most_stored_points;
  }

  /// Takes the steps; `progress` is called with their number so far.
  template <class Progress>
  CanonicalTransformationRun run(const Progress& progress) {
    try {
      TransformedMidpoint<double> transformed(hamiltonian_, SymplecticPowers(study_.transformation),
                                              state_, result_.step);
      energy_ = original_.value(state_);
      transformed_energy_ = transformed.energy();
      record(transformed, 0);
      for (long k = 0; k < result_.steps; ++k) {
        progress(k);
        const Vector<double> next = midpoint_step<double>(original_, state_, result_.step);
        check_hamilton_jacobi(transformed, (state_ + next) / 2);
        state_ = next;
        transformed.advance();
        record(transformed, k + 1);
      }
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      result_.failure = fmt::format("after {} of {} steps: {}", done_, result_.steps, error.what());
    }
    return std::move(result_);
  }

 private:
  void record(TransformedMidpoint<double>& transformed, long k) {
    const AffineSymplecticMap<double>& map = transformed.map();
    const double condition = map.condition();
    if (!(condition <= largest_transformation_condition)) {
      throw Error(ErrorKind::numerical,
                  fmt::format("the condition of A_{} is {:.3g}: powers of the transformation grow, "
                              "and round-off alone would be all that is seen",
                              k, condition));
    }
    CanonicalTransformationPoint point;
    point.step = k;
    point.time = static_cast<double>(k) * result_.step;
    point.energy_error = original_.value(state_) - energy_;
    point.transformed_energy_error = transformed.energy() - transformed_energy_;
    const double difference = std::abs(point.transformed_energy_error - point.energy_error);
    if (!std::isfinite(difference)) {
      throw Error(ErrorKind::numerical, "the energy is not finite");
    }
    done_ = k;
    raise_to(result_.largest_condition, condition);
    raise_to(result_.largest_symplecticity_defect, symplecticity_defect(map.matrix()).relative);
    raise_to(result_.largest_energy_error, std::abs(point.energy_error));
    raise_to(result_.largest_transformed_energy_error, std::abs(point.transformed_energy_error));
    raise_to(result_.largest_energy_difference, difference);
    raise_to(result_.largest_state_difference,
             (map.inverse()(transformed.state()) - state_).cwiseAbs().maxCoeff());
    least_position_ = std::min(least_position_, state_(0));
    greatest_position_ = std::max(greatest_position_, state_(0));
    if (study_.system.model == SystemModel::double_well) {
      result_.crosses_barrier = least_position_ < 0 && greatest_position_ > 0;
    }
    if (k % result_.stored_interval != 0 && k != result_.steps) return;
    point.original = numbers(state_);
    point.transformed = numbers(transformed.state());
    result_.trajectory.push_back(std::move(point));
  }

  /// Computes the residual at the midpoint of the step in z, whose image under f_k is the midpoint
  /// in Z.
  void check_hamilton_jacobi(TransformedMidpoint<double>& transformed,
                             const Vector<double>& middle) {
    using Kind = DiscreteGeneratingFunctionKind;
    const Eigen::Index n = middle.size() / 2;
    const AffineSymplecticMap<double>& map = transformed.map();
    const Vector<double> image = map(middle);
    double best_existence = 0;
    double best_residual = 0;
    for (const Kind kind : {Kind::first, Kind::second}) {
      HamiltonJacobiCheck& check = kind == Kind::first ? result_.first_kind : result_.second_kind;
      if (!exists(map, kind)) continue;
      const double existence = existence_measure(map, kind);
      const DiscreteGeneratingFunction<double> generating_function(map, kind);
      Vector<double> w(2 * n);
      w << middle.head(n), (kind == Kind::first ? image.head(n) : image.tail(n));
      const double residual = std::abs(hamilton_jacobi_residual<double>(
          original_, transformed.hamiltonian(), generating_function, w));
      ++check.steps;
      raise(check.largest_residual, residual);
      check.smallest_existence = std::min(existence, check.smallest_existence.value_or(existence));
      if (existence > best_existence) {
        best_existence = existence;
        best_residual = residual;
      }
    }
    if (best_existence > 0) raise(result_.hamilton_jacobi_residual, best_residual);
  }

  const CanonicalTransformationStudy& study_;
  RecordedHamiltonian<double> original_;
  RecordedHamiltonian<double> hamiltonian_;  ///< the H from which K is made
  Vector<double> state_;
  double energy_ = 0;
  double transformed_energy_ = 0;
  double least_position_ = std::numeric_limits<double>::infinity();
  double greatest_position_ = -std::numeric_limits<double>::infinity();
  long done_ = 0;
  CanonicalTransformationRun result_;
};

}  // namespace

CanonicalTransformationResult run_study(const CanonicalTransformationStudy& study,
                                        const ProgressCallback& progress) {
  validate(study);
  const DynamicalSystem system = make_system(study.system, study.canonical_radius);
  const auto dimension = static_cast<Eigen::Index>(system.dimension());
  if (study.nominal.size() != system.dimension() || study.transformation.dimension() != dimension) {
    throw Error(ErrorKind::usage,
                fmt::format("canonical transformation: the model has {} variables, the nominal {}, "
                            "the transformation {}",
                            dimension, study.nominal.size(), study.transformation.dimension()));
  }
  CanonicalTransformationResult result;
  result.study = study;
  result.energy = RecordedHamiltonian<double>(system).value(
      Eigen::Map<const Vector<double>>(study.nominal.data(), dimension));
  if (!std::isfinite(result.energy)) {
    throw Error(ErrorKind::numerical,
                "canonical transformation: the energy of the start is not finite");
  }
  double total = 0;
  for (const double step : study.steps) total += step_count(study, step);
  double before = 0;
  for (const double step : study.steps) {
    constexpr long interval = 256;  // number of steps between two reports
    const std::string task = fmt::format("step {:g}", step);
    result.runs.push_back(Run(study, system, step).run([&](long k) {
      if (progress && k % interval == 0) {
        progress(task, (before + static_cast<double>(k)) / total);
      }
    }));
    before += step_count(study, step);
  }
  return result;
}

int exit_code(const CanonicalTransformationResult& result) {
  int code = 0;
  for (const CanonicalTransformationRun& run : result.runs) {
    if (!run.failure.empty()) return static_cast<int>(ErrorKind::numerical);
    if (result.study.require_invariance &&
        !(run.largest_energy_difference <= *result.study.require_invariance)) {
      code = static_cast<int>(ErrorKind::check_failed);
    }
  }
  return code;
}

}  // namespace hamjet
