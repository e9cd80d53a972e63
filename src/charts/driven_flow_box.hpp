#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/charts/deputy_flow.hpp"
#include "hamjet/dynamics/clock_time.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"
#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// The elements in which flow boxes of forces that depend on the time are told for a chief: nodal
/// ones, or Poincaré's near the equatorial plane.
ChartName driven_flow_box_elements(const SixNumbers<double>& chief, double mu);

/// A flow box for forces that depend on the time: from all states at a start to the times and
/// places at which they cross a section, the angle along the orbit at which the chief ends. About
/// an oblate body the steady motion (see secular_rates) is taken out in closed form.
///
/// The variables u at the start, at one time of the clock, are the differences from the chief's
/// elements: those of the nodal chart, or Poincaré's near the equatorial plane. Only L is replaced,
/// by P/P_chief - 1, the period of the energy in the field of the mass and its J2. The steady
/// motion crosses the section at the time
///
///   t_s(u) = (rate_chief T - u_0) / rate(u) ,
///
/// until which pericentre and node turn steadily too. The values are what all forces make beyond
/// this: the time of crossing less t_s, and the elements there (without the angle) less the
/// chief's, turned back, with L less what the period asks for. They vary slowly with u, since at a
/// given angle neighbours see the same periodic forces of the body's zonals; those of its turning
/// differ by its turn in the time between the crossings.
///
/// The polynomials follow from jets in positions and momenta without another integration of the
/// series' equations: the start's states are composed with the jets at times about the end, and
/// the time of crossing is solved for as a series. To the order this is exact. Where the jets are
/// expanded in parameters too, these are further variables, which differ from the chief's.
class DrivenFlowBox {
 public:
  /// `about_end[k]` is the coefficient of t^k, the time after the end, of the jet in positions and
  /// momenta, for k from 0 to the order. Throws Error(numerical) where the chief's orbit is no
  /// ellipse, and Error(usage) unless the jets have six components, perhaps followed by those of
  /// parameters, in as many variables.
  DrivenFlowBox(const SixNumbers<double>& start, std::vector<FlowJet<double>> about_end,
                double duration, double mu, double oblateness);

  /// The polynomials of the values in u, without constant terms.
  const std::vector<Series<double>>& values() const noexcept { return values_; }
  const SixNumbers<double>& start_state() const noexcept { return start_state_; }
  std::array<std::string, 6> variable_names() const;
  std::array<std::string, 6> value_names() const;

  /// The variables of a state at the start; not finite for a state on no ellipse.
  SixNumbers<double> variables(const SixNumbers<double>& state) const;
  struct Crossing {
    SixNumbers<double> state;
    double time = 0;  ///< after the end of the flight
  };
  /// The crossing of the section that belongs to variables and values.
  Crossing crossing(const SixNumbers<double>& variables, const SixNumbers<double>& values) const;

  /// The chief's state at the end, and its derivative by the time.
  const SixNumbers<double>& chief_end() const noexcept { return end_state_; }
  SixNumbers<double> chief_rate() const;
  /// The derivatives, at the chief, of all variables by the state, and of the state at the end by
  /// the values.
  Matrix<double> entry_derivative() const;
  Matrix<double> exit_derivative() const;

  /// As flow_box_coordinates: the time since the section, the period less the chief's, and the
  /// other elements at the section, as series in the initial deviations.
  std::vector<Series<double>> end_coordinates() const;
  std::array<std::string, 6> end_coordinate_names() const;

 private:
  template <class T>
  struct Steady;
  struct SeriesCrossing {
    SixNumbers<Series<double>> elements;
    Series<double> time;
    Series<double> energy;
  };

  template <class T>
  T energy(const SixNumbers<T>& state) const;
  template <class T>
  Steady<T> steady(const SixNumbers<T>& variables) const;
  template <class T>
  void turn(SixNumbers<T>& elements, const Steady<T>& steady, double sign) const;
  bool is_nodal() const { return start_.name() == ChartName::nodal; }
  /// The states at the start as series in the variables.
  SixNumbers<Series<double>> states(const SpacePointer& space) const;
  /// The crossings of states at the start, given as deviations from the chief's, with parameters
  /// that are variables of their series behind them.
  SeriesCrossing crossing_of(const SixNumbers<Series<double>>& states) const;

  std::vector<FlowJet<double>> about_end_;
  double duration_;
  double mu_;
  double oblateness_;
  SixNumbers<double> start_state_;
  SixNumbers<double> end_state_;
  CanonicalChart<double> start_;
  CanonicalChart<double> end_;
  SixNumbers<double> start_elements_;
  SixNumbers<double> end_elements_;
  double energy_;
  double energy_slope_ = 0;  ///< derivative of the energy by L at the chief's start
  double rate_ = 0;          ///< of the angle at the chief's end
  double steady_rate_ = 0;   ///< of the chief's steady angle
  std::vector<Series<double>> values_;
};

/// What the states of deputies end with: the parameters that they all have, and how much these are
/// above the chief's.
struct DeputyParameters {
  std::vector<double> values;
  std::vector<double> differences;
};

/// The flow of deputies by a box. Each is carried from its crossing to the end by the full
/// equations, of the system whose clock stands at `end_time` there. Throws Error(usage) unless the
/// box is expanded in as many parameters.
std::unique_ptr<DeputyFlow> driven_flow_box_deputy_flow(const SharedSystem& system,
                                                        const ClockTime& end_time,
                                                        std::shared_ptr<const DrivenFlowBox> box,
                                                        DeputyParameters parameters = {});

}  // namespace hamjet
