#include "erroneous_flights.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "../../../algebra/state_sums.hpp"
#include "../../../dynamics/commanded_system.hpp"
#include "../../exact_flow.hpp"
#include "../../uncertainty/standard_normals.hpp"
#include "../single_transfer.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// What is wrong from one instant to the next.
struct DrawnErrors {
  RelativeState navigation;
  double size = 1;  ///< of the thrust, in parts of what is commanded
  Eigen::Matrix3d thrust = Eigen::Matrix3d::Identity();  ///< with the turn
};

DrawnErrors draw(const ThrustErrorSettings& settings, StandardNormals& normal) {
  const auto three = [&] {
    const double x = normal(), y = normal(), z = normal();
    return Eigen::Vector3d(x, y, z);
  };
  DrawnErrors errors;
  errors.navigation.position_m = settings.navigation.position_m.cwiseProduct(three());
  errors.navigation.velocity_m_s = settings.navigation.velocity_m_s.cwiseProduct(three());
  errors.size = 1 + settings.magnitude * normal();
  // Of a turn about three axes, that about the thrust itself does nothing.
  const Eigen::Vector3d turn = settings.direction_deg * std::numbers::pi / 180 * three();
  errors.thrust *= errors.size;
  if (const double angle = turn.norm(); angle > 0) {
    errors.thrust *= Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  }
  return errors;
}

class ErroneousFlights {
 public:
  ErroneousFlights(const Scene& scene, const ComputedProblem& orbit, const ThrustedFlight& flight,
                   FeedbackCostates& law, const std::vector<double>& costates, int panels)
      : start_time_(orbit.start_time),
        flight_(flight),
        law_(law),
        units_(metric_units(scene)),
        panels_(std::max(1, panels / static_cast<int>(law.count()))),
        system_(commanded_system(*orbit.system)),
        plan_(law.count()) {
    std::vector<double> z = flight.deputy(costates);
    for (std::size_t k = 0; k < law.count(); ++k) {
      plan_[k].start = z;
      flight.fly_on(z, law.time(k), law.time(k + 1), panels_, plan_[k].integrals);
    }
  }

  ErroneousFlight closed_loop(const std::vector<DrawnErrors>& errors) {
    return flown([&](std::size_t k, std::vector<double>& deputy, ThrustIntegrals& integrals) {
      const std::vector<double> noise = law_.frame(k).deviation(errors[k].navigation);
      std::vector<double> z =
          commanded(law_.with_costates(k, state_sum(deputy, noise)), deputy, errors[k]);
      flight_.fly_on(system_, {Places::costates[3], errors[k].size}, z, law_.time(k),
                     law_.time(k + 1), panels_, integrals);
      deputy = deputy_of(z);
    });
  }

  ErroneousFlight open_loop(const std::vector<DrawnErrors>& errors) {
    return flown([&](std::size_t k, std::vector<double>& deputy, ThrustIntegrals& integrals) {
      const double from = law_.time(k);
      deputy = deputy_of(exact_flow(system_, commanded(plan_[k].start, deputy, errors[k]),
                                    start_time_ + from, law_.time(k + 1) - from));
      const double size = std::abs(errors[k].size);
      integrals.energy_m2_s3 += size * size * plan_[k].integrals.energy_m2_s3;
      integrals.change_m_s += size * plan_[k].integrals.change_m_s;
    });
  }

 private:
  using Places = CommandedPlaces;
  static constexpr std::size_t states = ThrustedFlight::states;

  /// The planned flight from one instant to the next.
  struct Part {
    std::vector<double> start;  ///< state and costates
    ThrustIntegrals integrals;
  };

  static std::vector<double> commanded(const std::vector<double>& controller,
                                       const std::vector<double>& deputy,
                                       const DrawnErrors& errors) {
    std::vector<double> z(Places::count);
    for (std::size_t i = 0; i < states; ++i) {
      z[Places::believed[i]] = controller[i];
      z[Places::costates[i]] = controller[states + i];
      z[Places::spacecraft[i]] = deputy[i];
    }
    for (std::size_t i = 0; i < 9; ++i) {
      z[Places::matrix + i] =
          errors.thrust(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3));
    }
    return z;
  }

  static std::vector<double> deputy_of(const std::vector<double>& z) {
    std::vector<double> deputy;
    for (const std::size_t place : Places::spacecraft) deputy.push_back(z[place]);
    return deputy;
  }

  template <class FlyPart>
  ErroneousFlight flown(const FlyPart& fly_part) {
    ErroneousFlight result;
    try {
      std::vector<double> deputy = flight_.deputy(std::vector<double>(states, 0.0));
      deputy.resize(states);
      ThrustIntegrals integrals;
      for (std::size_t k = 0; k < law_.count(); ++k) fly_part(k, deputy, integrals);
      const ThrustedFlight::State miss = flight_.missing_at(deputy);
      result.miss_m = miss.head<3>().norm() * units_.length_m;
      result.velocity_miss_m_s = miss.tail<3>().norm() * units_.velocity_m_s();
      result.energy_m2_s3 = integrals.energy_m2_s3;
      result.change_m_s = integrals.change_m_s;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      result.failure = error.what();
    }
    return result;
  }

  ClockTime start_time_;
  const ThrustedFlight& flight_;
  FeedbackCostates& law_;
  MetricUnits units_;
  int panels_;
  SharedSystem system_;
  std::vector<Part> plan_;
};

}  // namespace

std::vector<ErrorSample> erroneous_flights(const Scene& scene, const ComputedProblem& orbit,
                                           const ThrustedFlight& flight, FeedbackCostates& law,
                                           const std::vector<double>& costates, int panels,
                                           const ProgressCallback& progress) {
  const ThrustErrorSettings& settings = *scene.transfer->errors;
  ErroneousFlights flights(scene, orbit, flight, law, costates, panels);
  StandardNormals normal(settings.seed);
  std::vector<ErrorSample> samples;
  for (int i = 0; i < settings.samples; ++i) {
    if (progress) progress("flights under errors", static_cast<double>(i) / settings.samples);
    std::vector<DrawnErrors> errors;
    for (std::size_t k = 0; k < law.count(); ++k) errors.push_back(draw(settings, normal));
    samples.push_back({flights.closed_loop(errors), flights.open_loop(errors)});
  }
  return samples;
}

}  // namespace hamjet
