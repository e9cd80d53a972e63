#pragma once

#include "hamjet/formats/stored_jet.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet::cli {

/// Whether a stored jet is about the chief of the scene.
bool is_about_chief(const io::StoredJet& stored, const Scene& scene);

}  // namespace hamjet::cli
