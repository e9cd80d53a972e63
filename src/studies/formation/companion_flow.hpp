#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "hamjet/detail/studies/singular_times.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// The linear flow about the orbit from the chief's start of a spacecraft like the deputy: deputies
/// are expanded about it, and told relative to the chief. Where both are alike, in C_D A / m and
/// C_R A / m, it is the chief's orbit.
class CompanionFlow : public LinearFlow {
 public:
  /// `problem`, which must outlive this object, is that of the scene with_deputy_coefficients. If
  /// both are unlike, the chief takes a second flow. Throws as LinearFlow.
  CompanionFlow(const Scene& scene, const ComputedProblem& problem, double duration,
                double per_revolution, const std::function<void(double)>& progress = {});

  /// The chief's state at a canonical time.
  std::vector<double> chief(double time) const;
  /// The chief's state less that of the orbit; zeros where both are alike.
  std::vector<double> chief_deviation(double time) const;

 private:
  /// The problem of a chief unlike the deputy.
  std::unique_ptr<const ComputedProblem> chief_problem_;
  std::unique_ptr<const LinearFlow> chief_;  ///< likewise
};

/// Flights of a chief and of its deputy in one system, whose states end with the coefficients in
/// which both differ.
class FlownTogether {
 public:
  explicit FlownTogether(const Scene& scene);

  const Scene& scene() const noexcept { return scene_; }  ///< of with_deputy_parameters
  /// Made when it is first asked for: air and axes are fitted anew for every system.
  const SharedSystem& system() const;
  /// States (q, p) with the spacecraft's own coefficients.
  std::vector<double> of_chief(const std::vector<double>& state) const;
  std::vector<double> of_deputy(const std::vector<double>& state) const;

 private:
  Scene scene_;
  mutable SharedSystem system_;
  std::vector<double> chief_;  ///< coefficients
  std::vector<double> deputy_;
};

}  // namespace hamjet
