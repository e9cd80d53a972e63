#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamjet/formats/jet_file.hpp"

namespace hamjet::cli {

/// io::read_jet_file, which prints the notes of the reader on standard error.
io::StoredJet read_noted_jet(const std::string& path, const std::optional<std::string>& label,
                             const io::JetDescription& foreign = {});

/// io::read_jets_at_times, likewise.
std::vector<io::StoredJet> read_noted_jets(const std::string& path,
                                           const std::optional<std::string>& label,
                                           const io::WantedTimes& wanted);

/// The times of an option --time: numbers of seconds between commas, or all.
io::WantedTimes wanted_times(const std::string& option);

}  // namespace hamjet::cli
