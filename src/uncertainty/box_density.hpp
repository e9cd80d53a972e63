#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace hamjet {

/// A box in three dimensions.
struct Box {
  std::array<double, 3> low;
  std::array<double, 3> high;

  double volume() const { return (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]); }
};

/// The logarithm of E[x^+], x normal of mean a and variance 1: log(phi(a) + a Phi(a)).
double log_mean_positive(double a);

/// A density at a point: exp(log_amplitude - |white|^2 / 2) E[(speed + x)^+], x standard normal,
/// the last factor only where there is a speed. Amplitude, `white` and speed are smooth.
struct NormalFactor {
  double log_amplitude;
  std::array<double, 3> white;
  std::optional<double> speed = {};

  double log_value() const {
    return log_amplitude - (white[0] * white[0] + white[1] * white[1] + white[2] * white[2]) / 2 +
           (speed ? log_mean_positive(*speed) : 0);
  }
};

/// A density that is a product of three exponential functions on each of many boxes, made to follow
/// a given one: boxes are halved where most may be lost by taking its logarithm as linear. How
/// large it may be within a box is told by what is smooth in it, also where the density itself is a
/// narrow peak between the points at which it is looked at; a share of that is added, the same
/// throughout the box. Points drawn from it, with the ratio of the two densities as weight, give
/// integrals over the given one without any error but that of the sample.
class BoxDensity {
 public:
  using Density = std::function<NormalFactor(const std::array<double, 3>&)>;

  /// The boxes must be apart from each other, and ascending in their first coordinate. They are
  /// halved until little is lost, or there are `most` of them. Those in which the density vanishes
  /// are left out.
  BoxDensity(const std::vector<Box>& boxes, const Density& density, std::size_t most);

  /// Nothing but zero was seen of the density.
  bool is_empty() const { return leaves_.empty(); }
  /// The logarithm of the integral, as the boxes have it.
  double log_mass() const { return log_mass_; }
  /// The point of five uniform numbers in [0, 1).
  std::array<double, 3> point(const std::array<double, 5>& uniform) const;
  /// The logarithm of this density, whose integral is 1, at a point; none outside all boxes.
  std::optional<double> log_density(const std::array<double, 3>& point) const;

 private:
  struct Node {
    Box box;
    double log_even = 0;            ///< of the share of the bound, the same throughout
    double log_mean = 0;            ///< of the density itself
    std::array<double, 3> slope{};  ///< of its logarithm, across the whole box
    double priority = 0;            ///< log of the bound on what is missed
    std::size_t first_child = 0;    ///< 0: a leaf
    int dimension = 0;              ///< along which it is, or would be, halved

    double log_mass() const;
  };
  static Node made(const Box& box, const Density& density);
  /// Whether further boxes would gain little.
  bool is_fine() const;

  std::vector<Node> nodes_;
  std::size_t roots_ = 0;
  std::vector<std::size_t> leaves_;
  std::vector<double> cumulative_;
  double log_mass_ = 0;
};

}  // namespace hamjet
