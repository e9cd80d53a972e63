#include "nodal_section.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "../formation/charts/deputy_flows.hpp"
#include "hamjet/charts/flow_section.hpp"
#include "hamjet/detail/algebra/eigen.hpp"
#include "hamjet/error.hpp"

namespace hamjet {

void require_nodal_section(const Scene& scene) {
  try {
    const FlowSection<double> section(orbit_field(scene), ChartName::nodal,
                                      six_numbers(scene.nominal));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    const Eigen::Vector3d q(scene.nominal.data());
    const Eigen::Vector3d p(scene.nominal.data() + 3);
    const Eigen::Vector3d momentum = q.cross(p);
    const double inclination =
        std::atan2(std::hypot(momentum[0], momentum[1]), momentum[2]) * 180 / std::numbers::pi;
    throw Error(ErrorKind::scene,
                fmt::format("nominal: no chief with a node and a period, got an inclination of "
                            "{:.4g} deg, must be an ellipse away from the equatorial plane: {}",
                            inclination, error.what()));
  }
}

}  // namespace hamjet
