#include "nodal_flight.hpp"

#include <fmt/format.h>

#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <limits>

#include "../algebra/instantiated_real.hpp"
#include "../charts/steady_turn.hpp"
#include "hamjet/error.hpp"

namespace hamjet {

template <class Real>
NodalFlight<Real> nodal_flight(const FlowBoxMap<Real>& map) {
  if (map.end->chart().name() != ChartName::nodal) {
    throw Error(ErrorKind::usage, "nodal flight: the map must be one between nodal sections");
  }
  // The end's places are q, H, p, and the node's advance stands behind them.
  const SteadyMotion<Series<Real>> steady = map.steady();
  NodalFlight<Real> flight{map.time + steady.time, map.coordinates[0], map.coordinates[2],
                           map.coordinates[3] + steady.node};
  turn_pair<Real>(flight.q, flight.p, steady.pericentre);
  return flight;
}

template <class Real>
Real kepler_period(const Real& energy, const Real& mu) {
  using std::pow;
  return Real(2) * boost::math::constants::pi<Real>() * mu *
         pow(Real(Real(-2) * energy), Real(-1.5));
}

template <class Real>
ReturnMap<Real> return_near(const ZonalGravity& field, const SixNumbers<Real>& chief,
                            const Real& near, int order, const GaussSettings& gauss) {
  using std::abs;
  using std::sqrt;
  FlowBoxPropagation<Real> propagation(field, ChartName::nodal, chief, order, gauss);
  constexpr int most_iterations = 10;
  Real time = near;
  Real left = 0;
  for (int i = 0; i <= most_iterations; ++i) {
    FlowBoxMap<Real> map = propagation.advance_to(time);
    const Real rate = map.end->rate();
    left = within_half_a_turn<Real>(map.start->chief()[0] - map.end->chief()[0]);
    // An ulp of the time turns the chief by as much times its rate.
    const Real rounding =
        Real(100) * std::numeric_limits<Real>::epsilon() * (Real(1) + Real(abs(Real(time * rate))));
    // What the flight itself rounds may be more, and is as good as at rest below this.
    const Real at_rest = sqrt(std::numeric_limits<Real>::epsilon());
    if (abs(left) <= rounding || (i == most_iterations && abs(left) <= at_rest)) {
      NodalFlight<Real> flight = nodal_flight(map);
      return {std::move(map), std::move(flight)};
    }
    time += left / rate;
  }
  throw Error(ErrorKind::numerical,
              fmt::format("return map: after {} steps of Newton's method the chief is still {:.2g} "
                          "radians from its section",
                          most_iterations, static_cast<double>(left)));
}

template <class Real>
ReturnMap<Real> first_return(const ZonalGravity& field, const SixNumbers<Real>& chief, int order,
                             const GaussSettings& gauss) {
  const FlowSection<Real> section(field, ChartName::nodal, chief);
  return return_near<Real>(field, chief, kepler_period<Real>(section.energy(), Real(field.mu)),
                           order, gauss);
}

template NodalFlight<InstantiatedReal> nodal_flight(const FlowBoxMap<InstantiatedReal>&);
template ReturnMap<InstantiatedReal> return_near(const ZonalGravity&,
                                                 const SixNumbers<InstantiatedReal>&,
                                                 const InstantiatedReal&, int,
                                                 const GaussSettings&);
template ReturnMap<InstantiatedReal> first_return(const ZonalGravity&,
                                                  const SixNumbers<InstantiatedReal>&, int,
                                                  const GaussSettings&);
template InstantiatedReal kepler_period(const InstantiatedReal&, const InstantiatedReal&);

}  // namespace hamjet
