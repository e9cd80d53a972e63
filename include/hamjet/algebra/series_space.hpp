#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "hamjet/detail/algebra/product_schedule.hpp"

namespace hamjet {

/// The truncated polynomial ring R[x_1..x_v] / (monomials of degree > N): its monomials in a fixed
/// order, and the schedule by which two of its elements are multiplied.
///
/// Monomials are graded: by degree first, and within a degree lexicographically with the exponent
/// of x_1 falling first (x^2, xy, y^2). There are C(v + N, N) monomials, or 1 + v N if the
/// variables are uncoupled, that is if products of different variables vanish.
///
/// A space is an immutable object; several spaces of different order or number of variables may
/// exist at once. A series holds a shared pointer to its space, and operations on series of two
/// different spaces throw.
class SeriesSpace {
 public:
  /// Creates a space of `variables` in 1..64 and `order` in 0..60. Throws Error(usage) for other
  /// numbers, and Error(too_large) for more than 5e7 monomials.
  static std::shared_ptr<const SeriesSpace> create(std::size_t variables, int order);
  /// The ring in which products of different variables also vanish, R[x_1..x_v] / (x_i x_j for i !=
  /// j, monomials of degree > N): functions along v lines through the origin, side by side. Its
  /// monomials are 1, x_1..x_v, x_1^2..x_v^2 and so on. Throws as `create`.
  static std::shared_ptr<const SeriesSpace> create_uncoupled(std::size_t variables, int order);

  std::size_t variables() const noexcept { return variables_; }
  int order() const noexcept { return order_; }
  /// Whether there are no products of different variables; this is also true of a single variable.
  bool is_uncoupled() const noexcept { return is_uncoupled_; }
  /// Number of monomials of degree 0..N.
  std::size_t size() const noexcept { return offsets_.back(); }
  /// Index of the first monomial of this degree; `first(order() + 1)` is `size()`.
  std::size_t first(int degree) const { return offsets_[static_cast<std::size_t>(degree)]; }
  std::size_t count(int degree) const { return first(degree + 1) - first(degree); }
  int degree(std::size_t monomial) const { return degrees_[monomial]; }
  /// The exponents of a monomial, one per variable.
  std::span<const std::uint8_t> exponents(std::size_t monomial) const {
    return {exponents_.data() + monomial * variables_, variables_};
  }
  /// Index of the monomial with these exponents, whose sum must not exceed the order. Throws
  /// Error(usage) where the space has no such monomial.
  std::size_t index(std::span<const std::uint8_t> exponents) const;
  /// Index of the monomial x_i, i = `variable`.
  std::size_t linear_index(std::size_t variable) const { return 1 + variable; }
  /// For every monomial of a degree below the order, the index of its product with x_i, i =
  /// `variable`. The table is made at the first call. Throws Error(usage) where such products
  /// vanish, in several uncoupled variables.
  std::span<const std::uint32_t> raised(std::size_t variable) const;

  /// The space of one order more in the same number of variables, for example that of an
  /// antiderivative. It is made at the first call and kept. Throws what `create` throws.
  const std::shared_ptr<const SeriesSpace>& next_order() const;

  /// The products that make up the slice of one degree; see ProductSchedule.
  const ProductSchedule& products(int degree) const {
    return schedules_[static_cast<std::size_t>(degree)];
  }

  /// The products of the slices a_i b_(degree - i) with i >= lowest_a and degree - i >= lowest_b,
  /// in a directed schedule; or, if both are slices of one series and `is_square`, in one like that
  /// of `products`. The schedule is made at the first call and kept.
  const ProductSchedule& products_above(int degree, int lowest_a, int lowest_b,
                                        bool is_square) const;

  /// Multiply-adds of one product of two series, with constant terms.
  std::size_t product_cost() const;

  bool operator==(const SeriesSpace& other) const noexcept {
    return variables_ == other.variables_ && order_ == other.order_ &&
           is_uncoupled_ == other.is_uncoupled_;
  }

  /// Number of monomials in `variables` variables up to `order`, as a real number so that it cannot
  /// overflow.
  static double monomial_count(std::size_t variables, int order);

 private:
  class ScheduleBuilder;

  SeriesSpace(std::size_t variables, int order, bool is_uncoupled);
  static std::shared_ptr<const SeriesSpace> make(std::size_t variables, int order,
                                                 bool is_uncoupled);

  /// Number of monomials that agree with x^a up to variable i - 1 and have a larger exponent of
  /// x_i, within a degree: with `left` = a_(i+1) + ... + a_v it is C(left - 1 + v - i, v - i).
  std::size_t before(std::size_t i, int left) const {
    return before_[i * (static_cast<std::size_t>(order_) + 1) + static_cast<std::size_t>(left)];
  }
  void list_monomials(int degree);
  void set_before();

  std::size_t variables_;
  int order_;
  bool is_uncoupled_;
  std::vector<std::size_t> offsets_;
  std::vector<std::uint8_t> exponents_;
  std::vector<std::uint8_t> degrees_;
  std::vector<std::size_t> before_;
  std::vector<ProductSchedule> schedules_;
  mutable std::once_flag is_raised_;
  mutable std::vector<std::uint32_t> raised_;
  mutable std::mutex has_products_above_;
  mutable std::map<std::array<int, 4>, ProductSchedule> products_above_;
  mutable std::once_flag has_next_order_;
  mutable std::shared_ptr<const SeriesSpace> next_order_;
};

using SpacePointer = std::shared_ptr<const SeriesSpace>;

/// Throws Error(usage) unless both spaces are the same: in order, and in number and coupling of the
/// variables.
void require_same_space(const SeriesSpace& a, const SeriesSpace& b);

}  // namespace hamjet
