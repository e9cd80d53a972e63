#pragma once

namespace hamjet {

/// Norms of what each degree of a series contributes at one point, where N is the highest degree.
/// `state` is the norm over position and momentum in units that make both comparable, `position`
/// the norm of the position alone; neither contains degree 0.
struct DegreeShares {
  struct Norms {
    double state = 0;
    double position = 0;
  };
  Norms lower;         ///< norms of the sum over degrees 1..N-2
  Norms last_but_one;  ///< norms of degree N-1
  Norms last;          ///< norms of degree N
};

/// An estimate of what the missing degrees of a series would add.
struct TruncationEstimate {
  enum class Support {
    inside,   ///< the degrees decay: `miss` is the estimate
    outside,  ///< the degrees do not decay, so that nothing can be said of the missing ones
    unknown   ///< a number is not finite, or there is but one degree to judge by
  };
  Support support = Support::unknown;
  double miss = 0;  ///< estimate of the miss in position; infinite where it is not known
};

/// The factor by which the norms of a series' degrees decay from one degree to the next. With N the
/// highest degree, it is found from the norms of degrees N and N-1 and of a leading degree N -
/// `steps`:
///
///   q = max( d_N / d_(N-1),  (d_N / d_lead)^(1/steps),  (d_(N-1) / d_lead)^(1/(steps-1)) ) .
///
/// A single degree that happens to be small does not decide. The first ratio is left out where
/// d_(N-1) is small, that is where d_(N-1) <= d_N q for the q of the other ratios, although regular
/// decay would make it d_N / q. Where d_N is small, the last ratio decides. With two degrees,
/// `steps` = 1, there is only the first ratio.
double decay_of_degrees(int steps, double leading, double last_but_one, double last);

/// Estimates the miss of a series truncated at degree N = `degree` from the decay of its degrees.
/// With d_k the state norms and p_k the position norms, q is decay_of_degrees with the leading
/// degree 1, whose norm is taken from the sum of the lower degrees (for N = 2 it is d_(N-1)). The
/// degrees above N, continued at that rate, add up to
///
///   miss = max(p_N q, p_(N-1) q^2) / (1 - q) .
///
/// The second term is for series of odd or even degrees alone, in which d_N vanishes. The estimate
/// is `outside` where q >= 1, and where the missing degrees would add as much as the lower ones.
///
/// This is an estimate, not a bound. It covers the truncation alone, not the integrator's error or
/// round-off. `degree` is 1 or more.
TruncationEstimate estimate_truncation(int degree, const DegreeShares& shares);

}  // namespace hamjet
