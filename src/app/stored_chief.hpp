#pragma once

#include "hamjet/formats/stored_jet.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet::cli {

/// Whether a stored jet is about the chief of the scene, whose told units it must be in.
bool is_about_chief(const io::StoredJet& stored, const Scene& scene);

/// The duration and the coefficients of such a jet, in positions and momenta, in the scene's own
/// units.
double duration_in_units_of(const Scene& scene, const io::StoredJet& stored);
FlowJet<double> jet_in_units_of(const Scene& scene, const io::StoredJet& stored);

}  // namespace hamjet::cli
