#pragma once

#include <cstddef>
#include <vector>

#include "clp_solver.hpp"
#include "least_impulses.hpp"

namespace hamjet {

/// The linear program of impulses along given directions, which approximates the problem with free
/// directions. With x_kj the size of the impulse along the unit vector u_kj at the time k, in units
/// of the limit if there is one,
///
///   sum_kj B_k u_kj x_kj = share change,    with a limit sum_j x_kj <= 1 for all k.
///
/// The program begins with the axes at all times and grows by the directions of primer vectors.
class DirectedImpulses {
 public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  /// The effects must outlive this object. Without a limit, `most` is infinite and the share is 1.
  DirectedImpulses(const std::vector<ImpulseEffect>& effects, const Vector6& change, double most);

  /// The largest fraction of the change, at most 1, that impulses below the limit can make.
  double solve_share();
  /// Finds the least sum that makes all of the change. Comes after solve_share.
  void solve_sum();

  /// The multipliers y of the last solution: B_k^T y is the primer vector at the time k.
  Vector6 costate() const;
  std::vector<ChosenImpulse> impulses() const;
  /// Adds the primer vector's directions where they gain more than they cost. Returns false if
  /// there are none.
  bool add_directions();

 private:
  static std::vector<LinearProgram::Row> rows(std::size_t times, bool is_limited);
  LinearProgram::Column column(std::size_t time, const Eigen::Vector3d& direction) const;
  void add(const std::vector<ChosenImpulse>& unit_vectors);

  const std::vector<ImpulseEffect>& effects_;
  bool is_limited_;
  double unit_;      ///< unit of the impulses
  double cost_ = 1;  ///< cost of an impulse; 0 while the share is maximised
  /// Directions of the columns that follow that of the share.
  std::vector<ChosenImpulse> directions_;
  LinearProgram program_;
};

}  // namespace hamjet
