"""hamjet transfer: told velocity changes are flown, limits are looked at along dense flights, and
plans are compared with linear programmes."""
import numpy as np

import orbit
from command import Run, number
from flight import REAL, FlightFailed
from plans import judge_coasting, judge_legs, judge_optimal, judge_revolutions
from refusal import judge_surface, results
from ways import Flights, least_ratio


EXTRAS = {"none": 3, "optimal": 4, "limited": 3, "coast": 2, "waypoints": 2, "revolutions": 1,
          "keep-out": 3, "budget": 1}


def draw(source):
    extra = source.one_of(list(EXTRAS), list(EXTRAS.values()))
    most = [1.5, 3, 8, 15] if extra in ("optimal", "limited") else [1.5, 3, 8]
    scene = source.scene(revolutions=(0.1, source.one_of(most)), orders=(2, 3, 4),
                  weights=(3, 3, 1))
    scene.extra = extra
    if "coordinates" in scene.tables["jet"] and source.chance(0.5):
        del scene.tables["jet"]["coordinates"]
    table = scene.tables["transfer"] = {}
    scene.transfer_frame = scene.frame(table)
    keys, scene.times = scene.times(6 if extra in ("optimal", "limited") else 12)
    table.update(keys)
    table["refine"] = source.chance(0.6)
    scene.distance = source.logarithmic(10, 2e4)
    if extra == "optimal" and source.chance(0.2):
        scene.distance = source.logarithmic(2e4, 3e5)
        if source.chance(0.7) and not scene.is_earth:
            scene.tables["jet"]["coordinates"] = "flow-box"
    draw_ends(scene, table)
    rate = scene.distance * float(scene.rate)
    if extra in ("optimal", "limited"):
        table["impulses"] = "optimal"
    if extra == "limited":
        table["largest_impulse_m_s"] = rate * source.logarithmic(0.02, 1)
        if source.chance(0.7):
            table["impulse_gap_s"] = float(scene.period) * source.logarithmic(0.02, 0.3)
    elif source.chance(0.15):
        table["largest_impulse_m_s"] = rate * source.logarithmic(0.1, 3)
    if extra == "coast":
        table["longest_coast_s"] = float(scene.period) * source.uniform(0.1, 1.2)
    if extra == "waypoints":
        last = abs(float(scene.times[-1]))
        sign = -1 if scene.duration < 0 else 1
        shares = sorted(source.uniform(0.1, 0.9) for _ in range(source.integer(1, 2)))
        table["waypoint"] = [{"time_s": sign * last * share,
                              "position_m": source.vector(scene.distance * source.uniform(0.1, 1))}
                             for share in shares]
    if extra == "revolutions":
        table["revolutions"] = source.one_of([[-1, 1], [1], [0, 1], [-1]])
    if extra == "keep-out" or source.chance(0.1):
        # Neither end of the transfer may lie in the ellipsoid.
        flights = Flights(scene)
        ends = [scene.start - scene.chief] + [flights.end(t) - flights.chief(t)
                                              for t in scene.times]
        inner = min(float(orbit.norm(end[:3])) for end in ends)
        table["keep_out_m"] = [inner * source.logarithmic(0.01, 0.95) for _ in range(3)]
    if extra == "budget":
        table["budget_m_s"] = rate * source.logarithmic(0.3, 10)
    # Of least impulses the linear programmes here are about the chief's own flow.
    is_told = extra not in ("optimal", "limited", "revolutions")
    if scene.is_earth and scene.field.air and is_told and source.chance(0.6):
        scene.tables["deputy"] = {"position_m": [0.0, scene.distance, 0.0]}
        scene.deputy_field = scene.unlike_deputy(scene.tables["deputy"])
    return scene


def draw_ends(scene, table):
    source, distance = scene.draw, scene.distance
    table["start"], table["end"] = {}, {}
    scene.end_form = None
    if scene.has_node and source.chance(0.35):
        # The transfer goes from one relative orbit to another.
        scene.end_form = "relative-elements"
        first = [0.0, source.uniform(-1, 1) * distance * 0.3] + source.vector(
            distance)[:2] + source.vector(distance)[:2]
        change = source.vector(distance * source.logarithmic(0.05, 1)) + source.vector(
            distance * source.logarithmic(0.05, 1))
        last = [0.0] + [float(f"{a + b:.9g}") for a, b in zip(first[1:], change[1:])]
        if distance > 2e4:
            first, last = [0, first[1], 0, 0, 0, 0], [0, first[1] * source.uniform(0.5, 1), 0, 0, 0,
                                                      0]
        for end, numbers in (("start", first), ("end", last)):
            table[end].update({key: float(x) for key, x in zip(orbit.RELATIVE_ELEMENTS, numbers)})
        scene.start = orbit.from_form(scene.mu, scene.chief, scene.end_form, first)
        scene.end = last
        return
    scene.start = scene.deputy(table["start"], scene.chief, distance, scene.transfer_frame)
    table["end"]["position_m"] = source.vector(distance * source.logarithmic(0.01, 1))
    if source.chance(0.5):
        table["end"]["velocity_m_s"] = source.vector(
            distance * float(scene.rate) * source.uniform(0, 0.3))
    scene.end = np.array(table["end"]["position_m"] + table["end"].get("velocity_m_s", [0] * 3),
                         dtype=REAL)


def judge(judgement, scene, folder):
    run = Run(folder, ["transfer", "scene.toml", "-o", "out"], limit=90)
    summary = results(judgement, scene, run, [
        (r"no transfer time has an answer|no .* answer", lambda s: True)])
    if summary is None:
        return
    flights = Flights(scene)
    letters = ["x", "y", "z"] if scene.transfer_frame[0] == "inertial" else ["r", "t", "n"]
    rows = run.table("out", "transfers.csv")
    judgement.require("one row a time", len(rows) == len(scene.times))
    floor = 10 * (summary["flight_floor_m"] + (summary["chief_error_m"] or 0))
    points = []
    for row, time in zip(rows, scene.times):
        judgement.within("transfer time (s)", float(row["time_s"]), float(time),
                         1e-11 * abs(time))
        if not row["answer"]:
            judgement.require("a time without an answer has a reason", row["failure"])
            continue
        point = {"time": REAL(row["time_s"]), "answer": row["answer"],
                 "first": [number(row[f"start_change_{x}_m_s"]) for x in letters],
                 "second": [number(row[f"end_change_{x}_m_s"]) for x in letters],
                 "total": number(row["total_change_m_s"]),
                 "near": row["near_singular"] == "true",
                 "beyond": row["beyond_tolerance"] == "true",
                 "exceeds": row["exceeds_impulse"] == "true",
                 "ratio": number(row["keep_out_ratio"])}
        point["miss"] = number(row["refined_miss_m"]) if row["answer"] == "refined" else number(
            row["miss_m_" + row["answer"].replace(" ", "_")])
        point["candidate"] = is_candidate(scene, point)
        points.append(point)
        judge_point(judgement, scene, flights, point, floor)
    judge_least(judgement, scene, flights, summary, points, floor)
    plan = (summary.get("optimal_impulses") or {}).get("plan")
    if scene.extra in ("optimal", "limited"):
        judge_optimal(judgement, scene, flights, summary["optimal_impulses"], points, floor)
    for name in ("waypoints", "coasting_start"):
        found = summary.get(name)
        if found and found["plan"]:
            judge_legs(judgement, scene, flights, name, found["plan"], floor)
    if summary.get("coasting_start") and summary["coasting_start"]["plan"]:
        judge_coasting(judgement, scene, summary, points)
    for one in (summary.get("other_revolutions") or {}).get("transfers", []):
        if one["plan"]:
            judge_legs(judgement, scene, flights, "revolutions", one["plan"], floor)
            judge_revolutions(judgement, flights, one)
    if not points and not plan:
        judgement.mark("no time has an answer")
    judge_surface(judgement, scene, run, summary)


def judge_point(judgement, scene, flights, point, floor):
    time = point["time"]
    what = f"{point['answer']} after {float(time):.6g} s"
    start = flights.kicked(scene.start, REAL(0), point["first"])
    try:
        there = flights.on(start, REAL(0), time)
    except FlightFailed:
        # Next to a singular time a polynomial may ask for any velocity, which is marked.
        judgement.require(f"{what}: flies into the centre", point["near"])
        return
    end = flights.end(time)
    miss = orbit.norm(there[:3] - end[:3])
    reach = orbit.norm(end[:3])
    allowed = floor + 1e-5 * point["miss"] + 1e-14 * reach
    judgement.within(f"{what}: miss (m)", point["miss"], miss, allowed)
    change = flights.axes(time) @ (end[3:] - there[3:])
    rate = np.sqrt(scene.mu / reach ** 3)
    # A polynomial's own velocity at the end is as wrong as its place is.
    judgement.within(f"{what}: change of velocity at the end (m/s)", point["second"], change,
                     20 * rate * (point["miss"] + floor) + 1e-9 * orbit.norm(change))
    total = np.linalg.norm(point["first"]) + np.linalg.norm(point["second"])
    judgement.within(f"{what}: total (m/s)", point["total"], total, 1e-12 * total)
    limit = scene.tables["transfer"].get("largest_impulse_m_s")
    if limit is not None:
        largest = max(np.linalg.norm(point["first"]), np.linalg.norm(point["second"]))
        judgement.require(f"{what}: an impulse of {largest:.9g} m/s, limit {limit:.9g}, told "
                          f"{'too large' if point['exceeds'] else 'allowed'}",
                          point["exceeds"] == (largest > limit) or abs(largest / limit - 1) < 1e-9)
    axes = scene.tables["transfer"].get("keep_out_m")
    if axes and point["ratio"] == 0:
        judgement.require(f"{what}: told that its way cannot be followed", point["near"])
    elif axes and point["ratio"] is not None:
        ratio = least_ratio(scene, start, time, axes)
        # The told one may be of a way that misses by what it says.
        judgement.within(f"{what}: keep-out ratio", point["ratio"], ratio,
                         1e-4 * ratio + (floor + point["miss"]) / min(axes) * 0.01)
    elif axes:
        judgement.require(f"{what}: has no keep-out ratio, but is compared",
                          point["near"] or point["beyond"])


def is_candidate(scene, point):
    axes = scene.tables["transfer"].get("keep_out_m")
    return (not point["near"] and not (point["beyond"] and point["answer"] != "refined")
            and not point["exceeds"]
            and not (axes and point["ratio"] is not None and point["ratio"] < 1))


def judge_least(judgement, scene, flights, summary, points, floor):
    candidates = [p for p in points if p["candidate"]]
    best = summary["best"]
    if not candidates:
        judgement.require("no time is allowed, but one is the least", best is None)
        judgement.mark("no time is allowed")
        return
    if not judgement.require("there are allowed times, but none is the least", best is not None):
        return
    least = min(p["total"] for p in candidates)
    judgement.within("least velocity change (m/s)", best["total_change_m_s"], least, 1e-12 * least)
    between = summary["least_between_listed_times"]
    if between:
        judgement.at_most("least between listed times (m/s)", between["total_change_m_s"],
                          least * (1 + 1e-9))
        judge_point(judgement, scene, flights, {
            "time": REAL(between["time_s"]), "answer": "between: " + between["answer"],
            "first": between["start_change_m_s"], "second": between["end_change_m_s"],
            "total": between["total_change_m_s"], "miss": between["miss_m"],
            "near": between["near_singular"], "beyond": between["beyond_tolerance"],
            "exceeds": between["exceeds_impulse"], "ratio": between["keep_out_ratio"]}, floor)
    windows = summary["budget_windows"]
    if windows is None:
        return
    budget = scene.tables["transfer"]["budget_m_s"]
    for point in candidates:
        time = float(point["time"])
        inside = any(abs(w["first_s"]) <= abs(time) * (1 + 1e-12)
                     and abs(time) <= abs(w["last_s"]) * (1 + 1e-12) for w in windows)
        clear = abs(point["total"] / budget - 1) > 1e-3
        if clear:
            judgement.require(
                f"{point['total']:.9g} m/s after {time:.6g} s, budget {budget:.9g}: told "
                f"{'within' if inside else 'beyond'}", inside == (point["total"] <= budget))


