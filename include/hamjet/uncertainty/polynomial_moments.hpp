#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hamjet/algebra/truncated_power_series.hpp"
#include "hamjet/detail/algebra/matrix.hpp"
#include "hamjet/uncertainty/covariance.hpp"

namespace hamjet {

/// Polynomials of Gaussian variables x of mean zero as polynomials of independent standard normal
/// ones: y(x) with x = L w, L the factor of the covariance. The result has `rank` variables (one
/// where the rank is 0) and the constant terms of the map. Throws Error(usage) unless the
/// covariance is of as many variables as the map has.
std::vector<Series<double>> in_standard_normals(const std::vector<Series<double>>& map,
                                                const Covariance& covariance);

/// The same of variables of another mean: y(mean + L w), exactly; the polynomials have as many
/// terms as before.
std::vector<Series<double>> in_standard_normals(const std::vector<Series<double>>& map,
                                                const Covariance& covariance,
                                                const Vector<double>& mean);

/// Polynomials from rows of coefficients and of exponents, as arrays have them: component c's
/// coefficient of the monomial whose exponents are in row k, one a variable, is at c K + k, K the
/// count of rows. Throws Error(usage) where sizes do not fit, or a monomial stands twice.
std::vector<Series<double>> polynomials_of_rows(std::span<const double> coefficients,
                                                std::span<const std::uint8_t> exponents,
                                                std::size_t variables);

/// Mean, covariance, third and fourth cumulants of a random vector y of m components, kept as
///
///   y = mean + axes w ,   E[w] = 0 ,   E[w w^T] = 1 ,
///
/// and the cumulants of the r uncorrelated variables w, r the rank of the covariance. The columns
/// of `axes` are the principal axes of y's correlations. Nothing is lost where y is all but on a
/// line, as the state of an orbit is after some revolutions.
///
/// Third cumulants are E[w_i w_j w_k]; fourth ones
///
///   k_ijkl = E[w_i w_j w_k w_l] - d_ij d_kl - d_ik d_jl - d_il d_jk .
///
/// Both vanish for a Gaussian vector, and add for the sum of independent ones.
class Cumulants {
 public:
  /// Of a Gaussian vector.
  Cumulants(const Vector<double>& mean, const Covariance& covariance);

  /// Of polynomials of independent standard normal variables, without the terms above `degree`, if
  /// given: exact but for rounding. With polynomials He_a of Hermite, orthogonal under the normal
  /// distribution, E[He_a He_b] = a! d_ab, covariances are sums over coefficients, and third and
  /// fourth moments those of the products of two components, of twice the degree, which is
  /// Isserlis' theorem. For 6 components of order 6 in 6 variables some 20 million multiply-adds.
  /// Throws Error(numerical) where a coefficient is not finite.
  static Cumulants of_polynomials(const std::vector<Series<double>>& map,
                                  std::optional<int> degree = {});

  /// Of the sum of two independent vectors of one size.
  static Cumulants of_sum(const Cumulants& first, const Cumulants& second);

  /// Of a weighted sample or of the nodes of a quadrature: columns of `points`, m x count, weights
  /// that sum up to 1. Of a sample all weights are equal; its moments are those of the sample
  /// itself, divided by the count.
  static Cumulants of_points(const Matrix<double>& points, const Vector<double>& weights);

  /// Of A y.
  Cumulants mapped(const Matrix<double>& map) const;

  Eigen::Index size() const { return axes_.rows(); }
  Eigen::Index rank() const { return axes_.cols(); }
  const Vector<double>& mean() const { return mean_; }
  const Matrix<double>& axes() const { return axes_; }
  Matrix<double> covariance() const;
  Vector<double> standard_deviations() const;

  /// Of each component alone, E[(y - mean)^3] / s^3 and E[(y - mean)^4] / s^4 - 3; 0 for a
  /// component without variance.
  Vector<double> skewness() const;
  Vector<double> excess_kurtosis() const;

  /// Mardia's measures of the whole vector: the sum of the squares of all third cumulants, and
  /// E[|w|^4] - r (r + 2), both 0 for a Gaussian vector. Source: K. V. Mardia, "Measures of
  /// multivariate skewness and kurtosis with applications", Biometrika 57 (1970) 519.
  double mardia_skewness() const;
  double mardia_excess_kurtosis() const;

  /// How non-Gaussian the vector is: the Kullback-Leibler divergence from its distribution to the
  /// Gaussian one of the same mean and covariance, in nats, which no linear change of coordinates
  /// alters. Of a vector of which more is not known, and where they are small, the leading terms
  ///
  ///   J = 1/12 sum k_ijk^2 + 1/48 sum k_ijkl^2 ,
  ///
  /// which say little above some tenths: of a vector that is all but on a curve they come to 6 or
  /// so, however thin it is. Of a vector that carried_without_compression() knows, otherwise
  ///
  ///   J = 1/2 ln det C - 1/2 ln det C_0 ,
  ///
  /// the entropy of a Gaussian vector of its covariance less its own, which the map has not
  /// changed. Source: P. Comon, "Independent component analysis, a new concept?", Signal Processing
  /// 36 (1994) 287, section 3.2 (the leading terms, from Edgeworth's expansion); T. M. Cover and J.
  /// A. Thomas, Elements of Information Theory, 2nd ed., theorem 8.4.1 and section 8.6 (entropies).
  double negentropy() const;
  /// Whether that is right however far from Gaussian the vector is.
  bool is_negentropy_exact() const { return gaussian_log_volume_ && rank() == size(); }

  /// ln sqrt(det C), the logarithm of the volume that the standard deviations span; none where the
  /// covariance is singular.
  std::optional<double> log_volume() const;

  /// Tells that the vector stands for what a map that keeps volumes, as a flow of Hamilton's
  /// equations, makes of a Gaussian one whose covariance has this log_volume(). Linear maps and
  /// known shifts keep that knowledge, sums with other random vectors do not.
  void carried_without_compression(double gaussian_log_volume) {
    gaussian_log_volume_ = gaussian_log_volume;
  }
  /// What that has told, after linear maps.
  const std::optional<double>& gaussian_log_volume() const { return gaussian_log_volume_; }

  /// Cumulants of w: at (i r + j) r + k, and at ((i r + j) r + k) r + l.
  const std::vector<double>& third() const { return third_; }
  const std::vector<double>& fourth() const { return fourth_; }

 private:
  Cumulants() = default;

  /// y = mean + factor v with uncorrelated v: axes, and the turn from v to w.
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
/// and covariance: the negentropy, and beside it the divergence between the two Gaussians,
///
///   1/2 (tr(C_1^-1 C) + d^T C_1^-1 d - r + ln det C_1 - ln det C) ,   d = mean - mean_1 .
///
/// Infinite where the Gaussian does not reach in some direction what the distribution does.
double divergence_from_gaussian(const Cumulants& distribution, const Cumulants& gaussian);

/// By how much the probability of an event can differ between two distributions of this divergence
/// D, at most: sqrt(D/2), and no more than 1 (Pinsker's inequality: M. S. Pinsker, Information and
/// Information Stability of Random Variables and Processes, 1964).
double largest_error_of_probability(double divergence);

/// A Gaussian distribution misleads where some probability that it gives may be wrong by more than
/// this. A one-sigma interval holds 68 %: five points more or less is as if the standard deviation
/// were wrong by a tenth (2 phi(1) = 0.48 a unit of the logarithm of s).
inline constexpr double misleading_probability = 0.05;

}  // namespace hamjet
