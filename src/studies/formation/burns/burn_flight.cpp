#include "burn_flight.hpp"

#include <cmath>

#include "../../../algebra/state_sums.hpp"
#include "../../exact_flow.hpp"
#include "../formation_problem.hpp"
#include "../single_transfer.hpp"
#include "../two_point_flight.hpp"
#include "hamjet/algebra/composition.hpp"

namespace hamjet {
namespace {

constexpr std::size_t states = 6;

/// A unit vector; that of zero is along the motion, so that a burn can grow from nothing.
Eigen::Vector3d direction_of(const Eigen::Vector3d& change) {
  const double size = change.norm();
  return size > 0 ? Eigen::Vector3d(change / size) : Eigen::Vector3d::UnitY();
}

/// The tolerance of the derivatives in Newton's method. Flights without derivatives judge its
/// result.
constexpr double tolerance_of_derivatives = 1e-11;

}  // namespace

BurnFlight::BurnFlight(const Scene& scene, const ComputedProblem& problem,
                       const SharedSystem& burning, double duration)
    : scene_(scene),
      problem_(problem),
      burning_(burning),
      duration_(duration),
      units_(metric_units(scene)),
      chief_system_(system_of_chief(scene, problem)),
      chief_end_(exact_flow(chief_system_, problem.nominal, problem.start_time, duration)),
      end_(scene.transfer->end.deviation(chief_end_, units_, scene.transfer->frame)) {}

/// The rows are the axes of the thruster's attitude at a deputy's state.
Eigen::Matrix3d BurnFlight::axes(const std::vector<double>& state) const {
  if (scene_.thruster->attitude == BurnAttitude::inertial) return Eigen::Matrix3d::Identity();
  const ChiefFrame own(state, units_, RelativeFrame::rtn_inertial);
  Eigen::Matrix3d rows;
  for (Eigen::Index i = 0; i < 3; ++i) rows.col(i) = own.along_axes(Eigen::Vector3d::Unit(i));
  return rows;
}

std::vector<double> BurnFlight::start_state() const {
  return state_sum(problem_.nominal, ChiefFrame(problem_.nominal, units_, scene_.transfer->frame)
                                         .deviation(scene_.transfer->start));
}

BurnFlight::Changes BurnFlight::changes_of(const std::vector<Impulse>& impulses) const {
  Changes changes;
  std::vector<double> chief = problem_.nominal;
  std::vector<double> deputy = start_state();
  double now = 0;
  for (const Impulse& impulse : impulses) {
    if (impulse.time != now) {
      const ClockTime from = problem_.start_time + now;
      chief = exact_flow(chief_system_, chief, from, impulse.time - now);
      deputy = exact_flow(problem_.system, deputy, from, impulse.time - now);
      now = impulse.time;
    }
    const Eigen::Vector3d change =
        momentum_of(ChiefFrame(chief, units_, scene_.transfer->frame)
                        .deviation({Eigen::Vector3d::Zero(), impulse.change_m_s}));
    changes.push_back(axes(deputy) * change);
    for (std::size_t i = 0; i < 3; ++i) deputy[3 + i] += change[static_cast<Eigen::Index>(i)];
  }
  return changes;
}

std::vector<BurnSpan> BurnFlight::spans(const CanonicalThruster& thruster,
                                        const std::vector<Impulse>& at,
                                        const Changes& changes) const {
  std::vector<BurnSpan> spans;
  double mass = 1;
  for (std::size_t k = 0; k < at.size(); ++k) {
    const double size = changes[k].norm();
    const double start = at[k].time - thruster.centre(size, mass);
    spans.push_back({start, start + thruster.length(size, mass), mass});
    mass = thruster.mass_after(size, mass);
  }
  return spans;
}

std::vector<double> BurnFlight::burning_state(const CanonicalThruster& thruster,
                                              std::vector<double> state, const BurnSpan& span,
                                              const Eigen::Vector3d& change) const {
  const double size = thruster.mass_falls() ? thruster.exhaust : thruster.acceleration;
  for (const double x : Eigen::Vector3d(direction_of(change) * size)) state.push_back(x);
  if (thruster.mass_falls()) {
    const double empty = span.start + span.mass * thruster.exhaust / thruster.acceleration;
    state.push_back((problem_.start_time + empty).in<double>());
  }
  return state;
}

std::vector<double> BurnFlight::flown(const CanonicalThruster& thruster,
                                      const std::vector<Impulse>& at, const Changes& changes,
                                      double pace, const Look& look) const {
  std::vector<double> state = start_state();
  double now = 0;
  const auto fly = [&](const SharedSystem& system, double time) {
    if (time == now) return;
    const bool is_seen = look && time > now;
    const double from = now;
    const double parts = is_seen ? std::ceil((time - from) / pace) : 1;
    for (double part = 1; part <= parts; ++part) {
      const double next = part == parts ? time : from + (time - from) * part / parts;
      state = exact_flow(system, state, problem_.start_time + now, next - now);
      now = next;
      if (is_seen) look(now, {state.begin(), state.begin() + states});
    }
  };
  const std::vector<BurnSpan> times = spans(thruster, at, changes);
  for (std::size_t k = 0; k < times.size(); ++k) {
    fly(problem_.system, times[k].start);
    state = burning_state(thruster, std::move(state), times[k], changes[k]);
    fly(burning_, times[k].end);
    state.resize(states);
  }
  fly(problem_.system, duration_);
  return state;
}

BurnFlight::Vector6 BurnFlight::missing(const CanonicalThruster& thruster,
                                        const std::vector<Impulse>& at,
                                        const Changes& changes) const {
  const std::vector<double> missing =
      state_difference(end_, state_difference(flown(thruster, at, changes), chief_end_));
  return Eigen::Map<const Vector6>(missing.data());
}

// Derivatives are carried at fixed times: where a thrust is switched on dt later, the state behind
// has dt times its acceleration less, and where it is switched off later, as much more.
Eigen::Matrix<double, 6, Eigen::Dynamic> BurnFlight::derivatives(const CanonicalThruster& thruster,
                                                                 const std::vector<Impulse>& at,
                                                                 const Changes& changes) const {
  const auto columns = static_cast<Eigen::Index>(3 * changes.size());
  Eigen::Matrix<double, 6, Eigen::Dynamic> carried =
      Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, columns);
  Eigen::RowVectorXd mass_rate = Eigen::RowVectorXd::Zero(columns);
  std::vector<double> state = start_state();
  double now = 0;
  const auto coast = [&](double time) {
    if (time == now) return;
    const FlowJet<double> leg = linear_jet(problem_.system, state, problem_.start_time + now,
                                           time - now, tolerance_of_derivatives);
    carried = linear_part(leg) * carried;
    state = nominal_of(leg);
    now = time;
  };
  const std::vector<BurnSpan> times = spans(thruster, at, changes);
  for (std::size_t k = 0; k < times.size(); ++k) {
    const BurnSpan& span = times[k];
    const auto own = static_cast<Eigen::Index>(3 * k);
    const double size = changes[k].norm();
    const Eigen::Vector3d direction = direction_of(changes[k]);
    const double first = thruster.acceleration / span.mass;
    const double last = thruster.acceleration / thruster.mass_after(size, span.mass);
    // How much earlier the burn begins, and how much later it ends.
    Eigen::RowVectorXd earlier = (at[k].time - span.start) / span.mass * mass_rate;
    earlier.segment<3>(own) += thruster.centre_rate(size, span.mass) * direction.transpose();
    Eigen::RowVectorXd later = span.length() / span.mass * mass_rate - earlier;
    later.segment<3>(own) += direction.transpose() / last;
    const auto switched = [&](double acceleration) {
      return Eigen::Vector3d(axes(state).transpose() * direction * acceleration);
    };
    coast(span.start);
    carried.bottomRows<3>() += switched(first) * earlier;
    if (span.length() > 0) {
      const FlowJet<double> leg =
          linear_jet(burning_, burning_state(thruster, state, span, changes[k]),
                     problem_.start_time + now, span.length(), tolerance_of_derivatives);
      const Matrix<double> flow = linear_part(leg);
      Eigen::MatrixXd parameters = Eigen::MatrixXd::Zero(flow.cols() - 6, columns);
      const double scale = thruster.mass_falls() ? thruster.exhaust : thruster.acceleration;
      parameters.block<3, 3>(0, own) =
          scale / size * (Eigen::Matrix3d::Identity() - direction * direction.transpose());
      if (thruster.mass_falls()) {
        parameters.row(3) = thruster.exhaust / thruster.acceleration * mass_rate - earlier;
      }
      carried =
          flow.topLeftCorner(6, 6) * carried + flow.topRightCorner(6, flow.cols() - 6) * parameters;
      state = nominal_of(leg);
      state.resize(states);
      now = span.end;
    }
    carried.bottomRows<3>() += switched(last) * later;
    if (thruster.mass_falls()) {
      // The mass behind is exp(-change / exhaust) of that before.
      const double left = thruster.mass_after(size, 1);
      mass_rate *= left;
      mass_rate.segment<3>(own) -= span.mass * left / thruster.exhaust * direction.transpose();
    }
  }
  coast(duration_);
  return carried;
}

}  // namespace hamjet
