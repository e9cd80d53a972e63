#pragma once

#include <array>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>
#include <span>

#include "box_density.hpp"
#include "relative_paths.hpp"

namespace hamjet {

/// Random numbers of one stream; the same on every machine, which the standard library's
/// distributions are not.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t stream);
  double uniform() { return uniform_(engine_); }
  double normal() { return normal_(engine_); }

 private:
  boost::random::mt19937_64 engine_;
  boost::random::uniform_01<double> uniform_;
  boost::random::normal_distribution<double> normal_;
};

/// Deviations whose linear relative path enters a sphere in the window, or begins inside, drawn
/// with a density that is known.
///
/// Of all paths of the linear motion, those that enter the sphere of radius R at the time t within
/// dt, in the direction n within the solid angle dn, number on average
///
///   f(t, n) dt dn = R^2 p(R n; t) E[(-n.v)^+ | rho = R n] dt dn ,
///
/// dn = cos(latitude) d latitude d longitude, p the normal density of the relative position rho and
/// v the relative velocity, which on the condition is normal too. A draw takes (t, n) from boxes
/// that follow f, then n.v from its density on entry, then the deviation from the normal one on
/// these four conditions. A deviation with several entries can come by each of them: with q the
/// density of the draws and p(xi) the normal one,
///
///   q / p(xi) = sum over the entries j of b(t_j, n_j) / f(t_j, n_j) ,
///
/// b the boxes' density; what begins inside adds a term alike. The probability of a set of paths
/// that all enter is the mean over draws of p/q on the set. Source of the rate of entries: V. T.
/// Coppola, "Including Velocity Uncertainty in the Probability of Collision between Space Objects",
/// AAS 12-247 (2012), going back to S. O. Rice (1944).
class EntrySampler {
 public:
  /// `paths` must outlive it. Those that begin inside are drawn too: by their share of all or,
  /// where they count only once they come back (`begin_counts_late`), by a 20th at most. Throws
  /// Error(numerical) where the position is nearly certain in a direction: by the hundredth part of
  /// the radius.
  EntrySampler(const RelativePaths& paths, double radius, bool begin_counts_late);

  /// No path enters within the standard deviations that double precision can tell.
  bool is_empty() const { return entering_.is_empty() && inside_.is_empty(); }

  EncounterDeviation draw(RandomStream& random) const;
  /// The logarithm of q/p; none for a deviation without an entry. `states` are the linear relative
  /// states at all nodes.
  std::optional<double> log_density_ratio(std::span<const std::array<double, 6>> states) const;

  double radius() const { return radius_; }

 private:
  struct AtTime;
  struct Entry;
  AtTime at_time(double time) const;
  Entry entry(const AtTime& state, double latitude, double longitude) const;
  BoxDensity::Density entering() const;
  NormalFactor inside(const std::array<double, 3>& point) const;
  std::vector<Box> boxes() const;

  const RelativePaths* paths_;
  double radius_;
  BoxDensity entering_;
  BoxDensity inside_;
  double share_entering_ = 1;
};

}  // namespace hamjet
