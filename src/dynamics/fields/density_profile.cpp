#include "density_profile.hpp"

#include <fmt/format.h>

#include <cmath>

#include "hamjet/detail/algebra/pack.hpp"
#include "hamjet/error.hpp"
#include "septic_spline.hpp"

namespace hamjet {
namespace {

void require_density_table(const DensityTable& table) {
  const auto& [heights, densities] = table;
  if (heights.size() != densities.size()) {
    throw Error(ErrorKind::usage,
                fmt::format("a table of densities must have as many densities as heights, got {} "
                            "and {}",
                            densities.size(), heights.size()));
  }
  if (heights.size() < 4) {
    throw Error(ErrorKind::usage, fmt::format("a table of densities must have at least 4 heights, "
                                              "got {}",
                                              heights.size()));
  }
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (!std::isfinite(heights[i])) {
      throw Error(ErrorKind::usage,
                  fmt::format("height {} of a table of densities is not finite", i + 1));
    }
    if (i > 0 && !(heights[i] > heights[i - 1])) {
      throw Error(ErrorKind::usage,
                  fmt::format("the heights of a table of densities must increase, but {} km is "
                              "followed by {} km",
                              heights[i - 1], heights[i]));
    }
    if (!(densities[i] > 0) || !std::isfinite(densities[i])) {
      throw Error(ErrorKind::usage,
                  fmt::format("densities must be positive and finite, got {} kg/m^3 at {} km",
                              densities[i], heights[i]));
    }
  }
}

}  // namespace

DensityProfile::DensityProfile(const DensityTable& table) : table_(table) {
  require_density_table(table);
  std::vector<SplineNumber> heights;
  std::vector<SplineNumber> logarithms;
  for (std::size_t i = 0; i < table.heights_km.size(); ++i) {
    heights.push_back(table.heights_km[i]);
    logarithms.push_back(log(SplineNumber(table.densities[i])));
  }
  const auto spline = septic_spline(heights, logarithms);
  in_extended_.push_back(
      {table.heights_km[0], table.densities[0], {convert<Extended>(spline[0][1])}});
  for (std::size_t i = 0; i < spline.size(); ++i) {
    Piece<Extended> piece{table.heights_km[i], table.densities[i], {}};
    for (std::size_t k = 0; k < spline_degree; ++k)
      piece.log_slopes[k] = convert<Extended>(spline[i][k + 1]);
    in_extended_.push_back(piece);
  }
  const auto in = [&]<class Real>(std::vector<Piece<Real>>& to) {
    for (const Piece<Extended>& piece : in_extended_) {
      Piece<Real> rounded{convert<Real>(piece.height), convert<Real>(piece.density), {}};
      for (std::size_t k = 0; k < spline_degree; ++k) {
        rounded.log_slopes[k] = convert<Real>(piece.log_slopes[k]);
      }
      to.push_back(rounded);
    }
  };
  in(in_double_);
  in(in_double_double_);
}

double DensityProfile::largest_departure() const {
  constexpr int parts = 32;
  double largest = 0;
  for (std::size_t i = 0; i + 1 < table_.heights_km.size(); ++i) {
    const double width = table_.heights_km[i + 1] - table_.heights_km[i];
    const double step = std::log(table_.densities[i + 1] / table_.densities[i]);
    for (int part = 1; part < parts; ++part) {
      const double t = static_cast<double>(part) / parts;
      Pack<double, 1> density;
      expand(Pack<double, 1>(table_.heights_km[i] + t * width), 0, &density);
      const double exponential = table_.densities[i] * std::exp(t * step);
      largest = std::max(largest, std::abs(density.lane(0) / exponential - 1));
    }
  }
  return largest;
}

}  // namespace hamjet
