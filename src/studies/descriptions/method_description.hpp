#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/integrators/arc_splitting.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "hamjet/studies/scene.hpp"

// The single description of every integrator: scenes, lists, comparisons, self-checks and results
// read it. A method is added by its integrator, its place in integration_method.hpp and its
// description in integration_methods.cpp.

namespace hamjet {

/// The largest number of stages of Gauss collocation in a scene.
inline constexpr int most_gauss_stages = 12;

/// A key of `[[integrator]]` that only some methods have.
struct MethodSetting {
  std::string_view key;           ///< the name of the member
  std::string_view column = key;  ///< the method's name in comparisons
  std::string_view help = {};     ///< what it is, for people
  std::variant<int IntegratorSettings::*, double IntegratorSettings::*, bool IntegratorSettings::*>
      member;
  double least = 0;  ///< least value; the range includes both ends
  double most = 0;
  std::vector<int> choices = {};  ///< the only values of a whole number; if empty, all in the range
  /// Words for people, such as "8 stages"; empty if there is nothing to say.
  std::string (*text)(const IntegratorSettings&) = [](const IntegratorSettings&) {
    return std::string();
  };
  /// Whether another value means another method, so that comparisons have a column for it and name
  /// it in their advice.
  bool is_compared = true;
};

/// A form of a method that a comparison runs with several steps or tolerances.
struct ComparedForm {
  IntegratorSettings settings;
  std::string name;   ///< name for people
  std::string label;  ///< the beginning of its runs' labels
  double order = 0;   ///< order of convergence, for fixed steps
};

/// The functions by which a method integrates in either arithmetic; null for an arithmetic that it
/// does not have. `records_step_error` asks for the largest local error even if that takes extra
/// work.
struct MethodIntegration {
  template <class Real>
  using Function = FlowJet<Real> (*)(const FlowProblem<Real>&, const IntegratorSettings&,
                                     IntegrationStatistics&, const StepObserver<Real>&,
                                     bool records_step_error);
  Function<double> in_double = nullptr;
  Function<Extended> in_extended = nullptr;
};

/// The description of an integrator for scenes, lists, comparisons, self-checks and results.
struct MethodDescription {
  IntegrationMethod method;
  std::string_view name;  ///< name in scenes and results
  std::string_view
      help;  ///< description for people: kind of method, order, whether it is symplectic, keys
  std::vector<MethodSetting> settings = {};
  bool has_fixed_steps = true;
  bool has_tolerance = false;
  /// Whether the tolerance bounds the relative error of every degree after one period, instead of
  /// the local error of each step.
  bool tolerance_is_of_the_jet = false;

  /// The library that a build may lack, the option that enables it, and whether this build has it.
  std::string_view library = {};
  std::string_view build_option = {};
  bool (*is_built)() = [] { return true; };

  MethodIntegration integrate;
  /// The method in the form that integrations in arcs use; no value if its steps do not follow from
  /// the nominal alone, so that a flow cannot be split.
  std::optional<SplittableMethod> (*splittable)(const IntegratorSettings&) =
      [](const IntegratorSettings&) { return std::optional<SplittableMethod>(); };

  /// The reason why its jets are not checked for symplecticity; empty if they are.
  std::string_view not_symplectic = {};
  /// Whether a method that is not checked is symplectic in (q, p) with these settings; null if it
  /// is with none.
  bool (*is_symplectic_with)(const IntegratorSettings&) = nullptr;
  std::string_view symplectic_with = {};  ///< those settings, for people: "beta = 0"

  /// The reason why these settings have no iteration to check; empty if equations are solved.
  std::string_view (*solves_no_equations)(const IntegratorSettings&) =
      [](const IntegratorSettings&) {
        return std::string_view("an explicit method solves no equations");
      };
  bool is_stable_for_every_step = false;  ///< on linear systems
  /// Whether the map of a step preserves a two-form in some variables.
  bool preserves_a_two_form = true;
  bool is_multistep = false;  ///< whether its steps depend on earlier steps
  /// The exponent, relative to the leading term, of the next term in the error: symmetric methods
  /// have an expansion in even powers of the step (Hairer, Nørsett and Wanner, Solving ODEs I,
  /// II.8).
  int error_correction = 2;
  /// The number of numbers that the integration holds for each coefficient of a series, if an
  /// evaluation of the vector field has `values` series and the state has `dimension` components.
  double (*numbers_held)(const IntegratorSettings&, double values, double dimension) =
      [](const IntegratorSettings&, double values, double dimension) {
        // The states that odeint's 13 stages, or CVODE's Nordsieck array, hold, and one lane.
        return values + 20 * dimension;
      };

  /// The forms in which comparisons run the method, as the scene's `[compare]` chooses them.
  std::vector<ComparedForm> (*compared_forms)(const ComparisonSettings&) =
      [](const ComparisonSettings&) { return std::vector<ComparedForm>(); };
  bool is_compared_by_default = false;
  /// Whether it serves systems q' = M^-1 p, p' = F(q) alone, with a constant M.
  bool needs_second_order_form = false;

  /// Whether the method with these settings is symplectic in (q, p).
  bool is_symplectic(const IntegratorSettings& given) const {
    return not_symplectic.empty() || (is_symplectic_with != nullptr && is_symplectic_with(given));
  }
};

/// The settings of a Gauss method as integrate_gauss takes them.
GaussSettings gauss_settings(const IntegratorSettings& settings);

/// All methods, in the order of the enumeration.
const std::vector<MethodDescription>& all_methods();

/// The description of one method.
const MethodDescription& description_of(IntegrationMethod method);

/// The settings that comparisons list, without repetition, in the order of the methods.
std::vector<MethodSetting> compared_settings();

/// A method's settings that comparisons list, with their values: {"stages", "8"}.
std::vector<std::pair<std::string_view, std::string>> compared_values(
    const IntegratorSettings& settings);

}  // namespace hamjet
