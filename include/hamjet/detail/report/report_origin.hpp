#pragma once

#include <string>

namespace hamjet::io {

/// Where a report comes from: what a reader needs to make it again.
struct ReportOrigin {
  std::string command;    ///< as it was typed
  std::string date;       ///< the date of the run, with time and zone
  std::string processor;  ///< the processor that the times were taken on
  /// Used by comparisons only: all that determines the runs, as the caller writes it; a resumption
  /// compares it with its own.
  std::string determinants;
  /// Program that draws the plots: a name on the path, or a path; empty: nothing is drawn.
  std::string gnuplot = "gnuplot";
};

}  // namespace hamjet::io
