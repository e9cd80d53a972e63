#include "hamjet/maps/domain_splitting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// The size of a monomial's largest value in a box.
double largest_monomial(std::span<const std::uint8_t> exponents, std::span<const double> widths) {
  double size = 1;
  for (std::size_t i = 0; i < widths.size(); ++i) {
    for (int k = 0; k < exponents[i]; ++k) size *= widths[i];
  }
  return size;
}

struct Assessment {
  double error = 0;
  std::size_t direction = 0;
};

/// The estimate of one component from the sizes of its degrees.
double extrapolated(const std::vector<double>& sizes) {
  const std::size_t order = sizes.size() - 1;
  // A vanishing degree, as of an even function, is no sign of the decay.
  double count = 0, sum = 0, sum_of_squares = 0, logarithms = 0, products = 0;
  for (std::size_t k = 1; k <= order; ++k) {
    if (!(sizes[k] > 0)) continue;
    const auto degree = static_cast<double>(k);
    count += 1;
    sum += degree;
    sum_of_squares += degree * degree;
    logarithms += std::log(sizes[k]);
    products += degree * std::log(sizes[k]);
  }
  double fitted = 0;
  const double spread = count * sum_of_squares - sum * sum;
  if (spread > 0) {
    const double slope = (count * products - sum * logarithms) / spread;
    const double offset = (logarithms - slope * sum) / count;
    fitted = std::exp(offset + slope * static_cast<double>(order + 1));
  }
  const double last = sizes[order];
  const double before = sizes[order - 1];
  return std::max(fitted, before > last ? last * last / before : last);
}

Assessment assess(const FlowMap<double>& map, std::span<const double> widths,
                  std::size_t components) {
  const SeriesSpace& space = *map.space();
  const auto order = static_cast<std::size_t>(space.order());
  Assessment result;
  std::vector<double> by_variable(widths.size(), 0);
  for (std::size_t c = 0; c < components; ++c) {
    std::vector<double> sizes(order + 1, 0);
    std::vector<double> own(widths.size(), 0);
    for (std::size_t degree = 1; degree <= order; ++degree) {
      const auto d = static_cast<int>(degree);
      for (std::size_t j = space.first(d); j < space.first(d + 1); ++j) {
        const auto exponents = space.exponents(j);
        const double size = std::abs(map.jet()[c][j]) * largest_monomial(exponents, widths);
        sizes[degree] += size;
        if (degree < order) continue;
        for (std::size_t i = 0; i < widths.size(); ++i) own[i] += size * exponents[i];
      }
    }
    const double error = extrapolated(sizes);
    if (!std::isfinite(error)) {
      throw Error(ErrorKind::numerical, "domains: the polynomials about a centre are not finite");
    }
    if (c > 0 && error <= result.error) continue;
    result.error = error;
    by_variable = own;
  }
  result.direction = static_cast<std::size_t>(
      std::max_element(by_variable.begin(), by_variable.end()) - by_variable.begin());
  return result;
}

void require(bool holds, const char* what) {
  if (!holds) throw Error(ErrorKind::usage, what);
}

}  // namespace

double truncation_in_box(const FlowMap<double>& map, std::span<const double> half_widths,
                         std::size_t components) {
  return assess(map, half_widths, components).error;
}

SplitMap split_domains(const std::function<FlowMap<double>(std::span<const double>)>& map_about,
                       std::span<const double> centre, std::span<const double> half_widths,
                       const SplitSettings& settings) {
  require(!centre.empty() && centre.size() == half_widths.size(),
          "domains: a half width for each coordinate of the centre is needed");
  require(std::all_of(half_widths.begin(), half_widths.end(),
                      [](double w) { return w > 0 && std::isfinite(w); }),
          "domains: half widths must be above 0");
  require(settings.tolerance > 0, "domains: the tolerance must be above 0");
  require(settings.most_domains > 0, "domains: at least one is needed");
  SplitMap result;
  std::vector<std::size_t> directions;
  const auto add = [&](std::vector<double> middle, std::vector<double> widths) {
    FlowMap<double> map = map_about(middle);
    ++result.maps_made;
    require(map.variables() == widths.size() && map.order() >= 2 &&
                settings.components <= map.components(),
            "domains: maps of order 2 or more, in as many variables as the box has, are needed");
    const Assessment found =
        assess(map, widths, settings.components == 0 ? map.components() : settings.components);
    result.domains.push_back({std::move(middle), std::move(widths), std::move(map), found.error});
    directions.push_back(found.direction);
  };
  add({centre.begin(), centre.end()}, {half_widths.begin(), half_widths.end()});
  while (true) {
    const auto worst =
        std::max_element(result.domains.begin(), result.domains.end(),
                         [](const auto& a, const auto& b) { return a.error < b.error; });
    if (worst->error <= settings.tolerance) return result;
    if (result.domains.size() == settings.most_domains) {
      result.is_right = false;
      return result;
    }
    const auto place = worst - result.domains.begin();
    const std::size_t direction = directions[static_cast<std::size_t>(place)];
    std::vector<double> widths = worst->half_widths;
    widths[direction] /= 2;
    std::vector<double> below = worst->centre;
    std::vector<double> above = worst->centre;
    below[direction] -= widths[direction];
    above[direction] += widths[direction];
    result.domains.erase(worst);
    directions.erase(directions.begin() + place);
    add(std::move(below), widths);
    add(std::move(above), widths);
  }
}

namespace {

/// The least box about some of the points.
PointDomain least_domain(std::span<const std::vector<double>> points,
                         std::vector<std::size_t> members) {
  PointDomain domain;
  std::vector<double> low = points[members.front()];
  std::vector<double> high = low;
  for (const std::size_t k : members) {
    for (std::size_t i = 0; i < low.size(); ++i) {
      low[i] = std::min(low[i], points[k][i]);
      high[i] = std::max(high[i], points[k][i]);
    }
  }
  for (std::size_t i = 0; i < low.size(); ++i) {
    domain.centre.push_back((low[i] + high[i]) / 2);
    domain.half_widths.push_back((high[i] - low[i]) / 2);
  }
  domain.points = std::move(members);
  return domain;
}

/// The points of a domain below and above the middle of their own box across a coordinate; nothing
/// where they cannot be told apart.
std::array<std::vector<std::size_t>, 2> halves(std::span<const std::vector<double>> points,
                                               const PointDomain& domain, std::size_t coordinate) {
  const double middle = least_domain(points, domain.points).centre[coordinate];
  std::array<std::vector<std::size_t>, 2> parts;
  for (const std::size_t k : domain.points) {
    parts[points[k][coordinate] < middle ? 0 : 1].push_back(k);
  }
  return parts;
}

/// A domain, its weights and whether it is to be split no further.
struct AssessedDomain {
  PointDomain domain;
  std::vector<double> weights;
  bool is_last = false;
};

}  // namespace

PointSplit split_points(const std::function<PointAssessment(const PointDomain&)>& assess,
                        std::span<const std::vector<double>> points, std::span<const double> centre,
                        const SplitSettings& settings) {
  require(!points.empty(), "domains: points are needed");
  require(std::all_of(points.begin(), points.end(),
                      [&](const auto& point) { return point.size() == centre.size(); }),
          "domains: a coordinate of each point for each of the centre is needed");
  require(settings.tolerance > 0, "domains: the tolerance must be above 0");
  require(settings.most_domains > 0, "domains: at least one is needed");
  PointSplit result;
  result.splits.resize(centre.size());
  std::vector<AssessedDomain> all;
  const auto add = [&](PointDomain domain) {
    const PointAssessment found = assess(domain);
    ++result.maps_made;
    domain.error = found.error;
    all.push_back({std::move(domain), found.weights});
  };
  std::vector<std::size_t> members(points.size());
  std::iota(members.begin(), members.end(), std::size_t{0});
  const PointDomain least = least_domain(points, std::move(members));
  PointDomain first = least;
  bool is_inside = true;  // the given centre in the least box
  for (std::size_t i = 0; i < centre.size(); ++i) {
    const double aside = std::abs(least.centre[i] - centre[i]);
    is_inside = is_inside && aside <= least.half_widths[i];
    first.half_widths[i] += aside;
    first.centre[i] = centre[i];
  }
  add(std::move(first));
  if (!is_inside && all.front().domain.error > settings.tolerance) {
    // Points that lie together to one side may need no more than a centre among them.
    all.clear();
    add(least);
  }
  const auto needs_less = [&](const AssessedDomain& one, const AssessedDomain& other) {
    const auto rank = [&](const AssessedDomain& d) { return d.is_last ? -1.0 : d.domain.error; };
    if (rank(one) != rank(other)) return rank(one) < rank(other);
    return one.domain.points.size() < other.domain.points.size();
  };
  while (true) {
    const auto worst = std::max_element(all.begin(), all.end(), needs_less);
    const bool is_done = worst->is_last || !(worst->domain.error > settings.tolerance);
    if (is_done || all.size() >= settings.most_domains) break;
    const auto largest = std::max_element(worst->weights.begin(), worst->weights.end());
    const auto coordinate = static_cast<std::size_t>(largest - worst->weights.begin());
    if (!(*largest > 0)) {
      worst->is_last = true;
      continue;
    }
    auto [below, above] = halves(points, worst->domain, coordinate);
    if (below.empty() || above.empty()) {
      // All points are at one value of it.
      *largest = 0;
      continue;
    }
    all.erase(worst);
    ++result.splits[coordinate];
    add(least_domain(points, std::move(below)));
    add(least_domain(points, std::move(above)));
  }
  for (AssessedDomain& one : all) {
    result.is_right = result.is_right && one.domain.error <= settings.tolerance;
    result.domains.push_back(std::move(one.domain));
  }
  return result;
}

double SplitMap::error() const {
  double largest = 0;
  for (const SplitDomain& domain : domains) largest = std::max(largest, domain.error);
  return largest;
}

const SplitDomain& SplitMap::domain_of(std::span<const double> point) const {
  const SplitDomain* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const SplitDomain& domain : domains) {
    if (point.size() != domain.centre.size()) {
      throw Error(ErrorKind::usage, "domains: as many numbers as variables are needed");
    }
    // The largest coordinate in units of the half widths: at most 1 inside.
    double distance = 0;
    for (std::size_t i = 0; i < point.size(); ++i) {
      distance = std::max(distance, std::abs(point[i] - domain.centre[i]) / domain.half_widths[i]);
    }
    if (nearest != nullptr && !(distance < least)) continue;
    least = distance;
    nearest = &domain;
  }
  if (nearest == nullptr) throw Error(ErrorKind::usage, "domains: there are none");
  return *nearest;
}

std::vector<double> SplitMap::evaluate(std::span<const double> point) const {
  const SplitDomain& domain = domain_of(point);
  std::vector<double> deviation(point.begin(), point.end());
  for (std::size_t i = 0; i < deviation.size(); ++i) deviation[i] -= domain.centre[i];
  std::vector<double> result = domain.map.evaluate(deviation);
  for (std::size_t c = 0; c < result.size(); ++c) result[c] += domain.map.jet()[c][0];
  return result;
}

}  // namespace hamjet
