#pragma once

#include <optional>

#include "hamjet/formats/stored_jet.hpp"

namespace hamjet::python {

/// Throws Error(usage) if both jets are dated and the second does not start when the first ends, or
/// in another frame, about another centre or in another time system.
void require_dates_meeting(const io::StoredJet& first, const io::StoredJet& second);

/// The jet's ephemeris, if it has one, dated by the end of its flow: that of the flow back.
std::optional<EphemerisSettings> ephemeris_at_end(const io::StoredJet& jet);

}  // namespace hamjet::python
