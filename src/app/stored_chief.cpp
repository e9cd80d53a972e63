#include "stored_chief.hpp"

namespace hamjet::cli {

bool is_about_chief(const io::StoredJet& stored, const Scene& scene) {
  return stored.model == scene.system.model && stored.units.length_km == scene.units.length_km &&
         stored.units.time_s == scene.units.time_s && stored.nominal_initial == scene.nominal;
}

}  // namespace hamjet::cli
