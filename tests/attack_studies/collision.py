"""hamjet uncertainty with [uncertainty.collision]: probabilities and least separations against
pairs that are flown, closest approaches of the means, and the formula for short encounters."""
import numpy as np

import orbit
from command import Run
from drawing import rounded
from flight import REAL
from refusal import results
from uncertain import (draw_known, inertial_covariance, judge_quantile, judge_share, samples_of)

SAMPLES = 1500


def draw(source):
    scene = source.scene(revolutions=(0.2, source.one_of([1.5, 3])), orders=(1, 2, 3),
                  weights=(1, 4, 2), may_go_back=False, coordinates=False,
                  whole=source.one_of([None, 1.0, 2.0], [5, 1, 2]))
    time = scene.duration * source.one_of([source.uniform(0.05, 0.98), 0.5, 1.0], [6, 1, 1])
    chief = scene.chief_at(time)
    sigma = source.logarithmic(5, 500)
    miss = np.array(source.vector(sigma * source.logarithmic(0.05, 3)), dtype=REAL)
    axes = orbit.axes_of(chief)[0]
    speed = orbit.norm(chief[3:])
    rate = np.sqrt(scene.mu / orbit.norm(chief[:3]) ** 3)
    if source.chance(0.5):
        # The deputy has another orbit, which meets the chief's at an angle.
        angle = REAL(source.logarithmic(1e-3, 3))
        across = np.cross(axes[2], chief[3:] / speed)
        turned = np.cos(angle) * chief[3:] + np.sin(angle) * speed * (
            axes[2] * REAL(source.uniform(-1, 1)) + across * REAL(source.uniform(-0.3, 0.3)))
        velocity = turned * speed / orbit.norm(turned) - chief[3:]
    else:
        velocity = np.array(source.vector(float(rate) * sigma * source.logarithmic(0.3, 30)),
                            dtype=REAL)
    meeting = np.concatenate([chief[:3] + miss, chief[3:] + velocity])
    if orbit.perigee(scene.mu, meeting) < REAL(1.02) * scene.radius:
        # An orbit through the ground is replaced by one that goes the chief's way.
        meeting[3:] = chief[3:]
    if source.chance(0.4):
        # Of the chief's period, so that it comes back to where it was.
        energy = scene.field.energy(scene.chief) + scene.mu / orbit.norm(meeting[:3])
        meeting[3:] *= np.sqrt(2 * energy) / orbit.norm(meeting[3:])
    deputy = scene.field.to(meeting, -time)
    scene.deputy_state = write_deputy(scene, deputy)
    table = scene.tables["uncertainty"] = {"samples": 0}
    covariance, frame = draw_known(scene, table, sigma, frames=False)
    scene.chief_covariance = inertial_covariance(scene.chief, covariance, frame)
    own = table["deputy"] = {}
    covariance, frame = draw_known(scene, own, sigma * source.uniform(0.2, 1), frames=False)
    scene.deputy_covariance = inertial_covariance(scene.deputy_state, covariance, frame)
    collision = table["collision"] = {"radius_m": sigma * source.logarithmic(0.03, 2),
                                      "samples": 3000}
    table["seed"] = source.integer(1, 10 ** 6)
    scene.window = [0.0, float(scene.duration)]
    if source.chance(0.5):
        width = abs(float(scene.duration)) * source.logarithmic(0.01, 1)
        begin = max(0.0, float(time) - width * source.uniform(0, 1))
        scene.window = [rounded(begin), rounded(min(begin + width, float(scene.duration)), 12)]
        if source.chance(0.3):
            whole = float(scene.period) * source.one_of([0.5, 1.0, 2.0])
            scene.window = [scene.window[0], scene.window[0] + whole]
        if not 0 <= scene.window[0] < scene.window[1] <= float(scene.duration):
            scene.window = [0.0, float(scene.duration)]
        else:
            collision["window_s"] = scene.window
    if source.chance(0.2):
        collision["event"] = "entry"
    if source.chance(0.3):
        collision["sampling"] = source.one_of(["plain", "entries"])
    return scene


def write_deputy(scene, deputy):
    """The deputy at the start, by its own state or, near its chief, by the difference."""
    separation = deputy - scene.chief
    table = scene.tables["deputy"] = {}
    if orbit.norm(separation[:3]) < 0.01 * orbit.norm(scene.chief[:3]) and scene.draw.chance(0.5):
        frame = scene.frame(table)
        told = orbit.to_frame(scene.chief, separation, *frame)
        table["position_m"] = [rounded(x, 15) for x in told[:3]]
        table["velocity_m_s"] = [rounded(x, 15) for x in told[3:]]
        return scene.chief + orbit.from_frame(
            scene.chief, table["position_m"] + table["velocity_m_s"], *frame)
    table["position_km"] = [rounded(x / 1000, 17) for x in deputy[:3]]
    table["velocity_km_s"] = [rounded(x / 1000, 17) for x in deputy[3:]]
    return np.array(table["position_km"] + table["velocity_km_s"], dtype=REAL) * 1000


def judge(judgement, scene, folder):
    run = Run(folder, ["uncertainty", "scene.toml", "-o", "out"], limit=120)
    summary = results(judgement, scene, run)
    if summary is None:
        return
    told = summary["collision"]
    random = np.random.default_rng(scene.draw.integer(0, 2 ** 31))
    chief = scene.chief + samples_of(random, scene.chief_covariance, SAMPLES)
    deputy = scene.deputy_state + samples_of(random, scene.deputy_covariance, SAMPLES)
    begin, end = (REAL(x) for x in told["window_s"])
    # Without a window of the scene's own a passage at its start or end is looked at as a whole.
    is_wider = "window_s" not in scene.tables["uncertainty"]["collision"] and told.get(
        "window_widened")
    if is_wider:
        judgement.require("a wider window has that of the scene in it",
                          begin <= 0 and end >= scene.window[1] * (1 - 1e-9))
    else:
        judgement.within("window (s)", told["window_s"], scene.window, 1e-9 * scene.window[1])
    least, _ = scene.field.least_separations(chief, deputy, begin, end)
    least = np.array(least, dtype=float)
    radius = scene.tables["uncertainty"]["collision"]["radius_m"]
    nearer = least < radius
    fewest = most = int(np.sum(nearer))
    if scene.tables["uncertainty"]["collision"].get("event") == "entry":
        # Those that are nearer when the window begins count only once they come back, which is not
        # looked at here.
        apart = orbit.norm((scene.field.to(deputy, begin) - scene.field.to(chief, begin))[:, :3])
        fewest = int(np.sum(nearer & np.array(apart >= radius)))
    # The orders' own difference is printed beside the probability; it says how far the polynomials
    # are from right.
    doubt = abs(told.get("change_from_lower_order") or 0)
    order = scene.tables["jet"]["order"]
    mean_least = judge_approaches(judgement, scene, told, begin, end)
    del mean_least
    if order == 1 or doubt > 0.3 * told["probability"] + 1e-3:
        judgement.mark(f"order {order} changes the probability by {doubt:.2g}")
    else:
        judge_share(judgement, "probability", told["probability"], *told["interval"],
                    (fewest, most), SAMPLES, slack=doubt)
        separation = told["least_separation"]
        for k, share in enumerate(separation["shares"]):
            judge_quantile(judgement, "least separation", share, separation["separations_m"][k],
                           separation["lower_m"][k], separation["upper_m"][k], least,
                           0.01 + doubt)


def judge_approaches(judgement, scene, told, begin, end):
    least, when = scene.field.least_separations(scene.chief[None], scene.deputy_state[None], begin,
                                                end, looks=60, tolerance=REAL(2) ** -50)
    inner = (when[0] - begin) > 1e-6 * (end - begin) and (end - when[0]) > 1e-6 * (end - begin)
    # Of a passage that an edge of the window cuts the whole is told of beside the window.
    whole = told["whole_passage"]["window_s"] if told["whole_passage"] else [begin, end]
    for approach in told["approaches"]:
        time = REAL(approach["time_s"])
        rounding = REAL(1e-12) * max(abs(begin), abs(end))
        judgement.require("an approach is in the window or in a passage that it cuts",
                          whole[0] - rounding <= time <= whole[1] + rounding)
        judgement.require("an approach is where it says that it is",
                          (begin + rounding <= time <= end - rounding) <= approach["in_window"]
                          <= (begin - rounding <= time <= end + rounding))
        both = [scene.field.to(s, time) for s in (scene.chief, scene.deputy_state)]
        apart = both[1] - both[0]
        distance, speed = orbit.norm(apart[:3]), orbit.norm(apart[3:])
        judgement.within("distance at an approach (m)", approach["distance_m"], distance,
                         1e-6 * distance + 1e-3)
        judgement.within("speed at an approach (m/s)", approach["speed_m_s"], speed,
                         1e-6 * speed + 1e-6)
        # Where a time is wrong by dt the distance still falls; at rest the acceleration turns it.
        step = 1e-4 * scene.period
        after, before = [scene.field.to(scene.deputy_state, t) - scene.field.to(scene.chief, t)
                         for t in (time + step, time - step)]
        bend = speed ** 2 + orbit.dot(apart[:3], after[3:] - before[3:]) / (2 * step)
        judgement.at_most("time from the closest approach (s)",
                          abs(orbit.dot(apart[:3], apart[3:]) / bend),
                          1e-6 * float(scene.period) + 1e-3)
        plane = approach.get("short_encounter")
        if plane:
            edges = min(time - begin, end - time)
            passage = REAL(plane["passage_s"])
            judgement.require("whether the window cuts a passage",
                              plane["cut_by_window"] == bool(edges < passage)
                              or abs(edges - passage) < 1e-9 * passage + rounding)
        if plane and plane["holds"]:
            judgement.note("collision: short encounter over probability",
                           plane["foster"] / max(told["probability"], 1e-12))
    if inner:
        # Those outside the window are no answer to what is nearest in it.
        distances = [a["distance_m"] for a in told["approaches"] if a["in_window"]]
        judgement.at_most("distance of the nearest approach (m)", min(distances, default=np.inf),
                          least[0] * (1 + 1e-6) + 1e-3)
    return least[0]
