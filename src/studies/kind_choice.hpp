#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace hamjet {

/// Chooses a kind along time: the best one, except that the last choice is kept as long as it is
/// not much worse. So the kind does not change back and forth where several are nearly equal.
class KindChoice {
 public:
  /// Index of the chosen kind, by a figure of merit of each kind for which smaller is better; no
  /// value if no figure is finite. Before the first choice, F1, the first kind, counts as the last
  /// choice.
  std::optional<std::size_t> choose(const std::vector<double>& figures) {
    const auto best =
        static_cast<std::size_t>(std::min_element(figures.begin(), figures.end(),
                                                  [](double a, double b) {
                                                    return std::isnan(b) ? !std::isnan(a) : a < b;
                                                  }) -
                                 figures.begin());
    if (!std::isfinite(figures[best])) return std::nullopt;
    if (!(figures[last_] <= hysteresis * figures[best])) last_ = best;
    return last_;
  }

 private:
  static constexpr double hysteresis = 1.5;

  std::size_t last_ = 0;
};

}  // namespace hamjet
