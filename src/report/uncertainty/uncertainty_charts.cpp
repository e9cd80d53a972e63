#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../../text/time_axis.hpp"
#include "../drawing/along_time_charts.hpp"
#include "uncertainty_report.hpp"
#include "uncertainty_view.hpp"

namespace hamjet::io {
namespace {

constexpr Eigen::Index most_drawn_samples = 1500;

/// The ellipse of three standard deviations in two components.
ChartCurve ellipse(const Cumulants& moments, Eigen::Index across, Eigen::Index up) {
  ChartCurve curve = unmarked_line();
  constexpr int points = 128;
  const Matrix<double>& axes = moments.axes();
  const double s = axes.row(across).norm();
  const double t = axes.row(up).norm();
  const double correlation = s > 0 && t > 0 ? axes.row(across).dot(axes.row(up)) / (s * t) : 0;
  const double rest = std::sqrt(std::max(0.0, 1 - correlation * correlation));
  for (int k = 0; k <= points; ++k) {
    const double angle = 2 * std::numbers::pi * k / points;
    curve.points.emplace_back(
        moments.mean()[across] + 3 * s * std::cos(angle),
        moments.mean()[up] + 3 * t * (correlation * std::cos(angle) + rest * std::sin(angle)));
  }
  return curve;
}

std::string axis_label(const StateComponent& component) {
  return fmt::format("{} ({})", component.name, component.unit);
}

}  // namespace

Chart ellipse_chart(const UncertaintyResult& result, const UncertaintyAt& at,
                    const UncertainState& state, Eigen::Index across, Eigen::Index up) {
  const auto components = state_components(result);
  const StateComponent& x = components[static_cast<std::size_t>(across)];
  const StateComponent& y = components[static_cast<std::size_t>(up)];
  Chart chart;
  chart.name = fmt::format("ellipse-{}-{}", x.name, y.name);
  chart.title = fmt::format("{} and {} of the {} after {}", x.name, y.name, state.name,
                            time_text(result, at));
  chart.is_panel = true;
  chart.x.label = axis_label(x);
  chart.y.label = axis_label(y);
  chart.reading = fmt::format(
      "Deviations from the nominal. The ellipses have three standard deviations, about the mean; "
      "of a Gaussian distribution they hold 98.9 % of a pair of components. {}",
      state.flown ? "Points are states that were flown with the full equations of motion."
                  : "No states were flown.");
  if (state.flown) {
    ChartCurve points;
    points.title = "flown";
    points.is_cloud = true;
    const Eigen::Index step =
        std::max<Eigen::Index>(1, state.flown_states.cols() / most_drawn_samples);
    for (Eigen::Index k = 0; k < state.flown_states.cols(); k += step) {
      points.points.emplace_back(state.flown_states(across, k), state.flown_states(up, k));
    }
    chart.curves.push_back(std::move(points));
  }
  ChartCurve linear = ellipse(state.cartesian.front(), across, up);
  linear.title = "linear";
  linear.style = 0;
  chart.curves.push_back(std::move(linear));
  if (result.scene.order > 1) {
    ChartCurve full = ellipse(state.cartesian.back(), across, up);
    full.title = fmt::format("order {}", result.scene.order);
    full.style = 1;
    chart.curves.push_back(std::move(full));
  }
  return chart;
}

Chart histogram_chart(const UncertaintyResult& result, const UncertaintyAt& at,
                      const UncertainState& state, Eigen::Index component) {
  const StateComponent of = state_components(result)[static_cast<std::size_t>(component)];
  Chart chart;
  chart.name = fmt::format("histogram-{}", of.name);
  chart.title = fmt::format("Distribution of {} of the {} after {}", of.name, state.name,
                            time_text(result, at));
  chart.is_panel = true;
  chart.x.label = axis_label(of);
  chart.y.label = fmt::format("density (1/{})", of.unit);
  chart.reading =
      "Steps: states that were flown with the full equations of motion, by equal intervals. Lines: "
      "the Gaussian distributions of the linear theory and of the mean and standard deviation of "
      "the highest order.";
  double lower = 0;
  double upper = 0;
  for (const std::size_t n : {std::size_t{0}, state.cartesian.size() - 1}) {
    const double mean = state.cartesian[n].mean()[component];
    const double s = state.cartesian[n].standard_deviations()[component];
    lower = std::min(lower, mean - 4 * s);
    upper = std::max(upper, mean + 4 * s);
  }
  if (state.flown) {
    const Vector<double> values = state.flown_states.row(component);
    // Intervals as wide as n^(-1/3) of the data's spread (D. W. Scott, Biometrika 66 (1979) 605).
    const double s = state.flown->cumulants.standard_deviations()[component];
    const double width = 3.49 * s / std::cbrt(static_cast<double>(values.size()));
    const double first = values.minCoeff();
    if (width > 0) {
      const auto count =
          static_cast<std::size_t>(std::clamp((values.maxCoeff() - first) / width + 1, 1.0, 400.0));
      std::vector<double> bins(count, 0.0);
      for (const double value : values) {
        bins[std::min(count - 1, static_cast<std::size_t>((value - first) / width))] += 1;
      }
      ChartCurve steps = unmarked_line(fmt::format("{} flown", values.size()), 2);
      const double unit = 1 / (width * static_cast<double>(values.size()));
      steps.points.emplace_back(first, 0.0);
      for (std::size_t k = 0; k < count; ++k) {
        const double left = first + width * static_cast<double>(k);
        steps.points.emplace_back(left, bins[k] * unit);
        steps.points.emplace_back(left + width, bins[k] * unit);
      }
      steps.points.emplace_back(first + width * static_cast<double>(count), 0.0);
      chart.curves.push_back(std::move(steps));
    }
  }
  const auto gaussian = [&](const Cumulants& moments, std::string title, std::size_t style) {
    const double mean = moments.mean()[component];
    const double s = moments.standard_deviations()[component];
    if (s == 0) return;
    ChartCurve curve = unmarked_line(std::move(title), style);
    constexpr int points = 200;
    for (int k = 0; k <= points; ++k) {
      const double x = lower + (upper - lower) * k / points;
      const double z = (x - mean) / s;
      curve.points.emplace_back(x, std::exp(-z * z / 2) / (s * std::sqrt(2 * std::numbers::pi)));
    }
    chart.curves.push_back(std::move(curve));
  };
  gaussian(state.cartesian.front(), "linear", 0);
  if (result.scene.order > 1) {
    gaussian(state.cartesian.back(), fmt::format("Gaussian of order {}", result.scene.order), 1);
  }
  return chart;
}

Chart misleading_chart(const UncertaintyResult& result) {
  const double unit = result.scene.units.time_s;
  const TimeAxis axis = time_axis(std::abs(result.points.back().time) * unit);
  Chart chart;
  chart.name = "misleading";
  chart.title = "How far the linear covariance misleads";
  chart.x.label = fmt::format("time ({})", axis.name);
  add_revolutions(result.scene, axis.seconds, chart.x);
  chart.y = logarithmic_axis("largest error of a probability");
  chart.reading = fmt::format(
      "The bound sqrt(D/2), D the divergence from the distribution of order {} to the linear "
      "theory's Gaussian one in the same coordinates. Above {} the linear covariance counts as "
      "misleading.",
      result.scene.order, misleading_probability);
  chart.rules.push_back({false, misleading_probability, "misleading", false});
  std::size_t style = 0;
  for (std::size_t s = 0; s < result.points.front().states.size(); ++s) {
    ChartCurve cartesian;
    cartesian.title = fmt::format("{}, Cartesian", result.points.front().states[s].name);
    cartesian.style = style++;
    ChartCurve charted;
    charted.title =
        fmt::format("{}, {}", result.points.front().states[s].name, name_of(result.coordinates));
    charted.style = style++;
    for (const UncertaintyAt& at : result.points) {
      const double time = at.time * unit / axis.seconds;
      cartesian.points.emplace_back(time, linear_error_of_probability(at.states[s].cartesian));
      if (at.states[s].charted.empty()) continue;
      charted.points.emplace_back(time, linear_error_of_probability(at.states[s].charted));
    }
    chart.curves.push_back(std::move(cartesian));
    if (!charted.points.empty()) chart.curves.push_back(std::move(charted));
  }
  return chart;
}

}  // namespace hamjet::io
