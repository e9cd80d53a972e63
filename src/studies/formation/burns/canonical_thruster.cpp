#include "canonical_thruster.hpp"

#include <cmath>

namespace hamjet {
namespace {

double mean_share_rate(double x) {
  if (x > 1e-2) return (-std::expm1(-x) - x * std::exp(-x)) / (x * x);
  return 1.0 / 2 - x * (1.0 / 3 - x * (1.0 / 8 - x * (1.0 / 30 - x / 144)));
}

}  // namespace

// Small x take its series, as the differences would lose their digits.
double mean_share(double x) {
  if (x > 1e-2) return 1 + std::expm1(-x) / x;
  return x * (1.0 / 2 - x * (1.0 / 6 - x * (1.0 / 24 - x * (1.0 / 120 - x / 720))));
}

CanonicalThruster::CanonicalThruster(const ThrusterSettings& settings, const MetricUnits& units)
    : acceleration(settings.acceleration_m_s2 * units.time_s / units.velocity_m_s()) {
  if (settings.exhaust_m_s) exhaust = *settings.exhaust_m_s / units.velocity_m_s();
}

double CanonicalThruster::length(double change, double mass) const {
  if (!mass_falls()) return change / acceleration;
  return -mass * exhaust / acceleration * std::expm1(-change / exhaust);
}

double CanonicalThruster::mass_after(double change, double mass) const {
  return mass_falls() ? mass * std::exp(-change / exhaust) : mass;
}

double CanonicalThruster::centre(double change, double mass) const {
  if (!mass_falls()) return length(change, mass) / 2;
  return mass * exhaust / acceleration * mean_share(change / exhaust);
}

double CanonicalThruster::centre_rate(double change, double mass) const {
  if (!mass_falls()) return 1 / (2 * acceleration);
  return mass / acceleration * mean_share_rate(change / exhaust);
}

}  // namespace hamjet
