"""hamjet transfer: told velocity changes are flown, limits are looked at along dense flights, and
plans are compared with linear programmes."""
import numpy as np

import orbit
from command import Refused, Run, number
from drawing import Scene
from flight import REAL, coast_times
from least_impulses import least_sum
from refusal import judge_refusal, says_below_surface


EXTRAS = {"none": 3, "optimal": 4, "limited": 3, "coast": 2, "waypoints": 2, "revolutions": 1,
          "keep-out": 3, "budget": 1}


def draw(source):
    extra = source.one_of(list(EXTRAS), list(EXTRAS.values()))
    most = [1.5, 3, 8, 15] if extra in ("optimal", "limited") else [1.5, 3, 8]
    scene = Scene(source, revolutions=(0.1, source.one_of(most)), orders=(2, 3, 4),
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
        if source.chance(0.7):
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
        # Neither end lies in it.
        flights = Flights(scene)
        ends = [scene.start - scene.chief] + [flights.end(t) - flights.chief(t)
                                              for t in scene.times]
        inner = min(float(orbit.norm(end[:3])) for end in ends)
        table["keep_out_m"] = [inner * source.logarithmic(0.01, 0.95) for _ in range(3)]
    if extra == "budget":
        table["budget_m_s"] = rate * source.logarithmic(0.3, 10)
    return scene


def draw_ends(scene, table):
    source, distance = scene.draw, scene.distance
    table["start"], table["end"] = {}, {}
    scene.end_form = None
    if scene.has_node and source.chance(0.35):
        # From one relative orbit to another.
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


class Flights:
    """The chief and what is wanted of the deputy at a time."""

    def __init__(self, scene):
        self.scene, self.field, self.frame = scene, scene.field, scene.transfer_frame

    def chief(self, time):
        return self.field.to(self.scene.chief, time) if time else self.scene.chief

    def end(self, time):
        chief = self.chief(time)
        if self.scene.end_form:
            return orbit.from_form(self.scene.mu, chief, self.scene.end_form, self.scene.end)
        return chief + orbit.from_frame(chief, self.scene.end, *self.frame)

    def axes(self, time):
        return np.eye(3, dtype=REAL) if self.frame[0] == "inertial" else orbit.axes_of(
            self.chief(time))[0]

    def kicked(self, state, time, change):
        """A state after a velocity change along the frame's axes at a time."""
        return np.concatenate([state[:3], state[3:] + np.array(change, dtype=REAL)
                               @ self.axes(time)])

    def on(self, state, time, then):
        return self.field.to(state, REAL(then) - REAL(time)) if then != time else state


def judge(judgement, scene, folder):
    run = Run(folder, ["transfer", "scene.toml", "-o", "out"], limit=90)
    try:
        summary = run.summary("out")
    except Refused as refused:
        judge_refusal(judgement, scene, refused, [
            (r"no transfer time has an answer|no .* answer", lambda s: True)])
        return
    if run.code:
        judgement.mark(f"exit code {run.code}: {run.said.strip()[:200]}")
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


def judge_surface(judgement, scene, run, summary):
    if scene.highest and scene.lowest() < scene.radius * REAL(0.99999):
        if run.code or says_below_surface(run, summary):
            judgement.mark("below the surface")
        else:
            judgement.wrong("nothing is said of a chief below the surface")


def judge_point(judgement, scene, flights, point, floor):
    time = point["time"]
    what = f"{point['answer']} after {float(time):.6g} s"
    start = flights.kicked(scene.start, REAL(0), point["first"])
    there, end = flights.on(start, REAL(0), time), flights.end(time)
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
    if axes and point["ratio"] is not None:
        ratio = least_ratio(scene, start, time, axes)
        # The told one may be of a way that misses by what it says.
        judgement.within(f"{what}: keep-out ratio", point["ratio"], ratio,
                         1e-4 * ratio + (floor + point["miss"]) / min(axes) * 0.01)
    elif axes:
        judgement.require(f"{what}: has no keep-out ratio, but is compared",
                          point["near"] or point["beyond"])


def least_ratio(scene, deputy, time, axes):
    """The least of |(R/a, T/b, N/c)| along the way, by looks and by golden sections between them."""
    field, chief = scene.field, scene.chief
    axes = np.array(axes, dtype=REAL)

    def ratios(times, chief, deputy):
        chiefs, deputies = field.fly(chief, times), field.fly(deputy, times)
        return np.array([orbit.norm(orbit.axes_of(c)[0] @ (d - c)[:3] / axes)
                         for c, d in zip(chiefs, deputies)]), chiefs, deputies

    times = coast_times(field, chief, time, 60)
    found, chiefs, deputies = ratios(times, chief, deputy)
    least = np.min(found)
    for k in range(len(times)):
        before, after = max(k - 1, 0), min(k + 1, len(times) - 1)
        if found[k] > found[before] or found[k] > found[after] or found[k] > 1.3 * least:
            continue
        low, high = REAL(0), times[after] - times[before]
        for _ in range(7):
            inner = low + (high - low) * np.linspace(0, 1, 11).astype(REAL)
            values = ratios(inner, chiefs[before], deputies[before])[0]
            place = int(np.argmin(values))
            least = min(least, values[place])
            low, high = inner[max(place - 1, 0)], inner[min(place + 1, 10)]
    return least


def is_candidate(scene, point):
    axes = scene.tables["transfer"].get("keep_out_m")
    return (not point["near"] and not (point["beyond"] and point["answer"] != "refined")
            and not point["exceeds"]
            and not (axes and point["ratio"] is not None and point["ratio"] < 1))


def judge_least(judgement, scene, flights, summary, points, floor):
    candidates = [p for p in points if is_candidate(scene, p)]
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


def fly_plan(scene, flights, impulses):
    """States right before each impulse and after the last one."""
    state, time = scene.start, REAL(0)
    before = []
    for impulse in impulses:
        then = REAL(impulse["time_s"])
        state, time = flights.on(state, time, then), then
        before.append(state)
        state = flights.kicked(state, time, impulse["change_m_s"])
    return before, state, time


def judge_sum(judgement, name, plan):
    total = sum(np.linalg.norm(i["change_m_s"]) for i in plan["impulses"])
    judgement.within(f"{name}: total (m/s)", plan["total_change_m_s"], total, 1e-12 * total)


def judge_optimal(judgement, scene, flights, optimal, points, floor):
    plan = optimal["plan"]
    judge_by_time(judgement, scene, flights, optimal)
    if plan is None or optimal["failure"]:
        judgement.require("optimal: no plan and no reason", optimal["failure"])
        return
    judge_sum(judgement, "optimal", plan)
    impulses = plan["impulses"]
    _, state, time = fly_plan(scene, flights, impulses)
    duration = REAL(plan["duration_s"])
    state = flights.on(state, time, duration)
    end = flights.end(duration)
    rate = np.sqrt(scene.mu / orbit.norm(end[:3]) ** 3)
    # A correction of a flight is not better than its rounding.
    allowed = floor + 1e-3 * plan["miss_m"] + 1e-14 * orbit.norm(end[:3])
    judgement.within("optimal: miss (m)", plan["miss_m"], orbit.norm(state[:3] - end[:3]), allowed)
    judgement.within("optimal: miss in velocity (m/s)", plan["velocity_miss_m_s"],
                     orbit.norm(state[3:] - end[3:]), 10 * rate * allowed
                     + 1e-3 * plan["velocity_miss_m_s"])
    table = scene.tables["transfer"]
    limit = table.get("largest_impulse_m_s")
    if limit is not None:
        judgement.at_most("optimal: largest impulse (m/s)",
                          max(i["magnitude_m_s"] for i in impulses), limit * (1 + 1e-6))
    if plan["spacing_s"]:
        gap = table.get("impulse_gap_s", float(scene.period) / 72)
        times = sorted(abs(i["time_s"]) for i in impulses)
        if len(times) > 1:
            judgement.at_most("optimal: gap between impulses, negative (s)",
                              -min(b - a for a, b in zip(times, times[1:])), -gap * (1 - 1e-6))
    total = plan["total_change_m_s"]
    bound = plan["lower_bound_m_s"]
    if bound is not None:
        judgement.at_most("optimal: bound (m/s)", bound, total * (1 + 1e-4) + 1e-9)
    # Two impulses that the same command found are a plan that it may give too.
    for point in points:
        if not is_candidate(scene, point):
            continue
        judgement.at_most(f"optimal ({len(impulses)} impulses), beside two impulses in "
                          f"{float(point['time']):.6g} s of {point['total']:.6g} m/s", total,
                          point["total"] * (1 + 2e-3) + 1e-9)
        if bound is not None and abs(point["time"] / duration - 1) < 1e-9:
            judgement.at_most("optimal: bound (m/s), beside two impulses in the same time", bound,
                              point["total"] * (1 + 1e-3) + 1e-9)


def departure(scene):
    """About how far the linear theory about the chief is off, in parts."""
    growth = (1 + 6 * np.pi * abs(scene.revolutions)) / (1 - float(scene.e)) ** 1.5
    return scene.distance / float(orbit.norm(scene.chief[:3])) * growth


def linear_programme(scene, flights, duration, times):
    """Effects of impulses along inertial axes at times, and the wanted changes of the end: with the
    coast in the linear theory, and with it flown."""
    whole = flights.field.transition(scene.chief, duration)
    # Phi(T, t) = Phi(T, 0) Phi(t, 0)^-1, and the inverse of a symplectic matrix is its adjoint.
    effects = []
    inner = [t for t in times if t != 0]
    flows = flights.field.transition(scene.chief, np.array(inner)) if inner else []
    flows = dict(zip(inner, flows))
    for t in times:
        if t == 0:
            effects.append(whole[:, 3:])
            continue
        F = flows[t]
        inverse = np.vstack([np.hstack([F[3:, 3:].T, -F[:3, 3:].T]),
                             np.hstack([-F[3:, :3].T, F[:3, :3].T])])
        effects.append((whole @ inverse)[:, 3:])
    end = flights.end(duration)
    changes = [end - flights.chief(duration) - whole @ (scene.start - scene.chief),
               end - flights.on(scene.start, REAL(0), duration)]
    return np.array(effects, dtype=float), [np.array(c, dtype=float) for c in changes]


def judge_by_time(judgement, scene, flights, optimal):
    """Least sums of the linear theory at some of the transfer times."""
    if departure(scene) > 0.05:
        return
    chosen = optimal["least_by_time"]
    if len(chosen) > 4:
        chosen = [chosen[k] for k in np.linspace(0, len(chosen) - 1, 4).astype(int)]
    for one in chosen:
        if abs(one["time_s"]) > 0.02 * scene.period:
            judge_least_sum(judgement, scene, flights, REAL(one["time_s"]),
                            one["linear_change_m_s"])


def judge_least_sum(judgement, scene, flights, duration, told):
    table = scene.tables["transfer"]
    limit = table.get("largest_impulse_m_s")
    looks = coast_times(flights.field, scene.chief, duration,
                        24 if abs(scene.revolutions) < 4 else 10)
    effects, changes = linear_programme(scene, flights, duration, looks)
    found = [least_sum(effects, change) for change in changes]
    if None in found:
        return
    judgement.note("optimal: gap of the judge", max(p / d - 1 for p, d in found if d))
    # Looks, and the command's, leave out what lies between them: the primer vector is curved there
    # by (step n)^2.
    low, high = 0.97 * min(dual for _, dual in found), 1.03 * max(primal for primal, _ in found)
    what = f"optimal: least sum in {float(duration):.6g} s (m/s)"
    if limit is None:
        if judgement.require(f"{what}: has none", told is not None):
            judgement.at_most(what + ", bound of the judge", low, told + 1e-9)
            judgement.at_most(what, told, high + 1e-9)
        return
    gap = max(table.get("impulse_gap_s", float(scene.period) / 72), 1e-3 * float(abs(duration)))
    count = max(1, int(float(abs(duration)) / gap * (1 + 1e-12)))
    # Of many times every so manieth is looked at, which only bounds from above.
    every = -(-count // 120)
    equal = [duration * k / count for k in sorted({*range(0, count, every), count})]
    effects, changes = linear_programme(scene, flights, duration, equal)
    programmes = [least_sum(effects, change, limit) for change in changes]
    if None in programmes:
        return
    limited = [primal for primal, _ in programmes]
    if told is None:
        # Where the coast flown and the linear one differ in it, rounding may decide.
        judgement.require(f"{what}: told that no impulses of limited size do it, the judge's sum is "
                          f"{limited}", None in limited)
        return
    judgement.at_most(what + " of limited size, bound of the judge", low, told + 1e-9)
    if told <= high:
        return  # The least of any size are small enough, it may be.
    if None not in limited:
        judgement.at_most(what + " of limited size", told, max(limited) * 1.03 + 1e-9)
    if every > 1:
        return
    if limited == [None, None]:
        judgement.wrong(f"{what}: told {told:.6g} of limited size, the judge's programme has no "
                        "solution")
    elif None not in limited:
        judgement.at_most(what + " of limited size, bound of the judge", 0.97 * min(
            dual for _, dual in programmes), told + 1e-9)


def judge_legs(judgement, scene, flights, name, plan, floor):
    judge_sum(judgement, name, plan)
    impulses, legs = plan["impulses"], plan["legs"]
    before, state, time = fly_plan(scene, flights, impulses)
    places = scene.tables["transfer"].get("waypoint", []) if name == "waypoints" else []
    for k, leg in enumerate(legs):
        there = REAL(leg["end_s"])
        at = next((b for b, i in zip(before, impulses) if abs(i["time_s"] - leg["end_s"])
                   <= 1e-9 * abs(leg["end_s"])), None)
        if at is None:
            at = flights.on(state, time, there)
        if k < len(places):
            chief = flights.chief(there)
            wanted = chief + orbit.from_frame(
                chief, places[k]["position_m"] + [0] * 3, *flights.frame)
        else:
            wanted = flights.end(there)
        miss = orbit.norm(at[:3] - wanted[:3])
        # The legs before leave what they missed, and what rounding made of it grows.
        allowed = (10 * floor + 1e-3 * leg["miss_m"] + 1e-14 * orbit.norm(wanted[:3])
                   + (20 * k + (name == "revolutions") * 100) * (floor + 1e-3))
        judgement.within(f"{name}: miss of leg {k + 1} (m)", leg["miss_m"], miss, allowed)
    end = flights.end(time)
    rate = np.sqrt(scene.mu / orbit.norm(end[:3]) ** 3)
    judgement.within(f"{name}: velocity at the end (m/s)", state[3:], end[3:],
                     100 * rate * (floor + 1e-2))


def judge_coasting(judgement, scene, summary, points):
    plan = summary["coasting_start"]["plan"]
    first = plan["impulses"][0]["time_s"]
    longest = scene.tables["transfer"]["longest_coast_s"]
    judgement.at_most("coasting: first impulse after (s)", abs(first), longest * (1 + 1e-9))
    for point in points:
        if is_candidate(scene, point) and departure(scene) < 1e-3:
            judgement.at_most("coasting (m/s), beside an impulse at once",
                              plan["total_change_m_s"], point["total"] * (1 + 1e-2) + 1e-9)


def judge_revolutions(judgement, flights, one):
    """Turns of deputy and chief about the centre, on the ellipses of their starts."""
    scene = flights.scene
    start = flights.kicked(scene.start, REAL(0), one["plan"]["impulses"][0]["change_m_s"])
    time = REAL(one["time_s"])
    difference = turns(scene.mu, start, time) - turns(scene.mu, scene.chief, time)
    sign = -1 if time < 0 else 1
    judgement.within("revolutions: turns more than the chief's", one["difference"],
                     sign * difference, 0.2)


def turns(mu, state, time):
    k = orbit.elements_of(mu, state)
    e, w = np.hypot(k["q1"], k["q2"]), np.arctan2(k["q2"], k["q1"])
    mean = k["u"] - w + np.sqrt(mu / k["a"] ** 3) * time
    nu = orbit.true_of_eccentric(orbit.eccentric_anomaly(mean, e), e)
    # The true anomaly is the mean one's turn, give or take less than half of one.
    return float(mean + orbit.wrapped(nu - mean) - (k["theta"] - w)) / (2 * np.pi)
