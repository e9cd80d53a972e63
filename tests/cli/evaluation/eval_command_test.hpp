#pragma once

#include <string>
#include <vector>

#include "../command_test.hpp"

namespace hamjet::test {

/// A circular orbit of radius 7000 km and speed 7 km/s, without its jet: canonically mu = 1, (1,
/// 0), (0, 1), and 1000 s the unit of time.
inline const std::string circular_orbit = R"(schema = 1
title = "circular"
[system]
model = "kepler"
mu_km3_s2 = 343000
[nominal]
position_km = [7000, 0, 0]
velocity_km_s = [0, 7, 0]
)";

/// The same orbit over a full turn, with order 5.
inline const std::string circular_scene =
    circular_orbit + "[jet]\norder = 5\nduration_canonical = 6.283185307179586\n" +
    gauss8("tolerance = 1e-15");

inline const std::string rtn_header = "R_m,T_m,N_m,vR_m_s,vT_m_s,vN_m_s";

/// Stores results and maps deviations through them.
class EvalTest : public CommandTest {
 protected:
  /// Stores the results of a scene in a directory of that name.
  void store(const std::string& name, const std::string& scene,
             std::vector<std::string> more = {}) const {
    write(name + ".toml", scene);
    std::vector<std::string> arguments = {"run", name + ".toml", "-q", "-o", name};
    arguments.insert(arguments.end(), more.begin(), more.end());
    succeed(arguments);
  }

  Json eval_json(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "eval");
    arguments.insert(arguments.end(), {"--json", "-q"});
    return Json::parse(succeed(arguments).out);
  }

  /// The only row, without its miss and mark.
  std::vector<double> eval_one(const std::string& directory, const std::string& deviation,
                               std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"eval", directory, "--deviation", deviation, "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::vector<double> numbers;
    const Table table = parse_table(succeed(arguments).out);
    for (const std::string& field : table.rows.at(0)) {
      if (field != "inside" && field != "outside" && field != "unknown" && !field.empty()) {
        numbers.push_back(std::stod(field));
      }
    }
    if (!numbers.empty()) numbers.pop_back();
    return numbers;
  }
};

}  // namespace hamjet::test
