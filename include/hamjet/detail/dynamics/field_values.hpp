#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <type_traits>
#include <utility>
#include <vector>

#include "hamjet/detail/algebra/pack.hpp"
#include "hamjet/detail/dynamics/operation_list.hpp"
#include "hamjet/detail/dynamics/time_function.hpp"

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
  static void set(T& value, std::size_t lane, const Number& number) {
    if constexpr (is_pack<T>) {
      value.set_lane(static_cast<int>(lane), convert<Real>(number));
    } else {
      value = convert<Real>(number);
    }
  }
};

/// Sets the Taylor coefficients of a function of the time, as TimeFunction::expand, each lane about
/// its own time; those of a lane without a time are NaN. Such functions know no double-double
/// numbers.
template <class T, class Real>
void expand_in_lanes(const TimeFunction& function, const T& time, int degree,
                     std::vector<T>& coefficients) {
  using Number = std::conditional_t<std::is_same_v<Real, double>, double, Extended>;
  using Lanes = ObjectLanes<T, Real, Number>;
  std::array<Number, Lanes::count()> times;
  Lanes::put(time, times.data());
  std::vector<Number> at_lane(function.components() * (static_cast<std::size_t>(degree) + 1));
  coefficients.assign(at_lane.size(), T(Real(std::numeric_limits<double>::quiet_NaN())));
  for (std::size_t lane = 0; lane < times.size(); ++lane) {
    if (!(times[lane] == times[lane])) continue;
    function.expand(times[lane], degree, at_lane.data());
    for (std::size_t j = 0; j < at_lane.size(); ++j) {
      Lanes::set(coefficients[j], lane, at_lane[j]);
    }
  }
}

/// The fields of a list that expand_fields made: their values, the coefficients of their
/// coordinates, and the cofactors of these, which are the series
///
///   Q_i = sum over the products of coordinate i of coefficient (factor's deviation) .
///
/// At each point, an object is asked once for all derivatives. T and Real are as in SliceEvaluator.
template <class T, class Real>
class FieldValues {
 public:
  /// Coefficients are those of series up to `order`, and the series of a value have `stride`
  /// coefficients. The list must outlive this object.
  FieldValues(const OperationList& list, int order, std::size_t stride)
      : order_(std::max(order, 1)), stride_(stride) {
    if (!list.has_fields()) return;
    index_.resize(list.operations().size());
    std::map<std::pair<const LocalField*, std::array<std::size_t, 3>>, std::size_t> point_of;
    for (std::size_t i = 0; i < list.operations().size(); ++i) {
      const Operation& o = list.operations()[i];
      if (o.code != OperationCode::field) continue;
      index_[i] = fields_.size();
      Field& field = fields_.emplace_back();
      for (const FieldPart& part : o.parts) {
        const auto [place, is_new] =
            point_of.try_emplace({part.field.get(), part.position}, points_.size());
        if (is_new) points_.push_back({part.field.get(), part.position});
        Point& point = points_[place->second];
        point.orders = std::max(point.orders, part.orders[0] + part.orders[1] + part.orders[2]);
        field.parts.push_back(part_of(o, part, place->second, is_new));
      }
      for (const FieldProduct& product : o.products) {
        field.degrees.push_back(degree_of(product.monomial));
      }
      put_into_group(o, field);
    }
    for (Point& point : points_) {
      point.coefficients.resize(lanes * local_field_size(point.orders + order_));
    }
    for (Group& group : groups_) set_up(group);
  }

  bool is_empty() const { return points_.empty(); }

  /// The value of field i; `value(k)` is the constant term of value k.
  template <class Value>
  T evaluate(std::size_t i, const Value& value) {
    T sum(Real(0));
    for (const Part& part : fields_[index_[i]].parts) {
      if (part.is_first) expand(points_[part.point], 0, value);
      sum += coefficient(part, part.of_value);
    }
    return sum;
  }

  /// Sets the coefficients of field i for the degrees above `known` up to `degree`; those of the
  /// coordinates go to `set(term, coefficient)`.
  template <class Value, class Set>
  void evaluate_coefficients(std::size_t i, int known, int degree, const Value& value,
                             const Set& set) {
    const Field& field = fields_[index_[i]];
    for (const Part& part : field.parts) {
      if (part.is_first) expand(points_[part.point], degree, value);
    }
    const auto sum_of = [&](const auto& term) {
      T sum(Real(0));
      for (const Part& part : field.parts) sum += coefficient(part, term(part));
      return sum;
    };
    if (known < 1 && degree >= 1) {
      for (std::size_t t = 0; t < field.parts[0].of_terms.size(); ++t) {
        set(t, sum_of([&](const Part& part) { return part.of_terms[t]; }));
      }
    }
    for (std::size_t k = 0; k < field.degrees.size(); ++k) {
      if (field.degrees[k] <= known || field.degrees[k] > degree) continue;
      Group& group = groups_[field.group];
      group.coefficients[k * group.fields + field.place] =
          sum_of([&](const Part& part) { return part.of_products[k]; });
    }
  }

  /// Forms the slices of degree d of all cofactors, which stand from `first` to `last` in the
  /// series of a value; value k stands at slices + k stride.
  void form_cofactors(int d, std::size_t first, std::size_t last, const T* slices) {
    for (Group& group : groups_) {
      if (group.fields == whole_group) {
        form_cofactors<whole_group>(group, d, first, last, slices);
      } else {
        form_cofactors<1>(group, d, first, last, slices);
      }
    }
  }
  /// The cofactor of a coordinate of field i.
  const T* cofactor(std::size_t i, std::size_t coordinate) const {
    const Field& field = fields_[index_[i]];
    const Group& group = groups_[field.group];
    return group.cofactors.data() + (coordinate * group.fields + field.place) * stride_;
  }

 private:
  using Lanes = ObjectLanes<T, Real>;
  using Number = typename Lanes::Number;
  static constexpr std::size_t lanes = Lanes::count();
  static constexpr std::size_t whole_group = 3;

  /// A position at which an object is expanded.
  struct Point {
    const LocalField* field = nullptr;
    std::array<std::size_t, 3> position = {};
    int orders = 0;  ///< the highest order of differentiation
    std::vector<Number> coefficients = {};
  };
  /// The place of a coefficient of the object, and its factor.
  struct Term {
    std::size_t place = 0;
    Real factor = Real(0);
  };
  struct Part {
    std::size_t point = 0;
    bool is_first = false;  ///< whether it is the first of the list at its point
    Term of_value = {};
    std::vector<Term> of_terms = {};
    std::vector<Term> of_products = {};
  };
  struct Field {
    std::vector<Part> parts;
    std::vector<int> degrees;  ///< the degrees of the monomials of its products
    std::size_t group = 0;
    std::size_t place = 0;  ///< in its group
  };
  /// One or three fields with the same products, whose cofactors are formed together.
  struct Group {
    std::vector<FieldProduct> products = {};
    std::vector<std::size_t> terms = {};
    std::size_t fields = 0;
    std::vector<std::size_t> first =
        {};                         ///< by coordinate, its first product, and one entry for the end
    std::vector<int> degrees = {};  ///< the degrees of the factors of the products
    std::vector<T> coefficients = {};  ///< by product and field
    std::vector<T> cofactors = {};     ///< by coordinate and field
  };

  static int degree_of(std::size_t monomial) {
    int degree = 0;
    while (local_field_size(degree) <= monomial) ++degree;
    return degree;
  }

  static std::array<int, 3> exponents_of(std::size_t monomial) {
    const int degree = degree_of(monomial);
    for (int a = degree; a >= 0; --a) {
      for (int b = degree - a; b >= 0; --b) {
        if (field_monomial(a, b, degree - a - b) == monomial) return {a, b, degree - a - b};
      }
    }
    return {};
  }

  /// D^beta U(r + d) has the coefficients (alpha + beta)! / alpha! c_(alpha + beta).
  static Term term_of(const FieldPart& part, const std::array<int, 3>& alpha) {
    Extended factor = part.factor;
    for (std::size_t k = 0; k < 3; ++k) {
      for (int j = 1; j <= part.orders[k]; ++j) factor *= alpha[k] + j;
    }
    const auto& beta = part.orders;
    return {field_monomial(alpha[0] + beta[0], alpha[1] + beta[1], alpha[2] + beta[2]),
            convert<Real>(factor)};
  }

  static Part part_of(const Operation& o, const FieldPart& part, std::size_t point, bool is_first) {
    Part result{point, is_first, term_of(part, {0, 0, 0})};
    for (const std::size_t axis : o.axes) {
      std::array<int, 3> alpha = {};
      alpha[axis] = 1;
      result.of_terms.push_back(term_of(part, alpha));
    }
    for (const FieldProduct& product : o.products) {
      result.of_products.push_back(term_of(part, exponents_of(product.monomial)));
    }
    return result;
  }

  void put_into_group(const Operation& o, Field& field) {
    if (o.products.empty()) return;
    std::vector<std::size_t> terms;
    for (const LinearTerm& term : o.terms) terms.push_back(term.value);
    for (field.group = 0; field.group < groups_.size(); ++field.group) {
      Group& group = groups_[field.group];
      if (group.fields < whole_group && group.products == o.products && group.terms == terms) break;
    }
    if (field.group == groups_.size()) groups_.push_back({o.products, std::move(terms)});
    field.place = groups_[field.group].fields++;
  }

  void set_up(Group& group) const {
    for (const FieldProduct& product : group.products) {
      while (group.first.size() <= product.coordinate) group.first.push_back(group.degrees.size());
      group.degrees.push_back(degree_of(product.monomial) - 1);
    }
    while (group.first.size() <= group.terms.size()) group.first.push_back(group.degrees.size());
    group.coefficients.assign(group.products.size() * group.fields, T(Real(0)));
    group.cofactors.assign(group.terms.size() * group.fields * stride_, T(Real(0)));
  }

  T coefficient(const Part& part, const Term& term) const {
    return T(term.factor) *
           Lanes::take(points_[part.point].coefficients.data() + term.place * lanes);
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

  /// `Fields` cofactors together, or each by itself.
  template <std::size_t Fields>
  void form_cofactors(Group& group, int d, std::size_t first, std::size_t last, const T* slices) {
    for (std::size_t c = 0; c < group.terms.size(); ++c) {
      for (std::size_t f = 0; f < group.fields; f += Fields) {
        std::size_t k = first;
        for (; k + tile <= last; k += tile) form_tile<Fields, tile>(group, c, f, d, k, slices);
        for (; k < last; ++k) form_tile<Fields, 1>(group, c, f, d, k, slices);
      }
    }
  }

  /// The sums of a tile stay in registers.
  static constexpr std::size_t tile = sizeof(T) > 256 ? 1 : (sizeof(T) > 64 ? 2 : 4);

  template <std::size_t Fields, std::size_t Monomials>
  void form_tile(Group& group, std::size_t coordinate, std::size_t field, int d,
                 std::size_t monomial, const T* slices) {
    std::array<std::array<T, Monomials>, Fields> sums;
    for (auto& row : sums) row.fill(T(Real(0)));
    for (std::size_t k = group.first[coordinate]; k < group.first[coordinate + 1]; ++k) {
      // A factor has no slices below its own degree, and the factors stand by degree.
      if (group.degrees[k] > d) break;
      const T* const factor = slices + group.products[k].factor * stride_ + monomial;
      const T* const coefficient = &group.coefficients[k * group.fields + field];
      for (std::size_t t = 0; t < Monomials; ++t) {
        for (std::size_t f = 0; f < Fields; ++f) sums[f][t] += coefficient[f] * factor[t];
      }
    }
    T* const target = &group.cofactors[(coordinate * group.fields + field) * stride_ + monomial];
    for (std::size_t f = 0; f < Fields; ++f) {
      for (std::size_t t = 0; t < Monomials; ++t) target[f * stride_ + t] = sums[f][t];
    }
  }

  int order_;
  std::size_t stride_;
  std::vector<std::size_t> index_;  ///< by value, its place among the fields
  std::vector<Field> fields_;
  std::vector<Point> points_;
  std::vector<Group> groups_;
};

}  // namespace hamjet
