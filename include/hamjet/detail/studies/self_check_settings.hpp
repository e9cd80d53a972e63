#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace hamjet {

/// The checks that a run makes of its own result; see self_checks.
enum class SelfCheckName {
  finite,          ///< every number of the result is finite
  convergence,     ///< the equations of implicit methods were solved to round-off in every step
  step_error,      ///< the method's own estimate of its local error
  energy,          ///< the energy along the nominal
  symplecticity,   ///< for symplectic methods, Poisson brackets of the linear part
  inversion,       ///< inverted maps composed with the map are the identity
  surface,         ///< the nominal's smallest distance from the centre
  error_estimate,  ///< the error of every degree, by independent runs along a few directions
};

inline constexpr std::size_t self_check_count =
    static_cast<std::size_t>(SelfCheckName::error_estimate) + 1;

/// The checks' names in scenes and results, in the order of the enumeration.
const std::vector<std::string_view>& self_check_names();

inline std::string_view name_of(SelfCheckName name) {
  return self_check_names()[static_cast<std::size_t>(name)];
}

/// One key of the table `[checks]`.
struct SelfCheckSetting {
  bool is_on = true;
  std::optional<double> limit;  ///< limit that replaces the one that self_checks chooses
};

/// Table `[checks]`: all checks are on unless a scene turns them off.
class SelfCheckSettings {
 public:
  SelfCheckSetting& operator[](SelfCheckName name) {
    return settings_[static_cast<std::size_t>(name)];
  }
  const SelfCheckSetting& operator[](SelfCheckName name) const {
    return settings_[static_cast<std::size_t>(name)];
  }

 private:
  std::array<SelfCheckSetting, self_check_count> settings_;
};

}  // namespace hamjet
