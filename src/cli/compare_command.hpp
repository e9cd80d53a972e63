#pragma once

#include "hamjet/report/comparison_report.hpp"
#include "scene_options.hpp"

namespace hamjet::cli {

struct CompareOptions {
  RunOptions scene;
  bool resume = false;  ///< take up what an interrupted comparison left in the output directory
  io::PlotFormat plots = io::PlotFormat::none;
};

/// Compares integrators on a scene and writes the report; returns the exit code.
int compare(const CompareOptions& options);

}  // namespace hamjet::cli
