#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "scene_sections.hpp"

// Keys that the tables of the studies of relative motion share: [transfer], [validity],
// [assignment]. All functions throw Error(scene).

namespace hamjet::io {

/// The largest number of transfer times of a table, and of deputies of an assignment.
inline constexpr int most_transfer_times = 10000;
inline constexpr int most_deputies = 200;

/// Refuses a scene on which these studies cannot work: one without an orbit, with a jet that is not
/// expanded in all six variables, or in extended precision.
void require_relative_motion(const TableReader& table, const Scene& scene);
/// The same for the studies that also serve systems without an orbit, along their coordinates.
void require_deviations(const TableReader& table, const Scene& scene);
/// Refuses keys that are about spacecraft in an orbit, in the table of a system without one;
/// `instead` is what the table has along the coordinates of such a system.
void refuse_keys_of_orbits(const TableReader& table, const std::vector<std::string_view>& keys,
                           std::string_view instead);

/// The keys of read_relative_state, of read_arrival, and of read_place.
std::vector<SceneKey> relative_state_keys();
std::vector<SceneKey> arrival_keys();
std::vector<SceneKey> axes_keys();
/// The keys of the frame of a table; `frame` says what holds if the table names none.
std::vector<SceneKey> relative_frame_keys(const Absence& frame);
/// The keys of read_transfer_times; `absence` says what holds if the table has none of them.
std::vector<SceneKey> transfer_time_keys(const Absence& absence);

/// A moment of the motion, given by exactly one of `time_s`, `time_orbits` and `time_canonical`.
/// Reads it in canonical units, and returns which key gave it.
std::vector<SceneKey> instant_keys();
std::string_view read_instant(const TableReader& table, const Nominal& nominal, double& time);

/// Transfer times, given by exactly one of `times_s`, `times_orbits`, `times_canonical` (a number
/// or an array) and `count` (equal parts of the duration, its end included). With a default count,
/// all keys may be absent. The result is in canonical units; the times are not 0 and move away from
/// 0.
std::vector<double> read_transfer_times(const TableReader& table, const Scene& scene,
                                        const Nominal& nominal,
                                        std::optional<int> default_count = std::nullopt);

/// The times of the table [jet], by the same keys, without the duration, at which each run has a
/// jet anyway; empty if the table has none of these keys. It also throws Error(scene) if an
/// integrator has no jets between its steps, or if the scene has more than one arc.
std::vector<double> read_jet_times(const TableReader& jet, const Scene& scene,
                                   const Nominal& nominal);

/// The frame that the keys `frame` and `derivatives` give. A missing key is taken from `fallback`,
/// if the table's own frame allows it; the default is RTN with rotating derivatives. A nominal that
/// is no orbit has the frame of its coordinates alone.
RelativeFrame read_relative_frame(const TableReader& table, const TableReader& fallback,
                                  const Nominal& nominal);
RelativeFrame read_relative_frame(const TableReader& table, const Nominal& nominal);

/// Where a deputy may be: within reach of expansions about the chief, or anywhere. The latter holds
/// for the other spacecraft of an encounter, which has polynomials about its own trajectory.
enum class DeputyPlace { near_chief, anywhere };

/// A deputy at the start, in the given frame: `position_m` and, optionally, `velocity_m_s` in that
/// frame; or the numbers of another form (components_of); or its own orbit in the keys of
/// [nominal], from which the difference to the chief is taken.
RelativeState read_relative_state(const TableReader& table, const Nominal& nominal,
                                  RelativeFrame frame, DeputyPlace place = DeputyPlace::near_chief);

/// A deputy at its arrival, in the same forms except a message. Its state relative to the chief
/// depends on the chief's state at that time.
ArrivalState read_arrival(const TableReader& table, const Nominal& nominal);

/// `position_m` and, optionally, `velocity_m_s` in the frame of the table, relative to the chief at
/// any time.
RelativeState read_place(const TableReader& table, const Nominal& nominal);

/// The value of a key of standard deviations along the axes of a frame, and its numbers, each from
/// 0 to below the limit, which may be infinite; `of_limit` goes on in the message about one that is
/// not. The key has `count` numbers, and those along further axes are 0.
ValueForm deviations_form();
std::vector<double> read_deviations(const TableReader& table, std::string_view key, double limit,
                                    std::string_view of_limit, std::size_t count = 3);

/// The keys `tolerance_m` and `most_domains` of a table whose set is split into domains; the
/// absences and meanings say what holds in it. A scene of order 1 is refused: nothing says what is
/// right in it. `what` is split.
std::vector<SceneKey> domain_keys(const Absence& tolerance, std::string_view tolerance_meaning,
                                  std::string_view most_meaning);
DomainSettings read_domains(const TableReader& table, const Scene& scene, std::string_view what);

/// The start of the scene's deputy in the frame of another table.
RelativeState in_other_frame(const TableReader& table, const Nominal& nominal,
                             const DeputySettings& deputy, RelativeFrame frame);

/// Whether the scene asks for collisions of chief and deputy, table [uncertainty.collision].
bool has_collision(const TableReader& root);

/// Keys of the tables that watch the distance of spacecraft: the canonical ends of `window_s`, in a
/// scene with a deputy and a positive duration, before the start only if `may_begin_before`, and a
/// length that is small compared to the chief's distance from the centre but not below the accuracy
/// of the motion.
SceneKey window_key(std::string_view absence = "from the start to the end");
std::array<double, 2> read_window(const TableReader& table, const Scene& scene,
                                  bool may_begin_before);
double read_nearness(const TableReader& table, std::string_view key, const Scene& scene);

/// Warnings: a line for each deputy that is a twentieth of the chief's distance from the centre
/// away or more, beyond the reach of polynomials about the chief; and a line for a kind of
/// generating function that the scene's coordinates leave unused. The deputy of a scene with
/// [uncertainty.collision] is never too far, because it is flown about its own trajectory.
std::vector<std::string> likely_slips_of_deputies(const TableReader& root, const Scene& scene);

}  // namespace hamjet::io
