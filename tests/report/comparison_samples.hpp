#pragma once

#include <limits>
#include <string>

#include "hamjet/report/comparison_report.hpp"
#include "sample_scene.hpp"

// A small comparison of made-up numbers with every case that a report must show.

namespace hamjet::io {

inline ComparedRun sample_run(const std::string& series, const std::string& label, double error) {
  ComparedRun run;
  run.series = series;
  run.settings.label = label;
  run.settings.stages = 4;
  run.settings.step_canonical = 0.1;
  run.order = 2;
  run.statistics.steps = 314;
  run.statistics.rejected_steps = 3;
  run.statistics.vector_field_evaluations = 1256;
  run.statistics.nominal_evaluations = 2048;
  run.statistics.wall_seconds = 0.1 + 0.2;
  run.multiply_adds = 1.0 / 3.0;
  run.memory_bytes = 123456;
  run.seconds = {0.003, 0.0020000000000000001, 1.0 / 300};
  run.error_by_degree = {error, 2 * error, error / 3};
  run.error_estimate_by_degree = {3 * error, 5 * error, error};
  run.error_at_formation_m = 1e6 * error;
  run.exactness = {{{0, 1e-15, 3e-16, 1e-9},
                    ExactnessResidual{0, 2e-15, 1e-15, std::nullopt},
                    std::nullopt,
                    std::nullopt},
                   {{1, 5e-13, 7e-14, std::nullopt}, std::nullopt, std::nullopt, std::nullopt}};
  run.symplecticity = {{0, 4e-16, 1.1e-16}, {1, 5e-16, 2.2e-16}};
  run.energy_error = 4.4e-16;
  run.corner = Corner::exact_and_accurate;
  return run;
}

inline ComparisonResult sample_comparison() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  ComparisonResult result;
  result.is_complete = true;
  Scene& scene = result.scene;
  scene = sample_scene(31.4);
  scene.separation = 10.0 / 7000;
  scene.comparison.wanted_error_m = 1;
  result.separation_points = 27;
  result.kind = GeneratingFunctionKind{{false, false, false}, {false, false, false}};
  result.kind_condition = 12.5;
  result.reference.uncertainty_by_degree = {1e-20, 1e-19, 1e-18};
  result.reference.stages = 16;
  result.reference.tolerance = 1e-24;
  result.reference.statistics.steps = 27;

  result.runs = {sample_run("gauss, 4 stages", "gauss4-0.1", 1e-9),
                 sample_run("gauss, 4 stages", "gauss4-0.05", 4e-12),
                 sample_run("gauss, 4 stages", "gauss4-0.01", 3e-15)};
  result.runs[1].settings.step_canonical = 0.05;
  result.runs[2].settings.step_canonical = 0.01;
  result.runs[0].statistics.steps = 314;  // 31.4 in equal steps
  result.runs[1].statistics.steps = 628;
  result.runs[2].statistics.steps = 3140;
  result.runs.push_back(sample_run("fehlberg78", "fehlberg78-1e-2", 1e-2));
  ComparedRun& loose = result.runs.back();
  loose.settings.method = IntegrationMethod::fehlberg78;
  loose.settings.step_canonical.reset();
  loose.settings.tolerance = 1e-2;
  loose.settings.require_relative_error = 5e-324;
  loose.corner = Corner::neither;
  loose.symplecticity[0].scaled = -0.0;
  loose.error_by_degree[2] = infinity;
  loose.error_estimate_by_degree.clear();  // its independent run failed
  loose.exactness.clear();
  loose.exactness_failure = "singular, \"F1\" does not exist";
  result.runs.push_back(sample_run("cvode-bdf", "bdf-1e-2", 0));
  result.runs.back().failure = "too many steps, at time 3";
  result.runs.back().seconds.clear();
  result.runs.push_back(sample_run("cvode-bdf", "bdf-1e-14", 0));
  result.runs.back().left_out = "would exceed the time budget";
  result.runs.back().seconds.clear();

  result.cost_runs = {sample_run("gauss, 4 stages", "gauss4-order-1", 1e-9),
                      sample_run("gauss, 4 stages", "gauss4-order-2", 1e-9)};
  result.cost_runs[0].order = 1;

  RunAlongTime watched{"midpoint", "", {}, {0.7}};
  for (int i = 0; i < 40; ++i) {
    watched.points.push_back({0.1 * i, 1e-15 * (1 + i % 7), 2.5, i == 0 ? 0.0 : -1e-13 * i});
  }
  watched.points[7].exactness.reset();
  watched.points[7].condition = infinity;
  result.along_time = {watched, {"other", "stopped <here>", {{0, std::nullopt, infinity, 0}}, {}}};
  result.fits = {{"gauss, 4 stages",
                  0,
                  7.97,
                  8,
                  {"gauss4-0.1", "gauss4-0.05"},
                  {{0.05, 1e-9}, {0.1, 2.5e-7}}}};
  return result;
}

inline ReportOrigin sample_origin() {
  return {"hamjet compare sample.toml --set 'title=\"<b>\"'", "2025-01-02 03:04 UTC",
          "A processor & more", "determinants: 1\n2", "gnuplot"};
}

}  // namespace hamjet::io
