#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace hamjet::io {

/// What became of a script that gnuplot was given.
struct GnuplotOutcome {
  bool is_started = true;  ///< false: there is no such program, or the system refused to start it
  bool is_late = false;    ///< it took longer than a limit
  std::string output;      ///< what it drew; empty if it could not
  std::string problem;     ///< why not, one line; empty if all is well
};

/// How long a drawing may take.
struct GnuplotLimits {
  /// Of processor time, so that a busy machine, which only waits longer, loses no picture.
  std::chrono::milliseconds processor{10'000};
  /// In all, for a child that waits for something that does not come.
  std::chrono::milliseconds whole{120'000};
};

/// Runs gnuplot as a child process, without a shell: its standard input is a file in memory with
/// the script, which is its argument too, and the drawing comes out by its standard output. A child
/// that takes longer than a limit is ended. What the system refuses for a moment, processes or
/// descriptors, is asked for again within a second.
GnuplotOutcome run_gnuplot(const std::string& program, std::string_view script,
                           const GnuplotLimits& limits = {});

/// A text as a gnuplot expression. In single quotes neither backslashes nor commands in back-quotes
/// mean anything; line breaks would end the command and become spaces. Apostrophes at the start
/// stand in double quotes, for gnuplot takes two that are doubled there for an empty text.
std::string gnuplot_literal(std::string_view text);

}  // namespace hamjet::io
