#pragma once

#include <string>
#include <vector>

#include "../store/table_view.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet::io {

/// What all tables are declared with.
Scene declaring_scene();

// Tables without rows of the studies whose results need more than the scene's table to have them.

std::vector<TableView> declared_motion();
std::vector<TableView> declared_transfer();
std::vector<TableView> declared_validity();
std::vector<TableView> declared_uncertainty();
std::vector<TableView> declared_assignment();
std::vector<TableView> declared_event();
std::vector<TableView> declared_frozen_orbit();
std::vector<TableView> declared_bounded();

/// All tables of results without rows, as they are declared: of a frame RTN and of two orders.
std::vector<TableView> declared_tables();

/// The page of all columns in Markdown, from what the tables declare.
/// src/formats/columns/README.md holds it.
std::string columns_page();

}  // namespace hamjet::io
