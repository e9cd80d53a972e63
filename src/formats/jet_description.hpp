#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/formats/stored_jet.hpp"

namespace hamjet::io {

/// The coordinates of a model, in words.
std::string frame_of(SystemModel model);

/// The names of a chart's coordinates, positions and then momenta, as at CanonicalChart; those of
/// elements by the angles that they are made of.
std::vector<std::string> coordinate_names(ChartName chart);

/// The names of the columns of a jet's series, and which of these its values and its variables are.
struct SeriesNames {
  std::vector<std::string> all;
  std::vector<std::size_t> components;
  std::vector<std::size_t> variables;

  std::vector<std::string> of(const std::vector<std::size_t>& indices) const {
    std::vector<std::string> chosen;
    for (const std::size_t i : indices) chosen.push_back(all[i]);
    return chosen;
  }
};
/// Of a jet in other coordinates than Cartesian: with other ones at the end, those at the start
/// before them; of flow boxes the names at flow_box_coordinate_names.
SeriesNames series_names(const StoredJet& stored);

/// The description of a run's polynomials in its scene's coordinates. Precondition: it has such.
StoredJet describe_charted_jet(const PropagationResult& result, const RunResult& run);

/// `polynomials.csv`, their text, and reading it.
inline constexpr std::string_view polynomials_file = "polynomials.csv";
std::string polynomials_csv(const StoredJet& description, const FlowJet<Extended>& jet);
FlowJet<Extended> read_polynomials_csv(const StoredJet& description, int order,
                                       const std::string& name, std::string_view text);

/// Throws Error(usage) where a file of such a format does not say a jet's coordinates.
void require_place_for_coordinates(const StoredJet& stored, const std::string& ending);

/// What a text of polynomials alone does not say: scene, components, variables, units; and that the
/// coefficients are rounded, where they are.
std::vector<std::string> jet_notes(const StoredJet& description, int order);

}  // namespace hamjet::io
