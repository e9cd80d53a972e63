#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "chart.hpp"
#include "chart_drawer.hpp"
#include "hamjet/detail/report/report_origin.hpp"

// What the pages of all reports are made of, in HTML. A page needs no other file, no network and no
// script.

namespace hamjet::io {

/// The pages' style sheet.
extern const char* const page_style;

/// A fitted chart with its notes and how to read it, or why it is not there.
std::string figure_html(const Chart& chart, ChartDrawer& drawer);
/// Fitted charts side by side where the window is wide enough; below them the notes of all, and how
/// to read the first.
std::string panels_html(const std::vector<Chart>& charts, ChartDrawer& drawer);
/// The figure_html of a chart under its title.
std::string section_html(const Chart& chart, ChartDrawer& drawer);

/// A table in a box of its own, which scrolls where the window is too narrow. What it says stands
/// above the box: a caption would be as narrow as its table. `caption`, `head` and `rows` are HTML.
std::string table_html(std::string_view caption, std::string_view head, std::string_view rows);
/// The same table from rows of plain text. The first row is the head, and the first cell of each
/// row is its name.
std::string table_html(std::string_view caption, const std::vector<std::vector<std::string>>& rows);
/// Cells of a head, of a row's name and of its values, from plain text.
std::string header_cells(const std::vector<std::string>& names);
std::string row_name_cell(std::string_view text);
std::string cell(std::string_view text);

/// An entry of the list beside the first plot, from plain text.
std::string fact_html(std::string_view name, std::string_view value);
/// The first entries of that list: what a reader needs to make the report again.
std::string origin_facts_html(const ReportOrigin& origin);

/// A page's parts.
struct ReportPage {
  std::string title;         ///< plain text
  std::string notice;        ///< HTML above the verdict
  std::string verdict;       ///< plain text, the first that a reader sees
  std::string first_figure;  ///< HTML
  std::string facts;         ///< HTML, entries of the list beside the first figure
  std::string sections;      ///< HTML
};

/// The whole page. What the drawer could not draw is said below the verdict, so that all plots must
/// have been drawn before.
std::string page_html(const ReportPage& page, const ChartDrawer& drawer);

}  // namespace hamjet::io
