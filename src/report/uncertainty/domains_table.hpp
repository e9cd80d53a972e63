#pragma once

#include "../../store/table_view.hpp"
#include "../../studies/uncertainty/uncertainty.hpp"

namespace hamjet::io {

/// A row for each domain of each uncertain spacecraft.
TableView domains_table(const UncertaintyResult& result);

}  // namespace hamjet::io
