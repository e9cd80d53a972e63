#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <type_traits>

#include "hamjet/detail/dynamics/spherical_harmonic_coefficients.hpp"
#include "scene/study_reader.hpp"
#include "studies/descriptions/settings_fields.hpp"

// The settings that a scene was read into, as a text, so that two readings can be compared.

namespace hamjet::io {

/// All settings of a study that a key can change, in one text.
class StudyText {
 public:
  template <class Value>
  void add(const Value& value) {
    if constexpr (HasFields<Value>) {
      for_each_field(value, [&](std::string_view, const auto& member) { add(member); });
    } else if constexpr (std::is_enum_v<Value>) {
      add(static_cast<int>(value));
    } else if constexpr (std::is_same_v<Value, ZonalCoefficients>) {
      for (int n = ZonalCoefficients::lowest; n <= ZonalCoefficients::highest; ++n) add(value[n]);
    } else if constexpr (requires {
                           *value;
                           value.has_value();
                         }) {
      if (value) add(*value);
      text_ += "; ";
    } else if constexpr (std::is_base_of_v<RelativeState, Value>) {
      for (int i = 0; i < 3; ++i) add_all(value.position_m[i], value.velocity_m_s[i]);
      if constexpr (std::is_same_v<Value, ArrivalState>) {
        if (value.in_form) add_all(static_cast<int>(value.in_form->form), value.in_form->numbers);
        add(value.own_state);
      }
    } else if constexpr (std::is_same_v<Value, Waypoint>) {
      add(value.time);
      for (int i = 0; i < 3; ++i) add(value.position_m[i]);
    } else if constexpr (std::is_arithmetic_v<Value> ||
                         std::is_convertible_v<Value, std::string_view>) {
      text_ += fmt::format("{} ", value);
    } else {
      for (const auto& element : value) add(element);
      text_ += "; ";
    }
  }
  void add(const std::shared_ptr<const SphericalHarmonicCoefficients>& field) {
    if (!field) return;
    for (int n = 0; n <= field->degree(); ++n) {
      for (int m = 0; m <= std::min(n, field->order()); ++m)
        add_all(field->C(n, m), field->S(n, m));
    }
  }
  /// The heights and densities stand for the profile.
  void add(const std::shared_ptr<const DensityProfile>&) {}
  /// The checksum of its file stands for it.
  void add(const std::shared_ptr<const EarthOrientation>&) {}
  void add(const std::shared_ptr<const Sunlight>&) {}
  template <class... Values>
  void add_all(const Values&... values) {
    (add(values), ...);
  }
  void add(const TransferSettings& s) {
    add_all(s.frame, s.start, s.end, s.times, s.kind, s.tolerance_m, s.refine, s.refined_miss_m,
            s.singular_margin, s.strict, s.impulse_gap, s.longest_coast, s.revolutions, s.waypoints,
            s.thrust, s.thrust_order, s.largest_thrust_m_s2, s.feedback, s.errors);
  }
  void add(const ThrustErrorSettings& s) {
    add_all(s.navigation, s.magnitude, s.direction_deg, s.samples, s.seed);
  }
  void add(const ThrusterSettings& s) {
    add_all(s.acceleration_m_s2, s.exhaust_m_s, s.mass_kg, s.propellant_kg, s.longest_burn_s,
            s.shortest_burn_s, s.attitude);
  }
  void add(const DeputySettings& s) { add_all(s.frame, s.start); }
  void add(const ValiditySettings& s) {
    add_all(s.tolerance_m, s.times, s.semi_axes, s.samples, s.frame, s.separation_m,
            s.most_domains);
  }
  void add(const DomainSettings& s) { add_all(s.tolerance_m, s.most_domains); }
  void add(const Covariance& s) {
    const Matrix<double> matrix = s.matrix();
    for (const double entry : matrix.reshaped()) add(entry);
  }
  void add(const StateUncertainty& s) { add_all(s.frame, s.covariance); }
  void add(const BurnUncertainty& s) { add_all(s.frame, s.covariance()); }
  void add(const CollisionWatch& s) {
    add_all(s.radius_m, s.from, s.to, s.event, s.sampling, s.samples, s.confidence);
  }
  void add(const SafetyWatch& s) {
    add_all(s.keep_apart_m, s.from, s.to, s.burn_shares, s.deputies, s.share, s.confidence,
            s.samples, s.least_separation_m, s.least_deviations);
    if (s.keep_out_m) add_all((*s.keep_out_m)[0], (*s.keep_out_m)[1], (*s.keep_out_m)[2]);
  }
  void add(const UncertaintySettings& s) {
    add_all(s.frame, s.chief, s.deputy, s.burn, s.times, s.acceleration_density_m2_s3, s.domains,
            s.collision, s.safety, s.coordinates, s.samples, s.seed);
  }
  void add(const AssignmentSettings& s) { add_all(s.deputies, s.slots, s.time); }
  void add(const BoundedSettings& s) {
    add_all(s.sizes_m, s.phase_deg, s.cross_track, s.along_track, s.revolutions, s.refine, s.box);
  }
  void add(const EventSettings& s) {
    add_all(s.surface, s.normal[0], s.normal[1], s.normal[2], s.offset_km, s.distance_km,
            s.direction, s.number, s.amplitudes_m);
  }
  void add(const PeriodicFamilySettings& s) { add_all(s.along, s.to, s.step, s.members); }
  void add(const PeriodicSettings& s) {
    add_all(s.period, s.hold, s.value, s.arcs, s.tolerance, s.family);
  }
  void add(const BoxSettings& s) {
    add_all(s.half_widths_m, s.reference, s.position_m, s.return_orbits, s.days);
  }
  void add(const EphemerisSettings& s) {
    add_all(s.epoch, s.time_system, s.reference_frame, s.center_name, s.reference_frame_epoch,
            s.object_name, s.object_id, s.deputy_name, s.deputy_id, s.originator, s.oem_version);
  }
  void add(const FigureSettings& s) { add_all(s.quantity, s.kind); }
  void add(const SelfCheckSetting& s) { add_all(s.is_on, s.limit); }
  void add(const Scene& s) {
    add_all(s.title, s.precision, s.system, s.units, s.canonical_radius, s.nominal, s.duration,
            s.order, s.arcs, s.variables, s.jet_times, s.integrators, s.separation, s.kinds,
            s.reference, s.relative_hamiltonian_times, s.comparison, s.figure, s.deputy, s.transfer,
            s.thruster, s.validity, s.eval, s.assignment, s.uncertainty, s.bounded, s.event,
            s.periodic, s.output.formats, s.ephemeris);
    for (std::size_t i = 0; i < self_check_count; ++i) add(s.checks[SelfCheckName(i)]);
  }
  void add(const EnergyConservationStudy& s) {
    add_all(s.title, s.system, s.nominal, s.method, s.first_step, s.duration, s.expected,
            s.require_energy_error);
  }
  void add(const CanonicalTransformationStudy& s) {
    add_all(s.title, s.system, s.nominal, s.duration, s.steps, s.require_invariance);
  }
  void add(const OptimalControlStudy& s) {
    add_all(s.title, s.model, s.discretization, s.duration, s.steps, s.refinements, s.start, s.end,
            s.costate_guess, s.shooting_intervals, s.require_cost_error, s.require_equivalence);
  }

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace hamjet::io
