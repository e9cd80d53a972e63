#include "box_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../exact_flow.hpp"
#include "../formation/single_transfer.hpp"
#include "../jets_along_time.hpp"
#include "../thinned_list.hpp"
#include "box_burns.hpp"
#include "box_company.hpp"
#include "hamjet/error.hpp"
#include "hamjet/maps/position_boundary_values.hpp"
#include "hamjet/studies/propagation.hpp"
#include "scene_gauss.hpp"

namespace hamjet {
namespace {

constexpr double seconds_a_day = 86400;
constexpr std::size_t drawn_places = 4001;
/// Beyond this part of the box the deputy is looked at so many times as often: it may leave and
/// come back between two looks.
constexpr double near_face = 0.9;
constexpr double more_looks = 10;

class Keeper {
 public:
  Keeper(const Scene& scene, const std::vector<double>& member, double revolution,
         const ProgressCallback& progress)
      : scene_(scene),
        settings_(scene.bounded->box),
        units_(metric_units(scene)),
        revolution_(revolution),
        step_(revolution / BoxControl::places_a_revolution),
        progress_(progress),
        flow_(make_system(scene)),
        company_(scene, scene.nominal, start_of(member), member_of(member)),
        problem_(make_problem(scene)),
        integrator_(scene_gauss_integrator(scene, 1e-12)) {
    problem_.symmetry = FlowSymmetry::none;
    if (scene.thruster) burns_.emplace(scene, problem_, flow_, revolution);
  }

  BoxControl run() {
    const double end = settings_.days * seconds_a_day / units_.time_s;
    result_.days = settings_.days;
    result_.start = company_.deputy();
    result_.least_m = result_.most_m = company_.place_m();
    if (company_.part() > 1) {
      throw Error(
          ErrorKind::numerical,
          fmt::format("bounded.box: the deputy starts outside of it, at {:.10g} of its half "
                      "widths from its middle",
                      company_.part()));
    }
    note(looked(company_, time_));
    while (time_ < end) {
      if (progress_) progress_("box", time_ / end);
      const double step = std::min(pace(company_), end - time_);
      Company next = company_;
      next.advance(flow_, step);
      if (next.part() <= 1) {
        company_ = std::move(next);
        time_ += step;
        note(looked(company_, time_));
        continue;
      }
      coast_to_face(step);
      bring_back();
    }
    result_.places = places_.take();
    return std::move(result_);
  }

 private:
  std::vector<double> start_of(const std::vector<double>& member) const {
    if (!scene_.deputy && settings_.reference == BoxReference::member) return member;
    const RelativeState start =
        scene_.deputy ? scene_.deputy->start : RelativeState{settings_.position_m, {0, 0, 0}};
    const RelativeFrame frame = scene_.deputy ? scene_.deputy->frame : RelativeFrame::rtn_rotating;
    std::vector<double> state = ChiefFrame(scene_.nominal, units_, frame).deviation(start);
    for (std::size_t i = 0; i < state.size(); ++i) state[i] += scene_.nominal[i];
    return state;
  }
  std::vector<double> member_of(const std::vector<double>& member) const {
    return settings_.reference == BoxReference::member ? member : std::vector<double>();
  }

  /// Where the deputy is at a time.
  struct Look {
    BoxControl::Place place;
    Eigen::Vector3d from_chief_m;
    double part;  ///< of the box
  };
  static Look looked(const Company& company, double time) {
    return {{time, company.from_reference_m()}, company.place_m(), company.part()};
  }
  void note(const Look& look) {
    result_.least_m = result_.least_m.cwiseMin(look.from_chief_m);
    result_.most_m = result_.most_m.cwiseMax(look.from_chief_m);
    result_.farthest = std::max(result_.farthest, look.part);
    places_.add(look.place);
  }

  /// The time to the next look.
  double pace(const Company& company) const {
    return company.part() > near_face ? step_ / more_looks : step_;
  }

  /// Coasts to the last moment inside of a step that ends outside.
  void coast_to_face(double step) {
    double inside = 0;
    double outside = step;
    constexpr int halvings = 40;
    for (int i = 0; i < halvings; ++i) {
      const double middle = (inside + outside) / 2;
      Company at = company_;
      at.advance(flow_, middle);
      (at.part() <= 1 ? inside : outside) = middle;
    }
    company_.advance(flow_, inside);
    time_ += inside;
    note(looked(company_, time_));
  }

  /// A return of a given duration that has been flown and may still be discarded.
  struct Flown {
    BoxReturn told;
    Company end;
    std::vector<Look> looks;
  };

  void bring_back() {
    std::optional<Flown> best;
    problem_.nominal = company_.chief();
    problem_.start_time = company_.now();
    JetPropagation jets(problem_, integrator_);
    for (const double part : settings_.return_orbits) {
      const double duration = part * revolution_;
      std::optional<Flown> flown = flown_return(jets.advance_to(duration), duration);
      if (flown && (!best || is_better(flown->told, best->told))) best = std::move(flown);
    }
    if (!best) {
      throw Error(ErrorKind::numerical,
                  "bounded.box.return_orbits: no return of these times has an answer");
    }
    if (burns_) best->told.burns = burns_->replace(best->told, company_);
    for (const Look& look : best->looks) note(look);
    time_ = best->looks.back().place.time;
    company_ = std::move(best->end);
    result_.returns.push_back(std::move(best->told));
    if (const double part = company_.part(); part > 1) {
      throw Error(ErrorKind::numerical,
                  fmt::format("bounded.box: too small for polynomials of order {} and the rounding "
                              "of flights, a return ends at {:.3g} of its half widths",
                              scene_.order, part));
    }
  }

  static bool is_better(const BoxReturn& one, const BoxReturn& other) {
    const bool is_inside = one.farthest <= 1 + BoxControl::rounding;
    const bool other_is_inside = other.farthest <= 1 + BoxControl::rounding;
    if (is_inside != other_is_inside) return is_inside;
    return is_inside ? one.change_m_s() < other.change_m_s() : one.farthest < other.farthest;
  }

  /// The flown return; no value where the polynomials have no answer.
  std::optional<Flown> flown_return(const FlowJet<double>& jet, double duration) {
    Flown flown{{}, company_, {}};
    BoxReturn& told = flown.told;
    told.time = time_;
    told.duration = duration;
    told.deputy_before = company_.deputy();
    told.chief_before = company_.chief();
    Company target = company_;
    target.advance(flow_, duration);
    const std::vector<double> from = company_.deviation();
    const std::vector<double> to = target.reference();
    try {
      const PartialInversion<double> inversion =
          invert_partially(jet, parse_kind("F1", 3), std::numeric_limits<double>::epsilon(),
                           problem_.momentum_exponent);
      const BoundaryMomenta momenta = PositionBoundaryValues(inversion).solve(
          std::span(from).first(3), std::span(to).first(3), scene_.order);
      std::vector<double> deputy = told.deputy_before;
      Eigen::Vector3d change;
      for (std::size_t i = 0; i < 3; ++i) {
        deputy[3 + i] = told.chief_before[3 + i] + momenta.initial[i];
        change[static_cast<Eigen::Index>(i)] = deputy[3 + i] - told.deputy_before[3 + i];
      }
      told.first_m_s = company_.frame().velocity_change_m_s(change);
      flown.end.set_deputy(deputy);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      return std::nullopt;
    }
    for (double left = duration; left > 0;) {
      const double step = std::min(pace(flown.end), left);
      flown.end.advance(flow_, step);
      left -= step;
      flown.looks.push_back(looked(flown.end, time_ + duration - left));
      told.farthest = std::max(told.farthest, flown.looks.back().part);
    }
    // At its end the deputy takes the reference's velocity; its place is what the flight missed.
    told.miss_m = flown.end.from_reference_m().norm();
    const std::vector<double> reference = flown.end.reference();
    told.chief_after = flown.end.chief();
    told.deputy_after = flown.end.deputy();
    Eigen::Vector3d change;
    for (std::size_t i = 3; i < 6; ++i) {
      const double wanted = told.chief_after[i] + reference[i];
      change[static_cast<Eigen::Index>(i - 3)] = wanted - told.deputy_after[i];
      told.deputy_after[i] = wanted;
    }
    told.second_m_s = flown.end.frame().velocity_change_m_s(change);
    flown.end.set_deputy(told.deputy_after);
    return flown;
  }

  const Scene& scene_;
  const BoxSettings& settings_;
  MetricUnits units_;
  double revolution_;
  double step_;
  const ProgressCallback& progress_;
  TaylorFlow flow_;
  Company company_;
  ComputedProblem problem_;  ///< of the jets about the chief where it is
  IntegratorSettings integrator_;
  std::optional<BoxBurns> burns_;
  double time_ = 0;
  ThinnedList<BoxControl::Place, drawn_places> places_;
  BoxControl result_;
};

}  // namespace

double BoxControl::change_m_s() const {
  double sum = 0;
  for (const BoxReturn& one : returns) sum += one.change_m_s();
  return sum;
}

double BoxControl::burns_m_s() const {
  double sum = 0;
  for (const BoxReturn& one : returns) {
    if (const BurnedReturn* const burned = one.burned()) sum += burned->plan.change_m_s();
  }
  return sum;
}

std::string BoxControl::burns_failure() const {
  for (std::size_t k = 0; k < returns.size(); ++k) {
    if (!returns[k].burns) continue;
    const BurnedReturn& burns = *returns[k].burns;
    if (!burns.plan.is_found()) {
      const auto& least = burns.plan.least_acceleration_m_s2;
      return fmt::format("return {}: {}{}", k + 1, burns.plan.failure,
                         least ? fmt::format("; {:.4g} m/s^2 would do for this one", *least) : "");
    }
    if (burns.farthest > 1 + rounding && returns[k].farthest <= 1 + rounding) {
      return fmt::format(
          "return {}: by burns the deputy is up to {:.4g} half widths from the middle", k + 1,
          burns.farthest);
    }
  }
  return "";
}

BoxControl keep_in_box(const Scene& scene, const std::vector<double>& member, double revolution,
                       const ProgressCallback& progress) {
  return Keeper(scene, member, revolution, progress).run();
}

}  // namespace hamjet
