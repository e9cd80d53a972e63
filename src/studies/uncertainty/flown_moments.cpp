#include <cmath>

#include "uncertainty.hpp"

namespace hamjet {
namespace {

/// The standard error of the mean of f(z) over a sample.
template <class Function>
double scatter(const Vector<double>& z, const Function& f) {
  double sum = 0;
  double square = 0;
  for (const double x : z) {
    const double value = f(x);
    sum += value;
    square += value * value;
  }
  const auto n = static_cast<double>(z.size());
  return std::sqrt(std::max(0.0, square / n - sum / n * (sum / n)) / n);
}

}  // namespace

FlownMoments flown_moments(const Matrix<double>& states) {
  const Eigen::Index count = states.cols();
  const Vector<double> weights = Vector<double>::Constant(count, 1.0 / static_cast<double>(count));
  FlownMoments result{
      Cumulants::of_points(states, weights), static_cast<int>(count), {}, {}, {}, {}};
  const Eigen::Index m = states.rows();
  const Vector<double> deviations = result.cumulants.standard_deviations();
  const Vector<double> skewness = result.cumulants.skewness();
  const Vector<double> excess = result.cumulants.excess_kurtosis();
  for (Vector<double>* error : {&result.mean_error, &result.deviation_error, &result.skewness_error,
                                &result.kurtosis_error}) {
    *error = Vector<double>::Zero(m);
  }
  for (Eigen::Index i = 0; i < m; ++i) {
    const double s = deviations[i];
    if (s == 0) continue;
    const Vector<double> z = (states.row(i).transpose().array() - result.cumulants.mean()[i]) / s;
    const double g = skewness[i];
    const double b = excess[i] + 3;
    result.mean_error[i] = s / std::sqrt(static_cast<double>(count));
    result.deviation_error[i] = s * scatter(z, [](double x) { return x * x / 2; });
    result.skewness_error[i] =
        scatter(z, [=](double x) { return x * x * x - 3 * x - 1.5 * g * (x * x - 1); });
    result.kurtosis_error[i] =
        scatter(z, [=](double x) { return x * x * x * x - 4 * g * x - 2 * b * (x * x - 1); });
  }
  return result;
}

}  // namespace hamjet
