#pragma once

#include <string>
#include <vector>

#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/formats/stored_jet.hpp"

namespace hamjet::io {

/// The coordinates of a model, in words.
std::string frame_of(SystemModel model);

/// The names of a chart's coordinates, positions and then momenta, as at CanonicalChart; those of
/// elements by the angles that they are made of.
std::vector<std::string> coordinate_names(ChartName chart);

/// Throws Error(usage) where a file of such a format does not say a jet's coordinates.
void require_place_for_coordinates(const StoredJet& stored, const std::string& ending);

/// What a text of polynomials alone does not say: scene, components, variables, units; and that the
/// coefficients are rounded, where they are.
std::vector<std::string> jet_notes(const StoredJet& description, int order);

}  // namespace hamjet::io
