#pragma once

#include "../scene/tables/table_description.hpp"

namespace hamjet::io {

/// The keys at the top of a study of `hamjet sweep`, with those of its tables.
const TableDescription& sweep_study_table();

}  // namespace hamjet::io
