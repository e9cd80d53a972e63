#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace hamjet {

/// Chooses a kind along time: the best conditioned, but the last choice as long as it is not much
/// worse, so that the kind does not change to and fro where several are nearly alike.
class KindChoice {
 public:
  /// Index of the chosen kind from all kinds' condition numbers; none if every one is too large.
  std::optional<std::size_t> choose(const std::vector<double>& conditions, double largest) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < conditions.size(); ++k) {
      if (conditions[k] < conditions[best]) best = k;
    }
    if (!(conditions[best] < largest)) return std::nullopt;
    if (!last_ || conditions[*last_] > hysteresis * conditions[best]) last_ = best;
    return last_;
  }

 private:
  static constexpr double hysteresis = 3;

  std::optional<std::size_t> last_;
};

}  // namespace hamjet
