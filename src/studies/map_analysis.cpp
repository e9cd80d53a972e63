#include "map_analysis.hpp"

#include <cmath>
#include <span>

#include "../integrators/independent_runs.hpp"
#include "../integrators/momentum_unit.hpp"
#include "../maps/inversion_miss.hpp"
#include "checks/smooth_forces.hpp"
#include "formation_scale.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"
#include "integration.hpp"
#include "stopwatch.hpp"

namespace hamjet {
namespace {

/// The distance between the final positions of two nominals, in canonical units; positions are the
/// first components.
double position_distance(const FlowJet<Extended>& a, const FlowJet<Extended>& b,
                         std::size_t degrees_of_freedom) {
  Extended square = 0;
  for (std::size_t i = 0; i < degrees_of_freedom; ++i) {
    const Extended difference = a[i][0] - b[i][0];
    square += difference * difference;
  }
  return static_cast<double>(Extended(sqrt(square)));
}

template <class Real>
FlowJet<Extended> integrated_finer(const Scene& scene, const ComputedProblem& problem) {
  IntegrationStatistics statistics;
  return convert_map<Extended>(integrate_gauss<Real>(
      flow_problem<Real>(problem, scene.duration),
      gauss_of_independent_run<Real>(0, has_smooth_forces(scene.system)), statistics));
}

/// A bracket of degree d has products of the degrees a and d + 2 - a of the jet, each wrong by the
/// errors of both.
std::vector<double> defects_of_errors(const std::vector<double>& errors, std::size_t degrees) {
  std::vector<double> defects;
  for (std::size_t d = 0; d < degrees; ++d) {
    double worst = 0;
    for (std::size_t a = 1; a <= d + 1; ++a) worst = std::max(worst, errors[a] + errors[d + 2 - a]);
    defects.push_back(worst);
  }
  return defects;
}

}  // namespace

const FlowJet<Extended>* MapAnalysis::finer_jet() {
  if (reference_) return &reference_->jet;
  if (!finer_) {
    finer_.emplace();
    try {
      *finer_ = scene_.precision == Precision::extended
                    ? integrated_finer<Extended>(scene_, problem_)
                    : integrated_finer<double>(scene_, problem_);
    } catch (const Error& error) {
      // The residuals of the run itself are told all the same.
      if (error.kind() != ErrorKind::numerical && error.kind() != ErrorKind::too_large) throw;
    }
  }
  return finer_->empty() ? nullptr : &*finer_;
}

/// Tells what the forces and the integration leave of exactness, whose residual is linear in the
/// one-form.
void MapAnalysis::add_forces(KindResult& result, const std::vector<Series<Extended>>& sigma) {
  const FlowJet<Extended>* finer = finer_jet();
  if (finer == nullptr) return;
  std::vector<Series<Extended>> difference = one_form(invert_partially<Extended>(
      *finer, result.kind, rounding_of(scene_.precision), problem_.momentum_exponent));
  const auto forces = exactness_residual(difference, scales(result.kind));
  for (std::size_t i = 0; i < sigma.size(); ++i) difference[i] = sigma[i] - difference[i];
  const auto integration = exactness_residual(difference, scales(result.kind));
  for (std::size_t d = 0; d < result.by_degree.size(); ++d) {
    result.by_degree[d].forces = forces[d];
    result.by_degree[d].integration = integration[d].absolute;
  }
}

void MapAnalysis::add_integration_defects(RunResult& run, const FlowJet<Extended>& comparable) {
  std::vector<double> errors;
  if (finer_ && !finer_->empty()) {
    errors =
        relative_error_by_degree(comparable, compared_components(*finer_, problem_.variables,
                                                                 problem_.degrees_of_freedom.size(),
                                                                 problem_.momentum_exponent));
  } else if (run.error_by_degree) {
    errors = *run.error_by_degree;
  } else if (run.error_estimate.by_degree) {
    errors = *run.error_estimate.by_degree;
  }
  if (errors.size() > run.symplecticity.size()) {
    run.integration_defects = defects_of_errors(errors, run.symplecticity.size());
  }
}

std::vector<double> MapAnalysis::scales(const GeneratingFunctionKind& kind) const {
  if (!scene_.separation) return {};
  const double length = *scene_.separation;
  const double momentum = length * momentum_per_length(scene_);
  std::vector<double> result;
  for (const bool is_momentum : kind.final_is_momentum) {
    result.push_back(is_momentum ? momentum : length);
  }
  for (const bool is_momentum : kind.initial_is_momentum) {
    result.push_back(is_momentum ? momentum : length);
  }
  return result;
}

const std::vector<ExactnessResidual>* MapAnalysis::floor(const GeneratingFunctionKind& kind) {
  if (!reference_) return nullptr;
  const auto [place, is_new] = floors_.try_emplace(kind.name());
  if (is_new) {
    FlowJet<Extended> rounded = reference_->jet;
    if (scene_.precision == Precision::double_precision) {
      for (auto& component : rounded) {
        for (auto& c : component.coefficients()) c = Extended(static_cast<double>(c));
      }
    }
    try {
      ++floor_inversions_;
      const auto inversion = invert_partially<Extended>(
          rounded, kind, rounding_of(scene_.precision), problem_.momentum_exponent);
      place->second = exactness_residual(one_form(inversion), scales(kind));
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      // The kind does not exist for the true map, so that there is no rounding floor to report.
      place->second.clear();
    }
  }
  return place->second.empty() ? nullptr : &place->second;
}

/// Composes the inverted map with the map; keeps the worst result over all kinds for the
/// self-check.
void MapAnalysis::compose(RunResult& run, const PartialInversion<Extended>& inversion,
                          const std::string& requested) const {
  if (!run.inversion) run.inversion.emplace();
  InversionQuality& quality = *run.inversion;
  const Stopwatch stopwatch(quality.seconds);
  ++run.counts.compositions;
  const double miss = inversion_miss<Extended>(run.jet, inversion);
  if (quality.kinds == 0 || miss > quality.miss) {
    quality.miss = miss;
    quality.missing_kind = requested;
  }
  if (quality.kinds == 0 || inversion.amplification > quality.amplification) {
    quality.amplification = inversion.amplification;
    quality.amplified_kind = requested;
  }
  ++quality.kinds;
}

KindResult MapAnalysis::invert(RunResult& run, const std::string& requested) {
  const FlowJet<Extended>& jet = run.jet;
  KindResult result;
  result.requested = requested;
  const int exponent = problem_.momentum_exponent;
  result.kind = requested == "auto" ? best_conditioned_kind<Extended>(jet, exponent)
                                    : parse_kind(requested, problem_.degrees_of_freedom.size());
  result.condition = condition_number(inverted_block<Extended>(jet, result.kind, exponent));
  try {
    ++run.counts.inversions;
    const auto inversion =
        invert_partially<Extended>(jet, result.kind, rounding_of(scene_.precision), exponent);
    if (scene_.checks[SelfCheckName::inversion].is_on) compose(run, inversion, requested);
    const auto sigma = one_form(inversion);
    ++run.counts.exactness_residuals;
    const auto residuals = exactness_residual(sigma, scales(result.kind));
    const bool is_hamiltonian = problem_.system->is_hamiltonian;
    const auto* floors = is_hamiltonian ? floor(result.kind) : nullptr;
    for (std::size_t d = 0; d < residuals.size(); ++d) {
      ExactnessEntry entry{residuals[d], std::nullopt, std::nullopt, std::nullopt};
      if (floors != nullptr) entry.floor = (*floors)[d];
      result.by_degree.push_back(entry);
    }
    if (!is_hamiltonian) add_forces(result, sigma);
    result.generating_function = generating_function(sigma);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    result.failure = error.what();
  }
  return result;
}

void MapAnalysis::analyse(RunResult& run) {
  const auto compared = [&](const FlowJet<Extended>& jet) {
    return compared_components(jet, problem_.variables, problem_.degrees_of_freedom.size(),
                               problem_.momentum_exponent);
  };
  const FlowJet<Extended> comparable = compared(run.jet);
  if (reference_) {
    run.error_by_degree = relative_error_by_degree(comparable, compared(reference_->jet));
    run.position_error_m =
        position_distance(run.jet, reference_->jet, problem_.degrees_of_freedom.size()) *
        scene_.units.length_km * 1000;
  }
  if (!problem_.is_full_jet) return;
  run.symplecticity = symplecticity_by_degree<Extended>(comparable);
  const auto components = static_cast<long>(run.jet.size());
  run.counts.poisson_brackets += components * (components - 1) / 2;
  if (scene_.kinds) {
    for (const std::string& kind : *scene_.kinds) run.kinds.push_back(invert(run, kind));
  }
  if (!problem_.system->is_hamiltonian) add_integration_defects(run, comparable);
}

}  // namespace hamjet
