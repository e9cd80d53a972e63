#include "frozen_orbit_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../../text/quantity_text.hpp"

namespace hamjet::io {
namespace {

constexpr int places_of_circle = 128;

/// One curve against the amplitude, through points in any order.
Chart amplitude_chart(const std::string& quantity, const std::string& title,
                      std::vector<std::pair<double, double>> points) {
  Chart chart;
  chart.x = logarithmic_axis("amplitude of the eccentricity vector times a", AxisUnit::metres);
  chart.y = logarithmic_axis(quantity);
  std::sort(points.begin(), points.end());
  ChartCurve curve;
  curve.title = title;
  curve.points = std::move(points);
  chart.curves.push_back(std::move(curve));
  return chart;
}

}  // namespace

Chart invariant_curve_chart(const FrozenOrbitStudy& study) {
  Chart chart;
  chart.name = "poincare-curves";
  chart.title = "Invariant curves";
  chart.is_isometric = true;
  chart.x.label = "p less the frozen orbit's (amplitudes)";
  chart.y.label = "-q less the frozen orbit's (amplitudes)";
  chart.x.margin = chart.y.margin = 0.05;
  chart.reading = fmt::format(
      "Curves on which orbits about the frozen one return to the section, after the normal form: p "
      "is about e cos g and -q about e sin g, times the square root of L, and each curve is "
      "divided by its amplitude. Small ones are ellipses of one shape. Markers of the same colour: "
      "an orbit of each, flown over {}, which belongs on its curve.",
      counted(study.flown_revolutions, "revolution"));
  std::size_t style = 0;
  for (const LibrationCircle& circle : study.circles) {
    if (circle.curve.empty()) continue;
    ChartCurve curve = unmarked_line(
        length_text(study.length_m(circle.amplitude)) + (circle.is_chiefs ? " (chief)" : ""),
        style);
    for (const auto& [q, p] : circle.curve) {
      curve.points.emplace_back(p / circle.amplitude, -q / circle.amplitude);
    }
    chart.curves.push_back(std::move(curve));
    if (circle.flown_to) {
      ChartCurve flown;
      flown.style = style;
      flown.has_line = false;
      flown.points = {
          {(*circle.flown_to)[1] / circle.amplitude, -(*circle.flown_to)[0] / circle.amplitude}};
      chart.curves.push_back(std::move(flown));
    }
    ++style;
  }
  return chart;
}

Chart multiplier_chart(const FrozenOrbitStudy& study) {
  Chart chart;
  chart.name = "poincare-multipliers";
  chart.title = "Multipliers";
  chart.is_isometric = true;
  chart.x.label = "real part";
  chart.y.label = "imaginary part";
  chart.x.margin = chart.y.margin = 0.05;
  const auto [real, imaginary] = study.multiplier();
  chart.reading =
      study.is_stable()
          ? fmt::format(
                "The eigenvalues of the return's derivative, on the unit circle at +-{:.6g} "
                "degrees: the frozen orbit is stable to first order.",
                std::atan2(imaginary, real) * 180 / std::numbers::pi)
          : fmt::format(
                "The eigenvalues of the return's derivative, {:.9g} and its inverse, off the "
                "unit circle: the frozen orbit is unstable.",
                real);
  ChartCurve circle = unmarked_line("unit circle");
  for (int k = 0; k <= places_of_circle; ++k) {
    const double angle = 2 * std::numbers::pi * k / places_of_circle;
    circle.points.emplace_back(std::cos(angle), std::sin(angle));
  }
  ChartCurve multipliers;
  multipliers.title = "multipliers";
  multipliers.style = 1;
  multipliers.has_line = false;
  multipliers.points = {{real, imaginary}, {study.trace - real, -imaginary}};
  chart.curves = {std::move(circle), std::move(multipliers)};
  return chart;
}

Chart frequency_chart(const FrozenOrbitStudy& study) {
  const double smallest = study.circles.front().rotation_number;
  std::vector<std::pair<double, double>> points;
  const auto add = [&](double amplitude, double rotation) {
    const double change = std::abs(rotation / smallest - 1);
    if (change > 0) points.emplace_back(study.length_m(amplitude), change);
  };
  for (const LibrationCircle& circle : study.circles) {
    // The chief's has an energy of its own.
    if (!circle.is_chiefs) add(circle.amplitude, circle.rotation_number);
  }
  for (const FlownAmplitude& flown : study.flown_amplitudes) {
    add(flown.amplitude, flown.rotation_number);
  }
  Chart chart = amplitude_chart("change of the rotation number (parts of it)", "normal form",
                                std::move(points));
  chart.name = "poincare-frequencies";
  chart.title = "Frequency against amplitude";
  chart.reading = fmt::format(
      "By how much orbits of an amplitude turn faster or slower about the frozen one than those of "
      "{}, which take {:.6g} revolutions for a turn, by the normal form: the twist grows with the "
      "square of the amplitude where its lowest term leads.",
      length_text(study.length_m(study.circles.front().amplitude)), 1 / std::abs(smallest));
  return chart;
}

Chart reach_chart(const FrozenOrbitStudy& study) {
  std::vector<std::pair<double, double>> points;
  for (const LibrationCircle& circle : study.circles) {
    if (!circle.is_chiefs && circle.flown_to) {
      points.emplace_back(study.length_m(circle.amplitude), *circle.miss);
    }
  }
  for (const FlownAmplitude& flown : study.flown_amplitudes) {
    if (flown.miss) points.emplace_back(study.length_m(flown.amplitude), *flown.miss);
  }
  Chart chart = amplitude_chart("miss (parts of the amplitude)",
                                fmt::format("order {}", study.scene.order), std::move(points));
  chart.name = "poincare-reach";
  chart.title = "Where the normal form stops being right";
  chart.reading = fmt::format(
      "How far an orbit that starts on each circle is from where the normal form has it, flown "
      "over {} with the whole field; the line is the miss up to which the form is called right.",
      counted(study.flown_revolutions, "revolution"));
  chart.rules.push_back({false, FrozenOrbitStudy::largest_miss, "right below", false});
  return chart;
}

}  // namespace hamjet::io
