#include "flow_error.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "../algebra/raise_to.hpp"
#include "../charts/coordinate_units.hpp"
#include "../integrators/independent_runs.hpp"
#include "../integrators/momentum_unit.hpp"
#include "../studies/checks/smooth_forces.hpp"
#include "../studies/formation/charts/deputy_flows.hpp"
#include "../studies/integration.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/charts/flow_box.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet::cli {
namespace {

constexpr Eigen::Index positions = 3;

Matrix<double> linear_values(const DeputyFlow& flow) { return linear_part(flow.polynomials()); }

/// The same flow to first order, from an integration of its own.
std::unique_ptr<DeputyFlow> independent_linear_flow(const Scene& scene,
                                                    const ComputedProblem& problem,
                                                    const CoordinatesAtEnds& coordinates,
                                                    std::size_t number) {
  const GaussSettings settings =
      gauss_of_independent_run<double>(number, has_smooth_forces(scene.system));
  const SixNumbers<double> start = six_numbers(problem.nominal);
  if (coordinates == JetCoordinates::flow_box && !problem.system->is_autonomous()) {
    ComputedProblem linear = problem;
    linear.space = SeriesSpace::create(problem.variables.size(), 1);
    // The steps of these jets are tried on lines until they show rounding alone, also across seams.
    const GaussSettings tried = gauss_of_independent_run<double>(number, true);
    IntegratorSettings precise;
    precise.stages = tried.stages;
    precise.tolerance = tried.tolerance;
    JetPropagation jets(linear, precise);
    const FlowJet<double> jet = jets.advance_to(scene.duration);
    return driven_flow_box_deputy_flow(problem.system, problem.start_time + scene.duration,
                                       driven_flow_box(scene, linear, scene.duration, jet));
  }
  if (coordinates == JetCoordinates::flow_box) {
    const ZonalGravity field = orbit_field(scene);
    FlowBoxPropagation<double> boxes(field, section_chart(start, canonical_mu), start, 1, settings);
    return flow_box_deputy_flow(field, boxes.advance_to(scene.duration));
  }
  FlowProblem<double> linear = flow_problem<double>(problem, scene.duration);
  linear.space = SeriesSpace::create(problem.variables.size(), 1);
  linear.symmetry = FlowSymmetry::none;
  IntegrationStatistics statistics;
  return deputy_flow_of_jet(FlowMap<double>(integrate_gauss<double>(linear, settings, statistics)),
                            start, coordinates);
}

/// A matrix of up to six rows times x. It is summed in one order, column by column, whatever the
/// compiler makes of small matrices, so that its digits stay.
template <class Rows>
SixNumbers<double> product(const Rows& rows, const SixNumbers<double>& x) {
  SixNumbers<double> sums{};
  for (Eigen::Index j = 0; j < rows.cols(); ++j) {
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      sums[static_cast<std::size_t>(i)] += rows(i, j) * x[static_cast<std::size_t>(j)];
    }
  }
  return sums;
}

double length(const SixNumbers<double>& x) {
  return std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
}

double distance(const SixNumbers<double>& a, const SixNumbers<double>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// The errors of coefficients whose largest has the error 1, as evaluation_error spreads them.
Matrix<double> spread_error(const Matrix<double>& values) {
  return std::sqrt(values.cwiseAbs().maxCoeff()) * values.cwiseAbs().cwiseSqrt();
}

/// The geometric mean of what two independent runs show, as one that is far larger than the other
/// has errors of its own; a tenth of the larger where they agree to the bit in one.
double of_both(const std::vector<double>& shown) {
  double logarithm = 0;
  for (const double x : shown) logarithm += std::log(x) / static_cast<double>(shown.size());
  return std::max(0.1 * *std::max_element(shown.begin(), shown.end()), std::exp(logarithm));
}

/// The largest of positions q and of momenta p, these in units of 2^exponent.
double largest_number(std::span<const double> qs, std::span<const double> ps, int exponent) {
  double largest = 0;
  for (const double q : qs) raise_to(largest, std::abs(q));
  for (const double p : ps) raise_to(largest, std::ldexp(std::abs(p), -exponent));
  return largest;
}

}  // namespace

FlowError FlowError::measured(const Scene& scene, const ComputedProblem& problem,
                              const CoordinatesAtEnds& coordinates, const DeputyFlow& flow) {
  FlowError result;
  result.is_known_ = true;
  const Matrix<double> values = linear_values(flow);
  std::vector<double> of_chief;
  for (std::size_t number = 0; number < stages_of_runs.size(); ++number) {
    const auto other = independent_linear_flow(scene, problem, coordinates, number);
    of_chief.push_back(distance(other->chief_end(), flow.chief_end()));
    const Matrix<double> error = values - linear_values(*other);
    const Matrix<double> shown =
        flow.exit_derivative().topRows(positions) * error * flow.entry_derivative();
    result.shown_.push_back(shown);
  }
  result.of_chief_ = of_both(of_chief);
  return result;
}

FlowError FlowError::stated(const io::StoredJet& stored, const DeputyFlow& flow) {
  FlowError result;
  if (stored.error_by_degree.size() < 2) return result;
  result.is_known_ = true;
  result.of_chief_ = stated_chief_error(stored);
  const double relative = stored.error_by_degree[1];
  const Matrix<double> values = linear_values(flow);
  if (stored.flow_box) {
    const FlowBoxUnits units(stored.flow_box->section, initial_distance(stored.nominal_initial),
                             stored.flow_box->field.mu);
    const auto column = [](const std::vector<double>& numbers) {
      return Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                               static_cast<Eigen::Index>(numbers.size()));
    };
    const Matrix<double> unit =
        column(units.values) * column(units.variables).cwiseInverse().transpose();
    const Matrix<double> error =
        relative * spread_error(values.cwiseQuotient(unit)).cwiseProduct(unit);
    // A flow box has fewer variables than six; the others count nothing.
    Bound bound;
    bound.rows.leftCols(error.cols()) =
        flow.exit_derivative().topRows(positions).cwiseAbs() * error;
    bound.entry.setZero();
    bound.entry.topRows(error.cols()) = flow.entry_derivative();
    result.bound_ = bound;
    return result;
  }
  // Of other coordinates it is the error of the jet in positions and momenta.
  const int exponent = stored.momentum_exponent();
  const Matrix<double> linear = flow.exit_derivative() * values * flow.entry_derivative();
  Bound bound;
  bound.rows = relative *
               spread_error(in_momentum_unit<Matrix<double>>(linear, exponent)).topRows(positions);
  bound.rows.rightCols(positions) *= std::ldexp(1.0, -exponent);
  result.bound_ = bound;
  return result;
}

std::vector<double> FlowError::numbers() const {
  std::vector<double> result = {is_known_ ? 1.0 : 0.0, of_chief_, bound_ ? 1.0 : 0.0};
  const auto add = [&](const auto& matrix) {
    result.insert(result.end(), matrix.data(), matrix.data() + matrix.size());
  };
  if (bound_) {
    add(bound_->rows);
    add(bound_->entry);
  }
  for (const PositionRows& rows : shown_) add(rows);
  return result;
}

FlowError FlowError::of_numbers(std::span<const double> numbers) {
  constexpr const char* not_these = "flow error: these numbers are none";
  constexpr std::size_t head = 3;
  constexpr std::size_t size = PositionRows::SizeAtCompileTime;
  if (numbers.size() < head || (numbers.size() - head) % size != 0) {
    throw Error(ErrorKind::usage, not_these);
  }
  FlowError result;
  result.is_known_ = numbers[0] != 0;
  result.of_chief_ = numbers[1];
  std::size_t at = head;
  if (numbers[2] != 0) {
    // Six rows are as many numbers as twice three.
    if (numbers.size() < head + 3 * size) throw Error(ErrorKind::usage, not_these);
    result.bound_ = Bound{PositionRows(numbers.data() + at), Entry(numbers.data() + at + size)};
    at += 3 * size;
  }
  for (; at < numbers.size(); at += size) result.shown_.emplace_back(numbers.data() + at);
  return result;
}

double FlowError::of_deviation(const SixNumbers<double>& deviation) const {
  double error = 0;
  if (!shown_.empty()) {
    std::vector<double> lengths;
    for (const PositionRows& rows : shown_) lengths.push_back(length(product(rows, deviation)));
    error = of_both(lengths);
  }
  if (bound_) {
    const SixNumbers<double> entered = product(bound_->entry, deviation);
    SixNumbers<double> magnitudes;
    for (std::size_t i = 0; i < 6; ++i) magnitudes[i] = std::abs(entered[i]);
    const SixNumbers<double> end = product(bound_->rows, magnitudes);
    raise_to(error, length(end));
  }
  return error;
}

double stated_chief_error(const io::StoredJet& stored) {
  if (stored.error_by_degree.empty()) return 0;
  const std::span<const double> end(stored.nominal_final);
  const std::size_t n = stored.degrees_of_freedom();
  // The error of a flow box is relative to its positions, that of a jet to all numbers.
  const auto momenta = stored.flow_box ? std::span<const double>() : end.subspan(n, n);
  const double size = largest_number(end.first(n), momenta, stored.momentum_exponent());
  return stored.error_by_degree[0] * size;
}

}  // namespace hamjet::cli
