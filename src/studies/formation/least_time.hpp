#pragma once

#include "../jets_along_time.hpp"
#include "hamjet/studies/transfer.hpp"
#include "transfer_points.hpp"

namespace hamjet {

/// Answers one transfer at any times of a span, from jets that continue from the span's first time.
/// All arguments of the constructor must outlive it.
class TransferSearch {
 public:
  TransferSearch(TransferPoints& points, const IntegratorSettings& integrator,
                 const RelativeTransfer& ends)
      : points_(points), ends_(ends), propagation_(points.jet_problem(), integrator) {}

  /// Sets the first time of a span; successive spans move away from 0.
  void begin_at(double time);
  /// The answer at a time of the span. It does not depend on the order of the calls.
  TransferPoint at(double time);

  std::size_t count() const { return count_; }  ///< number of times answered
  double propagation_seconds() const { return propagation_.statistics().wall_seconds + seconds_; }

 private:
  TransferPoints& points_;
  const RelativeTransfer& ends_;
  JetPropagation propagation_;  ///< the propagation, at the first time of the span
  std::size_t count_ = 0;
  double seconds_ = 0;  ///< time of the propagations within spans
};

/// Minimises the velocity change between the listed times: about each of the three lowest listed
/// minima a grid between its neighbours, then Brent's method about the least of the grid, until the
/// time is known to a millionth of the span. (R. Brent, Algorithms for Minimization without
/// Derivatives, 1973, chapter 5.) Sets `least_between` and what belongs to it.
void find_least_between(TransferResult& result, TransferPoints& points,
                        const IntegratorSettings& integrator, const RelativeTransfer& ends,
                        const ProgressCallback& progress);

}  // namespace hamjet
