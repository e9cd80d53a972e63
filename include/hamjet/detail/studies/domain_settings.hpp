#pragma once

namespace hamjet {

/// How far the set that is asked about is split into domains, each with polynomials about a centre
/// of its own.
struct DomainSettings {
  double tolerance_m = 1;  ///< of every final position in the set
  int most_domains = 256;
};

}  // namespace hamjet
