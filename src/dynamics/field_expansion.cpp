#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "hamjet/detail/dynamics/operation_list.hpp"

namespace hamjet {
namespace {

/// The part of a value that varies with the variables, as a sum of coefficients times products; a
/// product is a value, followed by numbers in ascending order. Values with equal forms differ by a
/// number.
using VaryingPart = std::map<std::vector<std::size_t>, Extended>;
/// The varying parts of the three coordinates of a position.
using Deviations = std::array<VaryingPart, 3>;

VaryingPart varying_part(const OperationList& list, std::size_t value) {
  if (list.is_number(value)) return {};
  const Operation& o = list.operations()[value];
  VaryingPart result;
  if (o.code == OperationCode::linear) {
    for (const LinearTerm& term : o.terms) {
      for (const auto& [product, coefficient] : varying_part(list, term.value)) {
        result[product] += term.coefficient * coefficient;
      }
    }
  } else if (o.code == OperationCode::product && list.is_number(o.v)) {
    for (const auto& [product, coefficient] : varying_part(list, o.u)) {
      std::vector<std::size_t> factors = product;
      factors.insert(std::upper_bound(factors.begin() + 1, factors.end(), o.v), o.v);
      result[std::move(factors)] += coefficient;
    }
  } else {
    result[{value}] = 1;
  }
  std::erase_if(result, [](const auto& term) { return term.second == 0; });
  return result;
}

/// The list with expanded fields, operation by operation.
class FieldExpansion {
 public:
  FieldExpansion(const OperationList& list, int order, FieldMotion motion)
      : list_(list),
        order_(std::max(order, 1)),
        motion_(motion),
        place_(list.operations().size()) {}

  OperationList run() {
    for (std::size_t i = 0; i < list_.operations().size(); ++i) {
      Operation o = list_.operations()[i];
      if (o.code == OperationCode::field && moves(i)) {
        group_of_.resize(i + 1, none);
        group_of_[i] = find_group(o.parts[0].position);
        place_[i] = add_field(group_of_[i], placed(std::move(o.parts)));
        continue;
      }
      if (o.code == OperationCode::linear) merge_fields(o);
      if (o.code != OperationCode::input) {
        o.u = place_[o.u];
        o.v = place_[o.v];
      }
      for (LinearTerm& term : o.terms) term.value = place_[term.value];
      o.parts = placed(std::move(o.parts));
      // The partner of a sine follows it.
      if (o.code == OperationCode::sine || o.code == OperationCode::hyperbolic_sine) {
        o.v = operations_.size() + 1;
      }
      place_[i] = add(std::move(o));
    }
    std::vector<std::size_t> outputs;
    for (const std::size_t output : list_.outputs()) outputs.push_back(place_[output]);
    return needed_operations(list_.inputs(), std::move(operations_), std::move(outputs),
                             list_.has_time());
  }

 private:
  /// The parts of a sum of fields.
  using MergedKey = std::vector<
      std::tuple<const LocalField*, std::array<std::size_t, 3>, std::array<int, 3>, Extended>>;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// Fields whose positions have equal deviations.
  struct Group {
    Deviations deviations;
    std::vector<LinearTerm> terms;  ///< the coordinates that move
    std::vector<std::size_t> axes;
    std::vector<FieldProduct> products;
  };

  /// Whether a value has deviations.
  bool moves(std::size_t value) const {
    const bool moves_with_time = motion_ == FieldMotion::with_time && list_.depends_on_time(value);
    return moves_with_time || !list_.is_number(value);
  }

  VaryingPart deviation(std::size_t value) const {
    if (motion_ == FieldMotion::with_variables) return varying_part(list_, value);
    return moves(value) ? VaryingPart{{{value}, 1}} : VaryingPart();
  }

  std::size_t add(Operation o) {
    operations_.push_back(std::move(o));
    return operations_.size() - 1;
  }

  std::vector<FieldPart> placed(std::vector<FieldPart> parts) const {
    for (FieldPart& part : parts) {
      for (std::size_t& value : part.position) value = place_[value];
    }
    return parts;
  }

  std::size_t add_field(std::size_t group, std::vector<FieldPart> parts) {
    Operation o;
    o.code = OperationCode::field;
    o.terms = groups_[group].terms;
    o.axes = groups_[group].axes;
    o.products = groups_[group].products;
    o.parts = std::move(parts);
    return add(std::move(o));
  }

  std::size_t find_group(const std::array<std::size_t, 3>& position) {
    Deviations deviations;
    for (std::size_t i = 0; i < 3; ++i) deviations[i] = deviation(position[i]);
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      if (groups_[g].deviations == deviations) return g;
    }
    Group group;
    group.deviations = std::move(deviations);
    add_monomials(group, position);
    groups_.push_back(std::move(group));
    return groups_.size() - 1;
  }

  /// Sets the terms and products of a group, and adds the factors of the products, each as a
  /// product of two lower ones. A coordinate that is a number has no deviation.
  void add_monomials(Group& group, const std::array<std::size_t, 3>& position) {
    std::array<std::size_t, 3> term = {};
    std::map<std::array<int, 3>, std::size_t> values;
    for (std::size_t i = 0; i < 3; ++i) {
      if (group.deviations[i].empty()) continue;
      std::array<int, 3> powers = {};
      powers[i] = 1;
      values[powers] = place_[position[i]];
      term[i] = group.terms.size();
      group.terms.push_back({place_[position[i]], 1});
      group.axes.push_back(i);
    }
    for (int degree = 2; degree <= order_; ++degree) {
      for (int a = degree; a >= 0; --a) {
        for (int b = degree - a; b >= 0; --b) {
          const std::array<int, 3> powers = {a, b, degree - a - b};
          const std::size_t last = powers[2] > 0 ? 2 : (b > 0 ? 1 : 0);
          std::array<int, 3> rest = powers;
          --rest[last];
          std::array<int, 3> alone = {};
          alone[last] = 1;
          if (!values.contains(rest) || !values.contains(alone)) continue;
          group.products.push_back({term[last], values[rest], field_monomial(a, b, powers[2])});
          if (degree < order_) values[powers] = add_monomial(powers, values);
        }
      }
    }
    std::stable_sort(
        group.products.begin(), group.products.end(),
        [](const FieldProduct& x, const FieldProduct& y) { return x.coordinate < y.coordinate; });
  }

  std::size_t add_monomial(const std::array<int, 3>& powers,
                           const std::map<std::array<int, 3>, std::size_t>& values) {
    // A square takes half the products, and otherwise a factor of degree 1 leaves the fewest.
    std::array<int, 3> first = powers;
    std::array<int, 3> second = {};
    if (std::all_of(powers.begin(), powers.end(), [](int p) { return p % 2 == 0; })) {
      for (std::size_t i = 0; i < 3; ++i) first[i] = second[i] = powers[i] / 2;
    } else {
      const auto i = static_cast<std::size_t>(
          std::find_if(powers.begin(), powers.end(), [](int p) { return p > 0; }) - powers.begin());
      --first[i];
      ++second[i];
    }
    Operation o;
    o.code = OperationCode::deviation_product;
    o.u = values.at(first);
    o.v = values.at(second);
    o.lowest = {first[0] + first[1] + first[2], second[0] + second[1] + second[2]};
    return add(std::move(o));
  }

  /// The place in `place_` of the sum of fields of a group.
  std::size_t merged_field(std::size_t group, std::vector<FieldPart> parts) {
    MergedKey key;
    for (const FieldPart& part : parts) {
      key.emplace_back(part.field.get(), part.position, part.orders, part.factor);
    }
    const auto [known, is_new] = merged_.try_emplace(std::move(key), place_.size());
    if (is_new) place_.push_back(add_field(group, placed(std::move(parts))));
    return known->second;
  }

  /// Puts one field in the place of all terms of a sum that are fields of one group.
  void merge_fields(Operation& o) {
    std::map<std::size_t, std::vector<FieldPart>> parts;
    std::map<std::size_t, std::size_t> counts;
    const auto group_of = [&](const LinearTerm& term) {
      return term.value < group_of_.size() ? group_of_[term.value] : none;
    };
    for (const LinearTerm& term : o.terms) {
      const std::size_t group = group_of(term);
      if (group == none) continue;
      ++counts[group];
      for (FieldPart part : list_.operations()[term.value].parts) {
        part.factor *= term.coefficient;
        parts[group].push_back(std::move(part));
      }
    }
    std::vector<LinearTerm> kept;
    std::map<std::size_t, bool> is_added;
    for (const LinearTerm& term : o.terms) {
      const std::size_t group = group_of(term);
      if (group == none || counts[group] < 2) {
        kept.push_back(term);
      } else if (!is_added[group]) {
        is_added[group] = true;
        // Multiples of one sum are one operation.
        const Extended scale = parts[group][0].factor;
        for (FieldPart& part : parts[group]) part.factor /= scale;
        kept.push_back({merged_field(group, std::move(parts[group])), scale});
      }
    }
    o.terms = std::move(kept);
  }

  const OperationList& list_;
  int order_;
  FieldMotion motion_;
  std::vector<std::size_t>
      place_;  ///< of each value of the list, and of merged fields, in the new one
  std::vector<std::size_t> group_of_;  ///< of each field of the list
  std::vector<Group> groups_;
  std::map<MergedKey, std::size_t> merged_;
  std::vector<Operation> operations_;
};

}  // namespace

OperationList expand_fields(const OperationList& list, int order, FieldMotion motion) {
  return list.has_fields() ? FieldExpansion(list, order, motion).run() : list;
}

}  // namespace hamjet
