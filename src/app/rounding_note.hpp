#pragma once

#include <optional>
#include <string>

#include "hamjet/formats/jet_file.hpp"

namespace hamjet::cli {

/// What a file of this format loses of the jet's digits; no value where it keeps them all.
std::optional<std::string> rounding_note(const io::StoredJet& stored,
                                         const io::OutputFormat& format);

}  // namespace hamjet::cli
