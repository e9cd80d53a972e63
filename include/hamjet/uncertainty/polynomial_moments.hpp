#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hamjet/algebra/truncated_power_series.hpp"
#include "hamjet/detail/algebra/matrix.hpp"
#include "hamjet/uncertainty/covariance.hpp"

namespace hamjet {

/// Polynomials of Gaussian variables x of mean zero, written as polynomials of independent standard
/// normal variables w: y(x) with x = L w, where L is the factor of the covariance. The result has
/// `rank` variables (one where the rank is 0) and the constant terms of the map. Throws
/// Error(usage) unless the covariance has as many variables as the map.
std::vector<Series<double>> in_standard_normals(const std::vector<Series<double>>& map,
                                                const Covariance& covariance);

/// The polynomials y(mean + L w) for variables with another mean, exactly. They have as many terms
/// as before.
std::vector<Series<double>> in_standard_normals(const std::vector<Series<double>>& map,
                                                const Covariance& covariance,
                                                const Vector<double>& mean);

/// Polynomials from arrays of coefficients and exponents. Row k has the exponents of a monomial,
/// one for each variable; its coefficient in component c is at c K + k, where K is the number of
/// rows. Throws Error(usage) where sizes do not fit, or a monomial stands twice.
std::vector<Series<double>> polynomials_of_rows(std::span<const double> coefficients,
                                                std::span<const std::uint8_t> exponents,
                                                std::size_t variables);

/// Mean, covariance, third and fourth cumulants of a random vector y of m components, stored as
///
///   y = mean + axes w ,   E[w] = 0 ,   E[w w^T] = 1 ,
///
/// and the cumulants of the r uncorrelated variables w, r the rank of the covariance. The columns
/// of `axes` are the principal axes of y's correlations. In this form nothing is lost where y lies
/// almost on a line, as the state of an orbit does after some revolutions.
///
/// The third cumulants are E[w_i w_j w_k]; the fourth ones are
///
///   k_ijkl = E[w_i w_j w_k w_l] - d_ij d_kl - d_ik d_jl - d_il d_jk .
///
/// Both vanish for a Gaussian vector, and the cumulants of a sum of independent vectors are the
/// sums of theirs.
class Cumulants {
 public:
  /// The cumulants of a Gaussian vector.
  Cumulants(const Vector<double>& mean, const Covariance& covariance);

  /// The cumulants of polynomials of independent standard normal variables, exact but for rounding.
  /// Terms above `degree`, if given, are left out. With Hermite polynomials He_a, which are
  /// orthogonal under the normal distribution, E[He_a He_b] = a! d_ab, covariances are sums over
  /// coefficients, and third and fourth moments are covariances with, and of, the products of two
  /// components, which have twice the degree. This is Isserlis' theorem. For 6 components of order
  /// 6 in 6 variables it takes some 20 million multiply-adds. Throws Error(numerical) where a
  /// coefficient is not finite.
  static Cumulants of_polynomials(const std::vector<Series<double>>& map,
                                  std::optional<int> degree = {});

  /// The cumulants of the sum of two independent vectors of the same size.
  static Cumulants of_sum(const Cumulants& first, const Cumulants& second);

  /// The cumulants of a weighted sample or of the nodes of a quadrature. The points are the columns
  /// of `points`, m x count, and the weights sum up to 1. For a plain sample all weights are equal;
  /// the result then has the moments of the sample itself, divided by the count.
  static Cumulants of_points(const Matrix<double>& points, const Vector<double>& weights);

  /// The cumulants of a mixture: with the probability `weights[i]`, which sum up to 1, the vector
  /// is distributed as `parts[i]`. All parts have one size.
  static Cumulants of_mixture(std::span<const Cumulants> parts, const Vector<double>& weights);

  /// The cumulants of A y.
  Cumulants mapped(const Matrix<double>& map) const;

  Eigen::Index size() const { return axes_.rows(); }
  Eigen::Index rank() const { return axes_.cols(); }
  const Vector<double>& mean() const { return mean_; }
  const Matrix<double>& axes() const { return axes_; }
  Matrix<double> covariance() const;
  Vector<double> standard_deviations() const;

  /// The skewness E[(y - mean)^3] / s^3 and the excess kurtosis E[(y - mean)^4] / s^4 - 3 of each
  /// component by itself; 0 for a component without variance.
  Vector<double> skewness() const;
  Vector<double> excess_kurtosis() const;

  /// Mardia's measures of the whole vector: the sum of the squares of all third cumulants, and
  /// E[|w|^4] - r (r + 2). Both are 0 for a Gaussian vector. Source: K. V. Mardia, "Measures of
  /// multivariate skewness and kurtosis with applications", Biometrika 57 (1970) 519.
  double mardia_skewness() const;
  double mardia_excess_kurtosis() const;

  /// How non-Gaussian the vector is: the Kullback-Leibler divergence from its distribution to the
  /// Gaussian one of the same mean and covariance, in nats. No linear change of coordinates alters
  /// it. In general, and where they are small, the result is the sum of the leading terms
  ///
  ///   J = 1/12 sum k_ijk^2 + 1/48 sum k_ijkl^2 ,
  ///
  /// which mean little above some tenths: for a vector almost on a curve they come to about 6,
  /// however thin the curve is. For a vector about which carried_without_compression() was called,
  /// and where these terms are not small, the result is
  ///
  ///   J = 1/2 ln det C - 1/2 ln det C_0 ,
  ///
  /// the entropy of a Gaussian vector with this covariance minus the entropy of the vector itself,
  /// which the map has not changed. Source: P. Comon, "Independent component analysis, a new
  /// concept?", Signal Processing 36 (1994) 287, section 3.2 (the leading terms, from Edgeworth's
  /// expansion); T. M. Cover and J. A. Thomas, Elements of Information Theory, 2nd ed., theorem
  /// 8.4.1 and section 8.6 (entropies).
  double negentropy() const;
  /// Whether the negentropy is right however far from Gaussian the vector is.
  bool is_negentropy_exact() const { return gaussian_log_volume_ && rank() == size(); }

  /// ln sqrt(det C), the logarithm of the volume that the standard deviations span; no value where
  /// the covariance is singular.
  std::optional<double> log_volume() const;

  /// Declares that the vector is the image of a Gaussian vector with this log_volume() under a map
  /// that preserves volumes, such as a flow of Hamilton's equations. Linear maps and known shifts
  /// keep this knowledge, sums with other random vectors lose it.
  void carried_without_compression(double gaussian_log_volume) {
    gaussian_log_volume_ = gaussian_log_volume;
  }
  /// The log_volume() of that Gaussian vector, after linear maps.
  const std::optional<double>& gaussian_log_volume() const { return gaussian_log_volume_; }

  /// Third cumulants of w, at (i r + j) r + k, and fourth cumulants, at ((i r + j) r + k) r + l.
  const std::vector<double>& third() const { return third_; }
  const std::vector<double>& fourth() const { return fourth_; }

 private:
  Cumulants() = default;

  /// y = mean + factor v with uncorrelated v: the axes, and the rotation from v to w.
  static Cumulants turned(const Vector<double>& mean, const Matrix<double>& factor,
                          Matrix<double>& turn);
  void add_turned(const Cumulants& other, const Matrix<double>& turn);

  Vector<double> mean_;
  Matrix<double> axes_;
  std::vector<double> third_;
  std::vector<double> fourth_;
  std::optional<double> gaussian_log_volume_;
};

/// The Kullback-Leibler divergence, in nats, from a distribution to a Gaussian one of another mean
/// and covariance. It is the negentropy plus the divergence between the two Gaussians,
///
///   1/2 (tr(C_1^-1 C) + d^T C_1^-1 d - r + ln det C_1 - ln det C) ,   d = mean - mean_1 .
///
/// It is infinite where the distribution spreads in a direction in which the Gaussian has no
/// variance.
double divergence_from_gaussian(const Cumulants& distribution, const Cumulants& gaussian);

/// The largest possible difference of the probability of an event between two distributions of
/// divergence D: sqrt(D/2), and no more than 1 (Pinsker's inequality: M. S. Pinsker, Information
/// and Information Stability of Random Variables and Processes, 1964).
double largest_error_of_probability(double divergence);

/// A Gaussian distribution counts as misleading where one of its probabilities may be wrong by more
/// than this. A one-sigma interval holds 68 %; an error of five points there corresponds to a
/// standard deviation that is wrong by a tenth (2 phi(1) = 0.48 per unit of the logarithm of s).
inline constexpr double misleading_probability = 0.05;

}  // namespace hamjet
