#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/detail/studies/self_checks.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// A circle of the normal form about the frozen orbit, of the chief's energy and H.
struct LibrationCircle {
  bool is_chiefs = false;  ///< whether the scene's chief is on this circle
  double amplitude =
      0;  ///< radius of the eccentricity vector's circle: that of the pair over sqrt(L)
  double rotation_number = 0;  ///< turns of the eccentricity vector a revolution
  double mean_period = 0;      ///< nodal, canonical
  double mean_node = 0;        ///< radians a revolution
  double action = 0;           ///< canonical
  /// How far an orbit of the circle is from where the normal form has it after the flown
  /// revolutions, in (q, p) relative to the radius; none where it could not be flown.
  std::optional<double> miss;
  /// The circle in (q, p) less the frozen orbit's, over sqrt(L): for small eccentricities that of
  /// the eccentricity vector.
  std::vector<std::array<double, 2>> curve;
  /// Where the flown orbit is after these revolutions; none where there is no miss.
  std::optional<std::array<double, 2>> flown_to;
};

/// An amplitude that was flown to find how far the normal form reaches.
struct FlownAmplitude {
  double amplitude = 0;
  double rotation_number = 0;
  std::optional<double> miss;  ///< none where it could not be flown
};

/// The frozen orbit of a scene's chief, of its energy and momentum H about the axis, and what
/// librates about it.
struct FrozenOrbitStudy {
  Scene scene;
  // The frozen orbit, refined in extended precision, on the section of the chief's mean argument of
  // latitude and with its node; canonical.
  std::vector<double> state;
  double semi_major_axis = 0;
  double eccentricity = 0;
  double inclination_deg = 0;
  double pericentre_deg = 0;
  double nodal_period = 0;
  double node = 0;          ///< radians a revolution
  double residual = 0;      ///< by how much a revolution moves (q, p), in extended precision
  double trace = 0;         ///< the sum of the two multipliers
  double trace_less_2 = 0;  ///< the trace less 2, without the loss of digits
  double area_defect = 0;   ///< the product of the multipliers, less 1
  int iterations = 0;
  double pericentre_depth =
      0;  ///< depth of the pericentre below the body's radius; negative above it
  // The normal form.
  std::string failure;  ///< if not empty, the reason why there is no normal form; what follows is
                        ///< empty then
  double smallest_divisor = 0;
  int flown_revolutions = 0;
  std::vector<LibrationCircle>
      circles;  ///< in the order of their amplitudes; the chief's circle is the last
  /// The largest amplitude at which an orbit is flown to within largest_miss of the normal form.
  double reach = 0;
  std::vector<FlownAmplitude> flown_amplitudes;  ///< ascending
  /// Of the chief's flight and the frozen orbit's, a revolution each.
  std::vector<SelfCheck> checks;

  static constexpr double largest_miss = 1e-3;
  /// The amplitude of an eccentricity as a length, metres: a times it.
  double length_m(double of_eccentricity) const;
  /// One of the two multipliers, its real and imaginary parts; the other one is its inverse.
  std::array<double, 2> multiplier() const;
  bool is_stable() const { return trace_less_2 < 0 && trace > -2; }
  bool is_inside_body() const { return pericentre_depth > 0; }
};

/// Finds the frozen orbit and its normal form to the scene's order. Throws Error(scene) for a scene
/// whose chief is no orbit or has no nodal section, and Error(numerical) where no frozen orbit is
/// found.
FrozenOrbitStudy study_frozen_orbit(const Scene& scene, const ProgressCallback& progress = {});

}  // namespace hamjet
