#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "scene_sections.hpp"

// What the tables of the studies of relative motion have in common: [transfer], [validity],
// [assignment]. All throw Error(scene).

namespace hamjet::io {

/// Most transfer times of a table, and most deputies of an assignment.
inline constexpr int most_transfer_times = 10000;
inline constexpr int most_deputies = 200;

/// Refuses a scene that these studies cannot work on: no orbit, a jet that is not expanded in all
/// six variables, extended precision.
void require_relative_motion(const TableReader& table, const Scene& scene);

/// The keys of read_relative_state, of read_arrival, and of read_place.
std::vector<SceneKey> relative_state_keys();
std::vector<SceneKey> arrival_keys();
std::vector<SceneKey> axes_keys();
/// The keys of the frame of a table, with what holds where it names none.
std::vector<SceneKey> relative_frame_keys(const Absence& frame);
/// The keys of read_transfer_times, with what holds where a table has none of them.
std::vector<SceneKey> transfer_time_keys(const Absence& absence);

/// A moment of the motion: the only one of `time_s`, `time_orbits` and `time_canonical`. Reads it,
/// canonical, and returns which it is.
std::vector<SceneKey> instant_keys();
std::string_view read_instant(const TableReader& table, const Nominal& nominal, double& time);

/// The only one of `times_s`, `times_orbits`, `times_canonical` (a number or an array) and `count`
/// (equal parts of the duration, its end included); with a default count none may be there.
/// Canonical times, none 0, that move away from 0.
std::vector<double> read_transfer_times(const TableReader& table, const Scene& scene,
                                        const Nominal& nominal,
                                        std::optional<int> default_count = std::nullopt);

/// The times of the table [jet], by the same keys, without the duration, whose jet each run has;
/// empty where the table has none of them. Throws Error(scene) too where an integrator has no jets
/// between its steps, or the scene more than one arc.
std::vector<double> read_jet_times(const TableReader& jet, const Scene& scene,
                                   const Nominal& nominal);

/// The frame of the keys `frame` and `derivatives`, each from `fallback` where the table does not
/// have it and its own frame takes it; RTN with rotating derivatives unless the keys say otherwise.
RelativeFrame read_relative_frame(const TableReader& table, const TableReader& fallback);
RelativeFrame read_relative_frame(const TableReader& table);

/// Where a deputy may be: in what expansions about the chief reach at all, or anywhere, as the
/// other spacecraft of an encounter, which has polynomials about its own trajectory.
enum class DeputyPlace { near_chief, anywhere };

/// A deputy at the start, in the given frame: `position_m` and, optional, `velocity_m_s` in that
/// frame; numbers of another form (components_of); or its own orbit in the keys of [nominal], whose
/// difference from the chief's is taken.
RelativeState read_relative_state(const TableReader& table, const Nominal& nominal,
                                  RelativeFrame frame, DeputyPlace place = DeputyPlace::near_chief);

/// A deputy at its arrival, in the same forms but a message: what they are relative to the chief
/// depends on where that is then.
ArrivalState read_arrival(const TableReader& table, const Nominal& nominal);

/// `position_m` and, optional, `velocity_m_s` in the frame of the table, relative to the chief at
/// whatever time.
RelativeState read_place(const TableReader& table, const Nominal& nominal);

/// The start of the scene's deputy in the frame of another table.
RelativeState in_other_frame(const TableReader& table, const Nominal& nominal,
                             const DeputySettings& deputy, RelativeFrame frame);

/// Whether the scene asks for collisions of chief and deputy, table [uncertainty.collision].
bool has_collision(const TableReader& root);

/// What the tables that watch how near spacecraft come have in common: the canonical ends of
/// `window_s` in a scene with a deputy that goes forwards, and a length that is small beside the
/// chief's distance from the centre, and not below what the motion is told to.
SceneKey window_key(std::string_view absence = "from the start to the end");
std::array<double, 2> read_window(const TableReader& table, const Scene& scene);
double read_nearness(const TableReader& table, std::string_view key, const Scene& scene);

/// A line for each deputy that is beyond what any polynomial about the chief resolves, a twentieth
/// of the chief's distance from the centre away or more; and for a kind of generating function that
/// the scene's coordinates leave unused. The deputy of a scene with [uncertainty.collision], which
/// is flown about its own trajectory, is never too far.
std::vector<std::string> likely_slips_of_deputies(const TableReader& root, const Scene& scene);

}  // namespace hamjet::io
