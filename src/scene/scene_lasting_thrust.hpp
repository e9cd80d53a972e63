#pragma once

#include <string_view>
#include <vector>

#include "hamjet/detail/studies/transfer_settings.hpp"
#include "tables/scene_table.hpp"

namespace hamjet::io {

/// What `transfer.thrust` may be, in the order of the enumerators.
inline std::vector<std::string_view> thrust_names() {
  return {"impulses", "energy-optimal", "fuel-optimal"};
}

/// Refuses, in one list for all studies, what a scene has beside a thrust of `[transfer]` that does
/// not go with it: keys that nothing would look at. What concerns impulses (`budget_m_s`,
/// `largest_impulse_m_s`, the burns of `[thruster]`) is refused beside a thrust that lasts only
/// where pairs are assigned, which then have no impulses; transfers have both. `root` is the whole
/// scene. Throws Error(scene), or keeps the errors if the reader does.
void require_keys_of_thrust(const TableReader& root, TransferThrust thrust);

/// Table `[transfer.errors]`.
const TableDescription& thrust_errors_table();
ThrustErrorSettings read_thrust_errors(const TableReader& errors);

}  // namespace hamjet::io
