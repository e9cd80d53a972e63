#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "../../algebra/singular_values.hpp"
#include "hamjet/error.hpp"
#include "shooting.hpp"

// Families of periodic orbits by pseudo-arclength continuation: a step along the curve's tangent,
// and Newton's method across it, which passes folds of every quantity.

namespace hamjet {
namespace {

using Kind = OrbitQuantity::Kind;

/// Of Newton's method at a member: its predicted start is near.
constexpr int most_member_iterations = 12;
/// The longest step along the curve, in parts of the orbit's sizes, and the least cosine between
/// tangents.
constexpr double longest_arc = 0.25;
constexpr double least_cosine = 0.8;

/// A member with what the next one needs.
struct Followed {
  PeriodicOrbit orbit;
  LinearShooting linear;
  Vector<double> tangent;  ///< the tangent, of length 1 in parts of the sizes
};

class FamilyFollower {
 public:
  FamilyFollower(const PeriodicProblem& problem, const PeriodicOrbit& first, const FamilyPath& path)
      : problem_(problem), path_(path), shooting_(problem, first.nodes) {}

  Followed first(const PeriodicOrbit& orbit) const {
    Followed at{orbit, shooting_.linearize(orbit.nodes), {}};
    const SingularValueDecomposition d = decompose_by_singular_values(tangent_rows(at));
    const Eigen::Index last = d.values.size() - 1;
    constexpr double isolated = 1e-9;
    if (last > 0 && d.values[last - 1] <= isolated * d.values[0]) {
      throw Error(ErrorKind::numerical,
                  "periodic.family: the orbit is in a family of more than one dimension, or where "
                  "two families meet, so that no one curve leads on; must be another start");
    }
    at.tangent = d.right.col(last);
    const double rate = along_rate(at);
    if (!(std::abs(rate) > 1e-12)) {
      throw Error(ErrorKind::numerical,
                  "periodic.family.along: does not change along the family at its first orbit; "
                  "must be another quantity, or another start");
    }
    if (rate * path_.step < 0) at.tangent = -at.tangent;
    return at;
  }

  /// The rate of the quantity by the arclength.
  double along_rate(const Followed& at) const { return rate(path_.along, at); }
  double rate(const OrbitQuantity& quantity, const Followed& at) const {
    return shooting_.gradient(quantity, at.orbit.nodes).dot(at.tangent);
  }
  /// The cosine between the tangent and a quantity's gradient.
  double slope(const OrbitQuantity& quantity, const Followed& at) const {
    return shooting_.gradient(quantity, at.orbit.nodes).normalized().dot(at.tangent);
  }
  bool is_held(const OrbitQuantity& quantity) const {
    return problem_.has_parameter && problem_.held.kind == quantity.kind;
  }

  /// The next member. `length` is the last step's and becomes this one's. Throws Error(numerical)
  /// where even short steps lead to none.
  Followed next(const Followed& from, double& length) {
    constexpr double growth = 1.5;
    constexpr int most_halvings = 12;
    const double wanted = std::abs(path_.step / along_rate(from));
    length = std::min({wanted, length * growth, longest_arc});
    shooting_.set_phase(from.orbit.nodes);
    for (int halvings = 0;; ++halvings, length /= 2) {
      try {
        Followed member = stepped(from, length);
        if (member.tangent.dot(from.tangent) >= least_cosine || halvings == most_halvings) {
          return member;
        }
      } catch (const Error& error) {
        if (error.kind() != ErrorKind::numerical || halvings == most_halvings) throw;
      }
    }
  }

  /// The member between two at which the quantity is at its end.
  Followed last(const Followed& before, const Followed& after, double part) {
    OrbitNodes nodes = before.orbit.nodes;
    for (std::size_t i = 0; i < nodes.states.size(); ++i) {
      nodes.states[i] += part * (after.orbit.nodes.states[i] - nodes.states[i]);
    }
    nodes.period += part * (after.orbit.nodes.period - nodes.period);
    nodes.parameter += part * (after.orbit.nodes.parameter - nodes.parameter);
    shooting_.set_phase(before.orbit.nodes);
    return solved(before, nodes,
                  [&](const OrbitNodes& at) { return shooting_.held(path_.along, path_.to, at); });
  }

 private:
  Matrix<double> tangent_rows(const Followed& at) const {
    if (!problem_.has_parameter) return at.linear.rows;
    Matrix<double> rows(at.linear.rows.rows() + 1, at.linear.rows.cols());
    rows.topRows(at.linear.rows.rows()) = at.linear.rows;
    rows.row(at.linear.rows.rows()) =
        shooting_.held(problem_.held, problem_.value, at.orbit.nodes).gradient.transpose();
    return rows;
  }

  /// The tangent nearest to another one: where families meet there are several.
  Vector<double> tangent_near(const Followed& at, const Vector<double>& other) const {
    const SingularValueDecomposition d = decompose_by_singular_values(tangent_rows(at));
    const Eigen::Index last = d.values.size() - 1;
    constexpr double vanishing = 1e-9;
    Vector<double> tangent = d.right.col(last).dot(other) * d.right.col(last);
    for (Eigen::Index i = 0; i < last; ++i) {
      if (d.values[i] > vanishing * d.values[0]) continue;
      tangent += d.right.col(i).dot(other) * d.right.col(i);
    }
    return tangent.normalized();
  }

  Followed solved(const Followed& from, const OrbitNodes& guess,
                  const std::function<ShootingEquation(const OrbitNodes&)>& place) const {
    Shooting::Solution solution = shooting_.solve(
        guess,
        [&](const OrbitNodes& nodes) {
          std::vector<ShootingEquation> equations = {place(nodes)};
          if (problem_.has_parameter) {
            equations.push_back(shooting_.held(problem_.held, problem_.value, nodes));
          }
          return equations;
        },
        most_member_iterations);
    Followed member{{}, solution.linear, {}};
    member.orbit = orbit_of_solution(problem_, std::move(solution), shooting_.scale());
    member.tangent = tangent_near(member, from.tangent);
    return member;
  }

  Followed stepped(const Followed& from, double length) const {
    OrbitNodes guess = shooting_.moved(from.orbit.nodes, from.linear, length * from.tangent, 1);
    const Vector<double> place = shooting_.unknowns(guess);
    return solved(from, guess, [&](const OrbitNodes& nodes) {
      return ShootingEquation{from.tangent, from.tangent.dot(shooting_.unknowns(nodes) - place)};
    });
  }

  const PeriodicProblem& problem_;
  const FamilyPath& path_;
  Shooting shooting_;
};

/// Puts a member's indices in the order of those of the member before.
void order_like(const Monodromy& before, Monodromy& after) {
  const std::size_t count = before.indices.size();
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t nearest = i;
    for (std::size_t j = i; j < count; ++j) {
      const auto distance = [&](std::size_t k) {
        return std::abs(after.indices[k] - before.indices[i]);
      };
      if (distance(j) < distance(nearest)) nearest = j;
    }
    std::swap(after.indices[i], after.indices[nearest]);
    std::swap(after.multipliers[i], after.multipliers[nearest]);
  }
}

/// What happens between two members, in words.
std::string mark_between(const FamilyFollower& follower, const FamilyPath& path,
                         const Followed& before, const Followed& after,
                         const std::array<double, 2>& along) {
  std::string text;
  const auto add = [&](const std::string& words) { text += (text.empty() ? "" : "; ") + words; };
  const auto add_fold = [&](const OrbitQuantity& quantity, std::string_view name) {
    if (follower.is_held(quantity)) return;
    const double first = follower.slope(quantity, before);
    const double second = follower.slope(quantity, after);
    // Of a quantity that all members share, rounding alone is left.
    constexpr double rounding = 1e-8;
    const bool is_there = std::min(std::abs(first), std::abs(second)) > rounding;
    if (is_there && first * second < 0) add(fmt::format("fold of the {}", name));
  };
  add_fold({Kind::energy}, "energy");
  add_fold({Kind::period}, "period");
  if (path.along.kind == Kind::variable) add_fold(path.along, "variable");
  if (path.along.kind == Kind::parameter) add_fold(path.along, "parameter");
  const std::vector<std::complex<double>>& from = before.orbit.monodromy.indices;
  const std::vector<std::complex<double>>& to = after.orbit.monodromy.indices;
  const double doubt =
      std::max({1e-8, before.orbit.monodromy.trivial_defect, after.orbit.monodromy.trivial_defect});
  bool meet = false;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if ((from[i].imag() == 0) != (to[i].imag() == 0)) meet = true;
    if (from[i].imag() != 0 || to[i].imag() != 0) continue;
    for (const double bound : {1.0, -1.0}) {
      const double first = from[i].real() - bound;
      const double second = to[i].real() - bound;
      if (first * second >= 0 || std::min(std::abs(first), std::abs(second)) <= doubt) continue;
      add(fmt::format("index {} passes {:+.0f} near {:.8g}", i + 1, bound,
                      along[0] + (along[1] - along[0]) * first / (first - second)));
    }
  }
  if (meet) add("two indices meet and leave the real line, or come back to it");
  return text;
}

}  // namespace

PeriodicFamily follow_family(const PeriodicProblem& problem, const PeriodicOrbit& first,
                             const FamilyPath& path, const std::function<void(double)>& progress) {
  FamilyFollower follower(problem, first, path);
  Followed at = follower.first(first);
  const auto along = [&](const Followed& one) {
    return quantity_of(problem, path.along, one.orbit.nodes);
  };
  PeriodicFamily family;
  family.members.push_back({first, along(at)});
  const double start = family.members.front().along;
  double length = longest_arc;
  while (family.members.size() < path.most_members) {
    if (progress) progress((family.members.back().along - start) / (path.to - start));
    Followed after;
    const double place = family.members.back().along;
    double end = 0;
    bool is_last = false;
    try {
      after = follower.next(at, length);
      end = along(after);
      is_last = (place - path.to) * (end - path.to) <= 0;
      if (is_last && end != path.to) {
        after = follower.last(at, after, (path.to - place) / (end - place));
        end = along(after);
      }
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      family.end = fmt::format("no member is found beyond {:.10g}: {}", place, error.what());
      family.is_failure = true;
      return family;
    }
    order_like(at.orbit.monodromy, after.orbit.monodromy);
    family.members.push_back(
        {after.orbit, end, mark_between(follower, path, at, after, {place, end})});
    if (is_last) return family;
    at = std::move(after);
  }
  family.end = fmt::format("{} members do not reach {:.10g}; the last is at {:.10g}",
                           family.members.size(), path.to, family.members.back().along);
  return family;
}

}  // namespace hamjet
