#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "hamjet/error.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/propagation.hpp"
#include "report/study_description.hpp"
#include "studies/formation/deputy_motion.hpp"
#include "sweep/sweep_report.hpp"
#include "sweep_samples.hpp"

namespace hamjet::io {
namespace {

using namespace hamjet::test;

class SweepItems : public ::testing::Test {
 protected:
  SweepItems() {
    write_text(temporary_.path() / "base.toml", sweep_scene);
    study_ = read_sweep_study(write_text(temporary_.path() / "study.toml", sweep_study));
  }

  std::filesystem::path rows() const { return temporary_.path() / "out"; }

  TemporaryDirectory temporary_;
  SweepStudy study_;
};

// The same as the scene with the same changes gives by itself.
TEST_F(SweepItems, AnItemIsTheScenesOwnResult) {
  const SweepRow row = run_sweep_item(study_, 4);
  EXPECT_EQ(row.exit_code, 0) << row.error;
  const PropagationResult result =
      propagate(parse_scene(sweep_scene, "base.toml",
                            {{"jet.order", "1"}, {"nominal.e", "0.3"}, {"nominal.i_deg", "30"}}));
  ASSERT_EQ(row.values.size(), 2U);
  EXPECT_EQ(std::get<double>(row.values[0]), result.runs[0].kinds[0].condition);
  EXPECT_EQ(std::get<double>(row.values[1]), result.runs[0].nominal_final[0]);
}

// What `hamjet motion` has in its summary: here the deputy's own start is the farthest it comes,
// since it is carried toward a chief of the same period.
TEST_F(SweepItems, AMotionHasItsSeparationsAndErrors) {
  study_.command = "motion";
  study_.constants = {{"jet.duration_canonical", "0.01"},
                      {"deputy", "{position_m = [0, -1000, 0], velocity_m_s = [0, 0.5, 0]}"}};
  study_.columns = {{"nearest", "m", "/nearest/separation_m"},
                    {"farthest", "m", "/farthest/separation_m"},
                    {"error", "m", "/largest_error_m"}};
  const SweepRow row = run_sweep_item(study_, 4);
  ASSERT_EQ(row.exit_code, 0) << row.error;
  EXPECT_LT(std::get<double>(row.values[0]), 999);
  EXPECT_NEAR(std::get<double>(row.values[1]), 1000, 1e-6);
  const DeputyMotion motion =
      study_deputy_motion(parse_scene(sweep_scene, "base.toml", sweep_overrides(study_, 4)));
  EXPECT_EQ(std::get<double>(row.values[2]), motion.largest_error_m(2));
  study_.constants.pop_back();
  const SweepRow without = run_sweep_item(study_, 4);
  EXPECT_NE(without.error.find("deputy: missing, must be a table [deputy]"), std::string::npos)
      << without.error;
}

// An item is a summary of the command of the same name, whatever the study: here of the smallest
// table that each works on, in a field that singles out a frozen orbit.
TEST_F(SweepItems, AreOfEveryStudy) {
  for (const StudyDescription& study : study_descriptions()) {
    study_.command = study.command;
    study_.constants = {
        {"system",
         "{model = \"zonal-gravity\", mu_km3_s2 = 398600.4415, radius_km = 6378.1363, "
         "J2 = 1.0826e-3, J3 = -2.53e-6}"},
        {"nominal",
         "{a_km = 7100, e = 0.001, i_deg = 50, raan_deg = 10, argp_deg = 90, ma_deg = 0}"},
        {"jet.duration_canonical", "7"}};
    study_.keys = {};
    study_.items = {{}};
    if (!study.table.empty()) {
      study_.constants.push_back(
          {std::string(study.table), "{" + std::string(study.smallest) + "}"});
    }
    if (study.table == "periodic") {  // the node of an orbit about an oblate body turns
      study_.constants[0].value = "{model = \"kepler\", mu_km3_s2 = 398600.4415}";
    }
    if (study.table == "assignment") {
      study_.constants.push_back(
          {"transfer", "{" + std::string(study_of_table("transfer").smallest) + "}"});
    }
    study_.columns = {{"integrator", "", "/integrator"}};
    const SweepRow row = run_sweep_item(study_, 0);
    ASSERT_EQ(row.exit_code, 0) << study.command << ' ' << study.table << ": " << row.error;
    EXPECT_EQ(std::get<std::string>(row.values[0]), "gauss8") << study.command;
  }
}

TEST_F(SweepItems, WhatFailsIsARow) {
  study_.items[3][0] = "1";  // a parabola has no semi-major axis
  const SweepRow row = run_sweep_item(study_, 3);
  EXPECT_EQ(row.exit_code, 3);
  // With the scene's name, wherever it is.
  EXPECT_EQ(row.error.rfind("--set nominal.e: ", 0), 0U) << row.error;
  EXPECT_EQ(row.values, std::vector<SweepValue>(2));

  study_.constants = {{"jet.order", "21"}};
  EXPECT_EQ(run_sweep_item(study_, 0).exit_code, 6);
  study_.constants = {{"generating_function.kinds", "[\"F2\"]"}, {"jet.duration_canonical", "0"}};
  EXPECT_EQ(run_sweep_item(study_, 0).exit_code, 0);
  // F1 does not exist at the start, where dq/dp0 = 0.
  study_.constants = {{"jet.duration_canonical", "0"}};
  const SweepRow singular = run_sweep_item(study_, 0);
  EXPECT_EQ(singular.exit_code, 4);
  EXPECT_NE(singular.error.find("qqq-qqq"), std::string::npos) << singular.error;
  EXPECT_TRUE(std::holds_alternative<double>(singular.values[1]));
}

// All errors of an item's scene stand in its row, which is one line.
TEST_F(SweepItems, SeveralErrorsAreOneRow) {
  study_.items[3][1] = "200";
  study_.constants = {{"jet.order", "0"}};
  const SweepRow row = run_sweep_item(study_, 3);
  EXPECT_EQ(row.exit_code, 3);
  EXPECT_EQ(row.error.find('\n'), std::string::npos) << row.error;
  for (const char* const word : {"--set nominal.i_deg: out of range, got 200", "; ",
                                 "--set jet.order: out of range, got 0"}) {
    EXPECT_NE(row.error.find(word), std::string::npos) << row.error;
  }
}

TEST_F(SweepItems, AColumnThatLeadsNowhereIsTheStudysMistake) {
  const auto message = [&](const std::string& pointer) {
    study_.columns[1].pointer = pointer;
    const SweepRow row = run_sweep_item(study_, 0);
    EXPECT_EQ(row.exit_code, row.astray.empty() ? 0 : 3);
    return row.astray;
  };
  EXPECT_NE(message("/runs/0/energy_eror").find("study.toml:22:9: column.1.value: leads nowhere"),
            std::string::npos);
  EXPECT_NE(message("/runs/0/energy_eror").find("did you mean energy_error?"), std::string::npos);
  EXPECT_NE(message("/runs/gauss9/energy_error").find("\"gauss9\""), std::string::npos);
  EXPECT_NE(message("/runs/0").find("is an object"), std::string::npos);
  EXPECT_NE(message("/order/0").find("a value already"), std::string::npos);
  // Beyond the end of a list, and below what was not computed, there is nothing.
  EXPECT_EQ(message("/runs/7/energy_error"), "");
  EXPECT_EQ(message("/reference/steps"), "");
  EXPECT_EQ(run_sweep_item(study_, 0).values[1], SweepValue());
}

TEST_F(SweepItems, AColumnThatLeadsNowhereForOneItemIsItsRow) {
  study_.columns[1].pointer = "/runs/gauss8/nominal_final/0";
  study_.keys.push_back({"integrator.gauss8.label", false, "here"});
  for (auto& item : study_.items) item.emplace_back("\"gauss8\"");
  study_.items[5].back() = "\"g\"";
  const SweepRow row = run_sweep_item(study_, 5);
  EXPECT_EQ(row.exit_code, 3);
  EXPECT_NE(row.error.find("column x_final: leads nowhere in summary.json, got \"gauss8\""),
            std::string::npos)
      << row.error;
  const SweepDirectory directory(rows(), study_);
  EXPECT_EQ(run_sweep_items(study_, directory, {4, 5, 6}, 1, [](const auto&) {}).failed, 1U);
  // First of all it is taken for a mistake of the study.
  try {
    run_sweep_items(study_, directory, {5, 6}, 1, [](const auto&) {});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::scene);
    EXPECT_NE(std::string(error.what()).find("study.toml:22:9: column.1.value: leads nowhere"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(SweepItems, WhatAnotherProcessIsWritingIsNoLeftover) {
  const SweepDirectory directory(rows(), study_);
  directory.write(run_sweep_item(study_, 0));
  const auto folder = rows() / "rows" / "000";
  char host[64] = {};
  ASSERT_EQ(::gethostname(host, sizeof host - 1), 0);
  const auto temporary = [&](const std::string& writer) {
    return write_text(folder / ("000001.json." + writer + ".tmp"), "half a r");
  };
  const auto of_this = temporary(std::string(host) + "-" + std::to_string(::getpid()));
  // The largest process number of Linux is below 2^22.
  const auto of_dead = temporary(std::string(host) + "-2147483647");
  const auto of_other = temporary("node17-2147483647");
  const auto of_old = temporary("node18-2147483647");
  std::filesystem::last_write_time(
      of_old, std::filesystem::file_time_type::clock::now() - std::chrono::hours(2));
  directory.remove_leftovers();
  EXPECT_TRUE(std::filesystem::exists(of_this));
  EXPECT_TRUE(std::filesystem::exists(of_other));
  EXPECT_FALSE(std::filesystem::exists(of_dead));
  EXPECT_FALSE(std::filesystem::exists(of_old));
}

TEST_F(SweepItems, RowsAreNotWrittenBehindALink) {
  const SweepDirectory directory(rows(), study_);
  std::filesystem::create_directories(rows() / "elsewhere");
  std::filesystem::create_directory_symlink("elsewhere", rows() / "rows");
  try {
    directory.write(run_sweep_item(study_, 0));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input_output);
    EXPECT_NE(std::string(error.what()).find("rows is a symbolic link"), std::string::npos)
        << error.what();
  }
  EXPECT_TRUE(std::filesystem::is_empty(rows() / "elsewhere"));
}

TEST_F(SweepItems, ARowIsReadAsItWasWritten) {
  const SweepDirectory directory(rows(), study_);
  const SweepRow row{7, 1, "a check, \"failed\"", {std::nextafter(0.1, 1), std::string("F1, \n")}};
  directory.write(row);
  EXPECT_EQ(directory.read(7), row);
  auto row_state = SweepDirectory::RowState::whole;
  EXPECT_FALSE(directory.read(8, &row_state));
  EXPECT_EQ(row_state, SweepDirectory::RowState::missing);
  // Cut at any byte, or with any byte changed, it is none.
  const std::filesystem::path file = rows() / "rows/000/000007.json";
  const std::string text = content(file);
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string flipped = text;
    flipped[i] = static_cast<char>(flipped[i] ^ 1);
    for (const std::string& damaged : {text.substr(0, i), flipped}) {
      write_text(file, damaged);
      EXPECT_FALSE(directory.read(7, &row_state)) << i;
      EXPECT_EQ(row_state, SweepDirectory::RowState::damaged);
    }
  }
}

TEST_F(SweepItems, ARowOfAnotherStudyOrItemDoesNotCount) {
  const SweepDirectory directory(rows(), study_);
  directory.write({7, 0, "", {1.0, 2.0}});
  auto row_state = SweepDirectory::RowState::whole;
  std::filesystem::copy_file(rows() / "rows/000/000007.json", rows() / "rows/000/000008.json");
  EXPECT_FALSE(directory.read(8, &row_state));
  EXPECT_EQ(row_state, SweepDirectory::RowState::foreign);

  SweepStudy other = study_;
  other.items[0][0] = "0.01";
  const SweepDirectory others(temporary_.path() / "other", other);
  others.write({3, 0, "", {1.0, 2.0}});
  std::filesystem::copy_file(temporary_.path() / "other/rows/000/000003.json",
                             rows() / "rows/000/000003.json");
  EXPECT_FALSE(directory.read(3, &row_state));
  EXPECT_EQ(row_state, SweepDirectory::RowState::foreign);
  EXPECT_THROW(SweepDirectory(rows(), other), Error);
}

TEST_F(SweepItems, ThreadsGiveTheSameBits) {
  std::vector<std::size_t> items(study_.items.size());
  for (std::size_t i = 0; i < items.size(); ++i) items[i] = i;
  std::vector<std::string> tables;
  for (const std::size_t threads : {1U, 2U, 4U}) {
    const SweepDirectory directory(temporary_.path() / std::to_string(threads), study_);
    std::size_t last_seen = 0;
    const SweepProgress progress =
        run_sweep_items(study_, directory, items, threads,
                        [&](const SweepProgress& now) { last_seen = now.finished; });
    EXPECT_EQ(progress.finished, items.size());
    EXPECT_EQ(last_seen, items.size());
    tables.push_back(sweep_csv(study_, read_sweep_rows(study_, directory)));
  }
  EXPECT_EQ(tables[0], tables[1]);
  EXPECT_EQ(tables[0], tables[2]);
  EXPECT_EQ(tables[0].find("missing"), std::string::npos);
}

TEST_F(SweepItems, WhatTheWatcherThrowsStopsThem) {
  struct Stop {};
  std::vector<std::size_t> items(12);
  study_.constants = {{"integrator.gauss8.stages", "1"},
                      {"integrator.gauss8.tolerance", "null"},
                      {"integrator.gauss8.step_canonical", "1e-7"}};  // ten million steps
  const SweepDirectory directory(rows(), study_);
  EXPECT_THROW(
      run_sweep_items(study_, directory, items, 2, [](const SweepProgress&) { throw Stop(); }),
      Stop);
  EXPECT_FALSE(std::filesystem::exists(rows() / "rows"));
}

TEST_F(SweepItems, TheTableSaysWhatFailedAndWhatIsMissing) {
  study_.items = {{"0", "0"}, {"0.5", "\"a, b\""}, {"", "90"}};
  SweepRows rows;
  rows.rows = {SweepRow{0, 0, "", {0.1, std::string("F1")}},
               SweepRow{1, 4, "no, \"solution\"", {{}, true}}, std::nullopt};
  EXPECT_EQ(sweep_csv(study_, rows),
            "item,nominal.e,nominal.i_deg,condition,x_final (length),exit_code,error\n"
            "0,0,0,0.10000000000000001,F1,0,\n"
            "1,0.5,\"a, b\",,true,4,\"no, \"\"solution\"\"\"\n"
            "2,,90,,,missing,\n");
  study_.map.reset();
  const StudyReport report = sweep_report(study_, rows);
  EXPECT_EQ(report.exit_code, 1);
  EXPECT_NE(report.failure.find("of 3 items 1 failed and 1 are missing"), std::string::npos)
      << report.failure;
  EXPECT_NE(report.table.find("3: 1 done, 1 failed, 1 missing"), std::string::npos) << report.table;
}

TEST_F(SweepItems, TheMapIsDrawn) {
  SweepRows rows;
  for (std::size_t i = 0; i < study_.items.size(); ++i) {
    rows.rows.push_back(SweepRow{i, 0, "", {static_cast<double>(i + 1), {}}});
  }
  rows.rows[3]->values[0] = {};
  rows.rows[5].reset();
  const StudyReport report = sweep_report(study_, rows);
  ASSERT_FALSE(report.drawing_problem) << *report.drawing_problem;
  const auto map = std::find_if(report.files.begin(), report.files.end(),
                                [](const auto& file) { return file.path == "map.svg"; });
  ASSERT_NE(map, report.files.end());
  for (const char* text :
       {"eccentricity", "inclination (degrees)", "condition", "least: 1", "missing", "no value"}) {
    EXPECT_NE(map->content.find(text), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace hamjet::io
