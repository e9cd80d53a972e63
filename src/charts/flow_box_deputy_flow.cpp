#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "../integrators/taylor_flow.hpp"
#include "hamjet/charts/deputy_flow.hpp"
#include "hamjet/detail/dynamics/slice_evaluator.hpp"
#include "hamjet/error.hpp"
#include "linear_chart.hpp"
#include "steady_turn.hpp"

namespace hamjet {
namespace {

constexpr double infinitesimal = 4 * std::numeric_limits<double>::epsilon();
/// A search ends by a last step along the straight line through its last two points where the
/// product of their misses is below this number. The curvature of the function that is searched is
/// of the order of 1.
constexpr double straight = 1e-17;

/// The numbers that bypass the polynomials.
enum Carried : std::size_t {
  time_since_section,
  energy,
  ignored_coordinate,
  steady_time,
  steady_pericentre,
  steady_node
};

std::vector<Series<double>> values_of(const FlowBoxMap<double>& map) {
  std::vector<Series<double>> values = {map.time};
  values.insert(values.end(), map.coordinates.begin(), map.coordinates.end());
  return values;
}

/// A field's Hamiltonian at single states.
class Energy {
 public:
  explicit Energy(const SharedSystem& system)
      : system_(system), list_(system_->hamiltonian, SeriesSpace::create(1, 0), 0) {}

  double operator()(const SixNumbers<double>& state) {
    for (std::size_t i = 0; i < 6; ++i) *list_.input(i) = state[i];
    list_.evaluate_constant_values();
    return *list_.output(0);
  }

  SixNumbers<double> gradient(const SixNumbers<double>& state) {
    for (std::size_t i = 0; i < 6; ++i) *list_.input(i) = state[i];
    list_.evaluate_constant_terms();
    SixNumbers<double> result;
    for (std::size_t i = 0; i < 6; ++i) result[i] = list_.output_gradient(0, i);
    return result;
  }

 private:
  SharedSystem system_;
  SliceEvaluator<double, double> list_;
};

class FlowBoxDeputyFlow : public DeputyFlow {
 public:
  FlowBoxDeputyFlow(const ZonalGravity& field, const FlowBoxMap<double>& map)
      : DeputyFlow(values_of(map), map.end->chart().state(map.end->chief())),
        system_(zonal_gravity(field)),
        map_(map),
        start_state_(map.start->chart().state(map.start->chief())) {
    set_derivatives(entry(), exit());
  }

 private:
  Matrix<double> entry() const {
    const FlowSection<double>& section = *map_.start;
    const Matrix<double> coordinates = coordinates_derivative(section.chart(), start_state_);
    Energy energy(system_);
    const SixNumbers<double> gradient = energy.gradient(start_state_);
    Eigen::Matrix<double, 1, 6> by_state;
    Eigen::Matrix<double, 6, 1> field;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      by_state[i] = gradient[k];
      by_state[i + 3] = gradient[k + 3];
      field[i] = gradient[k + 3];
      field[i + 3] = -gradient[k];
    }
    Matrix<double> result(variables(), 6);
    const double slope = section.is_bound() ? -1.5 / section.energy() : 1 / section.energy_unit();
    result.row(0) = slope * by_state;
    // A state is carried back along the flow until its angle equals the chief's.
    const Eigen::Matrix<double, 6, 1> rates = coordinates * field;
    for (std::size_t k = 0; k < section.places().size(); ++k) {
      const auto place = static_cast<Eigen::Index>(section.places()[k]);
      result.row(static_cast<Eigen::Index>(k) + 1) =
          coordinates.row(place) - rates[place] / rates[0] * coordinates.row(0);
    }
    return result;
  }

  Matrix<double> exit() const {
    const FlowSection<double>& section = *map_.end;
    const Matrix<double> by_variables =
        linear_part(section.states(SeriesSpace::create(section.variables(), 1)));
    Matrix<double> result =
        Matrix<double>::Zero(6, static_cast<Eigen::Index>(polynomials().size()));
    Energy energy(system_);
    const SixNumbers<double> gradient = energy.gradient(chief_end());
    for (std::size_t i = 0; i < 3; ++i) {
      result(static_cast<Eigen::Index>(i), 0) = -gradient[i + 3];
      result(static_cast<Eigen::Index>(i) + 3, 0) = gradient[i];
    }
    const auto column = [&](std::size_t place) {
      const auto& places = section.places();
      return 1 + std::find(places.begin(), places.end(), place) - places.begin();
    };
    for (const std::size_t place : section.places()) {
      result.col(column(place)) = by_variables.col(column(place));
    }
    // The steady motion turns the values before they are used as coordinates.
    const SteadyMotion<double> steady = map_.steady(map_.start->energy(), map_.start->chief());
    const auto turn = [&](std::size_t pair, double angle) {
      const Eigen::Matrix<double, 6, 1> q = result.col(column(pair));
      const Eigen::Matrix<double, 6, 1> p = result.col(column(pair + 3));
      result.col(column(pair)) = q * std::cos(angle) + p * std::sin(angle);
      result.col(column(pair + 3)) = p * std::cos(angle) - q * std::sin(angle);
    };
    if (section.chart().is_of_elements()) {
      turn(pericentre_place(section.ignored()), steady.pericentre);
      if (!section.ignored()) turn(node_pair_place, steady.node);
    }
    if (section.ignored()) {
      result.col(result.cols() - 1) = state_derivative(section.chart(), section.chief())
                                          .col(static_cast<Eigen::Index>(*section.ignored()));
    }
    return result;
  }

  struct Through : Passage {
    explicit Through(const FlowBoxDeputyFlow& of)
        : flow(of),
          taylor(of.system_),
          energy_of(of.system_),
          rate_share(of.map_.start->rate() / keplerian_rate(of.map_.start->chief())) {}

    /// The search for the time at which a lane's angle is the chief's.
    struct Search {
      SixNumbers<double> base;         ///< state about which the polynomial in time is expanded
      double until_base = 0;           ///< time from the deputy to that state
      double time = 0;                 ///< time from that state
      SixNumbers<double> coordinates;  ///< coordinates at that time
      double angle = 0;                ///< angle at that time, minus the chief's
      double rate = 0;                 ///< rate of the angle, approximately
      double least_angle = 1;          ///< least angle that was found
      int iterations = 0;
      bool is_over = false;
      bool has_moved = false;  ///< the base has moved since the last expansion
    };

    double angle_of(const SixNumbers<double>& coordinates) const {
      return within_half_a_turn(coordinates[0] - flow.map_.start->chief()[0]);
    }

    void begin(Search& search) const {
      search.coordinates = flow.map_.start->chart().coordinates(search.base);
      search.angle = angle_of(search.coordinates);
      search.rate = rate_of(search.coordinates);
    }

    /// Continues by the secant method until the angle vanishes, or to the end of the interval in
    /// which the lane's polynomial holds.
    void go_on(Search& search, std::size_t lane) const {
      constexpr int most_iterations = 100;
      search.has_moved = false;
      while (!search.is_over && !search.has_moved) {
        double change = -search.angle / search.rate;
        const bool is_lost = !std::isfinite(change) || ++search.iterations == most_iterations;
        // Where rounding alone moves the angle back and forth, the search stops.
        const bool is_rounding = std::abs(search.angle) <= 256 * infinitesimal &&
                                 std::abs(search.angle) >= search.least_angle / 2;
        search.least_angle = std::min(search.least_angle, std::abs(search.angle));
        search.is_over = is_lost || is_rounding || std::abs(search.angle) <= infinitesimal;
        const double wanted = search.time + change;
        const double time = search.is_over ? 0 : taylor.within_reach(lane, wanted);
        // Where the field is not finite, no time is within reach.
        if (is_lost || (!search.is_over && time == 0 && wanted != 0)) {
          search.coordinates.fill(std::numeric_limits<double>::quiet_NaN());
          search.is_over = true;
        }
        if (search.is_over) return;
        SixNumbers<double> there;
        taylor.evaluate(lane, time, there);
        change = time - search.time;
        search.time = time;
        const SixNumbers<double> last = search.coordinates;
        const double last_angle = search.angle;
        search.coordinates = flow.map_.start->chart().coordinates(there);
        search.angle = angle_of(search.coordinates);
        const double about = rate_of(search.coordinates);
        const double secant = (search.angle - last_angle) / change;
        const bool is_usable = secant > 0.2 * about && secant < 5 * about;
        search.rate = is_usable ? secant : about;
        if (time == wanted && is_usable && std::abs(search.angle * last_angle) <= straight) {
          // The number of such changes that are left.
          const double rest = -search.angle / (search.angle - last_angle);
          search.time += rest * change;
          for (std::size_t i = 0; i < 6; ++i) {
            const double moved = search.coordinates[i] - last[i];
            search.coordinates[i] += rest * (is_angle(i) ? within_half_a_turn(moved) : moved);
          }
          search.is_over = true;
          return;
        }
        if (time == wanted) continue;
        search.has_moved = true;
        search.base = there;
        search.until_base += time;
        search.time = 0;
      }
    }

    /// Flies the deputies to the section.
    void fly_to_section(std::span<Search> searches) {
      for (Search& search : searches) begin(search);
      for (std::size_t lane = 0; lane < block; ++lane) {
        taylor.set_state(lane, ClockTime::epoch(),
                         searches[lane < searches.size() ? lane : 0].base);
      }
      bool is_over = false;
      while (!is_over) {
        // Perturbations make the true rate differ from the known one by a small fraction.
        constexpr double margin = 1.01;
        std::array<double, block> wanted{};
        for (std::size_t lane = 0; lane < searches.size(); ++lane) {
          const Search& search = searches[lane];
          if (!search.is_over) wanted[lane] = margin * search.angle / search.rate;
        }
        taylor.expand(wanted);
        is_over = true;
        for (std::size_t lane = 0; lane < searches.size(); ++lane) {
          Search& search = searches[lane];
          if (search.is_over) continue;
          go_on(search, lane);
          if (search.has_moved) taylor.set_state(lane, ClockTime::epoch(), search.base);
          is_over = is_over && search.is_over;
        }
      }
    }

    bool is_angle(std::size_t place) const { return flow.map_.start->chart().is_angle(place); }

    /// Kepler's rate of the angle times the ratio of the chief's rate to Kepler's.
    double rate_of(const SixNumbers<double>& z) const { return rate_share * keplerian_rate(z); }

    double keplerian_rate(const SixNumbers<double>& z) const {
      switch (flow.map_.start->chart().name()) {
        case ChartName::spherical:
          return z[3] / std::pow(z[1] * std::cos(z[2]), 2);
        case ChartName::cylindrical:
          return z[3] / (z[1] * z[1]);
        default:
          return flow.map_.mu * flow.map_.mu / (z[3] * z[3] * z[3]);
      }
    }

    void enter(std::span<const SixNumbers<double>> deviations, std::span<double> variables,
               std::span<SixNumbers<double>> carried) override {
      const FlowSection<double>& section = *flow.map_.start;
      std::array<Search, block> searches;
      for (std::size_t k = 0; k < deviations.size(); ++k) {
        searches[k].base = flow.start_state_;
        for (std::size_t i = 0; i < 6; ++i) searches[k].base[i] += deviations[k][i];
        carried[k][energy] = energy_of(searches[k].base);
      }
      fly_to_section(std::span(searches).first(deviations.size()));
      for (std::size_t k = 0; k < deviations.size(); ++k) {
        const SixNumbers<double>& coordinates = searches[k].coordinates;
        double* const u = &variables[k * section.variables()];
        u[0] = section.variable_of(carried[k][energy]);
        for (std::size_t v = 0; v < section.places().size(); ++v) {
          const std::size_t place = section.places()[v];
          u[v + 1] = coordinates[place] - section.chief()[place];
          if (section.chart().is_angle(place)) u[v + 1] = within_half_a_turn(u[v + 1]);
        }
        const SteadyMotion<double> steady = flow.map_.steady(carried[k][energy], coordinates);
        carried[k][time_since_section] = -(searches[k].until_base + searches[k].time);
        carried[k][ignored_coordinate] = section.ignored() ? coordinates[*section.ignored()] : 0;
        carried[k][steady_time] = steady.time;
        carried[k][steady_pericentre] = steady.pericentre;
        carried[k][steady_node] = steady.node;
      }
    }

    void leave(std::span<const SixNumbers<double>> carried, std::span<const double> values,
               std::span<SixNumbers<double>> deviations) override {
      std::array<double, 6 * block> states;
      std::array<double, block> times;
      const std::size_t count = carried.size();
      const std::size_t width = values.size() / count;
      for (std::size_t k = 0; k < count; ++k) {
        const std::span<const double> of_one = values.subspan(k * width, width);
        times[k] = carried[k][time_since_section] + flow.map_.duration - carried[k][steady_time] -
                   of_one[0];
        const SixNumbers<double> state = state_on_section(carried[k], of_one);
        std::copy_n(state.begin(), 6, &states[6 * k]);
        if (!std::isfinite(times[k])) times[k] = 0;
      }
      taylor.advance(std::span(states).first(6 * count), ClockTime::epoch(),
                     std::span(times).first(count));
      for (std::size_t k = 0; k < count; ++k) {
        for (std::size_t i = 0; i < 6; ++i) {
          deviations[k][i] = states[6 * k + i] - flow.chief_end()[i];
        }
      }
    }

    /// The state on the end's section, from the numbers that bypassed the polynomials and from the
    /// polynomials' values.
    SixNumbers<double> state_on_section(const SixNumbers<double>& carried,
                                        std::span<const double> values) {
      const FlowSection<double>& section = *flow.map_.end;
      SixNumbers<double> z = section.chief();
      for (std::size_t k = 0; k < section.places().size(); ++k) {
        z[section.places()[k]] = values[k + 1];
      }
      const SteadyMotion<double> steady{carried[steady_time], carried[steady_pericentre],
                                        carried[steady_node]};
      turn_steadily(section, steady, z);
      if (section.ignored()) {
        z[*section.ignored()] = carried[ignored_coordinate] + carried[steady_node] + values.back();
      }
      SixNumbers<double> state;
      if (!find_state(carried[energy], z, state)) {
        state.fill(std::numeric_limits<double>::quiet_NaN());
      }
      return state;
    }

    /// Finds the state of this energy on the end's section, by the secant method on the momentum of
    /// the angle. Returns false if there is no such state near the chief's.
    bool find_state(double wanted, SixNumbers<double> z, SixNumbers<double>& state) {
      constexpr int most_iterations = 40;
      const FlowSection<double>& section = *flow.map_.end;
      if (section.is_bound() && section.chart().is_of_elements()) {
        z[3] *= std::sqrt(section.energy() / wanted);
      }
      double slope = section.rate();
      SixNumbers<double> last_state{};
      double last_excess = 0;
      double least_excess = std::numeric_limits<double>::infinity();
      double change = 0;
      for (int i = 0; i < most_iterations; ++i) {
        state = section.chart().state(z);
        const double excess = energy_of(state) - wanted;
        if (!std::isfinite(excess)) return false;
        // The energy is a difference of two numbers as large as the kinetic energy, and its
        // rounding adds to that of the chart: close to the root, rounding alone moves it back and
        // forth.
        const double size = (state[3] * state[3] + state[4] * state[4] + state[5] * state[5]) / 2 +
                            std::abs(wanted);
        const bool is_rounding =
            std::abs(excess) <= 256 * infinitesimal * size && std::abs(excess) >= least_excess / 2;
        if (is_rounding || std::abs(excess) <= infinitesimal * size) return true;
        least_excess = std::min(least_excess, std::abs(excess));
        const double secant = (excess - last_excess) / change;
        const bool is_usable = i > 0 && secant > 0.2 * slope && secant < 5 * slope;
        if (is_usable && std::abs(excess * last_excess) <= straight * size * size) {
          const double rest = -excess / (excess - last_excess);
          for (std::size_t k = 0; k < 6; ++k) state[k] += rest * (state[k] - last_state[k]);
          return true;
        }
        if (is_usable) slope = secant;
        change = -excess / slope;
        last_excess = excess;
        last_state = state;
        z[3] += change;
      }
      return false;
    }

    const FlowBoxDeputyFlow& flow;
    TaylorFlow taylor;
    Energy energy_of;
    double rate_share;
  };
  std::unique_ptr<Passage> passage() const override { return std::make_unique<Through>(*this); }

  SharedSystem system_;
  FlowBoxMap<double> map_;
  SixNumbers<double> start_state_;
};

}  // namespace

std::unique_ptr<DeputyFlow> flow_box_deputy_flow(const ZonalGravity& field,
                                                 const FlowBoxMap<double>& map) {
  return std::make_unique<FlowBoxDeputyFlow>(field, map);
}

}  // namespace hamjet
