#pragma once

#include <string>
#include <vector>

#include "argument_words.hpp"
#include "hamjet/formats/stored_jet.hpp"
#include "hamjet/maps/symplecticity.hpp"

namespace hamjet::cli {

/// A stored jet in other coordinates, and what it lost.
struct ConvertedJet {
  io::StoredJet stored;
  CoordinatesAtEnds from;  ///< coordinates of the given jet
  /// By how much the jet differs from the given one, degree by degree, once it is brought back: the
  /// largest difference relative to the largest coefficient of the degree. Empty if the given jet
  /// is a flow box, because its gravity field need not be known.
  std::vector<double> there_and_back;
  std::vector<SymplecticityDefect> symplecticity;  ///< in the new coordinates, which are canonical
};

/// Converts a jet of an orbit in all six variables, in extended precision, and rounds it to its own
/// precision. Errors of the coefficients, which are known in one kind of coordinates alone, are
/// left out. A flow box is made by composition, in the gravity field of `scene`, which must be of
/// the jet's chief and fly it to the jet's end. Throws Error(usage) for other jets and scenes, for
/// a flow box without a scene and for coordinates that cannot be converted to, and Error(numerical)
/// where the orbit has not such coordinates. `name` is the file's.
ConvertedJet converted_jet(const io::StoredJet& stored, const CoordinatesAtEnds& coordinates,
                           const std::string& name, const Scene* scene = nullptr,
                           Caller caller = Caller::command);

}  // namespace hamjet::cli
