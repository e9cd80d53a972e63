#pragma once

#include <string>
#include <vector>

#include "hamjet/formats/stored_jet.hpp"

namespace hamjet::io {

/// The coordinates of a model, in words.
std::string frame_of(SystemModel model);

/// What a text of polynomials alone does not say: scene, components, variables, units; and that the
/// coefficients are rounded, where they are.
std::vector<std::string> jet_notes(const StoredJet& description, int order);

}  // namespace hamjet::io
