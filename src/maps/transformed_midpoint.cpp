#include "transformed_midpoint.hpp"

#include <utility>

#include "../algebra/instantiated_real.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/midpoint.hpp"

namespace hamjet {

template <class Real>
TransformedMidpoint<Real>::TransformedMidpoint(DifferentiableHamiltonian<Real>& hamiltonian,
                                               CanonicalTransformationSequence<Real> transformation,
                                               const Vector<Real>& initial, const Real& tau)
    : transformation_(std::move(transformation)),
      tau_(tau),
      map_(transformation_(0)),
      hamiltonian_(hamiltonian, map_) {
  if (initial.size() != map_.dimension()) {
    throw Error(ErrorKind::usage,
                "transformed midpoint: the initial state has another number of variables");
  }
  state_ = map_(initial);
}

template <class Real>
void TransformedMidpoint<Real>::advance() {
  const Vector<Real> end = midpoint_step<Real>(hamiltonian_, state_, tau_);
  AffineSymplecticMap<Real> next = transformation_(step_ + 1);
  state_ = next.after(map_.inverse())(end);
  hamiltonian_.set_map(next);
  map_ = std::move(next);
  ++step_;
}

template class TransformedMidpoint<InstantiatedReal>;

}  // namespace hamjet
