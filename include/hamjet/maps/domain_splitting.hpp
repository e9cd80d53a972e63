#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "hamjet/maps/flow_map.hpp"

namespace hamjet {

/// A box of a map's variables, with polynomials about its own centre. All numbers are in the units
/// of the variables and components.
struct SplitDomain {
  std::vector<double> centre;
  std::vector<double> half_widths;
  FlowMap<double> map;  ///< in the deviations from the centre
  double error = 0;     ///< estimate of the largest error of a component in the box
};

struct SplitSettings {
  double tolerance = 1e-6;     ///< of every component that counts
  std::size_t components = 0;  ///< the first ones count; 0 for all
  std::size_t most_domains = 1000;
};

/// Polynomials about several centres, which fill a box together.
struct SplitMap {
  std::vector<SplitDomain> domains;
  /// Whether all are right to the tolerance, as far as estimates tell; not if there would be more
  /// domains than the limit.
  bool is_right = true;
  /// How many maps were asked for; those of boxes that were split count.
  std::size_t maps_made = 0;

  /// The largest estimated error.
  double error() const;
  /// The domain that holds a point of the box, or is nearest to one outside of it.
  const SplitDomain& domain_of(std::span<const double> point) const;
  /// The components of the final state at a point, by the polynomials of its domain. Throws
  /// Error(usage) for another count of numbers than variables.
  std::vector<double> evaluate(std::span<const double> point) const;
};

/// The estimate by which split_domains splits: the largest error, in a box about the map's nominal,
/// of one of the first `components`. Throws Error(numerical) for polynomials that are not finite.
double truncation_in_box(const FlowMap<double>& map, std::span<const double> half_widths,
                         std::size_t components);

/// Splits a box into halves until the polynomials about the centre of each part are right to a
/// tolerance. `map_about` gives the map about a centre, whose constant terms are the final state
/// there; its errors, as those of reading it off, are not part of the estimate.
///
/// The sizes S_k of the terms of degree k in the box, sums of their absolute values, are taken to
/// fall geometrically; the line through their logarithms, extrapolated to the degree N + 1, is the
/// estimate, and no smaller than S_N (S_N / S_(N-1)) where the last ratio is below one. A box is
/// split across the variable to which the terms of the highest degree have the largest degree, by
/// weight. The worst box is split first. Source: A. Wittig, P. Di Lizia, R. Armellin, K. Makino,
/// F. Bernelli-Zazzera, M. Berz, "Propagation of large uncertainty sets in orbital dynamics by
/// automatic domain splitting", Celestial Mechanics and Dynamical Astronomy 122 (2015) 239; here
/// maps are made anew about each centre, so that no error of a re-expansion adds up.
///
/// Throws Error(usage) for half widths that are not above 0 or not one for each coordinate of the
/// centre, a tolerance that is not above 0, maps of order below 2, and as `map_about`.
SplitMap split_domains(const std::function<FlowMap<double>(std::span<const double>)>& map_about,
                       std::span<const double> centre, std::span<const double> half_widths,
                       const SplitSettings& settings);

/// Some of a set of points, with the least box that holds them. All numbers are in the units of
/// the points' coordinates.
struct PointDomain {
  std::vector<std::size_t> points;  ///< their indices
  std::vector<double> centre;
  std::vector<double> half_widths;
  double error = 0;  ///< the largest of a point
};

/// What polynomials about a domain's centre make of its points.
struct PointAssessment {
  double error = 0;  ///< the largest of a point; infinite where nothing is known of it
  /// For each coordinate, how much of the error is of it, in any unit; all 0 where no smaller
  /// domain would have a smaller error.
  std::vector<double> weights;
};

/// Domains that hold a set of points together.
struct PointSplit {
  std::vector<PointDomain> domains;
  bool is_right = true;             ///< whether all errors are within the tolerance
  std::size_t maps_made = 0;        ///< how often `assess` was called
  std::vector<std::size_t> splits;  ///< for each coordinate, how many domains were halved across it
};

/// Splits a set of points into domains, as split_domains does a box, until the polynomials about
/// each domain's centre are right to the tolerance at its points: the worst domain is halved across
/// the coordinate of the largest weight, each half is the least box about its points, and half
/// boxes without points need no polynomials. The first domain has all points and the given centre;
/// where that is not right and the centre lies outside of the points' box, their own centre is
/// tried before they are split. `assess` is called once for each domain; the last call with a point
/// is that of the domain that holds it in the end.
///
/// Throws Error(usage) for no points, points of other lengths than the centre, and settings as
/// split_domains; and as `assess`.
PointSplit split_points(const std::function<PointAssessment(const PointDomain&)>& assess,
                        std::span<const std::vector<double>> points, std::span<const double> centre,
                        const SplitSettings& settings);

}  // namespace hamjet
