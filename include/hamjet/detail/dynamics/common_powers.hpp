#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "hamjet/detail/algebra/slice_recurrences.hpp"
#include "hamjet/detail/dynamics/operation_list.hpp"

namespace hamjet {

/// How the powers u^(-n/2), n = 1, 2, .., of the values of an operation list are made together: of
/// one value all from the power nearest to zero, whose digits count most, and from 1/u, so that
/// they take one root and one division. u^(-n/2) is u^(-m/2) (1/u)^((n - m)/2) where n and m, that
/// of the nearest, are both odd or both even, and (1/u)^(n/2) elsewhere. An odd power, if there is
/// one, is taken for the nearest, for it has the root.
struct PowerPlan {
  struct Group {
    std::size_t nearest = 0;     ///< the value that is the power nearest to zero
    unsigned twice_nearest = 0;  ///< its m
  };
  struct Member {
    std::size_t group = 0;
    bool is_first = false;       ///< in the list: it makes what is common
    bool is_of_inverse = false;  ///< starts from 1/u, not from the power nearest to zero
    unsigned factors = 0;        ///< of 1/u that follow
  };

  explicit PowerPlan(const OperationList& list);

  std::vector<Group> groups;
  std::vector<std::optional<Member>> members;  ///< by value; none for what is no such power
};

/// The values of the powers of a list and their derivatives, T and Real as in SliceEvaluator.
template <class T, class Real>
class CommonPowers {
 public:
  explicit CommonPowers(const OperationList& list)
      : plan_(list), inverses_(plan_.groups.size(), T(1)) {}

  /// Sets value i to the power of u, and where it is the first of its group the nearest one too;
  /// `value(i)` is the place of a value.
  template <class Value>
  void evaluate(std::size_t i, const T& u, const Real& exponent, const Value& value) {
    using std::sqrt;
    if (!plan_.members[i]) {
      value(i) = power(u, exponent);
      return;
    }
    const PowerPlan::Member& member = *plan_.members[i];
    const PowerPlan::Group& group = plan_.groups[member.group];
    T& inverse = inverses_[member.group];
    if (member.is_first) {
      // As in power(), with the digits that the nearest has alone; 1/u = u^(-m/2) u^(m/2 - 1).
      const unsigned m = group.twice_nearest;
      T rest(1);
      if (m % 2 == 1) rest = T(sqrt(u));
      for (unsigned k = 0; k + 1 < m / 2; ++k) rest *= u;
      T& nearest = value(group.nearest);
      nearest = T(1) / (m >= 2 ? T(rest * u) : rest);
      inverse = m == 1 ? T(nearest * nearest) : T(nearest * rest);
    }
    if (i == group.nearest) return;
    T result = member.is_of_inverse ? inverse : value(group.nearest);
    for (unsigned k = 0; k < member.factors; ++k) result *= inverse;
    value(i) = result;
  }

  /// The derivative of value i, w, by u.
  T derivative(std::size_t i, const T& u, const Real& exponent, const T& w) const {
    const T scaled = T(exponent) * w;
    return plan_.members[i] ? T(scaled * inverses_[plan_.members[i]->group]) : T(scaled / u);
  }

 private:
  PowerPlan plan_;
  std::vector<T> inverses_;  ///< 1/u, by group
};

}  // namespace hamjet
