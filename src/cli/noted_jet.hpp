#pragma once

#include <optional>
#include <string>

#include "hamjet/formats/jet_file.hpp"

namespace hamjet::cli {

/// io::read_jet_file, which prints the notes of the reader on standard error.
io::StoredJet read_noted_jet(const std::string& path, const std::optional<std::string>& label,
                             const io::JetDescription& foreign = {});

}  // namespace hamjet::cli
