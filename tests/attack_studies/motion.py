"""hamjet motion: places along time, nearest and farthest, against flights."""
import numpy as np

import orbit
from command import Refused, Run
from flight import REAL, coast_times
from refusal import judge_refusal, says_below_surface


def draw(source):
    scene = source.scene(revolutions=(0.05, source.one_of([3, 8, 20])))
    table = scene.tables["deputy"] = {}
    scene.frame_of_motion = scene.frame(table)
    distance = source.logarithmic(0.5, 3e4)
    scene.deputy_state = scene.deputy(table, scene.chief, distance, scene.frame_of_motion)
    scene.deputy_field = scene.field
    if scene.is_earth and scene.field.air and source.chance(0.5):
        scene.deputy_field = scene.unlike_deputy(table)
    return scene


def relative(scene, times):
    chief = scene.field.fly(scene.chief, times)
    deputy = scene.deputy_field.fly(scene.deputy_state, times)
    return chief, np.array([orbit.to_frame(c, d - c, *scene.frame_of_motion)
                            for c, d in zip(chief, deputy)])


def judge(judgement, scene, folder):
    run = Run(folder, ["motion", "scene.toml", "-o", "out"])
    try:
        summary = run.summary("out")
    except Refused as refused:
        judge_refusal(judgement, scene, refused)
        return
    rows = run.table("out", "motion.csv")
    letters = summary["axes"]
    columns = [f"{x}_m" for x in letters] + [f"v{x}_m_s" for x in letters]
    times = np.array([REAL(row["time_s"]) for row in rows])
    told = np.array([[float(row[c]) for c in columns] for row in rows])
    floor = summary["flight_floor_m"]
    chief, true = relative(scene, times)
    judgement.within("duration", float(times[-1]), float(scene.duration),
                     1e-12 * abs(scene.duration))
    # Rounding of a flight that is told to be `floor`, which is the size of a sample, not its bound.
    judge_states(judgement, scene, told, true, chief, 10 * floor, times)
    lowest = np.min(orbit.norm(chief[:, :3]))
    judge_extremes(judgement, scene, summary, 10 * floor)
    if scene.highest and lowest < scene.radius * REAL(0.99999):
        if not says_below_surface(run, summary) and run.code == 0:
            depth = float(scene.radius - lowest)
            judgement.wrong(f"nothing is said of a chief {depth:.4g} m below the surface")
        else:
            judgement.mark("below the surface")
    if run.code == 1:
        judgement.mark("exit code 1: " + run.said.strip()[:200])


def judge_states(judgement, scene, told, true, chief, floor, times):
    separation = orbit.norm(true[:, :3])
    miss = orbit.norm(told[:, :3] - true[:, :3])
    allowed = floor + 1e-12 * separation
    worst = int(np.argmax(miss / allowed))
    judgement.note("motion: place, in tens of floors", float(np.max(miss / allowed)))
    judgement.within(f"place after {float(times[worst]):.6g} s (m)", told[worst, :3],
                     true[worst, :3], allowed[worst])
    # An error in place changes the velocity by as much times the rate of the motion there, twice
    # for the turn of the axes.
    rate = np.sqrt(scene.mu / orbit.norm(chief[:, :3]) ** 3)
    allowed = 4 * floor * rate + 1e-12 * (orbit.norm(true[:, 3:]) + rate * separation)
    miss = orbit.norm(told[:, 3:] - true[:, 3:])
    worst = int(np.argmax(miss / allowed))
    judgement.within(f"velocity after {float(times[worst]):.6g} s (m/s)", told[worst, 3:],
                     true[worst, 3:], allowed[worst])


def judge_extremes(judgement, scene, summary, floor):
    least, _ = scene.field.least_separations(scene.chief[None], scene.deputy_state[None], 0,
                                             scene.duration, looks=40, tolerance=REAL(2) ** -50,
                                             of_second=scene.deputy_field)
    times = coast_times(scene.field, scene.chief, scene.duration, 40)
    chief = scene.field.fly(scene.chief, times)
    deputy = scene.deputy_field.fly(scene.deputy_state, times)
    most = np.max(orbit.norm(deputy[:, :3] - chief[:, :3]))
    for name in ("nearest", "farthest"):
        told = summary[name]
        time = REAL(told["time_s"])
        inside = 0 <= time / scene.duration <= 1 + 1e-12
        if not judgement.require(f"{name} after {float(time):.6g} s is not within the duration",
                                 inside):
            return
        _, there = relative(scene, [time])
        # Between the times of the table places are interpolated.
        allowed = floor + 1e-6 * orbit.norm(there[0, :3])
        judgement.within(f"{name}: separation after {float(time):.6g} s (m)", told["separation_m"],
                         orbit.norm(there[0, :3]), allowed)
        judgement.within(f"{name}: place (m)", told["position_m"], there[0, :3], allowed)
    judgement.at_most("nearest separation (m)", summary["nearest"]["separation_m"],
                      least[0] * (1 + 1e-6) + floor)
    judgement.at_most("farthest separation, found by looks (m)", most,
                      summary["farthest"]["separation_m"] * (1 + 1e-6) + floor)
