#include <algorithm>
#include <utility>

#include "hamjet/charts/deputy_flow.hpp"
#include "hamjet/error.hpp"
#include "linear_chart.hpp"

namespace hamjet {
namespace {

class ChartedDeputyFlow : public DeputyFlow {
 public:
  ChartedDeputyFlow(const CanonicalChart<double>& start, const SixNumbers<double>& start_state,
                    const CanonicalChart<double>& end, const SixNumbers<double>& end_state,
                    const FlowMap<double>& map)
      : DeputyFlow(without_constants(map.jet()), end_state),
        start_(start),
        end_(end),
        start_state_(start_state),
        start_coordinates_(start.coordinates(start_state)),
        end_coordinates_(end.coordinates(end_state)) {
    if (map.components() != 6 || map.variables() != 6) {
      throw Error(ErrorKind::usage, "deputy: a map of six components in six variables is needed");
    }
    set_derivatives(coordinates_derivative(start_, start_state_),
                    state_derivative(end_, end_coordinates_));
  }

 private:
  struct Through : Passage {
    explicit Through(const ChartedDeputyFlow& of) : flow(of) {}

    void enter(std::span<const SixNumbers<double>> deviations, std::span<double> variables,
               std::span<SixNumbers<double>>) override {
      for (std::size_t k = 0; k < deviations.size(); ++k) {
        SixNumbers<double> state = flow.start_state_;
        for (std::size_t i = 0; i < 6; ++i) state[i] += deviations[k][i];
        const SixNumbers<double> coordinates = flow.start_.coordinates(state);
        for (std::size_t i = 0; i < 6; ++i) {
          double& variable = variables[6 * k + i];
          variable = coordinates[i] - flow.start_coordinates_[i];
          if (flow.start_.is_angle(i)) variable = within_half_a_turn(variable);
        }
      }
    }

    void leave(std::span<const SixNumbers<double>>, std::span<const double> values,
               std::span<SixNumbers<double>> deviations) override {
      for (std::size_t k = 0; k < deviations.size(); ++k) {
        SixNumbers<double> coordinates = flow.end_coordinates_;
        for (std::size_t i = 0; i < 6; ++i) coordinates[i] += values[6 * k + i];
        deviations[k] = flow.end_.state(coordinates);
        for (std::size_t i = 0; i < 6; ++i) deviations[k][i] -= flow.chief_end()[i];
      }
    }

    const ChartedDeputyFlow& flow;
  };
  std::unique_ptr<Passage> passage() const override { return std::make_unique<Through>(*this); }

  CanonicalChart<double> start_;
  CanonicalChart<double> end_;
  SixNumbers<double> start_state_;
  SixNumbers<double> start_coordinates_;
  SixNumbers<double> end_coordinates_;
};

}  // namespace

std::unique_ptr<DeputyFlow> charted_deputy_flow(const CanonicalChart<double>& start,
                                                const SixNumbers<double>& start_state,
                                                const CanonicalChart<double>& end,
                                                const SixNumbers<double>& end_state,
                                                const FlowMap<double>& map) {
  return std::make_unique<ChartedDeputyFlow>(start, start_state, end, end_state, map);
}

}  // namespace hamjet
