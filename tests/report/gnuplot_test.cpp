#include "report/drawing/gnuplot.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/temporary_directory.hpp"

// If a picture cannot be drawn, the output has one line with the reason, and nothing else changes.
// Small shell scripts replace gnuplot.

namespace hamjet::io {
namespace {

namespace fs = std::filesystem;

/// A program in a directory.
std::string write_program(const test::TemporaryDirectory& directory, const std::string& name,
                          const std::string& text) {
  const fs::path file = directory.path() / name;
  std::ofstream(file) << "#!/bin/sh\n" << text << "\n";
  fs::permissions(file, fs::perms::owner_all);
  return file.string();
}

TEST(Gnuplot, IsEndedAfterItsTimeLimit) {
  const test::TemporaryDirectory folder;
  const std::string program = write_program(folder, "slow", "sleep 100");
  const auto start = std::chrono::steady_clock::now();
  const GnuplotOutcome outcome =
      run_gnuplot(program, "", {.whole = std::chrono::milliseconds(200)});
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  EXPECT_NE(outcome.problem.find("took longer than 0.2 s"), std::string::npos) << outcome.problem;
  EXPECT_TRUE(outcome.is_late);
}

// On a busy machine a child process waits, and this time is not its own.
TEST(Gnuplot, IsGivenProcessorTime) {
  const test::TemporaryDirectory folder;
  const GnuplotLimits limits{.processor = std::chrono::milliseconds(200)};
  const GnuplotOutcome waiting =
      run_gnuplot(write_program(folder, "waiting", "sleep 0.5; echo drawn"), "", limits);
  EXPECT_EQ(waiting.output, "drawn\n");
  EXPECT_EQ(waiting.problem, "");
  const GnuplotOutcome busy =
      run_gnuplot(write_program(folder, "busy", "while :; do :; done"), "", limits);
  EXPECT_NE(busy.problem.find("longer than 0.2 s of processor time"), std::string::npos)
      << busy.problem;
  EXPECT_TRUE(busy.is_late);
}

TEST(Gnuplot, WithoutDescriptorsThereIsNoPlotAndNoException) {
  const test::TemporaryDirectory folder;
  const std::string program = write_program(folder, "drawing", "echo drawn");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const int next = ::dup(STDIN_FILENO);
  ::close(next);
  const rlimit few{static_cast<rlim_t>(next + 3), before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
  const GnuplotOutcome outcome = run_gnuplot(program, "");
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_FALSE(outcome.is_started);
  EXPECT_NE(outcome.problem.find("cannot be started, so there are no plots: Too many open files"),
            std::string::npos)
      << outcome.problem;
  EXPECT_EQ(run_gnuplot(program, "").output, "drawn\n");
}

TEST(Gnuplot, SaysTrulyWhyItDoesNotStart) {
  const test::TemporaryDirectory folder;
  const std::string closed = write_program(folder, "closed", "echo drawn");
  fs::permissions(closed, fs::perms::owner_read);
  EXPECT_NE(run_gnuplot(closed, "")
                .problem.find("cannot be started, so there are no plots: "
                              "Permission denied"),
            std::string::npos);
  // The loader of a program whose libraries do not fit into memory ends in this way.
  const std::string unloaded =
      write_program(folder, "unloaded", "echo 'libX.so: failed to map segment' >&2; exit 127");
  const std::string problem = run_gnuplot(unloaded, "").problem;
  EXPECT_NE(problem.find("failed to map segment"), std::string::npos) << problem;
  EXPECT_EQ(problem.find("not installed"), std::string::npos) << problem;
  const std::string killed = write_program(folder, "killed", "kill -9 $$");
  EXPECT_NE(run_gnuplot(killed, "").problem.find("ended by signal 9"), std::string::npos);
}

TEST(Gnuplot, WhatItComplainsOfIsHandedOn) {
  const test::TemporaryDirectory folder;
  const std::string program =
      write_program(folder, "failing", "echo drawn; echo 'bad axis' >&2; exit 1");
  // The text is larger than the buffer of a socket, and the child does not read it: writing must
  // neither block nor raise a signal.
  const GnuplotOutcome outcome = run_gnuplot(program, std::string(4 << 20, '#'));
  EXPECT_TRUE(outcome.is_started);
  EXPECT_TRUE(outcome.output.empty());
  EXPECT_NE(outcome.problem.find("bad axis"), std::string::npos) << outcome.problem;
}

TEST(Gnuplot, LongOutputArrivesWhole) {
  const test::TemporaryDirectory folder;
  const std::string program = write_program(folder, "echoing", "exec cat");
  const std::string script(3 << 20, 'x');
  EXPECT_EQ(run_gnuplot(program, script).output, script);
}

TEST(Gnuplot, ALiteralCannotEndEarly) {
  EXPECT_EQ(gnuplot_literal("it's `x`\nplot"), "'it''s `x` plot'");
  EXPECT_EQ(gnuplot_literal("''x'"), "\"''\".'x'''");
  EXPECT_EQ(gnuplot_literal("'"), "\"'\".''");
}

}  // namespace
}  // namespace hamjet::io
