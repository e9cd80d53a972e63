#include "validity_view.hpp"

#include <fmt/format.h>

#include "../../formats/relative_frame_text.hpp"
#include "../../text/html_text.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {

std::string validity_verdict(const ValidityResult& result) {
  if (result.points.empty()) return "No time was examined.";
  const ValidityPoint& last = result.points.back();
  std::string text = fmt::format("After {} the polynomial is right to {} up to a separation of ",
                                 time_text(last.time * result.scene.units.time_s),
                                 length_text(result.scene.validity->tolerance_m));
  for (std::size_t k = 0; k < last.entries.size(); ++k) {
    const ValidityEntry& entry = last.entries[k];
    const bool is_last = k + 1 == last.entries.size();
    if (k > 0) text += is_last ? " and " : ", ";
    text += fmt::format("{}{} in order {}", entry.is_at_limit ? "at least " : "",
                        length_text(entry.proved_m), entry.order);
  }
  text += fmt::format(", proved by flying deputies with velocities {}.",
                      velocities_text(result.scene.validity->frame));
  if (result.scene.validity->tolerance_m < result.flight_floor_m) {
    text += fmt::format(
        " The flights themselves are right to {} only: with a tolerance below that, a small "
        "separation, or none, says nothing of the polynomial.",
        length_text(result.flight_floor_m));
  }
  return text;
}

}  // namespace hamjet::io
