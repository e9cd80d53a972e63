#pragma once

#include <memory>

#include "hamjet/astronomy/instant.hpp"
#include "hamjet/detail/dynamics/time_function.hpp"

namespace hamjet {

class PiecewiseHermite;

enum class PerturbingBody { sun, moon };

/// The position of the Sun's or the Moon's centre relative to the Earth's, along the axes of GCRF,
/// along time: the place where the body is, without the time of light. Sources: ERFA's eraEpv00
/// (VSOP2000 as shortened by SOFA, 1900 to 2100: 4.6 km, 3e-8) and eraMoon98 (Meeus's form of
/// ELP-2000/82: some 10 arcseconds and 40 km, 1e-4; of what the Moon does to an orbit of low height
/// that leaves a millimetre a day). TT stands for TDB.
class BodyPosition final : public TimeFunction {
 public:
  /// Times as for EarthRotation; lengths in `unit_km`. Throws Error(too_large).
  BodyPosition(PerturbingBody body, const Instant& epoch, const Extended& unit_s, double unit_km,
               double first, double last);
  ~BodyPosition() override;

  std::size_t components() const override { return 3; }
  void expand(double t, int degree, double* out) const override;
  void expand(const Extended& t, int degree, Extended* out) const override;

 private:
  template <class Real>
  void expand_as(const Real& t, int degree, Real* out) const;

  double first_;
  double last_;
  double unit_s_;
  std::unique_ptr<const PiecewiseHermite> position_;
};

}  // namespace hamjet
