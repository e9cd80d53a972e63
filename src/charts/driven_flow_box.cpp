#include "driven_flow_box.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <utility>

#include "hamjet/algebra/composition.hpp"
#include "hamjet/algebra/elementary_functions.hpp"
#include "hamjet/charts/flow_box.hpp"
#include "hamjet/charts/flow_box_states.hpp"
#include "hamjet/error.hpp"
#include "linear_chart.hpp"
#include "plane_elements.hpp"
#include "secular_motion.hpp"
#include "steady_turn.hpp"

namespace hamjet {
namespace {

/// What the steady motion is described by, in the order of the elements.
constexpr std::size_t period_place = 3;

SixNumbers<double> constants(const FlowJet<double>& jet) {
  SixNumbers<double> result;
  for (std::size_t i = 0; i < 6; ++i) result[i] = jet[i][0];
  return result;
}

/// The jets without the components of parameters, which stay as they are.
std::vector<FlowJet<double>> of_states(std::vector<FlowJet<double>> about_end) {
  const bool is_usable = !about_end.empty() && about_end.front().size() >= 6 &&
                         about_end.front().front().space().variables() == about_end.front().size();
  if (!is_usable) {
    throw Error(ErrorKind::usage,
                "flow box: a jet of six components, and of one for each parameter, in as many "
                "variables is needed");
  }
  for (FlowJet<double>& jet : about_end) jet.erase(jet.begin() + 6, jet.end());
  return about_end;
}

/// Deviations in all variables of their space, of which those of parameters stand for themselves.
std::vector<Series<double>> with_parameters(const SixNumbers<Series<double>>& states) {
  std::vector<Series<double>> result =
      without_constants(std::vector<Series<double>>(states.begin(), states.end()));
  const SpacePointer& space = states[0].space_pointer();
  for (std::size_t v = 6; v < space->variables(); ++v) {
    result.push_back(Series<double>::variable(space, v, 0.0));
  }
  return result;
}

}  // namespace

ChartName driven_flow_box_elements(const SixNumbers<double>& chief, double mu) {
  return section_chart(chief, mu) == ChartName::nodal ? ChartName::nodal : ChartName::poincare;
}

/// Of the steady motion until the section is crossed.
template <class T>
struct DrivenFlowBox::Steady {
  T time;        ///< of the crossing, after the end of the flight
  T pericentre;  ///< the angle by which the pericentre turns further than the chief's
  T node;        ///< likewise
  T L;           ///< how much larger L is than the chief's
};

template <class T>
T DrivenFlowBox::energy(const SixNumbers<T>& z) const {
  using std::sqrt;
  const T square = z[0] * z[0] + z[1] * z[1] + z[2] * z[2];
  const T inverse = 1.0 / sqrt(square);
  const T kinetic = (z[3] * z[3] + z[4] * z[4] + z[5] * z[5]) * 0.5;
  return kinetic - mu_ * inverse +
         (mu_ * oblateness_ / 2) * (inverse / square) * (3.0 * (z[2] * z[2] / square) - 1.0);
}

template <class T>
DrivenFlowBox::Steady<T> DrivenFlowBox::steady(const SixNumbers<T>& u) const {
  using std::pow;
  using std::sqrt;
  const auto rates_of = [&](const auto& variables) {
    using Number = std::decay_t<decltype(variables[0])>;
    const auto at = [&](std::size_t i) { return Number(variables[i] + start_elements_[i]); };
    const auto half_square = [&](std::size_t i) {
      return Number((at(i) * at(i) + at(i + 3) * at(i + 3)) * 0.5);
    };
    const Number of_energy = energy_ * pow(Number(variables[period_place] + 1.0), -2.0 / 3.0);
    const Number L = mu_ / sqrt(Number(-2.0 * of_energy));
    const Number eccentric = half_square(is_nodal() ? 2 : 1);
    const Number H = is_nodal() ? at(4) : Number(L - eccentric - half_square(node_pair_place));
    const auto rates = secular_rates<double, Number>(of_energy, eccentric, H, mu_, oblateness_);
    const Number pericentre = is_nodal() ? rates.pericentre : Number(rates.pericentre + rates.node);
    return std::array<Number, 4>{Number(rates.anomaly + pericentre), pericentre, rates.node, L};
  };
  const std::array<T, 4> own = rates_of(u);
  const std::array<double, 4> chief = rates_of(SixNumbers<double>{});
  const T crossing = (chief[0] * duration_ - u[0]) / own[0];
  return {crossing - duration_, own[1] * crossing - chief[1] * duration_,
          own[2] * crossing - chief[2] * duration_, own[3] - chief[3]};
}

template <class T>
void DrivenFlowBox::turn(SixNumbers<T>& z, const Steady<T>& steady, double sign) const {
  const std::size_t pair = is_nodal() ? 2 : 1;
  turn_pair<double>(z[pair], z[pair + 3], T(steady.pericentre * sign));
  if (!is_nodal()) {
    turn_pair<double>(z[node_pair_place], z[node_pair_place + 3], T(steady.node * sign));
  }
}

DrivenFlowBox::DrivenFlowBox(const SixNumbers<double>& start,
                             std::vector<FlowJet<double>> about_end, double duration, double mu,
                             double oblateness)
    : about_end_(of_states(std::move(about_end))),
      duration_(duration),
      mu_(mu),
      oblateness_(oblateness),
      start_state_(start),
      end_state_(constants(about_end_.front())),
      start_(driven_flow_box_elements(start, mu), start, mu),
      end_(start_.name(), end_state_, mu),
      start_elements_(start_.coordinates(start)),
      end_elements_(end_.coordinates(end_state_)),
      energy_(energy(start)) {
  const SpacePointer linear = SeriesSpace::create(6, 1);
  energy_slope_ = energy(start_.state(moved(start_elements_, linear)))[linear->linear_index(3)];
  const Matrix<double> by_state = coordinates_derivative(end_, end_state_);
  const SixNumbers<double> rate = chief_rate();
  for (std::size_t i = 0; i < 6; ++i) rate_ += by_state(0, static_cast<Eigen::Index>(i)) * rate[i];

  const SpacePointer space = about_end_.front().front().space_pointer();
  SeriesCrossing crossing = crossing_of(states(space));
  const SixNumbers<Series<double>> u = moved(SixNumbers<double>{}, space);
  const Steady<Series<double>> steady_motion = steady(u);
  SixNumbers<Series<double>>& z = crossing.elements;
  turn(z, steady_motion, -1);
  z[0] = crossing.time - steady_motion.time;
  if (is_nodal()) z[1] -= u[1] + steady_motion.node;
  z[3] -= steady_motion.L;
  values_ = without_constants(std::vector<Series<double>>(z.begin(), z.end()));
}

SixNumbers<double> DrivenFlowBox::chief_rate() const {
  return about_end_.size() > 1 ? constants(about_end_[1]) : SixNumbers<double>{};
}

SixNumbers<Series<double>> DrivenFlowBox::states(const SpacePointer& space) const {
  SixNumbers<Series<double>> z = moved(start_elements_, space);
  const Series<double> wanted =
      energy_ * pow(Series<double>::variable(space, period_place, 1.0), -2.0 / 3.0);
  z[3] = Series<double>(space, start_elements_[3]);
  // Newton's method with the chief's derivative makes one more degree right in each iteration; the
  // last iteration removes rounding errors.
  for (int i = 0; i <= space->order(); ++i) {
    Series<double> excess = energy(start_.state(z)) - wanted;
    excess[0] = 0;
    z[3] -= excess / energy_slope_;
  }
  return start_.state(z);
}

DrivenFlowBox::SeriesCrossing DrivenFlowBox::crossing_of(
    const SixNumbers<Series<double>>& states) const {
  const std::vector<Series<double>> deviations = with_parameters(states);
  std::vector<std::vector<Series<double>>> powers;
  for (const FlowJet<double>& jet : about_end_) powers.push_back(compose(jet, deviations));
  const SpacePointer& space = deviations[0].space_pointer();
  SeriesCrossing result{moved(end_state_, space), Series<double>(space), Series<double>(space)};
  SixNumbers<Series<double>> state = result.elements;
  // Newton's method with the chief's rate: each iteration makes one more degree right.
  for (int i = 0; i <= space->order(); ++i) {
    for (std::size_t c = 0; c < 6; ++c) {
      state[c] = powers.back()[c];
      for (std::size_t k = powers.size() - 1; k-- > 0;) {
        state[c] = state[c] * result.time + powers[k][c];
      }
    }
    result.elements = end_.coordinates(state);
    if (i == space->order()) break;
    Series<double> left = (result.elements[0] - end_elements_[0]) / rate_;
    left[0] = 0;
    result.time -= left;
  }
  result.energy = energy(state);
  return result;
}

SixNumbers<double> DrivenFlowBox::variables(const SixNumbers<double>& state) const {
  SixNumbers<double> u = start_.coordinates(state);
  for (std::size_t i = 0; i < 6; ++i) {
    u[i] -= start_elements_[i];
    if (start_.is_angle(i)) u[i] = within_half_a_turn(u[i]);
  }
  // (E / E_chief)^(-3/2) - 1, without loss of digits near 0.
  u[period_place] = std::expm1(-1.5 * std::log1p((energy(state) - energy_) / energy_));
  return u;
}

DrivenFlowBox::Crossing DrivenFlowBox::crossing(const SixNumbers<double>& u,
                                                const SixNumbers<double>& values) const {
  const Steady<double> steady_motion = steady(u);
  SixNumbers<double> z = end_elements_;
  for (std::size_t i = 1; i < 6; ++i) z[i] += values[i];
  turn(z, steady_motion, 1);
  if (is_nodal()) z[1] += u[1] + steady_motion.node;
  z[3] += steady_motion.L;
  return {end_.state(z), steady_motion.time + values[0]};
}

Matrix<double> DrivenFlowBox::entry_derivative() const {
  const std::size_t variables = about_end_.front().front().space().variables();
  Matrix<double> result = Matrix<double>::Zero(static_cast<Eigen::Index>(variables), 6);
  result.topRows(6) = linear_part(states(SeriesSpace::create(6, 1))).inverse();
  return result;
}

Matrix<double> DrivenFlowBox::exit_derivative() const {
  Matrix<double> result = state_derivative(end_, end_elements_);
  // A later crossing is carried back along the flow.
  const SixNumbers<double> rate = chief_rate();
  for (std::size_t i = 0; i < 6; ++i) result(static_cast<Eigen::Index>(i), 0) = -rate[i];
  return result;
}

std::vector<Series<double>> DrivenFlowBox::end_coordinates() const {
  const SpacePointer space = about_end_.front().front().space_pointer();
  const SeriesCrossing crossing = crossing_of(moved(SixNumbers<double>{}, space));
  std::vector<Series<double>> result = {-crossing.time,
                                        pow(crossing.energy / crossing.energy[0], -1.5)};
  for (const std::size_t i : {1U, 2U, 4U, 5U}) result.push_back(crossing.elements[i]);
  return without_constants(result);
}

std::array<std::string, 6> DrivenFlowBox::variable_names() const {
  std::array<std::string, 6> names = coordinate_names(start_.name());
  names[period_place] = "period";
  return names;
}

std::array<std::string, 6> DrivenFlowBox::value_names() const {
  std::array<std::string, 6> names = coordinate_names(start_.name());
  names[0] = "tau";
  return names;
}

std::array<std::string, 6> DrivenFlowBox::end_coordinate_names() const {
  const std::array<std::string, 6> names = coordinate_names(start_.name());
  return {"tau", "period", names[1], names[2], names[4], names[5]};
}

}  // namespace hamjet
