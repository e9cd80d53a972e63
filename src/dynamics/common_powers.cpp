#include "hamjet/detail/dynamics/common_powers.hpp"

#include <cmath>
#include <map>

namespace hamjet {
namespace {

/// The n of a power u^(-n/2), at most 40 (see power()); 0 for other operations.
unsigned twice_negative(const Operation& o) {
  if (o.code != OperationCode::power) return 0;
  const double twice = -2 * static_cast<double>(o.constant);
  const bool is_common = twice >= 1 && twice <= 40 && twice == std::floor(twice);
  return is_common ? static_cast<unsigned>(twice) : 0;
}

}  // namespace

PowerPlan::PowerPlan(const OperationList& list) : members(list.operations().size()) {
  const auto operations = list.operations();
  std::map<std::size_t, std::size_t> group_of;  // by operand
  for (std::size_t i = 0; i < operations.size(); ++i) {
    const unsigned n = twice_negative(operations[i]);
    if (n == 0) continue;
    const auto [place, is_new] = group_of.try_emplace(operations[i].u, groups.size());
    if (is_new) groups.push_back({i, n});
    members[i] = Member{place->second, is_new, false, 0};
    Group& group = groups[place->second];
    const bool is_odd = n % 2 == 1;
    const bool has_root = group.twice_nearest % 2 == 1;
    if (is_odd == has_root ? n < group.twice_nearest : is_odd) group = {i, n};
  }
  for (std::size_t i = 0; i < operations.size(); ++i) {
    if (!members[i]) continue;
    const unsigned n = twice_negative(operations[i]);
    const unsigned nearest = groups[members[i]->group].twice_nearest;
    members[i]->is_of_inverse = n % 2 != nearest % 2;
    members[i]->factors = members[i]->is_of_inverse ? n / 2 - 1 : (n - nearest) / 2;
  }
}

}  // namespace hamjet
