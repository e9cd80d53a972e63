#pragma once

namespace hamjet {

/// Norms of what the degrees of a series contribute at one point, N being the highest. `state` is
/// the norm over position and momentum in units that make them alike, `position` that of the
/// position alone; neither contains degree 0.
struct DegreeShares {
  struct Norms {
    double state = 0;
    double position = 0;
  };
  Norms lower;         ///< of the sum over degrees 1..N-2
  Norms last_but_one;  ///< of degree N-1
  Norms last;          ///< of degree N
};

/// What the degrees that a series lacks would add.
struct TruncationEstimate {
  enum class Support {
    inside,   ///< the degrees decay: `miss` is the estimate
    outside,  ///< the degrees do not decay, and the series says nothing there
    unknown   ///< a number is not finite, or there is but one degree to judge by
  };
  Support support = Support::unknown;
  double miss = 0;  ///< of the position; infinite where it is not known
};

/// The rate at which the norms of a series' degrees decay per degree, N being the highest, from
/// those of degree N-1 and N and that of a leading degree N - `steps`:
///
///   q = max( d_N / d_(N-1),  (d_N / d_lead)^(1/steps),  (d_(N-1) / d_lead)^(1/(steps-1)) ) .
///
/// One degree that happens to be small does not decide: the first ratio is left out where d_(N-1)
/// is small, d_(N-1) <= d_N q even so, for with regular decay it is d_N / q; and where d_N is, the
/// last ratio holds. Of two degrees, `steps` = 1, the first ratio is all.
double decay_of_degrees(int steps, double leading, double last_but_one, double last);

/// Estimates the miss of a series truncated at degree N = `degree` from the decay of its degrees.
/// With d_k the state norms and p_k the position norms, q is decay_of_degrees with d_1 leading,
/// which is read from the sum of the lower degrees (for N = 2 it is d_(N-1)), and the degrees above
/// N, continued at that rate, add up to
///
///   miss = max(p_N q, p_(N-1) q^2) / (1 - q) .
///
/// The second term is for series of odd or even degrees alone, in which d_N vanishes. The support
/// is `outside` where q >= 1, and where the missing degrees would add as much as the lower ones.
///
/// This is an estimate, not a bound, and of the truncation alone: the integrator's error and
/// round-off are no part of it. `degree` is 1 or more.
TruncationEstimate estimate_truncation(int degree, const DegreeShares& shares);

}  // namespace hamjet
