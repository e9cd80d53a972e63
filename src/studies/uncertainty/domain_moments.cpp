#include "domain_moments.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "../../algebra/singular_values.hpp"
#include "../formation/single_transfer.hpp"
#include "../jets_along_time.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"
#include "hamjet/maps/domain_splitting.hpp"
#include "hamjet/uncertainty/polynomial_moments.hpp"
#include "moments_in_coordinates.hpp"
#include "quadrature.hpp"
#include "uncertain_parameters.hpp"

namespace hamjet {
namespace {

/// The box that is split reaches so many standard deviations along each variable.
constexpr double farthest_split = 3;

/// Nodes of the quadrature in a domain. A fourth moment of polynomials of degree N has degree 4 N
/// in the variable that is stretched most, for which n = 2 N + 1 nodes are exact.
std::vector<int> nodes_of_domain(int order, bool is_fine, std::size_t variables) {
  std::vector<int> nodes = is_fine ? std::vector{std::min(2 * order + 1, 15), 5, 5, 3, 3, 3}
                                   : std::vector{std::min(2 * order - 1, 13), 5, 3, 3, 3, 3};
  nodes.resize(variables);
  return nodes;
}

/// The splitting of one start.
class SplitStart {
 public:
  SplitStart(const Scene& scene, const ComputedProblem& problem,
             const IntegratorSettings& integrator, const InitialState& start,
             const Matrix<double>& linear, const ProgressCallback& progress)
      : scene_(scene),
        problem_(problem),
        integrator_(integrator),
        start_(start),
        progress_(progress),
        factor_(stretched_factor(start.covariance, linear)) {}

  std::size_t variables() const { return static_cast<std::size_t>(factor_.cols()); }

  /// The start's deviation from the chief's nominal at standard normal numbers.
  Vector<double> deviation(const std::vector<double>& normals) const {
    return start_.deviation(factor_ *
                            Eigen::Map<const Vector<double>>(normals.data(), factor_.cols()));
  }

  /// The final states at all times, first all positions and then all velocities, as polynomials in
  /// the standard normal variables about a centre.
  FlowMap<double> map_about(std::span<const double> centre) {
    if (progress_) progress_("domains", 0);
    const Vector<double> from_chief = deviation({centre.begin(), centre.end()});
    ComputedProblem about = problem_;
    for (std::size_t i = 0; i < 6; ++i) {
      about.nominal[i] += from_chief[static_cast<Eigen::Index>(i)];
    }
    JetPropagation jets(about, integrator_);
    std::vector<Series<double>> positions, velocities;
    for (const double time : scene_.uncertainty->times) {
      const std::vector<Series<double>> map = in_normals(jets.advance_to(time), about.nominal);
      positions.insert(positions.end(), map.begin(), map.begin() + 3);
      velocities.insert(velocities.end(), map.begin() + 3, map.end());
    }
    positions.insert(positions.end(), velocities.begin(), velocities.end());
    require_memory(positions);
    return FlowMap<double>(std::move(positions));
  }

 private:
  /// A jet about a centre as polynomials of the standard normal variables.
  std::vector<Series<double>> in_normals(const FlowJet<double>& jet,
                                         const std::vector<double>& centre) const {
    if (!start_.straight) return in_standard_normals(jet, Covariance::of_factor(factor_));
    SixNumbers<double> state{};
    std::copy_n(centre.begin(), 6, state.begin());
    const StraightDeviations straight(start_.straight->chart(), state);
    // What is linear in the chart's coordinates about the mean is so about the centre.
    const Matrix<double> factor = Eigen::PartialPivLU<Eigen::Matrix<double, 6, 6>>(straight.slope())
                                      .solve(start_.straight->slope() * factor_);
    std::vector<Series<double>> curved =
        compose(without_constants(jet), straight.series(jet[0].space_pointer()));
    for (std::size_t c = 0; c < jet.size(); ++c) curved[c][0] = jet[c][0];
    return in_standard_normals(curved, Covariance::of_factor(factor));
  }

  void require_memory(const std::vector<Series<double>>& map) {
    constexpr double most = 2e9;
    bytes_ += static_cast<double>(map.size() * map[0].space().size() * sizeof(double));
    if (bytes_ <= most) return;
    throw Error(ErrorKind::too_large,
                fmt::format("uncertainty.most_domains: the polynomials of so many domains at {} "
                            "times take more than {:.0f} MB; fewer domains or times would fit",
                            scene_.uncertainty->times.size(), most / 1e6));
  }

  const Scene& scene_;
  const ComputedProblem& problem_;
  const IntegratorSettings& integrator_;
  const InitialState& start_;
  const ProgressCallback& progress_;
  Matrix<double> factor_;
  double bytes_ = 0;
};

/// The values of each variable that belong to a domain: the outermost domains go on.
std::vector<NormalInterval> intervals_of(const SplitDomain& domain) {
  constexpr double edge = farthest_split * (1 - 1e-9);
  std::vector<NormalInterval> intervals;
  for (std::size_t i = 0; i < domain.centre.size(); ++i) {
    NormalInterval one;
    const double from = domain.centre[i] - domain.half_widths[i];
    const double to = domain.centre[i] + domain.half_widths[i];
    if (from > -edge) one.from = from;
    if (to < edge) one.to = to;
    intervals.push_back(one);
  }
  return intervals;
}

/// The moments at every time by the terms up to a degree, under the condition that the deviation is
/// in the domain.
std::vector<Cumulants> moments_in_domain(const SplitDomain& domain, const NormalQuadrature& rule,
                                         int degree, const std::vector<TimeOfDomains>& at_times) {
  const auto variables = static_cast<Eigen::Index>(domain.centre.size());
  const Eigen::Index count = rule.weights.size();
  // Row-major, as an evaluator takes points.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> points =
      rule.points.colwise() - Eigen::Map<const Vector<double>>(domain.centre.data(), variables);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values(
      static_cast<Eigen::Index>(domain.map.components()), count);
  domain.map.evaluator(degree).evaluate(
      std::span(points.data(), static_cast<std::size_t>(points.size())),
      {.values = std::span(values.data(), static_cast<std::size_t>(values.size())),
       .last = {},
       .last_but_one = {}});
  std::vector<Cumulants> result;
  const Eigen::Index velocities = values.rows() / 2;
  for (std::size_t t = 0; t < at_times.size(); ++t) {
    const auto first = static_cast<Eigen::Index>(3 * t);
    Matrix<double> states(6, count);
    states << values.middleRows(first, 3), values.middleRows(velocities + first, 3);
    Vector<double> centre(6);
    for (Eigen::Index i = 0; i < 6; ++i) {
      const Eigen::Index row = first + (i < 3 ? i : velocities + i - 3);
      centre[i] = domain.map.jet()[static_cast<std::size_t>(row)][0] - at_times[t].chief[i];
    }
    states.colwise() += centre;
    result.push_back(Cumulants::of_points(states, rule.weights));
  }
  return result;
}

/// The moments of a start by the polynomials of its domains.
struct MomentsOfDomains {
  UncertaintyDomains domains;
  /// By the scene's times and the orders 1..N of the polynomials about each centre; of canonical
  /// deviations from the chief's nominal.
  std::vector<std::vector<Cumulants>> by_time;
};

/// `problem` is that of scene_of_start, with the chief's nominal as its own.
MomentsOfDomains moments_of_domains(const Scene& scene, const ComputedProblem& problem,
                                    const IntegratorSettings& integrator, const InitialState& start,
                                    const Matrix<double>& linear,
                                    const std::vector<TimeOfDomains>& at_times,
                                    const ProgressCallback& progress) {
  const MetricUnits units = metric_units(scene);
  const DomainSettings& settings = *scene.uncertainty->domains;
  const std::size_t times = at_times.size();
  SplitStart splitting(scene, problem, integrator, start, linear, progress);
  const std::size_t variables = splitting.variables();
  const SplitMap split = split_domains(
      [&](std::span<const double> centre) { return splitting.map_about(centre); },
      std::vector<double>(variables, 0.0), std::vector<double>(variables, farthest_split),
      {.tolerance = settings.tolerance_m / units.length_m,
       .components = 3 * times,
       .most_domains = static_cast<std::size_t>(settings.most_domains)});

  MomentsOfDomains result;
  result.domains.spacecraft = start.name;
  result.domains.maps = split.maps_made;
  result.domains.is_right = split.is_right;
  result.domains.error_m = split.error() * units.length_m;
  const Matrix<double> to_frame = relative_states_of_deviations(
      ChiefFrame(std::span(scene.nominal).first(6), units, scene.uncertainty->frame));
  const auto order = static_cast<std::size_t>(scene.order);
  const auto count = static_cast<Eigen::Index>(split.domains.size());
  Vector<double> shares(count);
  // By time, order and domain; and of fewer nodes by time and domain.
  std::vector<std::vector<std::vector<Cumulants>>> parts(
      times, std::vector<std::vector<Cumulants>>(order));
  std::vector<std::vector<Cumulants>> coarse(times);
  for (Eigen::Index k = 0; k < count; ++k) {
    if (progress) progress("domains", static_cast<double>(k) / static_cast<double>(count));
    const SplitDomain& domain = split.domains[static_cast<std::size_t>(k)];
    const std::vector<NormalInterval> intervals = intervals_of(domain);
    shares[k] = 1;
    for (const NormalInterval& interval : intervals) shares[k] *= interval.probability();
    const auto rule_of = [&](bool is_fine) {
      return product_quadrature(nodes_of_domain(scene.order, is_fine, variables), intervals);
    };
    const NormalQuadrature rule = rule_of(true);
    for (std::size_t n = 0; n < order; ++n) {
      const auto moments = moments_in_domain(domain, rule, static_cast<int>(n) + 1, at_times);
      for (std::size_t t = 0; t < times; ++t) parts[t][n].push_back(moments[t]);
    }
    const auto moments = moments_in_domain(domain, rule_of(false), scene.order, at_times);
    for (std::size_t t = 0; t < times; ++t) coarse[t].push_back(moments[t]);
    result.domains.domains.push_back(
        {to_frame * (splitting.deviation(domain.centre) - start.mean).head(6), shares[k],
         domain.error * units.length_m});
  }
  for (std::size_t t = 0; t < times; ++t) {
    result.by_time.emplace_back();
    for (std::size_t n = 0; n < order; ++n) {
      result.by_time.back().push_back(Cumulants::of_mixture(parts[t][n], shares));
    }
    const MomentsDifference doubt =
        difference_of(result.by_time.back().back(), Cumulants::of_mixture(coarse[t], shares));
    result.domains.doubt =
        std::max({result.domains.doubt, doubt.deviation, doubt.skewness, doubt.kurtosis});
  }
  return result;
}

}  // namespace

Matrix<double> stretched_factor(const Covariance& covariance, const Matrix<double>& linear) {
  Matrix<double> square = Matrix<double>::Zero(6, 6);
  const Matrix<double> stretched = linear * covariance.factor();
  if (stretched.cols() > 6) {
    const Cumulants whole(Vector<double>::Zero(6), covariance);
    return stretched_factor(Covariance::of_factor(whole.axes()), linear);
  }
  square.leftCols(stretched.cols()) = stretched;
  const SingularValueDecomposition parts = decompose_by_singular_values(square);
  return covariance.factor() * parts.right.topLeftCorner(stretched.cols(), stretched.cols());
}

void set_domains(UncertaintyResult& result, const std::vector<InitialState>& starts,
                 const IntegratorSettings& integrator, const std::vector<Matrix<double>>& linear,
                 const std::vector<TimeOfDomains>& times, const ProgressCallback& progress) {
  const Scene& scene = result.scene;
  for (const InitialState& start : starts) {
    if (start.parameters.empty()) continue;
    throw Error(ErrorKind::scene,
                fmt::format("uncertainty.tolerance_m: domains are of states alone, got the "
                            "uncertain parameter {}, must be left out",
                            start.parameters[0]));
  }
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const InitialState& start = starts[s];
    if (start.covariance.rank() == 0) {
      for (UncertaintyAt& at : result.points) at.states[s].split = at.states[s].cartesian;
      continue;
    }
    const ComputedProblem problem = make_problem(scene_of_start(scene, start));
    MomentsOfDomains found =
        moments_of_domains(scene, problem, integrator, start, linear[s], times, progress);
    for (std::size_t t = 0; t < times.size(); ++t) {
      std::vector<Cumulants>& split = result.points[t].states[s].split;
      split = std::move(found.by_time[t]);
      if (problem.system->is_hamiltonian) told_of_start(split, start);
      if (times[t].noise) add_noise(split, Cumulants(Vector<double>::Zero(6), *times[t].noise));
      for (Cumulants& one : split) one = one.mapped(times[t].to_frame);
    }
    result.domains.push_back(std::move(found.domains));
  }
  for (UncertaintyAt& at : result.points) {
    if (at.states.size() < 3) continue;
    at.states[2].split = difference_by_order(at.states[1].split, at.states[0].split);
  }
}

}  // namespace hamjet
