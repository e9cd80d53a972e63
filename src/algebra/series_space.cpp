#include "hamjet/algebra/series_space.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// Beyond this a single series takes half a gigabyte, and the space itself several.
constexpr double most_monomials = 5e7;

/// C(n, k) for small arguments.
std::size_t binomial(std::size_t n, std::size_t k) {
  std::size_t result = 1;
  for (std::size_t i = 1; i <= k; ++i) result = result * (n - k + i) / i;
  return result;
}

/// All exponent vectors of a degree in lexicographic order, the first exponent falling first.
std::vector<std::vector<std::uint8_t>> monomials_of_degree(std::size_t variables, int degree) {
  std::vector<std::vector<std::uint8_t>> result;
  std::vector<std::uint8_t> exponents(variables, 0);
  const auto fill = [&](auto&& self, std::size_t variable, int left) -> void {
    if (variable + 1 == variables) {
      exponents[variable] = static_cast<std::uint8_t>(left);
      result.push_back(exponents);
      return;
    }
    for (int e = left; e >= 0; --e) {
      exponents[variable] = static_cast<std::uint8_t>(e);
      self(self, variable + 1, left - e);
    }
  };
  if (variables == 0) {
    if (degree == 0) result.emplace_back();
  } else {
    fill(fill, 0, degree);
  }
  return result;
}

/// Builds the schedule of one degree of a space whose monomials are already listed.
class ScheduleBuilder {
 public:
  explicit ScheduleBuilder(const SeriesSpace& space)
      : space_(space), blocked_(space.variables() >= 3 ? 3 : 0) {}

  ProductSchedule build(int degree) const {
    ProductSchedule schedule;
    const std::size_t outer = space_.variables() - blocked_;
    const int lowest = blocked_ > 0 ? 0 : degree;
    for (int outer_degree = lowest; outer_degree <= degree; ++outer_degree) {
      for (const auto& exponents : monomials_of_degree(outer, outer_degree)) {
        add_output(schedule, exponents, degree, degree - outer_degree);
      }
    }
    return schedule;
  }

 private:
  std::size_t size_of_block(int m) const {
    return blocked_ > 0 ? block_size(static_cast<std::size_t>(m)) : 1;
  }

  /// Offset of the block with these outer exponents and inner degree m: its first monomial.
  std::uint32_t offset(std::vector<std::uint8_t> outer, int m) const {
    if (blocked_ > 0) {
      outer.push_back(static_cast<std::uint8_t>(m));
      outer.resize(space_.variables(), 0);
    }
    return static_cast<std::uint32_t>(space_.index(outer));
  }

  void add_output(ProductSchedule& schedule, const std::vector<std::uint8_t>& exponents, int degree,
                  int m) const {
    ProductSchedule::Output output{};
    output.offset = offset(exponents, m);
    output.block_degree = static_cast<std::uint32_t>(m);
    output.first_pair = static_cast<std::uint32_t>(schedule.pairs.size());
    output.first_run = static_cast<std::uint32_t>(schedule.run_ends.size());
    output.diagonal = ProductSchedule::no_diagonal;
    schedule.outputs.push_back(output);
    for (int m_x = 0; 2 * m_x <= m; ++m_x) {
      add_run(schedule, exponents, degree, m_x, m - m_x);
      schedule.run_ends.push_back(static_cast<std::uint32_t>(schedule.pairs.size()));
    }
  }

  /// Adds all splits of the outer exponents into two factors, for fixed inner degrees m_x <= m_y.
  void add_run(ProductSchedule& schedule, const std::vector<std::uint8_t>& exponents, int degree,
               int m_x, int m_y) const {
    std::vector<std::uint8_t> part(exponents.size(), 0);
    const std::size_t cost = size_of_block(m_x) * size_of_block(m_y);
    while (true) {
      const int degree_x = std::accumulate(part.begin(), part.end(), m_x);
      if (degree_x >= 1 && degree_x <= degree - 1) {
        std::vector<std::uint8_t> rest(exponents);
        for (std::size_t i = 0; i < rest.size(); ++i) {
          rest[i] = static_cast<std::uint8_t>(rest[i] - part[i]);
        }
        const std::uint32_t x = offset(part, m_x);
        const std::uint32_t y = offset(rest, m_y);
        if (x == y) {
          schedule.outputs.back().diagonal = x;
          schedule.multiply_adds += cost;
          schedule.square_multiply_adds += cost;
        } else if (m_x < m_y || x < y) {
          schedule.pairs.push_back({x, y});
          schedule.multiply_adds += 2 * cost;
          schedule.square_multiply_adds += cost;
        }
      }
      std::size_t i = 0;
      while (i < part.size() && part[i] == exponents[i]) part[i++] = 0;
      if (i == part.size()) return;
      ++part[i];
    }
  }

  const SeriesSpace& space_;
  std::size_t blocked_;
};

}  // namespace

double SeriesSpace::monomial_count(std::size_t variables, int order) {
  double result = 1;
  for (std::size_t i = 1; i <= variables; ++i) {
    result *= static_cast<double>(static_cast<std::size_t>(order) + i) / static_cast<double>(i);
  }
  return result;
}

std::shared_ptr<const SeriesSpace> SeriesSpace::create(std::size_t variables, int order) {
  if (variables < 1 || variables > 64 || order < 0 || order > 60) {
    throw Error(ErrorKind::usage,
                fmt::format("series space: {} variables and order {}, allowed are 1..64 variables "
                            "and order 0..60",
                            variables, order));
  }
  if (monomial_count(variables, order) > most_monomials) {
    throw Error(ErrorKind::too_large,
                fmt::format("series space: order {} in {} variables has {:.3g} coefficients", order,
                            variables, monomial_count(variables, order)));
  }
  return std::shared_ptr<const SeriesSpace>(new SeriesSpace(variables, order));
}

SeriesSpace::SeriesSpace(std::size_t variables, int order) : variables_(variables), order_(order) {
  offsets_.push_back(0);
  for (int d = 0; d <= order; ++d) {
    for (const auto& exponents : monomials_of_degree(variables, d)) {
      exponents_.insert(exponents_.end(), exponents.begin(), exponents.end());
      degrees_.push_back(static_cast<std::uint8_t>(d));
    }
    offsets_.push_back(degrees_.size());
  }
  const ScheduleBuilder builder(*this);
  for (int d = 0; d <= order; ++d) schedules_.push_back(builder.build(d));
}

std::size_t SeriesSpace::index(std::span<const std::uint8_t> exponents) const {
  const int degree = std::accumulate(exponents.begin(), exponents.end(), 0);
  if (exponents.size() != variables_ || degree > order_) {
    throw Error(ErrorKind::usage,
                fmt::format("series space: no monomial with {} exponents of sum {} among {} "
                            "variables of order {}",
                            exponents.size(), degree, variables_, order_));
  }
  // Monomials before this one in its degree: those that agree up to variable i - 1 and have a
  // larger exponent there; with `after` variables behind, C(left - 1 + after, after) of them.
  std::size_t rank = first(degree);
  auto left = static_cast<std::size_t>(degree);
  for (std::size_t i = 0; i + 1 < variables_; ++i) {
    const std::size_t after = variables_ - i - 1;
    left -= exponents[i];
    if (left > 0) rank += binomial(left - 1 + after, after);
  }
  return rank;
}

std::size_t SeriesSpace::product_cost() const {
  std::size_t cost = 1;
  for (int d = 1; d <= order_; ++d) cost += products(d).multiply_adds + 2 * count(d);
  return cost;
}

void require_same_space(const SeriesSpace& a, const SeriesSpace& b) {
  if (!(a == b)) {
    throw Error(
        ErrorKind::usage,
        fmt::format("series of different spaces are combined: {} variables of order {} with "
                    "{} variables of order {}",
                    a.variables(), a.order(), b.variables(), b.order()));
  }
}

}  // namespace hamjet
