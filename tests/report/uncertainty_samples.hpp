#pragma once

#include "../../src/studies/uncertainty/uncertainty.hpp"
#include "sample_scene.hpp"

// A small result of the study of uncertainty with collisions and passive safety, of made-up
// numbers.

namespace hamjet::io {

/// Two independent variables w and v of mean 0 and variance 1: w is 2 with the probability 0.2, or
/// -0.5; v is 1 or -1. Component i is 14 size (i + 1) + 0.4 size (i + 1) w, and with v for w from
/// the fourth on. w has the skewness 0.6 / 0.4 = 1.5 and the excess kurtosis (1 - 0.96) / 0.16 =
/// 0.25; v has 0 and -2.
inline Cumulants sample_moments(double size) {
  Matrix<double> points(6, 4);
  Vector<double> weights(4);
  for (Eigen::Index k = 0; k < 4; ++k) {
    const double w = k < 2 ? 2 : -0.5, v = k % 2 == 0 ? 1 : -1;
    weights[k] = k < 2 ? 0.1 : 0.4;
    for (Eigen::Index i = 0; i < 6; ++i) {
      points(i, k) = size * static_cast<double>(i + 1) * (14 + 0.4 * (i < 3 ? w : v));
    }
  }
  return Cumulants::of_points(points, weights);
}

inline CollisionProbability sample_probability(double size) {
  CollisionProbability p;
  p.sampling = CollisionSampling::entries;
  p.probability = size;
  p.lower = 0.9 * size;
  p.upper = 1.2 * size;
  p.path_error = 3 * size;
  p.standard_error = 0.1 * size;
  p.parts = 9;
  p.samples = 5000;
  p.hits = 321;
  p.equivalent_samples = 77000;
  p.change_from_lower_order = 0.02 * size;
  p.standard_error_of_change = 0.01 * size;
  p.sampled_radius = 31;
  p.largest_difference = 7;
  p.times = {0, 45};
  p.by_time = {0, 0.7 * size};
  return p;
}

inline LeastSeparations sample_separations() {
  LeastSeparations least;
  least.shares = {0.01, 0.5};
  least.separations = {52, 210};
  least.errors = {0.25, 0.5};
  least.lower = {49, 201};
  least.upper = {56, 220};
  least.samples = 4000;
  least.nearer = 8;
  least.lower_nearer = 0.001;
  least.upper_nearer = 0.003;
  least.flights = 32;
  least.flight_difference = 0.125;
  return least;
}

inline CollisionResult sample_collision() {
  CollisionResult result;
  result.gaussian_in = {"positions", "elements"};
  result.watch.radius_m = 15;
  result.watch.event = CollisionEvent::entry;
  result.watch.confidence = 0.75;
  result.from_s = 10;
  result.to_s = 100;
  result.is_widened = true;
  result.probability = sample_probability(0.25);
  result.of_whole_passage = sample_probability(0.5);
  result.whole_from_s = 5;
  result.whole_to_s = 110;
  UncertainApproach approach;
  approach.time = 0.04;
  approach.time_s = 40;
  approach.distance_m = 17;
  approach.speed_m_s = 8;
  approach.time_deviation_s = 0.375;
  approach.distance_deviation_m = 6;
  approach.refusal = "no relative velocity";
  result.approaches.push_back(approach);
  approach.time_s = 60;
  approach.is_in_window = false;
  approach.is_cut = true;
  approach.flights = 64;
  approach.position_error_m = 0.0625;
  approach.time_error_s = 0.03125;
  ShortEncounter& plane = approach.plane.emplace();
  plane.offset = {11, 13};
  plane.deviation = {19, 23};
  plane.foster = 0.26;
  plane.alfano = 0.27;
  plane.chan = 0.28;
  plane.passage = 1.5;
  plane.departure = 0.015625;
  result.approaches.push_back(approach);
  result.separations = sample_separations();
  result.order = 2;
  return result;
}

inline SafetyResult sample_safety() {
  SafetyResult result;
  result.watch.keep_apart_m = 50;
  result.watch.keep_out_m = {200, 400, 300};
  result.watch.least_separation_m = 45;
  result.watch.least_deviations = 3;
  result.from_s = 20;
  result.to_s = 200;
  result.order = 2;
  SafetyPair pair;
  pair.first = "deputy";
  pair.second = "deputy 2";
  pair.mean_separation_m = 350;
  pair.separations = sample_separations();
  result.pairs.push_back(pair);
  pair.first = "chief";
  pair.second = "deputy";
  pair.burn_share = 0.5;
  pair.margin.emplace();
  pair.margin->deviations = 4.5;
  pair.margin->time = 150;
  pair.margin->flown_ratio = 1.25;
  result.pairs.push_back(pair);
  return result;
}

inline UncertaintyResult sample_uncertainty() {
  UncertaintyResult result;
  result.scene = sample_scene(7);
  result.scene.uncertainty.emplace().samples = 900;
  UncertainState state;
  state.name = "chief";
  state.cartesian = {sample_moments(1), sample_moments(2)};
  state.charted = {sample_moments(3), sample_moments(4)};
  FlownMoments& flown = state.flown.emplace(FlownMoments{sample_moments(5), 900, {}, {}, {}, {}});
  flown.mean_error = Vector<double>::Constant(6, 0.01);
  flown.deviation_error = Vector<double>::Constant(6, 0.02);
  flown.skewness_error = Vector<double>::Constant(6, 0.03);
  flown.kurtosis_error = Vector<double>::Constant(6, 0.04);
  state.flown_states = Matrix<double>{{0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}, {0, 6}};
  UncertaintyAt at;
  at.time = 2.5;
  at.charted_names = {"a", "b", "c", "d", "e", "f"};
  at.states = {state};
  result.points = {at};
  result.collision = sample_collision();
  result.safety = sample_safety();
  return result;
}

}  // namespace hamjet::io
