"""hamjet assign: the least sum over permutations, the told transfers flown, and the nearest pairs
along dense flights."""
import numpy as np
from scipy.optimize import linear_sum_assignment

import orbit
from command import Run, number
from flight import REAL
from refusal import results
from ways import Flights


def draw(source):
    scene = source.scene(revolutions=(0.2, source.one_of([1.5, 3])), orders=(2, 3, 4),
                  weights=(3, 3, 2))
    table = scene.tables["transfer"] = {}
    scene.transfer_frame = scene.frame(table)
    keys, scene.times = scene.times(8)
    table.update(keys)
    table["refine"] = source.chance(0.5)
    distance = source.logarithmic(50, 2e4)
    assignment = scene.tables["assignment"] = {
        "time": source.one_of(["per-pair", "common"], [3, 1])}
    if source.chance(0.3):
        assignment["keep_apart_m"] = distance * source.logarithmic(0.01, 1)
    if source.chance(0.2):
        table["keep_out_m"] = [distance * source.logarithmic(0.01, 0.3) for _ in range(3)]
    count = source.integer(1, 5)
    slots = count if source.chance(0.6) else source.integer(1, 5)
    assignment["deputy"], assignment["slot"], scene.starts, scene.ends = [], [], [], []
    for _ in range(count):
        one = {}
        scene.starts.append(scene.deputy(one, scene.chief, distance, scene.transfer_frame))
        assignment["deputy"].append(one)
    for _ in range(slots):
        one = {"position_m": source.vector(distance)}
        scene.ends.append(np.array(one["position_m"] + [0] * 3, dtype=REAL))
        assignment["slot"].append(one)
    return scene


def judge(judgement, scene, folder):
    run = Run(folder, ["assign", "scene.toml", "-o", "out"], limit=90)
    summary = results(judgement, scene, run)
    if summary is None:
        return
    costs = np.full((len(scene.starts), len(scene.ends)), np.inf)
    for row in run.table("out", "costs.csv"):
        if row["total_change_m_s"]:
            costs[int(row["deputy"]), int(row["slot"])] = float(row["total_change_m_s"])
    rows = run.table("out", "assignment.csv")
    if not rows:
        judgement.require("nothing is assigned, without a reason", summary["failure"])
        return
    flights = Flights(scene)
    letters = ["x", "y", "z"] if scene.transfer_frame[0] == "inertial" else ["r", "t", "n"]
    ways, total, chosen = [], 0.0, 0.0
    floor = 10 * summary["flight_floor_m"]
    for row in rows:
        if not row["total_change_m_s"]:
            judgement.mark("a chosen transfer has no answer")
            continue
        deputy, slot = int(row["deputy"]), int(row["slot"])
        time = REAL(row["time_s"])
        first = [number(row[f"start_change_{x}_m_s"]) for x in letters]
        second = [number(row[f"end_change_{x}_m_s"]) for x in letters]
        start = flights.kicked(scene.starts[deputy], REAL(0), first)
        there = flights.on(start, REAL(0), time)
        chief = flights.chief(time)
        end = chief + orbit.from_frame(chief, scene.ends[slot], *flights.frame)
        told = float(row["miss_m"])
        judgement.within(f"deputy {deputy} to slot {slot}: miss (m)", told,
                         orbit.norm(there[:3] - end[:3]),
                         floor + 1e-5 * told + 1e-14 * orbit.norm(end[:3]))
        rate = np.sqrt(scene.mu / orbit.norm(end[:3]) ** 3)
        judgement.within(f"deputy {deputy} to slot {slot}: change at the end (m/s)", second,
                         flights.axes(time) @ (end[3:] - there[3:]), 20 * rate * (told + floor))
        sum_of_both = np.linalg.norm(first) + np.linalg.norm(second)
        judgement.within("a transfer's total (m/s)", float(row["total_change_m_s"]), sum_of_both,
                         1e-12 * sum_of_both)
        total += sum_of_both
        chosen += costs[deputy, slot]
        ways.append((deputy, slot, time, start, second))
    judgement.within("total (m/s)", summary["total_change_m_s"], total, 1e-9 * total)
    finite = np.where(np.isfinite(costs), costs, 1e12)
    best = finite[linear_sum_assignment(finite)].sum()
    if best < 1e12 and len(ways) == len(rows):
        judgement.at_most("cost of the chosen pairs (m/s)", chosen, best * (1 + 1e-9))
    judgement.require("every one of the fewer has a partner",
                      len(rows) == min(costs.shape) or summary["failure"])
    judge_pairs(judgement, scene, flights, run, summary, ways)


def judge_pairs(judgement, scene, flights, run, summary, ways):
    told = {(int(r["deputy"]), int(r["other_deputy"])): float(r["least_separation_m"])
            for r in run.table("out", "pairs.csv")}
    if len(ways) < 2:
        return
    last = max((w[2] for w in ways), key=abs)
    nearest = np.inf
    for i, a in enumerate(ways):
        for b in ways[i + 1:]:
            least = least_separation(scene, flights, a, b, last)
            nearest = min(nearest, least)
            key = (a[0], b[0]) if (a[0], b[0]) in told else (b[0], a[0])
            if not judgement.require(f"pair {key} is told", key in told):
                continue
            # The page says 1e-6 of the distance from the chief.
            away = max(orbit.norm(w[3][:3] - scene.chief[:3]) for w in (a, b))
            judgement.within(f"deputies {a[0]} and {b[0]}: least separation (m)", told[key], least,
                             1e-5 * away + 10 * summary["flight_floor_m"] + 1e-3 * least)
    keep = scene.tables["assignment"].get("keep_apart_m")
    if keep is not None and abs(nearest / keep - 1) > 1e-3:
        judgement.require(f"nearest {float(nearest):.6g} m, to keep apart {keep:.6g} m, exit code "
                          f"{run.code}", nearest > keep or run.code == 1)


def least_separation(scene, flights, a, b, last):
    """Of both from the start to the last arrival, after their own with the velocity that they are
    brought to."""
    def pieces(way):
        _, _, time, start, second = way
        yield REAL(0), time, start
        if time != last:
            yield time, last, flights.kicked(flights.on(start, REAL(0), time), time, second)

    least = np.inf
    for begin, end, state in pieces(a):
        for other_begin, other_end, other in pieces(b):
            first = max(begin, other_begin, key=abs)
            then = min(end, other_end, key=abs)
            if abs(first) >= abs(then):
                continue
            one = flights.on(state, begin, first)
            two = flights.on(other, other_begin, first)
            found, _ = scene.field.least_separations(one[None], two[None], 0, then - first,
                                                     looks=40, tolerance=REAL(2) ** -50)
            least = min(least, float(found[0]))
    return least
