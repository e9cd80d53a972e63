#pragma once

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"

namespace hamjet::test {

/// A file of data/references; see the README there for how its numbers were made.
inline nlohmann::json read_reference_file(const std::string& name) {
  const std::string path = std::string(HAMJET_SOURCE_DIR) + "/data/references/" + name;
  std::ifstream file(path);
  if (!file) throw std::runtime_error("no reference file " + path);
  return nlohmann::json::parse(file);
}

inline const nlohmann::json& reference_cases() {
  static const nlohmann::json data = read_reference_file("reference_cases.json");
  return data;
}

/// A binary64 number written in hexadecimal.
inline double from_hex(const nlohmann::json& text) {
  return std::strtod(text.get<std::string>().c_str(), nullptr);
}
inline Extended from_decimal(const nlohmann::json& text) {
  return Extended(text.get<std::string>());
}

/// An orbit whose end is known to more digits than double precision has.
struct ReferenceOrbit {
  std::string id;
  ZonalGravity field;
  std::vector<double> start;                  ///< x, y, z, p_x, p_y, p_z; exact
  double duration = 0;                        ///< exact duration
  std::vector<Extended> state;                ///< state at the end
  std::vector<std::vector<Extended>> matrix;  ///< d end_i / d start_j
  /// The error that half a unit in the last place of the start and of the duration causes.
  std::vector<double> floor;
  double matrix_norm = 0;  ///< Frobenius norm
};

inline std::vector<Extended> decimals(const nlohmann::json& row) {
  std::vector<Extended> result;
  for (const auto& text : row) result.push_back(from_decimal(text));
  return result;
}

inline const nlohmann::json& reference_case(const std::string& id) {
  for (const auto& entry : reference_cases()["cases"]) {
    if (entry["id"] == id) return entry;
  }
  throw std::runtime_error("no reference case " + id);
}

inline ReferenceOrbit reference_orbit(const std::string& id) {
  const auto& entry = reference_case(id);
  ReferenceOrbit orbit;
  orbit.id = id;
  const auto& model = entry["model"];
  orbit.field = {.mu = from_hex(model["GM"]),
                 .radius = from_hex(model["rho"]),
                 .J = {{2, from_hex(model["J2"])}, {3, from_hex(model["J3"])}}};
  for (const auto& text : entry["x0_hex"]) orbit.start.push_back(from_hex(text));
  orbit.duration = from_hex(entry["t_hex"]);
  orbit.state = decimals(entry["state"]);
  for (const auto& row : entry["stm"]) orbit.matrix.push_back(decimals(row));
  for (const auto& text : entry["half_ulp_floor"]) {
    orbit.floor.push_back(std::stod(text.get<std::string>()));
  }
  orbit.matrix_norm = std::stod(entry["stm_frobenius"].get<std::string>());
  return orbit;
}

/// The paper's Earth orbit, start and duration as binary64 numbers.
inline const ReferenceOrbit& paper_orbit() {
  static const ReferenceOrbit orbit = reference_orbit("SEED-10PI");
  return orbit;
}

}  // namespace hamjet::test
