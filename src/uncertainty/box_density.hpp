#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
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

/// A density at a point: exp(log_amplitude - |white|^2 / 2) E[(speed + x)^+] with x standard
/// normal. The last factor is absent if there is no speed. Amplitude, `white` and speed are smooth
/// functions of the point.
struct NormalFactor {
  double log_amplitude;
  std::array<double, 3> white;
  std::optional<double> speed = {};

  double log_value() const { return log_value(speed ? log_mean_positive(*speed) : 0); }
  /// The same, where the logarithm of the speed's factor is known already.
  double log_value(double of_speed) const {
    return log_amplitude - (white[0] * white[0] + white[1] * white[1] + white[2] * white[2]) / 2 +
           of_speed;
  }
};

/// A density that is a product of three exponential functions on each of many boxes, made to follow
/// a given density. A box is halved where taking the logarithm of the given density as linear may
/// lose most. A bound of the density within a box follows from the smooth functions that it is made
/// of, even where the density itself is a narrow peak between the points at which it is evaluated;
/// a fraction of this bound is added throughout the box. Points drawn from the boxes, weighted with
/// the ratio of the two densities, give integrals over the given density without any error but that
/// of sampling.
class BoxDensity {
 public:
  using Density = std::function<NormalFactor(const std::array<double, 3>&)>;

  /// The boxes must not overlap, and must ascend in their first coordinate. They are halved until
  /// little is lost, or until there are `most` of them. Boxes in which the density vanishes are
  /// left out.
  BoxDensity(const std::vector<Box>& boxes, const Density& density, std::size_t most);

  /// Whether the density was zero at all points.
  bool is_empty() const { return leaves_.empty(); }
  /// The logarithm of the density's integral, according to the boxes.
  double log_mass() const { return log_mass_; }
  /// The point that belongs to five uniform numbers in [0, 1).
  std::array<double, 3> point(const std::array<double, 5>& uniform) const;
  /// The logarithm of this density, whose integral is 1, at a point; no value outside all boxes.
  std::optional<double> log_density(const std::array<double, 3>& point) const;

 private:
  struct Node {
    Box box;
    double log_even = 0;  ///< logarithm of the added fraction of the bound, which is constant
    double log_mean = 0;  ///< logarithm of the mean of the density
    double log_mass = 0;  ///< logarithm of the mass of both
    std::array<double, 3> slope{};  ///< slope of the density's logarithm across the whole box
    double priority = 0;            ///< logarithm of the bound on the mass that is missed
    std::size_t first_child = 0;    ///< 0 marks a leaf
    int dimension = 0;              ///< dimension along which the box is, or would be, halved
  };
  static Node made(const Box& box, const Density& density);
  /// Whether further halving would gain little.
  bool is_fine() const;

  /// What a search of the box of a point reads of a node: of 100 000 boxes it stays in the cache.
  struct Branch {
    double middle;              ///< where the box is halved
    std::uint32_t first_child;  ///< 0 marks a leaf
    std::uint32_t dimension;
  };

  std::vector<Node> nodes_;
  std::vector<Branch> branches_;
  std::size_t roots_ = 0;
  std::vector<std::size_t> leaves_;
  std::vector<double> cumulative_;
  double log_mass_ = 0;
};

}  // namespace hamjet
