#pragma once

#include <array>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>
#include <span>

#include "box_density.hpp"
#include "relative_paths.hpp"

namespace hamjet {

/// Random numbers of one stream. They are the same on every machine, unlike the distributions of
/// the standard library.
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

/// Deviations whose linear relative path enters a sphere in the window, or begins inside the
/// sphere, drawn with a known density.
///
/// Of all paths of the linear motion, those that enter the sphere of radius R at the time t within
/// dt, in the direction n within the solid angle dn, number on average
///
///   f(t, n) dt dn = R^2 p(R n; t) E[(-n.v)^+ | rho = R n] dt dn ,
///
/// dn = cos(latitude) d latitude d longitude, where p is the normal density of the relative
/// position rho, and the relative velocity v is normal under this condition too. A draw takes (t,
/// n) from boxes that follow f, then n.v from its density on entry, then the deviation from its
/// normal density under these four conditions. A deviation with several entries can be drawn
/// through each of them. With q the density of the draws and p(xi) the normal density,
///
///   q / p(xi) = sum over the entries j of b(t_j, n_j) / f(t_j, n_j) ,
///
/// where b is the density of the boxes; a path that begins inside adds a similar term. The
/// probability of a set of paths that all enter is the mean over the draws of p/q, counted on the
/// set. Source of the rate of entries: V. T. Coppola, "Including Velocity Uncertainty in the
/// Probability of Collision between Space Objects", AAS 12-247 (2012), going back to S. O. Rice
/// (1944).
class EntrySampler {
 public:
  /// `paths` must outlive the sampler. Paths that begin inside are drawn too, in proportion to
  /// their probability or, where they count only once they return (`begin_counts_late`), in at most
  /// a 20th of the draws. Throws Error(numerical) where the position is nearly certain in some
  /// direction, with a standard deviation below a hundredth of the radius.
  EntrySampler(const RelativePaths& paths, double radius, bool begin_counts_late,
               std::size_t boxes = most_boxes);
  /// The largest number of boxes, which take a tenth of a second.
  static constexpr std::size_t most_boxes = 100000;

  /// Whether no path enters within the standard deviations that double precision can resolve.
  bool is_empty() const { return entering_.is_empty() && inside_.is_empty(); }

  EncounterDeviation draw(RandomStream& random) const;
  /// The logarithm of q/p; no value for a deviation without an entry. `states` are the linear
  /// relative states at all nodes.
  std::optional<double> log_density_ratio(std::span<const std::array<double, 6>> states) const;

  double radius() const { return radius_; }
  /// The logarithm of the mean number of entries, with the paths that begin inside; according to
  /// the boxes.
  double log_mass() const;

 private:
  struct AtTime;
  struct Entry;
  AtTime at_time(double time) const;
  Entry entry(const AtTime& state, double latitude, double longitude) const;
  BoxDensity::Density entering() const;
  NormalFactor inside(const std::array<double, 3>& point) const;
  std::vector<Box> first_boxes() const;

  const RelativePaths* paths_;
  double radius_;
  BoxDensity entering_;
  BoxDensity inside_;
  double share_entering_ = 1;
};

}  // namespace hamjet
