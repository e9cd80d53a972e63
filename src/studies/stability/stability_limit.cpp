#include "stability_limit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "../../algebra/matrix_eigenvalues.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/dynamics/relative_hamiltonian.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// Two eigenvalues that meet on the unit circle are known only to the square root of round-off.
constexpr double rounding_of_eigenvalues = 1e-6;
constexpr double tolerated_growth = 0.01;

/// The Jacobian of an affine vector field.
Matrix<double> jacobian_matrix(const OperationList& field) {
  const std::size_t size = field.inputs();
  const auto space = SeriesSpace::create(size, 1);
  std::vector<Series<double>> z;
  for (std::size_t i = 0; i < size; ++i) z.push_back(Series<double>::variable(space, i, 0.0));
  const auto values = evaluate_on_series(field, z);
  return linear_part(values);
}

class StabilityLimit {
 public:
  StabilityLimit(const DynamicalSystem& system, const LinearSteps& steps) : steps_(steps) {
    const Matrix<double> field = jacobian_matrix(system.vector_field);
    scale_momenta(field);
    const auto eigenvalues = matrix_eigenvalues("stability", scaled(field));
    for (const auto& lambda : eigenvalues) {
      frequency_ = std::max(frequency_, std::abs(lambda.imag()));
      growth_rate_ = std::max(growth_rate_, std::abs(lambda.real()));
    }
    // The eigenvalues of an oscillation are imaginary up to round-off.
    if (growth_rate_ < rounding_of_eigenvalues * frequency_) growth_rate_ = 0;
  }

  double frequency() const { return frequency_; }

  /// Growth of an amplitude in one step, relative to that of the flow; infinite if the step's
  /// matrix is not finite.
  double growth(double step) const {
    const Matrix<double> matrix = scaled(steps_.matrix(step));
    if (!matrix.allFinite()) return std::numeric_limits<double>::infinity();
    const auto eigenvalues = matrix_eigenvalues("stability", matrix);
    double radius = 0;
    for (const auto& lambda : eigenvalues) radius = std::max(radius, std::abs(lambda));
    return radius / std::exp(growth_rate_ * std::abs(step));
  }

  bool is_stable(double step) const {
    const double excess = growth(step) - 1;
    if (excess <= rounding_of_eigenvalues) return true;
    return !steps_.preserves_a_two_form &&
           std::log1p(excess) * std::abs(steps_.duration / step) <= tolerated_growth;
  }

  /// The stable step at the first edge below an unstable one; 0 if there is none. Compositions have
  /// several ranges of stable steps, of which only the first is useful.
  double first_edge(double unstable) const {
    constexpr int parts = 256;
    double stable = 0;
    for (int k = 1; k < parts; ++k) {
      const double step = unstable * k / parts;
      if (!is_stable(step)) {
        unstable = step;
        break;
      }
      stable = step;
    }
    if (stable == 0) {  // the stable steps are far below
      for (int halvings = 0; halvings < 60 && stable == 0; ++halvings) {
        if (is_stable(unstable / 2)) stable = unstable / 2;
        if (stable == 0) unstable /= 2;
      }
      if (stable == 0) return 0;
    }
    for (int k = 0; k < 40; ++k) {
      const double middle = (stable + unstable) / 2;
      (is_stable(middle) ? stable : unstable) = middle;
    }
    return stable;
  }

 private:
  /// Scales momenta so that each degree of freedom behaves like a unit oscillator; otherwise a
  /// stiff spring would spoil the eigenvalues.
  void scale_momenta(const Matrix<double>& field) {
    const Eigen::Index n = field.rows() / 2;
    units_ = Vector<double>::Ones(2 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double unit = std::sqrt(std::abs(field(n + i, i) / field(i, n + i)));
      if (std::isnormal(unit)) units_(n + i) = unit;
    }
  }

  Matrix<double> scaled(const Matrix<double>& matrix) const {
    return units_.cwiseInverse().asDiagonal() * matrix * units_.asDiagonal();
  }

  const LinearSteps& steps_;
  Vector<double> units_;
  double frequency_ = 0;
  double growth_rate_ = 0;
};

}  // namespace

void require_stable_steps(const DynamicalSystem& system, const LinearSteps& steps) {
  const StabilityLimit limit(system, steps);
  if (limit.is_stable(steps.step)) return;
  const double stable = limit.first_edge(steps.step);
  std::string problem = fmt::format("{}: unstable: omega tau = {:.4g}", steps.method,
                                    limit.frequency() * std::abs(steps.step));
  if (stable == 0) {
    problem += ", and no shorter step was found stable";
  } else {
    problem += fmt::format(" exceeds {:.4g}; a step of {:.6g} is stable",
                           limit.frequency() * std::abs(stable), std::abs(stable));
  }
  throw Error(ErrorKind::numerical,
              problem + fmt::format(" (with this step of {:.6g} amplitudes grow {:.4g} times a "
                                    "step)",
                                    std::abs(steps.step), limit.growth(steps.step)));
}

}  // namespace hamjet
