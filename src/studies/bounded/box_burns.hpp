#pragma once

#include <optional>

#include "../formation/burns/burn_flight.hpp"
#include "box_company.hpp"
#include "box_control.hpp"

namespace hamjet {

/// The burns of a scene's thruster in place of the impulses of returns into a box, one return after
/// the other: the mass falls from each to the next. All arguments of the constructor must outlive
/// it.
class BoxBurns {
 public:
  /// `problem` has the system of the flights, which `flow` integrates; `revolution` is the chief's
  /// nodal period, canonical.
  BoxBurns(const Scene& scene, const ComputedProblem& problem, TaylorFlow& flow, double revolution);

  /// The burns of one return, or why there are none. `company` is at its first impulse.
  BurnedReturn replace(const BoxReturn& told, Company company);

 private:
  BurnedReturn burns_of(const Scene& scene, const ComputedProblem& problem, const BoxReturn& told,
                        Company& company);
  double allowed_miss_m(double revolution) const;

  const Scene& scene_;
  const ComputedProblem& problem_;
  TaylorFlow& flow_;
  SharedSystem burning_;
  ThrusterSettings thruster_;       ///< with the mass that is left
  std::optional<double> last_end_;  ///< the end of the last burn
  double allowed_miss_m_;
  bool is_least_known_ = false;  ///< the least acceleration was looked for
};

}  // namespace hamjet
