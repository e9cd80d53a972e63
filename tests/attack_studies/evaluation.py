"""hamjet eval of a scene, and of the stored results of hamjet run: deputies in every form, carried
in every coordinates, against flights."""
import os

import numpy as np

import orbit
from command import Refused, Run, number
from drawing import rounded
from flight import REAL, TOLERANCE
from refusal import judge_refusal

ROWS = 14
# An estimate says only how large the part is that is left out. Along a deviation for which the last
# degrees happen to cancel, an error may be this many times larger.
ESTIMATE = 10

LINEAR = {"RTN": ["R_m", "T_m", "N_m", "vR_m_s", "vT_m_s", "vN_m_s"],
          "inertial": ["x_m", "y_m", "z_m", "vx_m_s", "vy_m_s", "vz_m_s"]}


def columns_of(frame):
    return LINEAR.get(frame) or orbit.FORMS.get(frame) or ["x", "y", "z", "px", "py", "pz"]


def draw(source):
    scene = source.scene(revolutions=(0.05, source.one_of([2, 4, 10])))
    if source.chance(0.3) and "coordinates" in scene.tables["jet"]:
        ends = source.one_of(["cartesian", "spherical", "cylindrical", "poincare", "nodal"])
        if scene.tables["jet"]["coordinates"] not in ("flow-box", "auto"):
            scene.tables["jet"]["end_coordinates"] = ends
    frames = ["RTN", "inertial"]
    if scene.has_node:
        frames += list(orbit.FORMS)
    scene.derivatives = source.one_of(["rotating", "inertial"])
    if source.chance(0.1):
        scene.frames = ["canonical"] * 2
    else:
        scene.frames = [source.one_of(frames), source.one_of(frames)]
    scene.is_stored = source.chance(0.5)
    scene.has_times = scene.is_stored and source.chance(0.4)
    if scene.has_times:
        keys, scene.times = scene.times(3)
        scene.tables["jet"].update(keys)
    largest = source.logarithmic(10, 0.1 * float(orbit.norm(scene.chief[:3])))
    sizes = np.exp(np.linspace(np.log(0.1), np.log(largest), ROWS))
    rate = float(scene.rate)
    scene.deviations = np.array([source.vector(s) + source.vector(s * rate * source.uniform(0, 1))
                                 for s in sizes], dtype=REAL)
    scene.rows = [start_row(scene, d) for d in scene.deviations]
    # The rows as they are written are what is flown.
    scene.deputies = np.array([deputy_of(scene, row) for row in scene.rows])
    scene.degree = None
    if source.chance(0.2) and scene.tables["jet"]["order"] > 1:
        scene.degree = source.integer(1, scene.tables["jet"]["order"])
    return scene


def start_row(scene, deviation):
    frame = scene.frames[0]
    if frame == "canonical":
        units = [scene.length] * 3 + [scene.length / scene.time_unit] * 3
        return [rounded(x / u, 17) for x, u in zip(deviation, units)]
    if frame in LINEAR:
        return [rounded(x, 17) for x in orbit.to_frame(scene.chief, deviation, frame,
                                                       scene.derivatives)]
    return [rounded(x, 17) for x in orbit.to_form(scene.mu, scene.chief, scene.chief + deviation,
                                                  frame)]


def state_of(scene, chief, row, frame):
    row = np.array(row, dtype=REAL)
    if frame == "canonical":
        units = np.array([scene.length] * 3 + [scene.length / scene.time_unit] * 3)
        return chief + row * units
    if frame in LINEAR:
        return chief + orbit.from_frame(chief, row, frame, scene.derivatives)
    return orbit.from_form(scene.mu, chief, frame, row)


def deputy_of(scene, row):
    return state_of(scene, scene.chief, row, scene.frames[0])


def judge(judgement, scene, folder):
    with open(os.path.join(folder, "deviations.csv"), "w") as file:
        file.write(",".join(columns_of(scene.frames[0])) + "\n")
        for row in scene.rows:
            file.write(",".join(repr(x) for x in row) + "\n")
    options = ["--deviations", "deviations.csv", "--frame", scene.frames[0], "-q"]
    if scene.frames[1] != scene.frames[0]:
        options += ["--to", scene.frames[1]]
    if "RTN" in scene.frames:
        options += ["--derivatives", scene.derivatives]
    if scene.degree:
        options += ["--degree", str(scene.degree)]
    judge_rows(judgement, scene, folder, ["eval", "scene.toml", *options, "-o", "end.csv"],
               "end.csv", [scene.duration])
    if not scene.is_stored:
        return
    run = Run(folder, ["run", "scene.toml", "-o", "out", "-q"])
    try:
        summary = run.summary("out")
    except Refused as refused:
        judge_refusal(judgement, scene, refused)
        return
    if run.code == 1:
        judgement.mark("run: " + run.said.strip()[:200])
    del summary
    times = [scene.duration]
    if scene.has_times:
        options += ["--time", "all"]
        times = list(scene.times)
        if abs(times[-1] / scene.duration - 1) > 1e-9:
            times.append(scene.duration)
    judge_rows(judgement, scene, folder, ["eval", "out", *options, "-o", "stored.csv"],
               "stored.csv", times)


def judge_rows(judgement, scene, folder, line, name, times):
    run = Run(folder, line)
    path = os.path.join(folder, name)
    if not os.path.exists(path):
        judge_refusal(judgement, scene, Refused(run.code, (run.said or run.printed).strip()))
        return
    rows = run.table("", name)
    if len(rows) == (len(times) + 1) * len(scene.rows) and abs(
            times[-1] / scene.duration - 1) < 1e-9:
        # A time that differs from the duration by its last digit is another one.
        times = [*times, scene.duration]
    if not judgement.require(f"{len(rows)} rows of {len(times)} times",
                             len(rows) == len(times) * len(scene.rows)):
        return
    chiefs = scene.field.fly(scene.chief, times)
    ends = scene.field.fly(scene.deputies, times)
    # Flights have errors too, some tens of what another step control changes.
    others = (scene.field.fly(scene.deputies, times, 8 * TOLERANCE)
              - scene.field.fly(scene.chief, times, 8 * TOLERANCE))
    doubts = 40 * np.max(orbit.norm((ends - chiefs - others)[..., :3]), axis=0)
    inside = 0
    for k, (time, chief) in enumerate(zip(times, chiefs)):
        growth = linear_growth(scene, time)
        reach = max(orbit.norm(chief[:3]), orbit.norm(scene.chief[:3]))
        for j in range(len(scene.rows)):
            row = rows[k * len(scene.rows) + j]
            if "time_s" in row:
                judgement.within("time of a row (s)", float(row["time_s"]), float(time),
                                 1e-11 * abs(time))
            # Over a few steps both controls may take the same columns, and show nothing: flights of
            # other steps differ by up to three times what one step may leave.
            doubt = doubts[k] + 10 * TOLERANCE * growth * reach
            inside += judge_row(judgement, scene, line[1], row, chief, ends[j, k],
                                growth * size_of(scene, j), doubt, j)
    if inside == 0:
        judgement.mark("no row is inside")


def size_of(scene, j):
    deviation = scene.deputies[j] - scene.chief
    r = orbit.norm(scene.chief[:3])
    return np.hypot(orbit.norm(deviation[:3]),
                    orbit.norm(deviation[3:]) * np.sqrt(r ** 3 / scene.mu))


def linear_growth(scene, time):
    """The largest coefficient of the linear flow in the chief's own units."""
    matrix = scene.field.transition(scene.chief, time)
    rate = np.sqrt(scene.mu / orbit.norm(scene.chief[:3]) ** 3)
    scale = np.array([1, 1, 1, 1 / rate, 1 / rate, 1 / rate])
    return np.max(np.abs(matrix * scale[:, None] / scale))


def judge_row(judgement, scene, source, row, chief, true, growth, doubt, j):
    if row["support"] != "inside":
        judgement.require("a row without numbers is marked", row["support"] in ("outside",
                                                                                "unknown"))
        return 0
    estimate = number(row["miss_estimate_m"])
    told = [number(row[c]) for c in columns_of(scene.frames[1])]
    if not judgement.require(f"row {j} of {source} is inside, but has {told}",
                             estimate is not None and None not in told
                             and np.all(np.isfinite(told))):
        return 0
    state = state_of(scene, chief, told, scene.frames[1])
    miss = orbit.norm(state[:3] - true[:3])
    # The estimates of a scene leave out the integration, whose tolerance is 1e-12 of the largest
    # coefficient a period of the motion (three times that is its promise), and rounding of numbers
    # near the distance from the centre, where a form has them.
    integration = 1e-11 * max(1, abs(scene.revolutions)) * growth
    rounding = doubt
    if estimate > 0:
        judgement.note("eval: miss over estimate", miss / (estimate + integration + rounding))
    judgement.checks += 1
    if miss > ESTIMATE * estimate + integration + rounding:
        apart = float(orbit.norm(scene.deviations[j][:3]))
        judgement.wrong(f"eval {source}, row {j}, {apart:.4g} m from the chief: misses by "
                        f"{float(miss):.4g} m, told {estimate:.3g} m (integration "
                        f"{float(integration):.2g} m)")
        return 1
    # Velocities have no estimate; an error in place comes with one of as much times the rate of
    # the motion, and those of the integration with that at the perigee.
    rate = np.sqrt(scene.mu / orbit.norm(chief[:3]) ** 3)
    speed = orbit.norm(state[3:] - true[3:])
    allowed = 100 * rate * (ESTIMATE * estimate + integration + rounding)
    judgement.at_most(f"eval {source}, row {j}: error of the velocity (m/s)", speed, allowed)
    return 1
