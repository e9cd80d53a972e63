#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "formation_scenes.hpp"
#include "hamjet/studies/assignment.hpp"
#include "hamjet/studies/transfer.hpp"
#include "studies/exact_flow.hpp"

// Ends of transfers, and slots, in all forms of deputies. Expected: the same transfer as to the
// same place given along the axes, which conversions by hand give for a moving chief.

namespace hamjet {
namespace {

Scene transfer_to(const ArrivalState& end) {
  Scene scene = paper_chief(3);
  TransferSettings settings;
  settings.start.position_m = {300, -2000, 100};
  settings.end = end;
  settings.times = {0.35 * paper_period, 0.6 * paper_period};
  settings.refine = true;
  settings.refined_miss_m = 1e-6;
  scene.transfer = settings;
  return scene;
}

void expect_same(const TransferPoint& point, const TransferPoint& right, double allowed_m_s) {
  ASSERT_TRUE(point.is_refined() && right.is_refined());
  EXPECT_LT((point.best().start_change_m_s - right.best().start_change_m_s).norm(), allowed_m_s);
  EXPECT_LT((point.best().end_change_m_s - right.best().end_change_m_s).norm(), allowed_m_s);
}

// A place on the chief's sphere and in its plane, at rest there: r d cos, r d sin by hand. The
// chief's distance at arrival is that of its flight.
TEST(ArrivalForms, CurvilinearAtWhereTheChiefIsThen) {
  const double arc = 40000, radial = 500;
  ArrivalState curvilinear;
  curvilinear.in_form = {DeputyForm::curvilinear, {radial, arc, 0, 0, 0, 0}};
  const TransferResult result = study_transfer(transfer_to(curvilinear));
  for (std::size_t k = 0; k < 2; ++k) {
    Scene scene = transfer_to({});
    scene.transfer->times = {scene.transfer->times[k]};
    const std::vector<double> chief = exact_flow(SharedSystem(make_system(scene)), scene.nominal,
                                                 scene.start_time, scene.transfer->times[0]);
    const double unit = scene.units.length_km * 1000;
    const double r = std::hypot(chief[0], chief[1], chief[2]) * unit;
    const double angle = arc / r;
    const double fast = (chief[0] * chief[3] + chief[1] * chief[4] + chief[2] * chief[5]) /
                        (r / unit) * unit / scene.units.time_s;
    // The chief's distance grows and the arc stays, so that the angle shrinks as 1 / r.
    const double turning = -angle * fast / r;
    scene.transfer->end.position_m = {(r + radial) * std::cos(angle) - r,
                                      (r + radial) * std::sin(angle), 0};
    scene.transfer->end.velocity_m_s = {
        fast * std::cos(angle) - (r + radial) * std::sin(angle) * turning - fast,
        fast * std::sin(angle) + (r + radial) * std::cos(angle) * turning, 0};
    // The bound is the rounding of 7000 km, and misses of a micrometre in a third of a revolution.
    expect_same(result.points[k], study_transfer(scene).points[0], 1e-7);
  }
}

// Six numbers that are 0 are the chief itself, whatever the form.
TEST(ArrivalForms, NothingIsTheChief) {
  const TransferResult right = study_transfer(transfer_to({}));
  for (const DeputyForm form : nonlinear_forms) {
    ArrivalState end;
    end.in_form = {form, {}};
    const TransferResult result = study_transfer(transfer_to(end));
    for (std::size_t k = 0; k < 2; ++k) {
      // At rest in the turning axes and on the chief's own orbit are the same there.
      expect_same(result.points[k], right.points[k], 1e-7);
    }
  }
}

// An orbit of the deputy's own does not depend on the chief.
TEST(ArrivalForms, AnOwnOrbit) {
  Scene scene = transfer_to({});
  scene.transfer->times = {0.6 * paper_period};
  scene.transfer->frame = RelativeFrame::inertial;
  const std::vector<double> chief = exact_flow(SharedSystem(make_system(scene)), scene.nominal,
                                               scene.start_time, scene.transfer->times[0]);
  const MetricUnits units{scene.units.length_km * 1000, scene.units.time_s};
  scene.transfer->end = {{200, -300, 50}, {0.1, 0.2, -0.3}};
  const TransferResult right = study_transfer(scene);
  std::array<double, 6> state{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    state[i] = chief[i] + scene.transfer->end.position_m[axis] / units.length_m;
    state[3 + i] = chief[3 + i] + scene.transfer->end.velocity_m_s[axis] / units.velocity_m_s();
  }
  scene.transfer->end = {};
  scene.transfer->end.own_state = state;
  expect_same(study_transfer(scene).points[0], right.points[0], 1e-7);
}

// A slot in relative elements: a da and the rest 0 at the chief's own phase cost at least n da / 2,
// which no transfer between orbits of these energies undercuts.
TEST(ArrivalForms, OfSlots) {
  Scene scene = transfer_to({});
  AssignmentSettings assignment;
  assignment.deputies = {{{0, -1000, 0}, {0, 0, 0}}, {{0, 1000, 0}, {0, 0, 0}}};
  ArrivalState own, curvilinear;
  own.in_form = {DeputyForm::relative_elements, {}};
  curvilinear.in_form = {DeputyForm::curvilinear, {0, 1000, 0, 0, 0, 0}};
  assignment.slots = {curvilinear, own};
  scene.assignment = assignment;
  const AssignmentResult result = study_assignment(scene);
  ASSERT_EQ(result.transfers.size(), 2U);
  for (const AssignedTransfer& assigned : result.transfers) {
    Scene alone = transfer_to(assignment.slots[assigned.slot]);
    alone.transfer->start = assignment.deputies[assigned.deputy];
    alone.transfer->times = {assigned.transfer.time};
    expect_same(study_transfer(alone).points[0], assigned.transfer, 1e-9);
  }
}

}  // namespace
}  // namespace hamjet
