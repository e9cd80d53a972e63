#include "deputy_rounding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../../../integrators/momentum_unit.hpp"
#include "../../exact_flow.hpp"
#include "../single_transfer.hpp"

namespace hamjet {

DeputyRounding::DeputyRounding(const ComputedProblem& problem, double time, double furthest)
    : of_chief_(rounding_of_flights(problem, time)),
      start_(std::hypot(problem.nominal[0], problem.nominal[1], problem.nominal[2])) {
  if (start_ >= furthest) return;
  constexpr double tolerance = 1e-10;  // the tolerance of a scale, for which two digits would do
  const FlowJet<double> flow =
      linear_jet(problem.system, problem.nominal, problem.start_time, time, tolerance);
  growth_ = in_momentum_unit<Matrix<double>>(linear_part(flow), problem.momentum_exponent).norm();
}

double DeputyRounding::at(double separation) const {
  const double further = std::max(0.0, separation - start_);
  return of_chief_ + std::numeric_limits<double>::epsilon() * growth_ * further;
}

}  // namespace hamjet
