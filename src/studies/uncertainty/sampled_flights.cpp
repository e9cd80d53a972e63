#include "sampled_flights.hpp"

#include <algorithm>

namespace hamjet {

SampledFlights::SampledFlights(const SharedSystem& system, const Scene& scene)
    : flow_(system), start_time_(scene.start_time), size_(scene.nominal.size()) {}

SampledFlights::SampledFlights(const SharedSystem& system, const Scene& scene,
                               const InitialState& start, int samples, StandardNormals& normals,
                               Matrix<double>& common)
    : SampledFlights(system, scene) {
  const Matrix<double>& factor = start.covariance.factor();
  const bool draws_common = common.cols() == 0;
  if (draws_common) common = Matrix<double>::Zero(start.common, samples);
  states_.reserve(size_ * static_cast<std::size_t>(samples));
  Vector<double> numbers(factor.cols());
  for (Eigen::Index k = 0; k < samples; ++k) {
    for (Eigen::Index i = 0; i < numbers.size(); ++i) {
      if (i < start.common && !draws_common) {
        numbers[i] = common(i, k);
      } else {
        numbers[i] = normals();
        if (i < start.common) common(i, k) = numbers[i];
      }
    }
    const Vector<double> deviation = start.deviation(factor * numbers);
    for (std::size_t i = 0; i < size_; ++i) {
      states_.push_back(scene.nominal[i] + deviation[static_cast<Eigen::Index>(i)]);
    }
  }
}

SampledFlights SampledFlights::of_nominal(const SharedSystem& system, const Scene& scene) {
  SampledFlights one(system, scene);
  one.states_.assign(scene.nominal.begin(), scene.nominal.end());
  return one;
}

void SampledFlights::advance_to(double time, const ProgressCallback& progress) {
  constexpr std::size_t at_once = 4096;  // between two reports of progress
  const std::vector<double> times(at_once, time - time_);
  const std::size_t all = states_.size() / size_;
  for (std::size_t k = 0; k < all; k += at_once) {
    if (progress) progress("flights", static_cast<double>(k) / static_cast<double>(all));
    const std::size_t count = std::min(at_once, all - k);
    flow_.advance(std::span(states_).subspan(size_ * k, size_ * count), start_time_ + time_,
                  std::span(times).first(count));
  }
  time_ = time;
}

Matrix<double> SampledFlights::deviations(const Vector<double>& chief) const {
  const auto rows = static_cast<Eigen::Index>(size_);
  const Eigen::Map<const Matrix<double>> states(states_.data(), rows,
                                                static_cast<Eigen::Index>(states_.size()) / rows);
  return states.topRows(6).colwise() - chief;
}

Vector<double> SampledFlights::first() const {
  return Eigen::Map<const Vector<double>>(states_.data(), 6);
}

}  // namespace hamjet
