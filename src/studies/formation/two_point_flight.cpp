#include "two_point_flight.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "../exact_flow.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {
TwoPointFlight fly_between(const SharedSystem& system, std::vector<double> guess,
                           const ClockTime& start_time, const Eigen::Vector3d& position,
                           double duration, double most_miss) {
  constexpr int most_flights = 20;
  constexpr double singular = 1e-10;
  constexpr double tolerance = 1e-12;  // the tolerance of the derivatives
  TwoPointFlight flight;
  flight.start = std::move(guess);
  try {
    while (flight.flights < most_flights) {
      ++flight.flights;
      // The final state is flown to the precision of double.
      flight.end = exact_flow(system, flight.start, start_time, duration);
      const Eigen::Vector3d missing = position - position_of(flight.end);
      flight.miss = missing.norm();
      if (flight.miss <= most_miss) return flight;
      const Matrix<double> flow =
          linear_part(linear_jet(system, flight.start, start_time, duration, tolerance));
      const Eigen::Matrix3d commanded = flow.topRightCorner(3, 3);
      const Eigen::JacobiSVD<Eigen::Matrix3d> solver(commanded,
                                                     Eigen::ComputeFullU | Eigen::ComputeFullV);
      const Eigen::Vector3d& values = solver.singularValues();
      if (!(values[2] > singular * values[0])) {
        flight.failure = "no velocity commands the place at its end in one direction";
        return flight;
      }
      Eigen::Vector3d step = solver.solve(missing);
      const double speed = std::hypot(flight.start[3], flight.start[4], flight.start[5]);
      if (step.norm() > speed / 2) step *= speed / 2 / step.norm();
      for (std::size_t i = 0; i < 3; ++i) {
        flight.start[3 + i] += step[static_cast<Eigen::Index>(i)];
      }
    }
    flight.failure = fmt::format("the last of {} flights is {:.3g} canonical lengths off its end",
                                 flight.flights, flight.miss);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    flight.failure = error.what();
  }
  return flight;
}

}  // namespace hamjet
