#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "hamjet/detail/algebra/slice_recurrences.hpp"
#include "hamjet/detail/dynamics/operation_list.hpp"

namespace hamjet {

/// A plan by which the powers u^(-n/2), n = 1, 2, .., of each value u of an operation list are
/// formed together. All powers of one value are made from the power nearest to zero, u^(-m/2),
/// whose digits count most, and from 1/u, so that they take one root and one division. If n and m
/// are both odd or both even, u^(-n/2) is u^(-m/2) (1/u)^((n - m)/2); otherwise it is (1/u)^(n/2).
/// If there are odd powers, one of them is taken as the nearest, because it needs the root.
struct PowerPlan {
  struct Group {
    std::size_t nearest = 0;     ///< value that is the power nearest to zero
    unsigned twice_nearest = 0;  ///< m of that power
  };
  struct Member {
    std::size_t group = 0;
    bool is_first = false;  ///< the first of its group in the list: it forms what the group shares
    bool is_of_inverse =
        false;             ///< the product starts from 1/u instead of the power nearest to zero
    unsigned factors = 0;  ///< number of factors 1/u that follow
  };

  explicit PowerPlan(const OperationList& list);

  std::vector<Group> groups;
  /// By value; empty for a value that is not such a power.
  std::vector<std::optional<Member>> members;
};

/// The values of the powers of a list and their derivatives. T and Real are as in SliceEvaluator.
template <class T, class Real>
class CommonPowers {
 public:
  explicit CommonPowers(const OperationList& list)
      : plan_(list), inverses_(plan_.groups.size(), T(1)) {}

  /// Sets value i to its power of u. If it is the first of its group, it also sets the power
  /// nearest to zero; `value(i)` is the storage of value i.
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
      // As in power(), with the digits that the nearest power has alone; 1/u = u^(-m/2) u^(m/2 -
      // 1).
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

  /// The derivative of w, value i, with respect to u.
  T derivative(std::size_t i, const T& u, const Real& exponent, const T& w) const {
    const T scaled = T(exponent) * w;
    return plan_.members[i] ? T(scaled * inverses_[plan_.members[i]->group]) : T(scaled / u);
  }

 private:
  PowerPlan plan_;
  std::vector<T> inverses_;  ///< 1/u, by group
};

}  // namespace hamjet
