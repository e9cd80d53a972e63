"""Plans of several impulses that hamjet transfer tells: optimal ones, by way of places, after
a coast, with other revolutions."""
import numpy as np

import orbit
from flight import REAL, coast_times
from least_impulses import least_sum


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
    # A correction of a flight is not better than its rounding, which every leg has.
    floor = max(floor, 10 * plan["flight_floor_m"])
    # Flights keep 1e-13 of the radius, to a factor of 3; only where the density has kinks are they
    # not far better than that.
    kept = 3e-13 if getattr(scene.field, "air", None) is not None else 1e-14
    allowed = floor + 1e-3 * plan["miss_m"] + kept * orbit.norm(end[:3])
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
        if not point["candidate"]:
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
        judgement.require(f"{what}: told that no impulses of limited size do it, the judge's sum "
                          f"is {limited}", None in limited)
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
        if point["candidate"] and departure(scene) < 1e-3:
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
    a, e, start, mean = orbit.anomalies(mu, state)
    mean = mean + np.sqrt(mu / a ** 3) * time
    nu = orbit.true_of_eccentric(orbit.eccentric_anomaly(mean, e), e)
    # The true anomaly is the mean one's turn, give or take less than half of one.
    return float(mean + orbit.wrapped(nu - mean) - start) / (2 * np.pi)
