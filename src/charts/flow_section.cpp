#include "hamjet/charts/flow_section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../algebra/instantiated_real.hpp"
#include "hamjet/algebra/elementary_functions.hpp"
#include "hamjet/error.hpp"
#include "series_energy.hpp"

namespace hamjet {
namespace {

template <class Real>
SixNumbers<Series<Real>> constant_series(const SpacePointer& space, const SixNumbers<Real>& z) {
  const auto constant = [&](std::size_t i) { return Series<Real>(space, z[i]); };
  return {constant(0), constant(1), constant(2), constant(3), constant(4), constant(5)};
}

}  // namespace

template <class Real>
FlowSection<Real>::FlowSection(const ZonalGravity& field, ChartName chart,
                               const SixNumbers<Real>& chief)
    : system_(zonal_gravity(field)),
      chart_(chart, chief, Real(field.mu)),
      origin_(chief),
      chief_(chart_.coordinates(chief)) {
  using std::sqrt;
  if (chart == ChartName::cartesian) {
    throw Error(ErrorKind::usage, "flow box: Cartesian coordinates have no angle along the orbit");
  }
  const Real r = sqrt(Real(chief[0] * chief[0] + chief[1] * chief[1] + chief[2] * chief[2]));
  energy_unit_ = Real(field.mu) / r;
  if (chart == ChartName::nodal) ignored_ = 1;
  for (const std::size_t i : {std::size_t{1}, std::size_t{2}, std::size_t{4}, std::size_t{5}}) {
    if (i != ignored_) places_.push_back(i);
  }
  // The rate of the angle is the derivative of the energy by the momentum of the angle.
  SixNumbers<Series<Real>> z = constant_series(SeriesSpace::create(1, 1), chief_);
  z[3][1] = Real(1);
  const Series<Real> energy = energy_series(*system_, chart_.state(z));
  energy_ = energy[0];
  rate_ = energy[1];
}

template <class Real>
Real FlowSection<Real>::energy_of(const Real& u0) const {
  using std::pow;
  if (!is_bound()) return energy_ + u0 * energy_unit_;
  return energy_ * pow(Real(Real(1) + u0), Real(Real(-2) / Real(3)));
}

template <class Real>
Real FlowSection<Real>::variable_of(const Real& energy) const {
  using std::expm1;
  using std::log1p;
  if (!is_bound()) return (energy - energy_) / energy_unit_;
  // (E / E_chief)^(-3/2) - 1, without loss of digits near 0.
  return expm1(Real(Real(-1.5) * log1p(Real((energy - energy_) / energy_))));
}

template <class Real>
Series<Real> FlowSection<Real>::energies(const SpacePointer& space) const {
  if (is_bound()) return energy_ * pow(periods(space), Real(Real(-2) / Real(3)));
  return Series<Real>::variable(space, 0) * energy_unit_ + energy_;
}

template <class Real>
Series<Real> FlowSection<Real>::periods(const SpacePointer& space) const {
  if (!is_bound()) return Series<Real>(space, Real(1));
  return Series<Real>::variable(space, 0, Real(1));
}

template <class Real>
SixNumbers<Series<Real>> FlowSection<Real>::states(const SpacePointer& space) const {
  SixNumbers<Series<Real>> z = constant_series(space, chief_);
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (space->order() >= 1) z[places_[k]][space->linear_index(k + 1)] = Real(1);
  }
  const Series<Real> wanted = energies(space);
  // Newton's method with the chief's derivative makes one more degree right in each iteration; the
  // last iteration removes rounding errors.
  for (int i = 0; i <= space->order(); ++i) {
    Series<Real> excess = energy_series(*system_, chart_.state(z)) - wanted;
    excess[0] = Real(0);
    z[3] -= excess / rate_;
  }
  return chart_.state(z);
}

template <class Real>
SixNumbers<Real> FlowSection<Real>::state(const Real& energy, SixNumbers<Real> z) const {
  using std::abs;
  using std::isfinite;
  using std::sqrt;
  z[0] = chief_[0];
  z[3] = chief_[3];
  if (is_bound() && chart_.is_of_elements() && energy < 0) z[3] *= sqrt(Real(energy_ / energy));
  const SpacePointer space = SeriesSpace::create(1, 1);
  // Newton's method doubles the number of right digits, beginning with an error of the order of J2.
  // A change below this limit that is no longer halved is rounding.
  const Real largest_rounding = sqrt(std::numeric_limits<Real>::epsilon());
  constexpr int most_iterations = 20;
  Real last_change = 0;
  for (int i = 0; i < most_iterations; ++i) {
    SixNumbers<Series<Real>> series = constant_series(space, z);
    series[3][1] = Real(1);
    const Series<Real> found = energy_series(*system_, chart_.state(series));
    const Real change = (found[0] - energy) / found[1];
    if (!isfinite(change) || !(abs(change) < abs(z[3]))) {
      throw Error(ErrorKind::numerical,
                  "section: no state of this energy and these coordinates lies near the chief's");
    }
    z[3] -= change;
    const bool is_rounding = i > 0 && abs(change) > Real(0.5) * abs(last_change) &&
                             abs(change) <= largest_rounding * abs(z[3]);
    if (is_rounding || abs(change) <= std::numeric_limits<Real>::epsilon() * abs(z[3])) {
      return chart_.state(z);
    }
    last_change = change;
  }
  throw Error(ErrorKind::numerical,
              "section: Newton's method finds no state of this energy and these coordinates");
}

template class FlowSection<InstantiatedReal>;

}  // namespace hamjet
