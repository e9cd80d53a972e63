#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace hamjet::io {

/// What became of a script that gnuplot was given.
struct GnuplotOutcome {
  bool is_installed = true;
  bool is_late = false;  ///< it took longer than the limit
  std::string output;    ///< what it drew; empty if it could not
  std::string problem;   ///< why not, one line; empty if all is well
};

/// Runs gnuplot as a child process, without a shell: the script goes in by its standard input, the
/// drawing comes out by its standard output. A child that takes longer than `limit` is ended.
/// Throws Error(input_output) only if the system has no pipes left.
GnuplotOutcome run_gnuplot(const std::string& program, std::string_view script,
                           std::chrono::milliseconds limit = std::chrono::seconds(10));

/// A text as a gnuplot expression. In single quotes neither backslashes nor commands in back-quotes
/// mean anything; line breaks would end the command and become spaces. Apostrophes at the start
/// stand in double quotes, for gnuplot takes two that are doubled there for an empty text.
std::string gnuplot_literal(std::string_view text);

}  // namespace hamjet::io
