#include "flight_arcs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../../integrators/taylor_flow.hpp"
#include "hamjet/error.hpp"

namespace hamjet {

double value_at(const Series<double>& series, double share) {
  double sum = 0;
  for (std::size_t k = series.size(); k-- > 0;) sum = sum * share + series[k];
  return sum;
}

std::vector<double> FlightArc::state(std::size_t craft, double share) const {
  std::vector<double> result;
  for (const Series<double>& component : spacecraft[craft]) {
    result.push_back(value_at(component, share));
  }
  return result;
}

std::vector<std::vector<double>> fly_arcs(const SharedSystem& system,
                                          std::vector<std::vector<double>> states,
                                          const ClockTime& start_time, double time,
                                          const std::function<void(const FlightArc&)>& on_arc,
                                          double since) {
  // Functions of the polynomials are polynomials too, whose last powers fall a little later, so
  // that only this fraction of the reach is used.
  constexpr double used_reach = 0.8;
  // A step shorter than this fraction of the whole time runs into a collision.
  constexpr double least_part = 1e-9;
  constexpr std::size_t lanes = TaylorFlow::lanes;
  const SpacePointer space = SeriesSpace::create(1, TaylorFlow::order);
  std::vector<TaylorFlow> flows((states.size() + lanes - 1) / lanes, TaylorFlow(system));
  double flown = 0;
  do {
    FlightArc arc;
    arc.start = since + flown;
    arc.span = time - flown;
    const ClockTime now = start_time + flown;
    for (std::size_t f = 0; f < flows.size(); ++f) {
      // Lanes without a state of their own repeat another one, so that they are finite.
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        flows[f].set_state(lane, now, states[std::min(f * lanes + lane, states.size() - 1)],
                           std::copysign(1.0, time));
      }
      flows[f].expand();
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const double reach = flows[f].reach(lane, used_reach);
        arc.span = std::clamp(arc.span, -reach, reach);
      }
    }
    const bool is_long = std::abs(arc.span) > least_part * std::abs(time);
    if (time != 0 && !(is_long || flows[0].ends_at_break(0, arc.span))) {
      throw Error(ErrorKind::numerical,
                  fmt::format("a flight cannot be followed beyond t = {:.6g}: it runs into a "
                              "collision",
                              arc.start));
    }
    for (std::size_t craft = 0; craft < states.size(); ++craft) {
      const TaylorFlow& flow = flows[craft / lanes];
      std::vector<Series<double>>& components = arc.spacecraft.emplace_back();
      for (std::size_t i = 0; i < states[craft].size(); ++i) {
        Series<double>& series = components.emplace_back(space);
        double power = 1;
        for (int k = 0; k <= TaylorFlow::order; ++k) {
          series[static_cast<std::size_t>(k)] = flow.coefficient(craft % lanes, i, k) * power;
          power *= arc.span / flow.unit(craft % lanes);
        }
      }
      states[craft] = arc.state(craft, 1);
    }
    on_arc(arc);
    // The last step ends exactly at the time.
    flown = arc.span == time - flown ? time : flown + arc.span;
  } while (flown != time);
  return states;
}

}  // namespace hamjet
