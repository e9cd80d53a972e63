#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <random>

#include "command_test.hpp"

// Sweeps of ten to forty items. However the items are computed, in one process, in parts, on
// threads, or killed and taken up, the table is the same, byte by byte.

namespace hamjet::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* study = R"(schema = 1
title = "orbits"
[sweep]
scene = "quick.toml"
command = "run"
[sweep.set]
integrator.midpoint = "null"
[[axis]]
key = "nominal.e"
from = 0.0
to = 0.9
count = 10
[[axis]]
key = "nominal.i_deg"
values = [0, 30, 60, 90]
[[column]]
name = "condition"
value = "/runs/gauss8/exactness/0/condition"
[[column]]
name = "energy_error"
value = "/runs/gauss8/energy_error"
[map]
x = "nominal.e"
y = "nominal.i_deg"
value = "condition"
)";

class Sweep : public CommandTest {
 protected:
  Sweep() {
    write("study.toml", study);
    // An array in which the tests themselves may run.
    options_.environment = {{"SLURM_ARRAY_TASK_ID", std::nullopt}};
  }

  std::string table(const std::string& directory) const {
    return content(directory_ / directory / "table.csv");
  }

  /// The table of a plain run.
  std::string expected() const {
    succeed({"sweep", "study.toml", "-q", "-o", "plain"});
    return table("plain");
  }

  fs::path row(const std::string& directory, int item) const {
    return directory_ / directory / fmt::format("rows/000/{:06}.json", item);
  }
};

TEST_F(Sweep, MakesATableAMapAndASummary) {
  const CommandResult result = succeed({"sweep", "study.toml"});
  EXPECT_NE(result.out.find("items            40: 40 done, 0 failed, 0 missing"), std::string::npos)
      << result.out;
  const Table rows = read_table(directory_ / "out/study/table.csv");
  EXPECT_EQ(rows.header, "item,nominal.e,nominal.i_deg,condition,energy_error,exit_code,error");
  ASSERT_EQ(rows.rows.size(), 40U);
  // Each row equals the result of `hamjet run` for the scene with the same changes.
  succeed({"run", "quick.toml", "-q", "--set", "nominal.e=0.3", "--set", "nominal.i_deg=60"});
  const Json run = read_json(directory_ / "out/quick/summary.json")["runs"][0];
  EXPECT_EQ(rows.rows[14][1], "0.3");
  EXPECT_EQ(std::stod(rows.rows[14][3]), run["exactness"][0]["condition"].get<double>());
  EXPECT_EQ(std::stod(rows.rows[14][4]), run["energy_error"].get<double>());
  const Json summary = read_json(directory_ / "out/study/summary.json");
  EXPECT_EQ(summary["done"], 40);
  EXPECT_EQ(summary["columns"][0]["numbers"], 40);
  EXPECT_NE(content(directory_ / "out/study/map.svg").find("<svg"), std::string::npos);
}

TEST_F(Sweep, PartsAndThreadsGiveTheSameTable) {
  const std::string whole = expected();
  succeed({"sweep", "study.toml", "-q", "-o", "one", "--threads", "1"});
  succeed({"sweep", "study.toml", "-q", "-o", "four", "--threads", "4"});
  EXPECT_EQ(table("one"), whole);
  EXPECT_EQ(table("four"), whole);
  for (const char* shard : {"3/3", "1/3", "2/3"}) {
    succeed({"sweep", "study.toml", "-q", "-o", "parts", "--shard", shard});
    EXPECT_FALSE(fs::exists(directory_ / "parts/table.csv"));
  }
  succeed({"sweep", "--merge", "-q", "-o", "parts"});
  EXPECT_EQ(table("parts"), whole);
  EXPECT_EQ(content(directory_ / "parts/summary.json"), content(directory_ / "plain/summary.json"));
}

TEST_F(Sweep, ATaskOfASlurmArrayIsAPart) {
  const std::string whole = expected();
  for (const char* id : {"5", "7", "9"}) {
    options_.environment = {{"SLURM_ARRAY_TASK_ID", id},
                            {"SLURM_ARRAY_TASK_COUNT", "3"},
                            {"SLURM_ARRAY_TASK_MIN", "5"},
                            {"SLURM_ARRAY_TASK_MAX", "9"},
                            {"SLURM_ARRAY_TASK_STEP", "2"}};
    const CommandResult result = succeed({"sweep", "study.toml", "-o", "array"});
    EXPECT_NE(result.out.find(fmt::format("shard {}/3", (std::stoi(id) - 3) / 2)),
              std::string::npos)
        << result.out;
  }
  succeed({"sweep", "study.toml", "--merge", "-q", "-o", "array"});
  EXPECT_EQ(table("array"), whole);
  // A list of tasks that leaves some out does not say which part of how many this is.
  options_.environment = {{"SLURM_ARRAY_TASK_ID", "5"},
                          {"SLURM_ARRAY_TASK_COUNT", "2"},
                          {"SLURM_ARRAY_TASK_MIN", "2"},
                          {"SLURM_ARRAY_TASK_MAX", "5"}};
  const CommandResult result = hamjet({"sweep", "study.toml", "-q", "-o", "list"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("--shard k/n"), std::string::npos) << result.err;
}

TEST_F(Sweep, ResumeLeavesOutWhatIsWholeAlone) {
  const std::string whole = expected();
  fs::remove(row("plain", 3));
  write("plain/rows/000/000005.json", content(row("plain", 5)).substr(0, 60));
  write("plain/rows/000/000007.json", changed(content(row("plain", 7)), "0", "1"));
  write("plain/rows/000/000009.json", content(row("plain", 8)));
  const CommandResult merged = hamjet({"sweep", "--merge", "-o", "plain"});
  EXPECT_EQ(merged.exit_code, 1);
  EXPECT_NE(merged.err.find("of 40 items 0 failed and 4 are missing"), std::string::npos)
      << merged.err;
  EXPECT_NE(merged.out.find("damaged          2 rows"), std::string::npos) << merged.out;
  EXPECT_NE(merged.out.find("foreign          1 row of another study"), std::string::npos)
      << merged.out;
  EXPECT_NE(table("plain").find("\n3,0,90,,,missing,\n"), std::string::npos);

  const auto before = fs::last_write_time(row("plain", 4));
  const CommandResult part =
      succeed({"sweep", "study.toml", "-o", "plain", "--resume", "--shard", "1/1"});
  EXPECT_NE(part.out.find("4 computed now, 36 before, 0 failed"), std::string::npos) << part.out;
  EXPECT_EQ(fs::last_write_time(row("plain", 4)), before);
  succeed({"sweep", "study.toml", "-q", "-o", "plain", "--resume"});
  EXPECT_EQ(table("plain"), whole);
}

TEST_F(Sweep, AnotherStudyInTheSameDirectoryIsRefused) {
  succeed({"sweep", "study.toml", "-q", "-o", "out"});
  write("study.toml", changed(study, "count = 10", "count = 9"));
  for (const char* option : {"--resume", "--merge", "--shard=1/2"}) {
    expect_error({"sweep", "study.toml", "-q", "-o", "out", option}, 2,
                 {"out/manifest.json: belongs to another study: its items differ"});
  }
  write("study.toml", study);
  write("quick.toml", changed(quick_scene(), "a_km = 10000", "a_km = 10001"));
  expect_error({"sweep", "study.toml", "-q", "-o", "out"}, 2, {"the base scene has changed"});
  write("out/manifest.json", content(directory_ / "out/manifest.json").substr(1));
  expect_error({"sweep", "study.toml", "-q", "-o", "out"}, 5, {"it was changed or cut"});
  expect_error({"sweep", "--merge", "-o", "nowhere"}, 5, {"no sweep to merge"});
}

TEST_F(Sweep, FailedItemsAreInTheTable) {
  write("study.toml", changed(study, "to = 0.9", "to = 1.8"));  // e = 1 and above is no ellipse
  const CommandResult result = hamjet({"sweep", "study.toml", "-o", "out"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.out.find("40: 20 done, 20 failed, 0 missing"), std::string::npos) << result.out;
  EXPECT_EQ(result.err, "hamjet: of 40 items 20 failed and 0 are missing; see table.csv\n");
  const std::string rows = table("out");
  EXPECT_NE(rows.find("\n20,1,0,,,3,\"--set nominal.e: out of range, got 1,"), std::string::npos)
      << rows;
  // Failed items are rows like the others, and are not computed again.
  const CommandResult again =
      hamjet({"sweep", "study.toml", "-o", "out", "--resume", "--shard", "1/1"});
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_NE(again.out.find("0 computed now, 40 before, 20 failed"), std::string::npos);
}

// What a file that another machine does not see, or not yet, has made fail is tried again; and the
// error is the same text from wherever the sweep is started.
TEST_F(Sweep, WhatFailedForAFileIsTriedAgain) {
  const std::string first = "[[axis]]\nkey = \"nominal.e\"\nfrom = 0.0\nto = 0.9\ncount = 10\n";
  const std::string files =
      "[[axis]]\nkey = \"system.gravity_file\"\nvalues = [\"a.gfc\", \"b.gfc\"]\n";
  std::string changed_study = changed(study, first, files);
  changed_study = changed(changed_study, "x = \"nominal.e\"", "x = \"system.gravity_file\"");
  changed_study = changed_study.substr(0, changed_study.find("[map]"));
  write("study.toml", changed(changed_study, "integrator.midpoint = \"null\"",
                              "integrator.midpoint = \"null\"\nsystem.model = \"zonal-gravity\"\n"
                              "system.mu_km3_s2 = \"null\"\nsystem.highest_zonal = 2"));
  const std::string field = content(fs::path(HAMJET_SOURCE_DIR) / "data/gravity/EGM96-zonals.gfc");
  write("b.gfc", field);
  EXPECT_EQ(hamjet({"sweep", "study.toml", "-q", "-o", "out"}).exit_code, 1);
  EXPECT_NE(table("out").find("a.gfc cannot be read: No such file"), std::string::npos)
      << table("out");
  const std::string absolute = (directory_ / "study.toml").string();
  EXPECT_EQ(hamjet({"sweep", absolute, "-q", "-o", "far"}).exit_code, 1);
  EXPECT_EQ(table("far"), table("out"));
  write("a.gfc", field);
  const CommandResult again =
      succeed({"sweep", "study.toml", "-o", "out", "--resume", "--shard", "1/1"});
  EXPECT_NE(again.out.find("4 computed now, 4 before, 0 failed"), std::string::npos) << again.out;
}

TEST_F(Sweep, BadCommandLinesAndStudiesAreOneLine) {
  expect_error({"sweep"}, 2, {"needs a study"});
  expect_error({"sweep", "--merge"}, 2, {"needs the study"});
  for (const char* shard : {"0/3", "4/3", "1", "a/b", "1/", "-1/3"}) {
    expect_error({"sweep", "study.toml", std::string("--shard=") + shard}, 2, {"k/n"});
  }
  expect_error({"sweep", "study.toml", "--threads", "0"}, 2, {"--threads", "from 1 to"});
  expect_error({"sweep", "study.toml", "--merge", "--resume"}, 2, {"--merge"});
  expect_error({"sweep", "missing.toml"}, 5, {"missing.toml"});
  expect_error({"sweep", "quick.toml"}, 3, {"quick.toml:1:1: sweep: missing"});
  write("study.toml", changed(study, "nominal.e\"\nf", "nominal.ee\"\nf"));
  expect_error({"sweep", "study.toml"}, 3, {"study.toml:"});
  write("study.toml", changed(study, "command = \"run\"", "command = \"transfer\""));
  expect_error({"sweep", "study.toml"}, 3, {"quick.toml: transfer: missing"});
  write("study.toml", changed(study, "gauss8/energy_error", "gauss8/energy_eror"));
  const CommandResult result = hamjet({"sweep", "study.toml", "-q"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("column.1.value: leads nowhere"), std::string::npos) << result.err;
}

// gnuplot would lose the map of the first, a spreadsheet would take the others for formulas.
TEST_F(Sweep, ColumnsMayHaveAnyNameButAFormulas) {
  const std::string small =
      changed(changed(study, "count = 10", "count = 2"), "[0, 30, 60, 90]", "[0, 30]");
  const auto with_name = [&](const std::string& name) {
    return changed(changed(small, "\"condition\"", "\"" + name + "\""), "value = \"condition\"",
                   "value = \"" + name + "\"");
  };
  write("named.toml", with_name("'condition's"));
  succeed({"sweep", "named.toml", "-q"});
  EXPECT_NE(content(directory_ / "out/named/map.svg").find("'condition's"), std::string::npos);
  for (const char* name : {"=1+1", "+1", "-1", "@x"}) {
    write("named.toml", with_name(name));
    expect_error({"sweep", "named.toml", "-q"}, 3,
                 {"named.toml:17:8: column.0.name: begins as a formula of a spreadsheet, got",
                  "must begin with another character than = + - @"});
  }
}

/// Forty items of which each takes a while.
std::string slow_study() {
  return changed(study, "integrator.midpoint = \"null\"",
                 "integrator.midpoint.step_canonical = 4e-4");
}

TEST_F(Sweep, ASignalEndsItAndWhatIsFinishedStays) {
  write("study.toml", changed(study, "integrator.midpoint = \"null\"",
                              "integrator.midpoint.step_canonical = 1e-8"));
  for (const auto& [signal, code] : {std::pair(SIGINT, 130), std::pair(SIGTERM, 143)}) {
    options_.signal = Signal{signal};
    const CommandResult result = hamjet({"sweep", "study.toml", "-o", "out"});
    EXPECT_EQ(result.exit_code, code);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err,
              "hamjet: interrupted; 0 of 40 items are finished and stay in out; "
              "--resume goes on\n");
  }
  options_.signal.reset();
  EXPECT_FALSE(fs::exists(directory_ / "out/rows"));
}

TEST_F(Sweep, ASignalTellsHowManyItemsAreFinished) {
  write("study.toml", changed(study, "count = 10", "count = 5000"));
  for (const int milliseconds : {50, 150, 300}) {
    options_.signal = Signal{SIGINT, 1, std::chrono::milliseconds(milliseconds)};
    const CommandResult result = hamjet({"sweep", "study.toml", "-o", "out"});
    EXPECT_EQ(result.exit_code, 130);
    std::size_t rows = 0;
    if (fs::exists(directory_ / "out/rows")) {
      for (const auto& entry : fs::recursive_directory_iterator(directory_ / "out/rows")) {
        rows += entry.path().extension() == ".json" ? 1U : 0U;
      }
    }
    EXPECT_EQ(result.err, fmt::format("hamjet: interrupted; {} of 20000 items are finished and "
                                      "stay in out; --resume goes on\n",
                                      rows));
    fs::remove_all(directory_ / "out");
  }
}

using KillSweep = Sweep;

TEST_F(KillSweep, TakenUpItGivesTheSameTable) {
  write("study.toml", slow_study());
  const char* text = std::getenv("HAMJET_KILLS");
  const int kills = text == nullptr ? 5 : std::atoi(text);
  const auto start = std::chrono::steady_clock::now();
  const std::string whole = expected();
  const auto time = std::chrono::duration_cast<std::chrono::microseconds>(
      std::chrono::steady_clock::now() - start);
  std::mt19937_64 random{std::random_device{}()};
  int count_killed = 0;
  for (int i = 0; i < kills; ++i) {
    // Each run has a part of the time, so that several kills meet one sweep.
    options_.kill = Kill{std::chrono::microseconds(
        std::uniform_int_distribution<std::int64_t>(0, time.count() / 2)(random))};
    const CommandResult result =
        run_command({"sweep", "study.toml", "-q", "-o", "killed", "--resume"}, options_);
    if (result.signal == SIGKILL) ++count_killed;
    options_.kill.reset();
    if (result.signal == SIGKILL && i % 4 != 3) continue;
    succeed({"sweep", "study.toml", "-q", "-o", "killed", "--resume"});
    EXPECT_EQ(table("killed"), whole);
    for (const auto& entry : fs::recursive_directory_iterator(directory_ / "killed")) {
      EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
    }
    fs::remove_all(directory_ / "killed");
  }
  succeed({"sweep", "study.toml", "-q", "-o", "killed", "--resume"});
  EXPECT_EQ(table("killed"), whole);
  fmt::print("hamjet sweep: {} moments, {} killed; other tables: {}\n", kills, count_killed,
             HasFailure() ? "see above" : "0");
}

}  // namespace
}  // namespace hamjet::test
