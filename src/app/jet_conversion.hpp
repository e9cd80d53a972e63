#pragma once

#include <string>
#include <vector>

#include "hamjet/formats/stored_jet.hpp"
#include "hamjet/maps/symplecticity.hpp"

namespace hamjet::cli {

/// A stored jet in other coordinates, and what it lost.
struct ConvertedJet {
  io::StoredJet stored;
  CoordinatesAtEnds from;  ///< those of the given one
  /// By how much the jet differs from the given one, degree by degree, once it is brought back: the
  /// largest difference relative to the largest coefficient of the degree. Empty of a flow box,
  /// into which no jet is brought back.
  std::vector<double> there_and_back;
  std::vector<SymplecticityDefect> symplecticity;  ///< in the new coordinates, which are canonical
};

/// Converts a jet of an orbit in all six variables, in extended precision, and rounds it to its own
/// precision. Errors of the coefficients, which are known in one kind of coordinates alone, are
/// left out. Throws Error(usage) for other jets and for coordinates that no jet in six variables is
/// in, and Error(numerical) where the orbit has not such coordinates. `name` is the file's.
ConvertedJet converted_jet(const io::StoredJet& stored, const CoordinatesAtEnds& coordinates,
                           const std::string& name);

}  // namespace hamjet::cli
