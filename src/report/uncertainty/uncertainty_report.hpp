#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../../studies/uncertainty/uncertainty.hpp"
#include "../drawing/chart.hpp"
#include "hamjet/detail/report/report_origin.hpp"
#include "hamjet/detail/report/study_report.hpp"

namespace hamjet::io {

/// What another study adds to the report of `hamjet uncertainty`: a member of summary.json, lines
/// for the terminal, charts under a heading of the page, and files.
struct UncertaintySection {
  std::string key;                    ///< the key in summary.json
  nlohmann::ordered_json json;        ///< the value of that key
  std::string verdict;                ///< a sentence behind that of the moments; or empty
  std::vector<std::string> warnings;  ///< why it is not to be trusted, a sentence each, for both
  std::string table;                  ///< for the terminal, below the moments
  std::string title;                  ///< title of the page's section
  std::string html;                   ///< above the charts
  std::vector<Chart> charts;          ///< not fitted
  std::vector<ReportFile> files;
  std::vector<std::string> failed_checks;  ///< checks of the scene that failed, a sentence each
};

/// `summary.json`.
nlohmann::ordered_json uncertainty_json(const UncertaintyResult& result);

/// The 3-sigma ellipses by order in two components of a state, with flown samples; and the
/// distribution of one component, by flown samples and by the linear theory. Not fitted.
Chart ellipse_chart(const UncertaintyResult& result, const UncertaintyAt& at,
                    const UncertainState& state, Eigen::Index across, Eigen::Index up);
Chart histogram_chart(const UncertaintyResult& result, const UncertaintyAt& at,
                      const UncertainState& state, Eigen::Index component);
/// By how much probabilities by the linear covariance may be wrong along time, by coordinates.
Chart misleading_chart(const UncertaintyResult& result);

/// The files of `hamjet uncertainty`: `moments.csv`, `report.html`, `summary.json`, and what the
/// sections of collisions and passive safety bring, where the result has them.
StudyReport uncertainty_report(const UncertaintyResult& result, const ReportOrigin& origin);

}  // namespace hamjet::io
