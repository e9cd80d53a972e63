#include "hamjet/algebra/series_space.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// With more monomials a single series takes half a gigabyte, and the space itself several.
constexpr double most_monomials = 5e7;

std::string text(const SeriesSpace& space) {
  const bool is_lines = space.is_uncoupled() && space.variables() > 1;
  return fmt::format("{}{} variables of order {}", space.variables(), is_lines ? " uncoupled" : "",
                     space.order());
}

}  // namespace

/// Builds the schedule of one degree of a space whose monomials are already listed.
class SeriesSpace::ScheduleBuilder {
 public:
  /// Slices below the lowest degrees of the factors are left out, in a directed schedule unless the
  /// factors are one series.
  explicit ScheduleBuilder(const SeriesSpace& space, int lowest_a = 1, int lowest_b = 1,
                           bool is_directed = false)
      : space_(space),
        lowest_a_(lowest_a),
        lowest_b_(lowest_b),
        is_directed_(is_directed),
        blocked_(space.variables() >= 3 ? 3 : 0),
        outer_(space.variables() - blocked_),
        exponents_(outer_),
        part_(outer_),
        rest_(outer_) {}

  ProductSchedule build(int degree) {
    if (space_.is_uncoupled())
      return build_uncoupled(degree);  // see form_uncoupled for lowest degrees
    ProductSchedule schedule;
    const int lowest = blocked_ > 0 ? 0 : degree;
    for (int outer_degree = lowest; outer_degree <= degree; ++outer_degree) {
      add_outputs(schedule, degree, degree - outer_degree, 0, outer_degree);
    }
    return schedule;
  }

 private:
  /// In uncoupled variables only powers of the same variable are multiplied.
  ProductSchedule build_uncoupled(int degree) {
    ProductSchedule schedule;
    const auto power = [&](int d, std::size_t variable) {
      return static_cast<std::uint32_t>(space_.first(d) + variable);
    };
    for (std::size_t v = 0; v < space_.count(degree); ++v) {
      const auto first_pair = static_cast<std::uint32_t>(schedule.pairs.size());
      const auto first_run = static_cast<std::uint32_t>(schedule.run_ends.size());
      for (int i = 1; 2 * i < degree; ++i) {
        schedule.pairs.push_back({power(i, v), power(degree - i, v)});
      }
      const bool has_diagonal = degree >= 2 && degree % 2 == 0;
      const std::uint32_t diagonal =
          has_diagonal ? power(degree / 2, v) : ProductSchedule::no_diagonal;
      schedule.outputs.push_back({power(degree, v), 0, first_pair, first_run, diagonal});
      schedule.run_ends.push_back(static_cast<std::uint32_t>(schedule.pairs.size()));
      if (degree >= 1) schedule.multiply_adds += static_cast<std::size_t>(degree - 1);
      schedule.square_multiply_adds += static_cast<std::size_t>(degree / 2);
    }
    return schedule;
  }

  std::size_t size_of_block(int m) const {
    return blocked_ > 0 ? block_size(static_cast<std::size_t>(m)) : 1;
  }

  /// Adds the blocks of inner degree m, for all exponents of the outer variables from `variable` on
  /// that add up to `left`, in order of falling exponent of the first of them.
  void add_outputs(ProductSchedule& schedule, int degree, int m, std::size_t variable, int left) {
    if (variable == outer_) {
      if (left == 0)
        add_output(schedule, degree,
                   m);  // without outer variables, all degrees belong to the inner ones
      return;
    }
    const int least = variable + 1 == outer_ ? left : 0;
    for (int e = left; e >= least; --e) {
      exponents_[variable] = e;
      add_outputs(schedule, degree, m, variable + 1, left - e);
    }
  }

  /// Offset of the block with these outer exponents, where `degree` counts the inner exponents too.
  /// It is the index of the block's first monomial, in which the first inner variable has all of
  /// the inner degree.
  std::uint32_t offset(const std::vector<int>& outer, int degree) const {
    std::size_t rank = space_.first(degree);
    int left = degree;
    for (std::size_t i = 0; i < outer.size(); ++i) {
      left -= outer[i];
      rank += space_.before(i, left);
    }
    return static_cast<std::uint32_t>(rank);
  }

  void add_output(ProductSchedule& schedule, int degree, int m) {
    ProductSchedule::Output output{};
    output.offset = offset(exponents_, degree);
    output.block_degree = static_cast<std::uint32_t>(m);
    output.first_pair = static_cast<std::uint32_t>(schedule.pairs.size());
    output.first_run = static_cast<std::uint32_t>(schedule.run_ends.size());
    output.diagonal = ProductSchedule::no_diagonal;
    schedule.outputs.push_back(output);
    for (int m_x = 0; 2 * m_x <= m; ++m_x) {
      add_run(schedule, degree, m_x, m - m_x);
      for (auto* pairs : {&forwards_, &backwards_}) {
        if (!is_directed_) continue;
        schedule.pairs.insert(schedule.pairs.end(), pairs->begin(), pairs->end());
        pairs->clear();
        if (pairs == &forwards_) {
          schedule.run_ends.push_back(static_cast<std::uint32_t>(schedule.pairs.size()));
        }
      }
      schedule.run_ends.push_back(static_cast<std::uint32_t>(schedule.pairs.size()));
    }
  }

  static void add_directed(std::vector<ProductSchedule::Pair>& pairs, ProductSchedule& schedule,
                           std::uint32_t x, std::uint32_t y, std::size_t cost) {
    pairs.push_back({x, y});
    schedule.multiply_adds += cost;
  }

  /// Adds all splits of the outer exponents into two factors, for fixed inner degrees m_x <= m_y.
  void add_run(ProductSchedule& schedule, int degree, int m_x, int m_y) {
    std::fill(part_.begin(), part_.end(), 0);
    const std::size_t cost = size_of_block(m_x) * size_of_block(m_y);
    while (true) {
      const int degree_x = std::accumulate(part_.begin(), part_.end(), m_x);
      if (degree_x >= 1 && degree_x <= degree - 1) {
        for (std::size_t i = 0; i < outer_; ++i) rest_[i] = exponents_[i] - part_[i];
        const std::uint32_t x = offset(part_, degree_x);
        const std::uint32_t y = offset(rest_, degree - degree_x);
        const int degree_y = degree - degree_x;
        if (is_directed_) {
          if (degree_x >= lowest_a_ && degree_y >= lowest_b_)
            add_directed(forwards_, schedule, x, y, cost);
          if (m_x < m_y && degree_x >= lowest_b_ && degree_y >= lowest_a_) {
            add_directed(backwards_, schedule, x, y, cost);
          }
        } else if (degree_x < lowest_a_ || degree_y < lowest_a_) {
          // The series has no such slices.
        } else if (x == y) {
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
      while (i < outer_ && part_[i] == exponents_[i]) part_[i++] = 0;
      if (i == outer_) return;
      ++part_[i];
    }
  }

  const SeriesSpace& space_;
  int lowest_a_;
  int lowest_b_;
  bool is_directed_;
  std::vector<ProductSchedule::Pair> forwards_;
  std::vector<ProductSchedule::Pair> backwards_;
  std::size_t blocked_;
  std::size_t outer_;
  /// Exponents of the outer variables in the block that is being added.
  std::vector<int> exponents_;
  std::vector<int> part_;
  std::vector<int> rest_;
};

const ProductSchedule& SeriesSpace::products_above(int degree, int lowest_a, int lowest_b,
                                                   bool is_square) const {
  const std::lock_guard lock(has_products_above_);
  const std::array<int, 4> key = {degree, lowest_a, lowest_b, is_square ? 1 : 0};
  auto place = products_above_.find(key);
  if (place == products_above_.end()) {
    ScheduleBuilder builder(*this, lowest_a, lowest_b, !is_square);
    place = products_above_.emplace(key, builder.build(degree)).first;
  }
  return place->second;
}

double SeriesSpace::monomial_count(std::size_t variables, int order) {
  double result = 1;
  for (std::size_t i = 1; i <= variables; ++i) {
    result *= static_cast<double>(static_cast<std::size_t>(order) + i) / static_cast<double>(i);
  }
  return result;
}

std::shared_ptr<const SeriesSpace> SeriesSpace::create(std::size_t variables, int order) {
  return make(variables, order, variables == 1);
}

std::shared_ptr<const SeriesSpace> SeriesSpace::create_uncoupled(std::size_t variables, int order) {
  return make(variables, order, true);
}

std::shared_ptr<const SeriesSpace> SeriesSpace::make(std::size_t variables, int order,
                                                     bool is_uncoupled) {
  if (variables < 1 || variables > 64 || order < 0 || order > 60) {
    throw Error(ErrorKind::usage,
                fmt::format("series space: {} variables and order {}, allowed are 1..64 variables "
                            "and order 0..60",
                            variables, order));
  }
  if (!is_uncoupled && monomial_count(variables, order) > most_monomials) {
    throw Error(ErrorKind::too_large,
                fmt::format("series space: order {} in {} variables has {:.3g} coefficients", order,
                            variables, monomial_count(variables, order)));
  }
  return std::shared_ptr<const SeriesSpace>(new SeriesSpace(variables, order, is_uncoupled));
}

SeriesSpace::SeriesSpace(std::size_t variables, int order, bool is_uncoupled)
    : variables_(variables), order_(order), is_uncoupled_(is_uncoupled) {
  set_before();
  offsets_.push_back(0);
  for (int d = 0; d <= order; ++d) {
    list_monomials(d);
    offsets_.push_back(degrees_.size());
  }
  ScheduleBuilder builder(*this);
  for (int d = 0; d <= order; ++d) schedules_.push_back(builder.build(d));
}

void SeriesSpace::set_before() {
  // The binomials C(left - 1 + after, after), from C(m, 0) = 1 and C(m + 1, k) = C(m, k) + C(m, k -
  // 1).
  const std::size_t row = static_cast<std::size_t>(order_) + 1;
  before_.assign(variables_ * row, 0);
  for (std::size_t i = variables_; i-- > 0;) {
    for (std::size_t left = 1; left < row; ++left) {
      const bool is_alone = is_uncoupled_ || i + 1 == variables_;
      before_[i * row + left] =
          is_alone ? 1 : before_[(i + 1) * row + left] + before_[i * row + left - 1];
    }
  }
}

/// Lists the monomials of a degree. With coupled variables, the next monomial is found so: the last
/// exponent that is not zero, the last variable's aside, falls by one; this one and the whole
/// exponent of the last variable go to the variable after it.
void SeriesSpace::list_monomials(int degree) {
  if (is_uncoupled_ && degree > 0) {
    for (std::size_t v = 0; v < variables_; ++v) {
      exponents_.resize(exponents_.size() + variables_, 0);
      exponents_[exponents_.size() - variables_ + v] = static_cast<std::uint8_t>(degree);
      degrees_.push_back(static_cast<std::uint8_t>(degree));
    }
    return;
  }
  std::vector<std::uint8_t> exponents(variables_, 0);
  exponents[0] = static_cast<std::uint8_t>(degree);
  while (true) {
    exponents_.insert(exponents_.end(), exponents.begin(), exponents.end());
    degrees_.push_back(static_cast<std::uint8_t>(degree));
    std::size_t i = variables_ - 1;
    while (i > 0 && exponents[i - 1] == 0) --i;
    if (i == 0) return;
    const std::uint8_t last = exponents.back();
    exponents.back() = 0;
    --exponents[i - 1];
    exponents[i] = static_cast<std::uint8_t>(last + 1);
  }
}

std::size_t SeriesSpace::index(std::span<const std::uint8_t> exponents) const {
  const int degree = std::accumulate(exponents.begin(), exponents.end(), 0);
  if (exponents.size() != variables_ || degree > order_) {
    throw Error(ErrorKind::usage,
                fmt::format("series space: no monomial with {} exponents of sum {} among {} "
                            "variables of order {}",
                            exponents.size(), degree, variables_, order_));
  }
  if (is_uncoupled_ && *std::max_element(exponents.begin(), exponents.end()) != degree) {
    throw Error(ErrorKind::usage, "series space: products of uncoupled variables vanish");
  }
  std::size_t rank = first(degree);
  int left = degree;
  for (std::size_t i = 0; i < variables_; ++i) {
    left -= exponents[i];
    rank += before(i, left);
  }
  return rank;
}

std::span<const std::uint32_t> SeriesSpace::raised(std::size_t variable) const {
  if (is_uncoupled_ && variables_ > 1) {
    throw Error(ErrorKind::usage,
                "series space: uncoupled variables have products that vanish, and no derivatives");
  }
  const std::size_t count = first(order_);
  std::call_once(is_raised_, [&] {
    raised_.resize(variables_ * count);
    for (std::size_t k = 0; k < count; ++k) {
      // Of the counts of monomials before this one, only those of variables before x_i grow with
      // its exponent.
      const int raised_degree = degree(k) + 1;
      std::size_t rank = first(raised_degree);
      int left = degree(k);
      std::size_t behind = 0;
      for (std::size_t i = 0; i < variables_; ++i) {
        left -= exponents(k)[i];
        behind += before(i, left);
      }
      left = degree(k);
      for (std::size_t i = 0; i < variables_; ++i) {
        raised_[i * count + k] = static_cast<std::uint32_t>(rank + behind);
        left -= exponents(k)[i];
        behind -= before(i, left);
        rank += before(i, left + 1);
      }
    }
  });
  return {raised_.data() + variable * count, count};
}

const std::shared_ptr<const SeriesSpace>& SeriesSpace::next_order() const {
  std::call_once(has_next_order_,
                 [&] { next_order_ = make(variables_, order_ + 1, is_uncoupled_); });
  return next_order_;
}

std::size_t SeriesSpace::product_cost() const {
  std::size_t cost = 1;
  for (int d = 1; d <= order_; ++d) cost += products(d).multiply_adds + 2 * count(d);
  return cost;
}

void require_same_space(const SeriesSpace& a, const SeriesSpace& b) {
  if (!(a == b)) {
    throw Error(ErrorKind::usage, fmt::format("series of different spaces are combined: {} with {}",
                                              text(a), text(b)));
  }
}

}  // namespace hamjet
