#pragma once

#include <string>
#include <vector>

#include "../store/table_view.hpp"

namespace hamjet::io {

/// All tables of results without rows, as they are declared: of a frame RTN and of two orders.
std::vector<TableView> declared_tables();

/// The page of all columns in Markdown, from what the tables declare.
/// src/formats/columns/README.md holds it.
std::string columns_page();

}  // namespace hamjet::io
