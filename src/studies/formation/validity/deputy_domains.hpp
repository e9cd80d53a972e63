#pragma once

#include <optional>
#include <span>
#include <vector>

#include "flown_deputies.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/maps/domain_splitting.hpp"
#include "hamjet/studies/validity.hpp"

namespace hamjet {

/// The canonical deviation (dq, dp) of a point from a centre, both along the columns of `axes`.
SixNumbers<double> deviation_along(const Matrix6& axes, const std::vector<double>& point,
                                   const std::vector<double>& centre = std::vector<double>(6, 0));

/// How much of what the highest degree adds at some of a domain's points is of each coordinate, by
/// the derivative along it: by Euler's theorem they add up to the degree times the whole. The flow
/// is about the domain's centre; coordinates are along the columns of `axes`, which have one unit.
/// Where the flow's coordinates fail at some point, the half widths; all 0 without points.
std::vector<double> domain_weights(const DeputyFlow& flow, int degree, const Matrix6& axes,
                                   const PointDomain& domain,
                                   std::span<const std::vector<double>> points,
                                   std::span<const std::size_t> chosen);

/// If the result's scene asks for them, splits deputies that fill the ellipsoids of
/// `validity.separation_m` into domains until the polynomials of the scene's order about each
/// domain's centre miss none of them, as flown to the last time, by more than the tolerance. Half
/// of the deputies are on the surface. Throws as study_validity; a domain whose centre has no flow
/// in the result's coordinates counts as not right.
void set_validity_domains(ValidityResult& result, const ProgressCallback& progress);

}  // namespace hamjet
