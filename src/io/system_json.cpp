#include "system_json.hpp"

#include <fmt/format.h>

#include "json_values.hpp"

namespace hamjet::io {

nlohmann::ordered_json system_json(const SystemSettings& system) {
  using Json = nlohmann::ordered_json;
  if (!is_orbit(system.model)) return nullptr;
  Json J = Json::object();
  for (int n = ZonalCoefficients::lowest; n <= ZonalCoefficients::highest; ++n) {
    if (system.J[n] != 0) J[fmt::format("J{}", n)] = system.J[n];
  }
  Json json = {{"mu_km3_s2", system.mu_km3_s2},
               {"radius_km", J.empty() ? Json(nullptr) : Json(system.radius_km)},
               {"zonal_coefficients", J},
               {"gravity_file", nullptr}};
  if (system.gravity_file) {
    json["gravity_file"] = {{"file", system.gravity_file->file},
                            {"model_name", text_or_null(system.gravity_file->model_name)},
                            {"tide_system", system.gravity_file->tide_system}};
  }
  return json;
}

}  // namespace hamjet::io
