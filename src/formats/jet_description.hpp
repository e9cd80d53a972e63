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

/// The names of a chart's coordinates, positions and then momenta, as at CanonicalChart; elements
/// are named by the angles from which they are made.
std::vector<std::string> coordinate_names(ChartName chart);

/// The names of all columns of a jet's series, and which of these are its values and which its
/// variables.
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
/// The names for a jet in coordinates other than Cartesian. If the coordinates differ at the end,
/// those of the start come first. For flow boxes the names are those of flow_box_coordinate_names.
SeriesNames series_names(const StoredJet& stored);

/// The description of a run's polynomials in the coordinates of its scene. Precondition: the run
/// has such polynomials.
StoredJet describe_charted_jet(const PropagationResult& result, const RunResult& run);

/// The file `polynomials.csv`: its name, its text, and its reader.
inline constexpr std::string_view polynomials_file = "polynomials.csv";
std::string polynomials_csv(const StoredJet& description, const FlowJet<Extended>& jet);
FlowJet<Extended> read_polynomials_csv(const StoredJet& description, int order,
                                       const std::string& name, std::string_view text);

/// Throws Error(usage) if a jet's coordinates are not Cartesian and a file of this format could not
/// say so.
void require_place_for_coordinates(const StoredJet& stored, const std::string& ending);

/// Notes on what a text of polynomials alone does not contain: scene, components, variables, units,
/// and, if the coefficients are rounded, that they are.
std::vector<std::string> jet_notes(const StoredJet& description, int order);

}  // namespace hamjet::io
