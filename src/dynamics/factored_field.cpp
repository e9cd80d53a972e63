#include "factored_field.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "hamjet/detail/dynamics/expression.hpp"

namespace hamjet {
namespace {

/// Sums of more monomials are not multiplied out.
constexpr std::size_t most_monomials = 40;

/// The exponents of atoms; an atom is an input or, numbered behind these, a base.
using Monomial = std::map<std::size_t, Extended>;
/// Monomials with their coefficients, none of which is 0.
using MonomialSum = std::map<Monomial, Extended>;

void add_monomial(MonomialSum& sum, const Monomial& monomial, const Extended& coefficient) {
  if (coefficient == 0) return;
  const auto [place, is_new] = sum.try_emplace(monomial, coefficient);
  if (is_new) return;
  place->second += coefficient;
  if (place->second == 0) sum.erase(place);
}

Monomial times_power(Monomial monomial, std::size_t atom, const Extended& exponent) {
  Extended& e = monomial[atom];
  e += exponent;
  if (e == 0) monomial.erase(atom);
  return monomial;
}

bool is_natural(const Extended& exponent) { return exponent > 0 && exponent == floor(exponent); }

/// What a Hamiltonian is when it is multiplied out.
class MultipliedOut {
 public:
  explicit MultipliedOut(const OperationList& list) : inputs_(list.inputs()) {
    sum_ = value_of(list);
    // A base may occur before its power; the second time all are known.
    if (!bases_.empty() && !is_given_up_) sum_ = value_of(list);
  }

  bool is_given_up() const { return is_given_up_; }
  const MonomialSum& sum() const { return sum_; }
  /// The sums whose powers are atoms; each contains only earlier ones.
  const std::vector<MonomialSum>& bases() const { return bases_; }

 private:
  MonomialSum value_of(const OperationList& list) {
    std::vector<MonomialSum> values;
    for (const Operation& o : list.operations()) {
      values.push_back(value_of(o, values));
      if (is_given_up_) return {};
    }
    return values[list.outputs()[0]];
  }

  MonomialSum value_of(const Operation& o, const std::vector<MonomialSum>& values) {
    switch (o.code) {
      case OperationCode::input:
        return {{{{o.u, 1}}, 1}};
      case OperationCode::linear: {
        MonomialSum sum;
        add_monomial(sum, {}, o.constant);
        for (const LinearTerm& term : o.terms) {
          for (const auto& [m, c] : values[term.value]) add_monomial(sum, m, c * term.coefficient);
        }
        return in_bases(std::move(sum));
      }
      case OperationCode::product:
        return product(values[o.u], values[o.v]);
      case OperationCode::square:
        return product(values[o.u], values[o.u]);
      case OperationCode::quotient:
        return product(values[o.u], power(values[o.v], -1));
      case OperationCode::power:
        return power(values[o.u], o.constant);
      default:
        is_given_up_ = true;
        return {};
    }
  }

  /// Differences such as x - 1 or x - y, of which digits would be lost where they are multiplied
  /// out.
  bool is_shift(const MonomialSum& sum) const {
    return std::count_if(sum.begin(), sum.end(), [&](const auto& term) {
             const Monomial& m = term.first;
             return m.empty() ||
                    (m.size() == 1 && m.begin()->first < inputs_ && m.begin()->second == 1);
           }) > 1;
  }

  /// Whether terms of a sum may cancel, so that digits would be lost where it is multiplied by
  /// another sum: (a - b)^2 is right to rounding of itself, a^2 - 2 a b + b^2 to that of a^2.
  bool may_cancel(const MonomialSum& sum) const {
    if (sum.size() < 2) return false;
    return std::any_of(sum.begin(), sum.end(), [&](const auto& term) {
      return term.second < 0 || std::any_of(term.first.begin(), term.first.end(), [&](auto& power) {
               const auto& [atom, exponent] = power;
               if (atom >= inputs_) return may_cancel(bases_[atom - inputs_]);
               return exponent / 2 != floor(exponent / 2);
             });
    });
  }

  MonomialSum product(const MonomialSum& first, const MonomialSum& second) {
    const bool is_of_sums = first.size() > 1 && second.size() > 1;
    const auto written = [&](const MonomialSum& sum) {
      const bool is_kept = is_shift(sum) || (is_of_sums && may_cancel(sum));
      return is_kept ? power_of_base(sum, 1) : sum;
    };
    const MonomialSum a = written(first);
    const MonomialSum b = written(second);
    MonomialSum result;
    if (a.size() * b.size() > most_monomials) {
      is_given_up_ = true;
      return result;
    }
    for (const auto& [m, c] : a) {
      for (const auto& [other, factor] : b) {
        Monomial both = m;
        for (const auto& [atom, e] : other) both = times_power(std::move(both), atom, e);
        add_monomial(result, both, c * factor);
      }
    }
    return in_bases(std::move(result));
  }

  MonomialSum power(const MonomialSum& base, const Extended& exponent) {
    if (base.size() == 1) {
      const auto& [monomial, coefficient] = *base.begin();
      // A power of a power is one where the inner one is positive anyway, or the outer one whole.
      const bool is_whole = exponent == floor(exponent);
      const bool is_one = coefficient > 0 && monomial.size() == 1;
      const bool is_atom = is_one && coefficient == 1 && monomial.begin()->second == 1;
      const bool is_positive =
          is_one && monomial.begin()->second != floor(monomial.begin()->second);
      if (is_whole || is_atom || is_positive) {
        Monomial result = monomial;
        for (auto& [atom, e] : result) e *= exponent;
        return {{result, Extended(pow(coefficient, exponent))}};
      }
    }
    return power_of_base(base, exponent);
  }

  MonomialSum power_of_base(const MonomialSum& base, const Extended& exponent) {
    const auto known = std::find(bases_.begin(), bases_.end(), base);
    const auto place = static_cast<std::size_t>(known - bases_.begin());
    if (known == bases_.end()) bases_.push_back(base);
    return {{{{inputs_ + place, exponent}}, 1}};
  }

  /// The sum with a multiple of a base in place of its monomials, where this leaves fewer.
  MonomialSum in_bases(MonomialSum sum) const {
    for (std::size_t b = 0; b < bases_.size(); ++b) {
      const MonomialSum& base = bases_[b];
      if (base.size() < 2 || sum.size() < base.size()) continue;
      for (const auto& candidate : base) {
        const auto found = sum.find(candidate.first);
        if (found == sum.end()) continue;
        const Extended factor = found->second / candidate.second;
        MonomialSum changed = sum;
        for (const auto& [m, c] : base) add_monomial(changed, m, -factor * c);
        add_monomial(changed, {{inputs_ + b, 1}}, factor);
        if (changed.size() >= sum.size()) continue;
        sum = std::move(changed);
        break;
      }
    }
    return sum;
  }

  std::size_t inputs_;
  bool is_given_up_ = false;
  MonomialSum sum_;
  std::vector<MonomialSum> bases_;
};

MonomialSum derivative_by(const MonomialSum& sum, std::size_t atom) {
  MonomialSum result;
  for (const auto& [m, c] : sum) {
    const auto place = m.find(atom);
    if (place != m.end()) add_monomial(result, times_power(m, atom, -1), c * place->second);
  }
  return result;
}

/// Writes sums of monomials as expressions, each monomial once.
class Writer {
 public:
  Writer(std::span<const Expression> inputs, const std::vector<MonomialSum>& bases)
      : atoms_(inputs.begin(), inputs.end()), inputs_(inputs.size()) {
    for (const MonomialSum& base : bases) atoms_.push_back(written(base));
  }

  const Expression& atom(std::size_t place) const { return atoms_[place]; }

  /// Whether a monomial needs no product: it has one factor, or is written already.
  bool is_free(const Monomial& monomial) const {
    return monomial.size() <= 1 || known_.contains(monomial);
  }

  /// A sum by Horner's scheme in the input that divides most of the monomials that need a product.
  Expression written(const MonomialSum& sum) {
    MonomialSum costly;
    Expression result(0);
    for (const auto& [m, c] : sum) {
      if (is_free(m)) {
        result += c * written(m);
      } else {
        costly[m] = c;
      }
    }
    std::size_t best = 0, divided = 1;
    for (std::size_t atom = 0; atom < inputs_; ++atom) {
      const auto count = static_cast<std::size_t>(
          std::count_if(costly.begin(), costly.end(),
                        [&](const auto& term) { return divides(atom, term.first); }));
      if (count > divided) {
        best = atom;
        divided = count;
      }
    }
    if (divided == 1) {
      for (const auto& [m, c] : costly) result += c * written(m);
      return result;
    }
    MonomialSum inner, outer;
    for (const auto& [m, c] : costly) {
      if (divides(best, m)) {
        inner[times_power(m, best, -1)] = c;
      } else {
        outer[m] = c;
      }
    }
    const Expression factored = atoms_[best] * written(inner);
    return result + factored + written(outer);
  }

 private:
  static bool divides(std::size_t atom, const Monomial& monomial) {
    const auto place = monomial.find(atom);
    return place != monomial.end() && is_natural(place->second);
  }

  Expression written(const Monomial& monomial) {
    const auto known = known_.find(monomial);
    if (known != known_.end()) return known->second;
    Expression product(1);
    for (const auto& [atom, e] : monomial) product *= pow(atoms_[atom], Expression(e));
    return known_[monomial] = product;
  }

  std::vector<Expression> atoms_;
  std::size_t inputs_;
  std::map<Monomial, Expression> known_;
};

/// The derivatives of a Hamiltonian by its variables, with the sign reversed.
std::vector<Expression> negative_gradient(const MultipliedOut& h, std::span<const Expression> z,
                                          std::size_t variables) {
  Writer writer(z, h.bases());
  const std::size_t inputs = z.size(), count = h.bases().size();
  // The bases by the variables; what is a multiple of the variable itself is multiplied by it last.
  std::vector<std::vector<MonomialSum>> slopes(count);
  std::vector<Extended> scale(count, -1);
  const auto multiple_of = [&](std::size_t b, std::size_t i) -> Extended {
    const MonomialSum& slope = slopes[b][i];
    const bool is_multiple = slope.size() == 1 && slope.begin()->first == Monomial{{i, 1}};
    return is_multiple ? slope.begin()->second : Extended(0);
  };
  for (std::size_t b = 0; b < count; ++b) {
    for (std::size_t i = 0; i < variables; ++i) {
      slopes[b].push_back(derivative_by(h.bases()[b], i));
      if (const Extended factor = multiple_of(b, i); factor != 0) scale[b] = -factor;
    }
  }
  std::vector<Expression> result, brackets(variables, Expression(0));
  for (std::size_t i = 0; i < variables; ++i) {
    bool has_bracket = false;
    for (std::size_t b = 0; b < count; ++b) has_bracket |= multiple_of(b, i) != 0;
    MonomialSum alone;
    for (const auto& [m, c] : derivative_by(h.sum(), i)) {
      const auto place = m.find(i);
      const bool is_divided =
          has_bracket && m.size() > 1 && place != m.end() && is_natural(place->second);
      const Monomial rest = is_divided ? times_power(m, i, -1) : m;
      if (is_divided && writer.is_free(rest)) {
        brackets[i] += writer.written(MonomialSum{{rest, -c}});
      } else {
        alone[m] = -c;
      }
    }
    result.push_back(writer.written(alone));
  }
  std::vector<Expression> by_base(count, Expression(0));  // times the scale
  for (std::size_t b = count; b-- > 0;) {
    MonomialSum direct = derivative_by(h.sum(), inputs + b);
    for (auto& term : direct) term.second *= scale[b];
    by_base[b] = writer.written(direct);
    for (std::size_t k = b + 1; k < count; ++k) {
      by_base[b] += scale[b] / scale[k] * by_base[k] *
                    writer.written(derivative_by(h.bases()[k], inputs + b));
    }
  }
  for (std::size_t i = 0; i < variables; ++i) {
    for (std::size_t b = 0; b < count; ++b) {
      if (const Extended factor = multiple_of(b, i); factor != 0) {
        brackets[i] += Extended(-factor / scale[b]) * by_base[b];
      } else {
        result[i] += Extended(-1 / scale[b]) * by_base[b] * writer.written(slopes[b][i]);
      }
    }
    result[i] += z[i] * brackets[i];
  }
  return result;
}

}  // namespace

std::optional<OperationList> factored_field(const OperationList& hamiltonian,
                                            std::size_t parameters) {
  const MultipliedOut h(hamiltonian);
  if (h.is_given_up()) return std::nullopt;
  const std::size_t variables = hamiltonian.variables() - parameters, n = variables / 2;
  return record(
      hamiltonian.inputs(),
      [&](std::span<const Expression> z) {
        const std::vector<Expression> slopes = negative_gradient(h, z, variables);
        std::vector<Expression> field;
        for (std::size_t i = 0; i < n; ++i) field.push_back(-slopes[n + i]);
        field.insert(field.end(), slopes.begin(), slopes.begin() + static_cast<std::ptrdiff_t>(n));
        field.resize(variables + parameters, Expression(0));
        return field;
      },
      hamiltonian.has_time());
}

}  // namespace hamjet
