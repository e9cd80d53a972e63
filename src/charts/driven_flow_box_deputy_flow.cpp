#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "../integrators/taylor_flow.hpp"
#include "driven_flow_box.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

class DrivenDeputyFlow : public DeputyFlow {
 public:
  DrivenDeputyFlow(SharedSystem system, const ClockTime& end_time,
                   std::shared_ptr<const DrivenFlowBox> box, DeputyParameters parameters)
      : DeputyFlow(box->values(), box->chief_end()),
        system_(std::move(system)),
        end_time_(end_time.in<double>()),
        start_(box->start_state()),
        box_(std::move(box)),
        parameters_(std::move(parameters)) {
    const std::size_t count = parameters_.differences.size();
    if (variables() != 6 + count || parameters_.values.size() != count) {
      throw Error(ErrorKind::usage, "flow box: other parameters than those it is expanded in");
    }
    set_derivatives(box_->entry_derivative(), box_->exit_derivative());
  }

 private:
  struct CarriedBack : Passage {
    explicit CarriedBack(const DrivenDeputyFlow& of)
        : flow(of), width(of.variables()), taylor(of.system_) {}

    void enter(std::span<const SixNumbers<double>> deviations, std::span<double> variables,
               std::span<SixNumbers<double>> carried) override {
      for (std::size_t k = 0; k < deviations.size(); ++k) {
        SixNumbers<double> state = flow.start_;
        for (std::size_t i = 0; i < 6; ++i) state[i] += deviations[k][i];
        carried[k] = flow.box_->variables(state);
        auto out = std::copy(carried[k].begin(), carried[k].end(),
                             variables.begin() + static_cast<std::ptrdiff_t>(width * k));
        std::copy(flow.parameters_.differences.begin(), flow.parameters_.differences.end(), out);
      }
    }

    void leave(std::span<const SixNumbers<double>> carried, std::span<const double> values,
               std::span<SixNumbers<double>> deviations) override {
      std::array<double, widest * block> states;
      std::array<double, block> starts;
      std::array<double, block> times;
      const std::size_t count = carried.size();
      for (std::size_t k = 0; k < count; ++k) {
        SixNumbers<double> of_one;
        std::copy_n(&values[6 * k], 6, of_one.begin());
        const auto [state, time] = flow.box_->crossing(carried[k], of_one);
        auto out = std::copy(state.begin(), state.end(), &states[width * k]);
        std::copy(flow.parameters_.values.begin(), flow.parameters_.values.end(), out);
        times[k] = std::isfinite(time) ? -time : 0;
        starts[k] = flow.end_time_ - times[k];
        if (!std::isfinite(time)) states[width * k] = time;
      }
      advance(std::span(states).first(width * count), std::span(starts).first(count),
              std::span(times).first(count));
      for (std::size_t k = 0; k < count; ++k) {
        for (std::size_t i = 0; i < 6; ++i) {
          deviations[k][i] = states[width * k + i] - flow.chief_end()[i];
        }
      }
    }

    /// A deputy whose crossing lies where the forces are not known, or whose flight has no end, has
    /// no place; the others have theirs.
    void advance(std::span<double> states, std::span<const double> starts,
                 std::span<const double> times) {
      const std::vector<double> crossings(states.begin(), states.end());
      try {
        return taylor.advance(states, starts, times);
      } catch (const Error& error) {
        if (error.kind() != ErrorKind::numerical) throw;
      }
      for (std::size_t k = 0; k < times.size(); ++k) {
        const std::span<double> state = states.subspan(width * k, width);
        std::copy_n(crossings.begin() + static_cast<std::ptrdiff_t>(width * k), width,
                    state.begin());
        try {
          taylor.advance(state, starts.subspan(k, 1), times.subspan(k, 1));
        } catch (const Error& error) {
          if (error.kind() != ErrorKind::numerical) throw;
          std::fill(state.begin(), state.end(), std::numeric_limits<double>::quiet_NaN());
        }
      }
    }

    const DrivenDeputyFlow& flow;
    std::size_t width;  ///< of a state with its parameters
    TaylorFlow taylor;
  };
  std::unique_ptr<Passage> passage() const override { return std::make_unique<CarriedBack>(*this); }

  SharedSystem system_;
  double end_time_;  ///< the clock's
  SixNumbers<double> start_;
  std::shared_ptr<const DrivenFlowBox> box_;
  DeputyParameters parameters_;
};

}  // namespace

std::unique_ptr<DeputyFlow> driven_flow_box_deputy_flow(const SharedSystem& system,
                                                        const ClockTime& end_time,
                                                        std::shared_ptr<const DrivenFlowBox> box,
                                                        DeputyParameters parameters) {
  return std::make_unique<DrivenDeputyFlow>(system, end_time, std::move(box),
                                            std::move(parameters));
}

}  // namespace hamjet
