#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "contraction.hpp"
#include "stage_system.hpp"

namespace hamjet {

/// Fixed-point iteration for `Width` monomials above degree 0 of the stage equations, which are
/// linear,
///
///   Y = known + W Dg Y ,   known = base + W R ,
///
/// for steps that are not stiff and for too few monomials to be worth a factorisation. Several
/// monomials are iterated side by side, because within one of them each operation waits for the one
/// before. `Components` is the number of components, or 0 if it is known at run time only.
template <class Real, int Lanes, std::size_t Components, std::size_t Width>
class DegreeIteration {
 public:
  using P = Pack<Real, Lanes>;
  template <std::size_t Count>
  using Packs = std::conditional_t<Components == 0, std::vector<P>, std::array<P, Count>>;
  /// Component c of monomial t stands at c Width + t.
  using Numbers = Packs<Components * Width>;
  /// Dg_(c, k) at c Components + k.
  using Gradient = Packs<Components * Components>;

  explicit DegreeIteration(const StageSystem<Real, Lanes>& system) : system_(system) {
    if constexpr (Components == 0) {
      const std::size_t m = system.components();
      gradient.resize(m * m);
      for (auto* numbers : {&known, &stages, &slopes_, &moved_, &inverse_scale_}) {
        numbers->resize(m * Width);
      }
    }
  }

  Gradient gradient;  ///< to be set by the caller
  Numbers known;      ///< to be set by the caller
  Numbers stages;     ///< the solution

  /// Returns false if the iteration does not contract.
  bool solve() {
    stages = known;
    replace();
    set_scale();
    Contraction<Real> contraction;
    while (true) {
      // Judging takes as long as iterating, so that only every second iteration is judged. The
      // contraction that is seen is that of two iterations, so that the remainder may be larger
      // than reported by one change.
      replace();
      const auto outcome = contraction.judge(replace_and_compare());
      if (outcome == Contraction<Real>::goes_on) continue;
      return outcome != Contraction<Real>::fails && are_finite(stages);
    }
  }

 private:
  std::size_t components() const { return Components == 0 ? system_.components() : Components; }

  /// Sets moved_ = W Dg Y. The function is always inlined, so that the numbers stay in registers.
  [[gnu::always_inline]] void move() {
    const std::size_t m = components();
    for (std::size_t c = 0; c < m; ++c) {
      for (std::size_t t = 0; t < Width; ++t) {
        P slope = gradient[c * m] * stages[t];
        for (std::size_t k = 1; k < m; ++k) slope += gradient[c * m + k] * stages[k * Width + t];
        slopes_[c * Width + t] = slope;
      }
    }
    if constexpr (Components == 0) {
      for (std::size_t i = 0; i < slopes_.size(); ++i) moved_[i] = system_.couple(slopes_[i]);
    } else {
      system_.couple(slopes_, moved_);
    }
  }

  void replace() {
    move();
    for (std::size_t i = 0; i < stages.size(); ++i) stages[i] = known[i] + moved_[i];
  }

  /// Replaces the stages and returns the largest change.
  Real replace_and_compare() {
    move();
    P largest(Real(0));
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const P stage = known[i] + moved_[i];
      largest = larger_magnitude(largest, (stage - stages[i]) * inverse_scale_[i]);
      stages[i] = stage;
    }
    return largest_magnitude(largest);
  }

  /// Changes count relative to the largest stage of a component, or to the largest term of the sum
  /// that gives the stage.
  void set_scale() {
    for (std::size_t i = 0; i < stages.size(); ++i) {
      inverse_scale_[i] = inverse_scale(stages[i], known[i]);
    }
  }

  const StageSystem<Real, Lanes>& system_;
  Numbers slopes_;
  Numbers moved_;
  Numbers inverse_scale_;
};

}  // namespace hamjet
