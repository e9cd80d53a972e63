#include "company_flight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "../../charts/plane_elements.hpp"
#include "../../poincare/nodal_flight.hpp"
#include "../exact_flow.hpp"
#include "../flights/extreme_distance.hpp"
#include "../formation/charts/deputy_flows.hpp"
#include "../formation/single_transfer.hpp"
#include "hamjet/error.hpp"
#include "hamjet/studies/propagation.hpp"
#include "relative_orbit_extent.hpp"

namespace hamjet {
namespace {

/// Of the relative orbits that are measured and drawn.
constexpr int points_of_orbit = 96;

}  // namespace

CompanyFlight::CompanyFlight(const Scene& scene, const FlowSection<double>& section,
                             const std::vector<double>& times, double nodal_period,
                             double mean_period)
    : section_(section),
      system_(make_system(scene)),
      start_time_(scene.start_time),
      units_(metric_units(scene)),
      mu_(orbit_field(scene).mu),
      nodal_period_(nodal_period),
      mean_period_(mean_period) {
  const SixNumbers<double>& chief = section.chief();
  const double G =
      chief[3] - (chief[q_place] * chief[q_place] + chief[p_place] * chief[p_place]) / 2;
  cosine_ = chief[momentum_place] / G;
  semi_major_axis_ = chief[3] * chief[3] / mu_;
  for (std::size_t k = 0; k < times.size(); ++k) {
    // Every tenth of the early times is one of the window's.
    if (k % 10 == 0) in_window_.push_back(k);
    in_tenth_.push_back(k);
    times_.push_back(times[k] / 10);
  }
  for (std::size_t k = (times.size() - 1) / 10 + 1; k < times.size(); ++k) {
    in_window_.push_back(times_.size());
    times_.push_back(times[k]);
  }
  choose_times_of_orbit();
  chief_.push_back(scene.nominal);
  for (std::size_t k = 1; k < times_.size(); ++k) {
    chief_.push_back(flown_on(chief_.back(), times_[k - 1], times_[k] - times_[k - 1]));
  }
  chief_first_ = orbit_from(chief_.front(), 0);
  chief_last_ = orbit_from(chief_.back(), times_.back());
}

double CompanyFlight::sine() const { return std::sqrt((1 - cosine_) * (1 + cosine_)); }

double CompanyFlight::mean_motion() const { return 2 * std::numbers::pi / mean_period_; }

std::vector<double> CompanyFlight::flown_on(const std::vector<double>& state, double since,
                                            double time) const {
  return exact_flow(system_, state, start_time_ + since, time);
}

/// One revolution in equal steps of the chief's eccentric anomaly, so that its pericentre has as
/// many places as its apocentre.
void CompanyFlight::choose_times_of_orbit() {
  const SixNumbers<double>& chief = section_.chief();
  const double ratio =
      1 - (chief[q_place] * chief[q_place] + chief[p_place] * chief[p_place]) / (2 * chief[3]);
  const double e = std::sqrt((1 - ratio) * (1 + ratio));
  const double start = within_half_a_turn(chief[0] - std::atan2(-chief[q_place], chief[p_place]));
  const double anomaly = eccentric_longitude<double>(start, e, 0).angle;
  const auto mean = [&](int k) {
    const double E = anomaly + 2 * std::numbers::pi * k / points_of_orbit;
    return E - e * std::sin(E);
  };
  for (int k = 1; k <= points_of_orbit; ++k) {
    steps_of_orbit_.push_back((mean(k) - mean(k - 1)) * nodal_period_ / (2 * std::numbers::pi));
  }
}

/// States along one revolution.
std::vector<std::vector<double>> CompanyFlight::orbit_from(const std::vector<double>& start,
                                                           double since) const {
  std::vector<std::vector<double>> orbit = {start};
  for (const double step : steps_of_orbit_) {
    orbit.push_back(flown_on(orbit.back(), since, step));
    since += step;
  }
  return orbit;
}

std::vector<RelativeState> CompanyFlight::relative_orbit(
    const std::vector<std::vector<double>>& chief,
    const std::vector<std::vector<double>>& deputy) const {
  std::vector<RelativeState> states;
  for (std::size_t k = 0; k < chief.size(); ++k) {
    std::vector<double> difference;
    for (std::size_t i = 0; i < 6; ++i) difference.push_back(deputy[k][i] - chief[k][i]);
    states.push_back(
        ChiefFrame(chief[k], units_, RelativeFrame::rtn_rotating).relative(difference));
  }
  return states;
}

std::vector<RelativeState> CompanyFlight::first_orbit(const std::vector<double>& deputy) const {
  return relative_orbit(chief_first_, orbit_from(deputy, 0));
}

CompanyFlight::Passage CompanyFlight::passage_of(std::vector<double> state, double since,
                                                 const SixNumbers<double>& chief) const {
  const CanonicalChart<double>& chart = section_.chart();
  constexpr int most_iterations = 30;
  constexpr double close = 2e-14;
  Passage passage;
  SixNumbers<double> z = chart.coordinates(six_numbers(state));
  double angle = within_half_a_turn(chief[0] - z[0]);
  double rate = mu_ * mu_ / (z[3] * z[3] * z[3]);
  for (int i = 0; i < most_iterations && std::abs(angle) > close; ++i) {
    const double step = angle / rate;
    state = flown_on(state, since + passage.delay, step);
    passage.delay += step;
    z = chart.coordinates(six_numbers(state));
    const double left = within_half_a_turn(chief[0] - z[0]);
    const double secant = (angle - left) / step;
    if (secant > 0.3 * rate && secant < 3 * rate) rate = secant;
    angle = left;
  }
  // Rounding leaves some 1e-14 of a revolution; a search that has not ended leaves more.
  constexpr double not_found = 1e-10;
  if (!(std::abs(angle) <= not_found)) {
    throw Error(ErrorKind::numerical,
                fmt::format("bounded: after {} steps of the secant method a deputy is still {:.2g} "
                            "radians from its chief's mean argument of latitude",
                            most_iterations, angle));
  }
  passage.node = z[1] - chief[1];
  return passage;
}

void CompanyFlight::fly(BoundedDeputy& deputy) const {
  const CanonicalChart<double>& chart = section_.chart();
  std::vector<double> along;
  std::vector<double> cross;
  std::vector<double> state = deputy.state;
  Passage first;
  double node = 0;
  double angle = 0;
  deputy.least_size_m = deputy.lowest_m = std::numeric_limits<double>::infinity();
  deputy.largest_size_m = 0;
  for (std::size_t k = 0; k < times_.size(); ++k) {
    if (k > 0) state = flown_on(state, times_[k - 1], times_[k] - times_[k - 1]);
    const Passage passage = passage_of(state, times_[k], chart.coordinates(six_numbers(chief_[k])));
    if (k == 0) first = passage;
    // Differences of angles go on from the last ones, so that whole turns are not lost; so do the
    // delays of a deputy that has drifted half a revolution away.
    node += within_half_a_turn(passage.node - first.node - node);
    angle += within_half_a_turn(-mean_motion() * (passage.delay - first.delay) - angle);
    along.push_back(semi_major_axis_ * (angle + cosine_ * node));
    cross.push_back(semi_major_axis_ * sine() * node);
    // The first part of the times is that of a tenth of the window.
    if (k == 0 || k > in_tenth_.back()) add_revolution(chief_[k], state, times_[k], deputy);
  }
  const std::vector<std::vector<double>> orbit = orbit_from(deputy.state, 0);
  deputy.first = relative_orbit(chief_first_, orbit);
  deputy.last = relative_orbit(chief_last_, orbit_from(state, times_.back()));
  deputy.size_m = largest_distance_m(deputy.first);
  deputy.drifts = {drift_of(in_tenth_, along, cross), drift_of(in_window_, along, cross)};
  for (BoundedDrift& drift : deputy.drifts) {
    const double size = deputy.size_m / units_.length_m;
    drift.along /= size;
    drift.along_doubt /= size;
    drift.cross /= size;
    drift.range /= size;
  }
}

void CompanyFlight::add_revolution(const std::vector<double>& chief,
                                   const std::vector<double>& state, double since,
                                   BoundedDeputy& deputy) const {
  ExtremeDistance farthest(ExtremeDistance::Kind::greatest);
  ExtremeDistance lowest(ExtremeDistance::Kind::least);
  fly_arcs(system_, {chief, state}, start_time_ + since, nodal_period_, [&](const FlightArc& arc) {
    farthest.add(arc, separation_along(arc, 0, 1));
    lowest.add(arc, place_along(arc, 1));
  });
  deputy.last_size_m = farthest.distance() * units_.length_m;
  deputy.least_size_m = std::min(deputy.least_size_m, deputy.last_size_m);
  deputy.largest_size_m = std::max(deputy.largest_size_m, deputy.last_size_m);
  deputy.lowest_m = std::min(deputy.lowest_m, lowest.distance() * units_.length_m);
}

/// The slope of least squares, a revolution, through the values at some of the times.
double CompanyFlight::slope_of(std::span<const std::size_t> places,
                               const std::vector<double>& values) const {
  const auto count = static_cast<double>(places.size());
  double middle = 0, sum = 0, squares = 0;
  for (const std::size_t k : places) middle += times_[k] / nodal_period_ / count;
  for (const std::size_t k : places) {
    const double place = times_[k] / nodal_period_ - middle;
    sum += place * values[k];
    squares += place * place;
  }
  return sum / squares;
}

BoundedDrift CompanyFlight::drift_of(std::span<const std::size_t> places,
                                     const std::vector<double>& along,
                                     const std::vector<double>& cross) const {
  BoundedDrift drift;
  drift.along = slope_of(places, along);
  drift.cross = slope_of(places, cross);
  drift.along_doubt = std::abs(slope_of(places.first(places.size() - 1), along) - drift.along);
  double least = 0, most = 0;
  for (const std::size_t k : places) {
    least = std::min(least, along[k]);
    most = std::max(most, along[k]);
  }
  drift.range = most - least;
  drift.revolutions = static_cast<int>(std::lround(times_[places.back()] / nodal_period_));
  return drift;
}

std::array<double, 2> CompanyFlight::rates_of(const BoundedDeputy& deputy) const {
  const double unit = deputy.size_m / units_.length_m / semi_major_axis_;
  const double node = deputy.drifts.back().cross * unit / sine();
  const double angle = deputy.drifts.back().along * unit - cosine_ * node;
  return {-angle / mean_motion(), node};
}

}  // namespace hamjet
