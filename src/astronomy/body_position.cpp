#include "hamjet/astronomy/body_position.hpp"

#include <erfa.h>

#include <algorithm>

#include "physical_constants.hpp"
#include "sampled_days.hpp"

namespace hamjet {
namespace {

FunctionOfDate position_of(PerturbingBody body, double unit_km) {
  const double unit = astronomical_unit_km / unit_km;
  if (body == PerturbingBody::sun) {
    return [unit](double day, double fraction, double* out) {
      double heliocentric[2][3], barycentric[2][3];
      eraEpv00(day, fraction, heliocentric, barycentric);
      for (int i = 0; i < 3; ++i) out[i] = -unit * heliocentric[0][i];
    };
  }
  return [unit](double day, double fraction, double* out) {
    double state[2][3];
    eraMoon98(day, fraction, state);
    for (int i = 0; i < 3; ++i) out[i] = unit * state[0][i];
  };
}

}  // namespace

BodyPosition::BodyPosition(PerturbingBody body, const Instant& epoch, const Extended& unit_s,
                           double unit_km, double first, double last)
    : first_(first),
      last_(last),
      unit_s_(convert<double>(unit_s)),
      position_(std::make_unique<PiecewiseHermite>(
          sampled_days(epoch, unit_s, first, last, 3, position_of(body, unit_km)))) {}

BodyPosition::~BodyPosition() = default;

template <class Real>
void BodyPosition::expand_as(const Real& t, int degree, Real* out) const {
  require_within_span(convert<double>(t), first_, last_, unit_s_);
  std::array<PiecewiseHermite::Coefficients<Real>, 3> position;
  position_->expand(t, degree, position.data());
  const int known = std::min(degree, PiecewiseHermite::degree);
  for (const auto& component : position) {
    std::copy(component.begin(), component.begin() + known + 1, out);
    std::fill(out + known + 1, out + degree + 1, Real(0));
    out += degree + 1;
  }
}

void BodyPosition::expand(double t, int degree, double* out) const { expand_as(t, degree, out); }
void BodyPosition::expand(const Extended& t, int degree, Extended* out) const {
  expand_as(t, degree, out);
}

}  // namespace hamjet
