#include "jet_evaluation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "flow_error.hpp"
#include "hamjet/algebra/composition.hpp"

namespace hamjet::cli {

JetEvaluation::JetEvaluation(const io::StoredJet& stored, std::optional<int> degree)
    : JetEvaluation(stored, without_constants(convert_map<double>(stored.jet)),
                    degree.value_or(stored.order())) {}

JetEvaluation::JetEvaluation(const io::StoredJet& stored, const std::vector<Series<double>>& map,
                             int degree)
    : evaluator_(map, degree),
      error_(io::evaluation_error(stored, map, degree), degree),
      positions_(static_cast<std::size_t>(std::lower_bound(stored.components.begin(),
                                                           stored.components.end(),
                                                           stored.degrees_of_freedom()) -
                                          stored.components.begin())),
      momentum_unit_(std::ldexp(1.0, stored.momentum_exponent())),
      length_m_(stored.units.length_km * 1000),
      chief_error_(stated_chief_error(stored)) {
  if (degree < stored.order()) whole_.emplace(map);
}

void JetEvaluation::add(const std::vector<double>& variables) {
  pending_.insert(pending_.end(), variables.begin(), variables.end());
}

DegreeShares JetEvaluation::shares(std::size_t point) const {
  const std::size_t count = pending();
  DegreeShares result;
  double squares[3] = {0, 0, 0};
  for (std::size_t c = 0; c < evaluator_.components(); ++c) {
    const std::size_t place = c * count + point;
    const double sum = whole_ ? whole_values_[place] : values_[place];
    const double lower = sum - last_[place] - last_but_one_[place];
    const double shares[3] = {lower, last_but_one_[place], last_[place]};
    const double unit = c < positions_ ? 1 : momentum_unit_;
    for (std::size_t i = 0; i < 3; ++i) squares[i] += shares[i] / unit * (shares[i] / unit);
    if (c + 1 == positions_) {
      result.lower.position = std::sqrt(squares[0]) * length_m_;
      result.last_but_one.position = std::sqrt(squares[1]) * length_m_;
      result.last.position = std::sqrt(squares[2]) * length_m_;
    }
  }
  result.lower.state = std::sqrt(squares[0]);
  result.last_but_one.state = std::sqrt(squares[1]);
  result.last.state = std::sqrt(squares[2]);
  return result;
}

MissEstimate JetEvaluation::estimate(std::size_t point) const {
  const int highest = whole_ ? whole_->degree() : evaluator_.degree();
  const TruncationEstimate truncation = estimate_truncation(highest, shares(point));
  double left_out = 0;
  double error = 0;
  const std::size_t count = pending();
  for (std::size_t c = 0; c < positions_; ++c) {
    const std::size_t place = c * count + point;
    if (whole_) {
      const double missing = whole_values_[place] - values_[place];
      left_out += missing * missing;
    }
    error += errors_[place] * errors_[place];
  }
  return {truncation.support, truncation.miss + std::sqrt(left_out) * length_m_,
          std::sqrt(error) * length_m_, 0};
}

void JetEvaluation::run(
    const std::function<void(const std::vector<double>&, const MissEstimate&)>& take) {
  const std::size_t count = pending();
  const std::size_t width = evaluator_.variables();
  variables_.resize(width * count);
  for (std::size_t j = 0; j < count; ++j) {
    for (std::size_t i = 0; i < width; ++i) {
      variables_[i * count + j] = pending_[j * width + i];
    }
  }
  for (auto* results : {&values_, &last_, &last_but_one_, &errors_}) {
    results->resize(evaluator_.components() * count);
  }
  const auto start = std::chrono::steady_clock::now();
  if (whole_) {
    evaluator_.evaluate(variables_, {values_, {}, {}});
  } else {
    evaluator_.evaluate(variables_, {values_, last_, last_but_one_});
  }
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  points_ += count;
  if (whole_) {
    whole_values_.resize(values_.size());
    whole_->evaluate(variables_, {whole_values_, last_, last_but_one_});
  }
  magnitudes_.resize(variables_.size());
  std::transform(variables_.begin(), variables_.end(), magnitudes_.begin(),
                 [](double x) { return std::abs(x); });
  error_.evaluate(magnitudes_, {errors_, {}, {}});
  std::vector<double> deviation(evaluator_.components());
  for (std::size_t j = 0; j < count; ++j) {
    for (std::size_t c = 0; c < deviation.size(); ++c) deviation[c] = values_[c * count + j];
    take(deviation, estimate(j));
  }
  pending_.clear();
}

}  // namespace hamjet::cli
