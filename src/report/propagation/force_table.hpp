#pragma once

#include <string>
#include <vector>

#include "../../store/table_view.hpp"
#include "../../studies/checks/force_sizes.hpp"

namespace hamjet::io {

/// The forces of a scene about the real Earth, one row for each that can be left out.
TableView force_table(const std::vector<ForceSize>& forces);

/// The same for the terminal, with the forces that act above it; empty for other models.
std::string force_text(const Scene& scene, const std::vector<ForceSize>& forces);

}  // namespace hamjet::io
