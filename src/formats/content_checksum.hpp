#pragma once

#include <string>

#include "hamjet/formats/stored_jet.hpp"

namespace hamjet::io {

/// The CRC-32, in hexadecimal digits, of all content that a reader of jets takes from a file:
/// `description` without its jet and notes, and `jet` in digits that bring it back bit by bit.
std::string content_checksum(const StoredJet& description, const FlowJet<Extended>& jet);

}  // namespace hamjet::io
