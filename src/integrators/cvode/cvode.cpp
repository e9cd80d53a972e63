#include "hamjet/integrators/cvode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "../integration_clock.hpp"
#include "../series_vector_field.hpp"
#include "../step_ends.hpp"
#include "../step_sequence.hpp"
#include "cvode_block_solver.hpp"
#include "cvode_vectors.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

static_assert(std::is_same_v<realtype, double>, "hamjet needs SUNDIALS in double precision");

const char* method_name(CvodeMethod method) {
  return method == CvodeMethod::adams ? "CVODE Adams" : "CVODE BDF";
}

/// One integration. CVODE calls the static functions, with this object as user data. No exception
/// may pass through CVODE, so that exceptions are kept and thrown afterwards.
class CvodeIntegration {
 public:
  CvodeIntegration(const FlowProblem<double>& problem, const CvodeSettings& settings,
                   IntegrationStatistics& statistics, const StepObserver<double>& observer)
      : problem_(problem),
        settings_(settings),
        statistics_(statistics),
        observer_(observer),
        ends_(problem),
        name_(method_name(settings.method)),
        field_(problem, name_),
        guard_(problem, settings.tolerance, name_),
        jet_(starting_jet(problem)) {
    const std::vector<double> initial = field_.initial_state();
    state_ = sundials::make_vector(static_cast<sunindextype>(initial.size()), context_);
    std::copy(initial.begin(), initial.end(), numbers());
    const bool is_adams = settings.method == CvodeMethod::adams;
    memory_.reset(sundials::require(CVodeCreate(is_adams ? CV_ADAMS : CV_BDF, context_)));
    require(CVodeSetErrHandlerFn(memory_.get(), keep_message, this));
    require(CVodeInit(memory_.get(), right_hand_side, 0, state_.get()));
    require(CVodeSetUserData(memory_.get(), this));
    require(CVodeWFtolerances(memory_.get(), error_weights));
    require(CVodeSetMaxHnilWarns(memory_.get(), -1));
    require(CVodeSetStopTime(memory_.get(), ends_.after(0)));
    if (is_adams) {
      nonlinear_solver_.reset(
          sundials::require(SUNNonlinSol_FixedPoint(state_.get(), 0, context_)));
      require(CVodeSetNonlinearSolver(memory_.get(), nonlinear_solver_.get()));
    } else {
      set_block_solver();
    }
  }

  FlowJet<double> run() {
    while (time_ != problem_.duration) {
      step();
      if (!observer_) continue;
      clock_.exclude([&] {
        field_.copy_to(jet_, numbers());
        observer_(time_, jet_);
      });
    }
    field_.copy_to(jet_, numbers());
    collect_counts();
    statistics_.vector_field_evaluations += field_.evaluations();
    statistics_.series_work = field_.work();
    if (settings_.counts != nullptr) *settings_.counts = counts_;
    statistics_.wall_seconds = clock_.seconds();
    return std::move(jet_);
  }

 private:
  double* numbers() { return N_VGetArrayPointer(state_.get()); }

  /// One step of CVODE, which stops at the stop time exactly.
  void step() {
    const double before = time_;
    const double end = ends_.after(time_);
    require(CVode(memory_.get(), end, state_.get(), &time_, CV_ONE_STEP));
    if (time_ == before) {
      // CVODE itself would continue with t + h = t for ever.
      throw Error(
          ErrorKind::numerical,
          fmt::format("{}: the step size underflowed at t = {:.15g}: a collision or another "
                      "singularity lies ahead",
                      name_, time_));
    }
    if (!field_.is_finite(numbers())) {
      throw Error(ErrorKind::numerical,
                  fmt::format("{}: a coefficient is not finite at t = {:.10g}", name_, time_));
    }
    guard_.check(numbers(), field_.coefficients(), time_);
    if (settings_.records_step_error) {
      clock_.exclude([&] { record_step_error(); }, statistics_.step_error_seconds);
    }
    ++statistics_.steps;
    limit_step_count(name_.c_str(), statistics_.steps, time_, problem_.duration);
    if (time_ == end && end != problem_.duration) begin_anew();
  }

  /// Starts at the present time as from the beginning: the polynomials of earlier steps say nothing
  /// about forces that have no derivatives there.
  void begin_anew() {
    collect_counts();
    require(CVodeReInit(memory_.get(), time_, state_.get()));
    require(CVodeSetStopTime(memory_.get(), ends_.after(time_)));
  }

  /// Records the root mean square that CVODE keeps below 1, multiplied by the tolerance.
  void record_step_error() {
    if (!errors_) {
      errors_.reset(sundials::require(N_VClone(state_.get())));
      error_weights_.reset(sundials::require(N_VClone(state_.get())));
    }
    require(CVodeGetEstLocalErrors(memory_.get(), errors_.get()));
    require(CVodeGetErrWeights(memory_.get(), error_weights_.get()));
    statistics_.record_step_error(settings_.tolerance *
                                  N_VWrmsNorm(errors_.get(), error_weights_.get()));
  }

  /// Throws if CVODE returned a negative flag, with the exception or the message that caused it.
  void require(int flag) {
    if (flag >= 0) return;
    if (exception_) std::rethrow_exception(exception_);
    char* flag_name = CVodeGetReturnFlagName(flag);
    std::string message =
        fmt::format("{}: CVODE failed with {} at t = {:.10g}", name_, flag_name, time_);
    std::free(flag_name);
    const std::string& reason = not_finite_.empty() ? message_ : not_finite_;
    if (!reason.empty()) message += " (" + reason + ")";
    throw Error(ErrorKind::numerical, message);
  }

  /// Sets a direct linear solver for Newton's iteration, with an empty matrix. CVODE then decides,
  /// as for its own direct solvers, when J is evaluated anew and when I - gamma J is factorised.
  void set_block_solver() {
    block_solver_.emplace(problem_);
    matrix_.reset(sundials::require(SUNMatNewEmpty(context_)));
    matrix_->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
    linear_solver_.reset(sundials::require(SUNLinSolNewEmpty(context_)));
    linear_solver_->content = this;
    linear_solver_->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
    linear_solver_->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
    linear_solver_->ops->solve = solve_linear_system;
    require(CVodeSetLinearSolver(memory_.get(), linear_solver_.get(), matrix_.get()));
    require(CVodeSetLinSysFn(memory_.get(), set_up_linear_system));
  }

  /// Does the work of a callback; returns 0, or a negative number if the work threw.
  template <class Work>
  static int call(void* self, const Work& work) noexcept {
    auto& integration = *static_cast<CvodeIntegration*>(self);
    try {
      return work(integration);
    } catch (...) {
      integration.exception_ = std::current_exception();
      return -1;
    }
  }

  /// The callback y' = f(y). If the result is not finite, a positive number tells CVODE to try a
  /// smaller step.
  static int right_hand_side(realtype time, N_Vector y, N_Vector derivative, void* self) {
    return call(self, [&](CvodeIntegration& integration) {
      try {
        integration.field_.evaluate(N_VGetArrayPointer(y), N_VGetArrayPointer(derivative), time);
      } catch (const Error& error) {
        if (error.kind() != ErrorKind::numerical) throw;
        integration.not_finite_ = error.what();
        return 1;
      }
      return 0;
    });
  }

  /// The callback that factorises I - gamma J. `*is_new` reports whether J was evaluated here;
  /// `may_keep` allows to keep the old J.
  static int set_up_linear_system(realtype time, N_Vector y, N_Vector, SUNMatrix,
                                  booleantype may_keep, booleantype* is_new, realtype gamma,
                                  void* self, N_Vector, N_Vector, N_Vector) {
    return call(self, [&](CvodeIntegration& integration) {
      CoefficientBlockSolver& solver = *integration.block_solver_;
      *is_new = may_keep ? SUNFALSE : SUNTRUE;
      if (!may_keep) {
        ++integration.counts_.jacobian_evaluations;
        if (!solver.evaluate(N_VGetArrayPointer(y), time)) return 1;
      }
      ++integration.counts_.factorisations;
      return solver.factorise(gamma) ? 0 : 1;
    });
  }

  static int solve_linear_system(SUNLinearSolver self, SUNMatrix, N_Vector x, N_Vector b,
                                 realtype) {
    return call(self->content, [&](CvodeIntegration& integration) {
      ++integration.counts_.linear_solves;
      N_VScale(1, b, x);
      integration.block_solver_->solve(N_VGetArrayPointer(x));
      return SUNLS_SUCCESS;
    });
  }

  /// Keeps the message that CVODE would write to standard error; warnings (positive codes) are
  /// ignored.
  static int error_weights(N_Vector y, N_Vector weights, void* self) {
    sundials::set_weights(y, weights, static_cast<CvodeIntegration*>(self)->settings_.tolerance);
    return 0;
  }

  static void keep_message(int code, const char*, const char*, char* message, void* self) {
    if (code >= 0) return;
    call(self, [&](CvodeIntegration& integration) {
      integration.message_ = message;
      return 0;
    });
  }

  /// Adds CVODE's counts since the start, or since it began anew.
  void collect_counts() {
    long test_failures = 0;
    long step_failures = 0;
    long iterations = 0;
    long failures = 0;
    require(CVodeGetNumErrTestFails(memory_.get(), &test_failures));
    require(CVodeGetNumStepSolveFails(memory_.get(), &step_failures));
    require(CVodeGetNonlinSolvStats(memory_.get(), &iterations, &failures));
    counts_.error_test_failures += test_failures;
    counts_.nonlinear_iterations += iterations;
    counts_.nonlinear_failures += failures;
    statistics_.rejected_steps += test_failures + step_failures;
  }

  const FlowProblem<double>& problem_;
  const CvodeSettings& settings_;
  IntegrationStatistics& statistics_;
  const StepObserver<double>& observer_;
  IntegrationClock clock_;
  StepEnds<double> ends_;
  std::string name_;
  SeriesVectorField<double> field_;
  EnergyGuard<double> guard_;
  std::optional<CoefficientBlockSolver> block_solver_;  ///< solver for BDF
  FlowJet<double> jet_;
  double time_ = 0;
  CvodeCounts counts_;
  std::exception_ptr exception_;
  std::string not_finite_;
  std::string message_;

  // The members stand in order of construction: CVODE's memory is freed before the objects that it
  // uses, and the context last.
  sundials::Context context_;
  sundials::Vector state_;
  sundials::Vector errors_;         ///< local errors, if they are recorded
  sundials::Vector error_weights_;  ///< weights of errors_
  sundials::NonlinearSolver nonlinear_solver_;
  sundials::Matrix matrix_;
  sundials::LinearSolver linear_solver_;
  sundials::Memory memory_;
};

}  // namespace

bool cvode_available() noexcept { return true; }

FlowJet<double> integrate_cvode(const FlowProblem<double>& problem, const CvodeSettings& settings,
                                IntegrationStatistics& statistics,
                                const StepObserver<double>& observer) {
  validate(problem);
  statistics = {};
  if (!(settings.tolerance >= std::numeric_limits<double>::epsilon()) ||
      !(settings.tolerance < 1)) {
    throw Error(ErrorKind::usage,
                fmt::format("{}: the tolerance must be between {:.2g}, the "
                            "rounding of its numbers, and 1",
                            method_name(settings.method), std::numeric_limits<double>::epsilon()));
  }
  if (problem.duration == 0) return starting_jet(problem);
  return CvodeIntegration(problem, settings, statistics, observer).run();
}

}  // namespace hamjet
