#pragma once

#include <string>

#include "hamjet/studies/validity.hpp"

namespace hamjet::io {

/// The first that a reader sees: how far each order carries at the last time.
std::string validity_verdict(const ValidityResult& result);

/// Why no separation could be proved in some order, where there is one, as a sentence after a
/// space.
std::string unproved_text(const ValidityResult& result);

}  // namespace hamjet::io
