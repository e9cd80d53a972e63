#include "hamjet/detail/algebra/monomial_values.hpp"

#include <cmath>
#include <limits>

#include "hamjet/error.hpp"

namespace hamjet {

MonomialValues::MonomialValues(SpacePointer space) : space_(std::move(space)) {
  const std::size_t variables = space_->variables();
  parent_.assign(space_->size(), 0);
  variable_.assign(space_->size(), 0);
  lowered_.assign(space_->size() * variables, 0);
  values_.assign(space_->size(), 1);
  std::vector<std::uint8_t> exponents;
  for (std::size_t k = 1; k < space_->size(); ++k) {
    const auto of = space_->exponents(k);
    exponents.assign(of.begin(), of.end());
    for (std::size_t v = 0; v < variables; ++v) {
      if (exponents[v] == 0) continue;
      --exponents[v];
      lowered_[k * variables + v] = space_->index(exponents);
      ++exponents[v];
      parent_[k] = lowered_[k * variables + v];
      variable_[k] = v;
    }
  }
}

void MonomialValues::set_point(std::span<const double> point) {
  if (point.size() != space_->variables()) {
    throw Error(ErrorKind::usage, "monomials: the point has not one number per variable");
  }
  for (std::size_t k = 1; k < values_.size(); ++k) {
    values_[k] = values_[parent_[k]] * point[variable_[k]];
  }
}

double MonomialValues::slice(const Series<double>& series, int degree) const {
  double sum = 0;
  for (std::size_t k = space_->first(degree); k < space_->first(degree + 1); ++k) {
    sum += series[k] * values_[k];
  }
  return sum;
}

double MonomialValues::value(const Series<double>& series, int degree) const {
  require_same_space(series.space(), *space_);
  double sum = 0;
  for (int d = degree; d >= 0; --d) sum += slice(series, d);
  return sum;
}

double MonomialValues::rounding(const Series<double>& series, int degree) const {
  require_same_space(series.space(), *space_);
  const std::size_t terms = space_->first(degree + 1);
  double sum = 0;
  for (std::size_t k = 0; k < terms; ++k) sum += std::abs(series[k] * values_[k]);
  const double unit = std::numeric_limits<double>::epsilon() / 2;
  return (static_cast<double>(terms) + degree) * unit * sum;
}

double MonomialValues::derivative(const Series<double>& series, std::size_t variable,
                                  int degree) const {
  require_same_space(series.space(), *space_);
  const std::size_t variables = space_->variables();
  double sum = 0;
  for (std::size_t k = space_->first(degree + 1); k-- > 1;) {
    const auto exponent = space_->exponents(k)[variable];
    if (exponent == 0) continue;
    sum += static_cast<double>(exponent) * series[k] * values_[lowered_[k * variables + variable]];
  }
  return sum;
}

}  // namespace hamjet
