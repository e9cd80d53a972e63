#pragma once

#include <cstddef>
#include <vector>

#include "least_impulses.hpp"
#include "linear_program.hpp"

namespace hamjet {

/// The linear program of impulses along given directions, which approximates that of all
/// directions: with x_kj of the unit vector u_kj at the time k, in units of the limit if there is
/// one,
///
///   sum_kj B_k u_kj x_kj = share change,    with a limit sum_j x_kj <= 1 for all k.
///
/// It begins with the axes of all times and grows by the directions of primer vectors.
class DirectedImpulses {
 public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  /// The effects must outlive it. Without a limit, `most` is infinite, the share is all.
  DirectedImpulses(const std::vector<ImpulseEffect>& effects, const Vector6& change, double most);

  /// The largest share of the change, all at most, that impulses below the limit make.
  double solve_share();
  /// After that: the least sum that makes all of the change.
  void solve_sum();

  /// Of the last of these: B_k^T y is the primer vector at the time k.
  Vector6 costate() const;
  std::vector<ChosenImpulse> impulses() const;
  /// Adds the primer vector's directions where it does more than it costs. False if it does so
  /// nowhere.
  bool add_directions();

 private:
  static std::vector<LinearProgram::Row> rows(std::size_t times, bool is_limited);
  LinearProgram::Column column(std::size_t time, const Eigen::Vector3d& direction) const;
  void add(const std::vector<ChosenImpulse>& unit_vectors);

  const std::vector<ImpulseEffect>& effects_;
  bool is_limited_;
  double unit_;                            ///< of the impulses
  double cost_ = 1;                        ///< of an impulse: 0 while the share is what counts
  std::vector<ChosenImpulse> directions_;  ///< of the columns behind the share's
  LinearProgram program_;
};

}  // namespace hamjet
