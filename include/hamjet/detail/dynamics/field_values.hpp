#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "hamjet/detail/algebra/pack.hpp"
#include "hamjet/detail/dynamics/operation_list.hpp"

namespace hamjet {

/// The lanes of a number or of a pack, as plain numbers, in which objects are asked.
template <class T, class Real, class ObjectNumber = Real>
struct ObjectLanes {
  using Number = ObjectNumber;
  static constexpr std::size_t count() {
    if constexpr (is_pack<T>) {
      return static_cast<std::size_t>(T::lanes);
    } else {
      return 1;
    }
  }
  static void put(const T& value, Number* target) {
    if constexpr (is_pack<T>) {
      for (std::size_t i = 0; i < count(); ++i) {
        target[i] = convert<Number>(value.lane(static_cast<int>(i)));
      }
    } else {
      *target = convert<Number>(value);
    }
  }
  static T take(const Number* source) {
    if constexpr (is_pack<T>) {
      return T::of_lanes([&](auto i) { return convert<Real>(source[i]); });
    } else {
      return convert<Real>(*source);
    }
  }
};

/// The same for functions of the time, which know no double-double numbers.
template <class T, class Real>
using TimeLanes =
    ObjectLanes<T, Real, std::conditional_t<std::is_same_v<Real, double>, double, Extended>>;

/// The values of the fields of a list that expand_fields made, and the coefficients of their
/// monomials. At each point, an object is asked once for all derivatives. T and Real are as in
/// SliceEvaluator.
template <class T, class Real>
class FieldValues {
 public:
  /// Coefficients are those of series up to `order`; the list must outlive this object.
  FieldValues(const OperationList& list, int order)
      : list_(&list), order_(order < 1 ? 1 : order), fields_(list.operations().size()) {
    std::map<std::pair<const LocalField*, std::array<std::size_t, 3>>, std::size_t> point_of;
    for (std::size_t i = 0; i < list.operations().size(); ++i) {
      const Operation& o = list.operations()[i];
      if (o.code != OperationCode::field) continue;
      for (const FieldPart& part : o.parts) {
        const auto [place, is_new] =
            point_of.try_emplace({part.field.get(), part.position}, points_.size());
        if (is_new) points_.push_back({part.field.get(), part.position});
        Point& point = points_[place->second];
        point.orders = std::max(point.orders, part.orders[0] + part.orders[1] + part.orders[2]);
        fields_[i].push_back(part_of(o, part, place->second, is_new));
      }
    }
    for (Point& point : points_) {
      point.coefficients.resize(lanes * local_field_size(point.orders + order_));
    }
  }

  bool is_empty() const { return points_.empty(); }

  /// The value of field i; `value(k)` is the constant term of value k.
  template <class Value>
  T evaluate(std::size_t i, const Value& value) {
    T sum(Real(0));
    for (const Part& part : fields_[i]) {
      if (part.is_first) expand(points_[part.point], 0, value);
      sum += T(part.of_value.second) * coefficient(part, part.of_value.first);
    }
    return sum;
  }

  /// The coefficients of the terms of field i up to a degree, in their order, by
  /// `set(term, coefficient)`.
  template <class Value, class Set>
  void evaluate_terms(std::size_t i, int degree, const Value& value, const Set& set) {
    const std::vector<std::size_t>& monomials = list_->operations()[i].monomials;
    for (const Part& part : fields_[i]) {
      if (part.is_first) expand(points_[part.point], degree, value);
    }
    // Terms stand by degree.
    for (std::size_t k = 0; k < monomials.size() && monomials[k] < local_field_size(degree); ++k) {
      T sum(Real(0));
      for (const Part& part : fields_[i]) {
        sum += T(part.of_terms[k].second) * coefficient(part, part.of_terms[k].first);
      }
      set(k, sum);
    }
  }

 private:
  using Lanes = ObjectLanes<T, Real>;
  using Number = typename Lanes::Number;
  static constexpr std::size_t lanes = Lanes::count();

  /// A position at which an object is expanded.
  struct Point {
    const LocalField* field = nullptr;
    std::array<std::size_t, 3> position = {};
    int orders = 0;  ///< the highest order of differentiation
    std::vector<Number> coefficients = {};
  };
  /// The place of a coefficient of the object, and its factor.
  using Term = std::pair<std::size_t, Real>;
  struct Part {
    std::size_t point = 0;
    bool is_first = false;  ///< whether it is the first of the list at its point
    Term of_value = {};
    std::vector<Term> of_terms = {};
  };

  /// D^beta U(r + d) / factor has the coefficients (alpha + beta)! / alpha! c_(alpha + beta).
  static Term term_of(const FieldPart& part, const std::array<int, 3>& alpha) {
    Extended factor = part.factor;
    for (std::size_t k = 0; k < 3; ++k) {
      for (int j = 1; j <= part.orders[k]; ++j) factor *= alpha[k] + j;
    }
    const auto& beta = part.orders;
    return {field_monomial(alpha[0] + beta[0], alpha[1] + beta[1], alpha[2] + beta[2]),
            convert<Real>(factor)};
  }

  Part part_of(const Operation& o, const FieldPart& part, std::size_t point, bool is_first) const {
    Part result{point, is_first, term_of(part, {0, 0, 0})};
    std::map<std::size_t, std::array<int, 3>> exponents;
    for (int degree = 1; degree <= order_; ++degree) {
      for (int a = degree; a >= 0; --a) {
        for (int b = degree - a; b >= 0; --b) {
          const int c = degree - a - b;
          exponents[field_monomial(a, b, c)] = {a, b, c};
        }
      }
    }
    for (const std::size_t monomial : o.monomials) {
      result.of_terms.push_back(term_of(part, exponents.at(monomial)));
    }
    return result;
  }

  T coefficient(const Part& part, std::size_t place) const {
    return Lanes::take(points_[part.point].coefficients.data() + place * lanes);
  }

  template <class Value>
  static void expand(Point& point, int order, const Value& value) {
    std::array<std::array<Number, lanes>, 3> position;
    for (std::size_t k = 0; k < 3; ++k) {
      Lanes::put(value(point.position[k]), position[k].data());
    }
    point.field->expand(lanes, position[0].data(), position[1].data(), position[2].data(),
                        point.orders + order, point.coefficients.data());
  }

  const OperationList* list_;
  int order_;
  std::vector<std::vector<Part>> fields_;  ///< by value
  std::vector<Point> points_;
};

}  // namespace hamjet
