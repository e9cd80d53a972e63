#include "scene_lasting_thrust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace hamjet::io {
namespace {

/// A key that does not go with some thrusts of `[transfer]`; without a key, the whole table.
struct RefusedKey {
  std::string_view table;
  std::string_view key;
  std::vector<TransferThrust> thrusts;
  /// Beside a table [assignment] alone, whose pairs have such a thrust and no other.
  bool of_pairs;
  std::string_view reason;
  std::string_view right;
};

const std::vector<RefusedKey>& refused_keys() {
  using enum TransferThrust;
  constexpr std::string_view of_thrust = "of a thrust that lasts";
  constexpr std::string_view beside_energy = "beside thrust = \"energy-optimal\"";
  constexpr std::string_view limit = "the limit is the acceleration of [thruster]";
  constexpr std::string_view law = "a law of energy-optimal thrust";
  constexpr std::string_view way = "not looked at on ways of a thrust that lasts";
  constexpr std::string_view beside_impulses = "left out, or beside thrust = \"impulses\"";
  constexpr std::string_view of_impulses = "not looked at where pairs have a thrust that lasts";
  constexpr std::string_view best =
      "not looked at: such a thrust burns as long as is best and "
      "turns freely";
  constexpr std::string_view out = "left out";
  static const std::vector<RefusedKey> keys = {
      {"transfer",
       "thrust_order",
       {impulses},
       false,
       of_thrust,
       "beside thrust = \"energy-optimal\" or \"fuel-optimal\""},
      {"transfer", "largest_thrust_m_s2", {impulses}, false, of_thrust, beside_energy},
      {"transfer", "largest_thrust_m_s2", {fuel_optimal}, false, limit, out},
      {"transfer", "feedback", {impulses, fuel_optimal}, false, law, beside_energy},
      {"transfer", "errors", {impulses, fuel_optimal}, false, law, beside_energy},
      {"transfer", "keep_out_m", {energy_optimal, fuel_optimal}, false, way, beside_impulses},
      {"transfer",
       "thrust",
       {fuel_optimal},
       true,
       "pairs are not followed to such a thrust",
       "\"impulses\" or \"energy-optimal\""},
      {"transfer", "largest_impulse_m_s", {energy_optimal}, true, of_impulses, beside_impulses},
      {"transfer", "budget_m_s", {energy_optimal}, true, of_impulses, beside_impulses},
      {"assignment", "keep_apart_m", {energy_optimal}, true, way, beside_impulses},
      {"thruster",
       "",
       {energy_optimal},
       true,
       "a thrust that lasts is not made of burns; transfer.largest_thrust_m_s2 limits it",
       beside_impulses},
      {"thruster", "longest_burn_s", {fuel_optimal}, false, best, out},
      {"thruster", "shortest_burn_s", {fuel_optimal}, false, best, out},
      {"thruster", "attitude", {fuel_optimal}, false, best, out},
  };
  return keys;
}

}  // namespace

void require_keys_of_thrust(const TableReader& root, TransferThrust thrust) {
  const bool has_pairs = root.has("assignment");
  const std::string name(thrust_names()[static_cast<std::size_t>(thrust)]);
  const auto found = [&](const RefusedKey& refused, const TableReader& table) {
    if (refused.key.empty()) return std::string("this table");
    return table.found(refused.key);
  };
  for (const RefusedKey& refused : refused_keys()) {
    const bool concerns =
        std::find(refused.thrusts.begin(), refused.thrusts.end(), thrust) != refused.thrusts.end();
    if (!concerns || (refused.of_pairs && !has_pairs) || !root.has(refused.table)) continue;
    root.attempt([&] {
      const TableReader table = root.table(refused.table);
      if (!refused.key.empty() && !table.has(refused.key)) return;
      const std::string beside =
          refused.key == "thrust" ? "" : fmt::format(" beside thrust = \"{}\"", name);
      table.fail(
          refused.key,
          fmt::format("{}, got {}{}{}, must be {}", refused.reason, found(refused, table), beside,
                      refused.of_pairs ? " in a scene with [assignment]" : "", refused.right));
    });
  }
  if (thrust == TransferThrust::fuel_optimal && !has_pairs && !root.has("thruster")) {
    root.table("transfer")
        .fail("thrust",
              "no table [thruster], got thrust = \"fuel-optimal\", must be "
              "beside one with acceleration_m_s2 or thrust_N");
  }
}

}  // namespace hamjet::io
