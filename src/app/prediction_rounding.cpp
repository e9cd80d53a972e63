#include "prediction_rounding.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "../algebra/signed_fraction.hpp"

namespace hamjet::cli {

double rounding_of_predictions(const DeputyFlow& flow, const SixNumbers<double>& start) {
  constexpr std::size_t pairs = 16;
  constexpr double units = 256;  // in the last place, of the position and of the velocity
  const double part = units * std::numeric_limits<double>::epsilon();
  const double position = part * std::hypot(start[0], start[1], start[2]);
  const double velocity = part * std::hypot(start[3], start[4], start[5]);
  std::mt19937_64 generator(1);
  std::vector<SixNumbers<double>> deviations(2 * pairs);
  for (std::size_t k = 0; k < deviations.size(); k += 2) {
    for (std::size_t i = 0; i < 6; ++i) {
      deviations[k][i] = signed_fraction(generator) * (i < 3 ? position : velocity);
      deviations[k + 1][i] = -deviations[k][i];
    }
  }
  std::vector<DeputyPrediction> predictions(deviations.size());
  flow.predict(deviations, flow.order(), predictions);
  double squares = 0;
  for (std::size_t k = 0; k < predictions.size(); k += 2) {
    for (std::size_t i = 0; i < 3; ++i) {
      squares += std::pow(predictions[k].deviation[i] + predictions[k + 1].deviation[i], 2);
    }
  }
  // Where all predictions share a rounding b, and each has one of its own, s, the square of a
  // pair's sum is 4 b^2 + 2 s^2 on average: half of it is at least b^2 + s^2.
  const double rounding = std::sqrt(squares / (2 * pairs));
  return std::isfinite(rounding) ? rounding : std::numeric_limits<double>::infinity();
}

}  // namespace hamjet::cli
