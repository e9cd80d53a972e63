#include "scene_relative_motion.hpp"
#include "starts/scene_manoeuvres.hpp"
#include "systems/scene_spacecraft.hpp"

namespace hamjet::io {

const TableDescription& deputy_table() {
  static const TableDescription table = {
      joined<SceneKey>({relative_frame_keys(absent::value("RTN")),
                        relative_state_keys(),
                        {{"spacecraft",
                          form::table(spacecraft_table()),
                          absent::other("like the chief"),
                          "what air and light do to the deputy",
                          {orbits}}}}),
      "The second satellite at the start: relative to the chief, or by its own orbit in the keys "
      "of "
      "`[nominal]`, all of one form, of the same moment and in the same axes. Its motion is told "
      "in the same frame. With `[uncertainty.collision]` it may be anywhere, at any speed."};
  return table;
}

DeputySettings read_deputy(const TableReader& deputy, const Scene& scene, const Nominal& nominal,
                           bool is_anywhere) {
  deputy.check_keys();
  require_relative_motion(deputy, scene);
  DeputySettings settings;
  settings.frame = read_relative_frame(deputy, nominal);
  settings.start =
      read_relative_state(deputy, nominal, settings.frame,
                          is_anywhere ? DeputyPlace::anywhere : DeputyPlace::near_chief);
  settings.manoeuvres = read_manoeuvres(deputy, scene.system, nominal.scale);
  const SpacecraftSettings spacecraft = read_spacecraft(deputy, scene.system);
  settings.drag_m2_kg = spacecraft.drag_m2_kg;
  settings.radiation_m2_kg = spacecraft.radiation_m2_kg;
  return settings;
}

}  // namespace hamjet::io
