"""hamjet poincare with [event]: the time of an event of the chief, and its polynomials at flown
deputies."""
import csv
import os

import numpy as np

import orbit
from command import Run
from flight import REAL, coast_times
from refusal import results


def draw(source):
    scene = source.scene(revolutions=(0.3, source.one_of([2, 5])), orders=(1, 2, 3, 4),
                  weights=(1, 3, 3, 2), coordinates=False)
    event = scene.tables["event"] = {
        "surface": source.one_of(["equator", "plane", "distance", "apsis"])}
    low, high = float(scene.a * (1 - scene.e)) / 1000, float(scene.a * (1 + scene.e)) / 1000
    if event["surface"] == "plane":
        event["normal"] = source.vector(source.logarithmic(0.01, 100))
        if source.chance(0.5):
            event["offset_km"] = low * source.uniform(-0.5, 0.5)
    if event["surface"] == "distance":
        event["distance_km"] = low + (high - low) * source.uniform(0.05, 0.95) + source.uniform(
            0, 1) * 1e-3
    if source.chance(0.6):
        event["direction"] = source.one_of(["either", "rising", "falling"])
    count = len(events(scene)[0])
    if count and source.chance(0.7):
        # At times one more than there are.
        event["number"] = source.integer(1, count + (1 if source.chance(0.1) else 0))
    event["amplitudes_m"] = [source.logarithmic(1, 1e4) for _ in range(2)]
    return scene


def values(scene, states):
    event = scene.tables["event"]
    x, v = states[..., :3], states[..., 3:]
    if event["surface"] == "equator":
        return x[..., 2]
    if event["surface"] == "plane":
        normal = np.array(event["normal"], dtype=REAL)
        return x @ (normal / orbit.norm(normal)) - REAL(event.get("offset_km", 0)) * 1000
    if event["surface"] == "distance":
        return orbit.norm(x) - REAL(event["distance_km"]) * 1000
    return orbit.dot(x, v)


def is_wanted(scene, before, after, sign):
    direction = scene.tables["event"].get("direction", "either")
    return direction == "either" or ((after - before) * sign > 0) == (direction == "rising")


def crossing(scene, state, low, high):
    """The root between two times after a state, by halving and secants."""
    at = lambda t: values(scene, scene.field.to(state, t))
    first = at(low)
    for _ in range(50):
        middle = (low + high) / 2
        value = at(middle)
        if value * first > 0:
            low, first = middle, value
        else:
            high = middle
        if abs(high - low) < 1e-4:
            break
    for _ in range(4):
        a, b = at(low), at(high)
        # Where the values are rounding alone, a secant leads anywhere.
        if a == b or abs(high - low) < 1e-9:
            break
        low, high = high, low + (high - low) * a / (a - b)
    return high


def events(scene):
    """Times of the chief's events, and whether two places come so near to the surface that a
    crossing may have been missed."""
    times = coast_times(scene.field, scene.chief, scene.duration, 25)
    states = scene.field.fly(scene.chief, times)
    found = values(scene, states)
    size = np.max(np.abs(found))
    sign = -1 if scene.duration < 0 else 1
    roots = []
    doubtful = abs(found[0]) < 1e-9 * size or abs(found[-1]) < 1e-6 * size
    # An orbit in the plane does not cross it, whatever its heights round to.
    doubtful |= bool(size < 1e-12 * orbit.norm(scene.chief[:3]))
    for k in range(len(times) - 1):
        if found[k] * found[k + 1] < 0:
            if is_wanted(scene, found[k], found[k + 1], sign):
                step = times[k + 1] - times[k]
                roots.append(times[k] + crossing(scene, states[k], REAL(0), step))
        elif (0 < k and found[k] * found[k - 1] > 0 and abs(found[k]) < 1e-2 * size
              and abs(found[k]) < min(abs(found[k - 1]), abs(found[k + 1]))):
            doubtful = True
    return roots, doubtful


def judge(judgement, scene, folder):
    run = Run(folder, ["poincare", "scene.toml", "-o", "out"])
    roots, doubtful = events(scene)
    number = scene.tables["event"].get("number", 1)
    few = len(roots) < number or doubtful
    summary = results(judgement, scene, run, [(r"no such event", lambda s: few),
                                              (r"tangent|touches|grazes", lambda s: doubtful)])
    if summary is None:
        return
    time = REAL(summary["time_s"])
    state = scene.chief_at(time)
    rounding = summary["position_rounding_m"]
    speed = orbit.norm(state[3:])
    if doubtful:
        judgement.mark("the chief is near the surface without crossing it")
    elif judgement.require(f"{len(roots)} events, but number {number} is told",
                           len(roots) >= number):
        # A time to the integration's tolerance of 1e-14 of the motion. Near a circle an apsis is
        # where a radial velocity of e times the whole one turns.
        turning = (orbit.eccentricity(scene.mu, scene.chief)
                   if scene.tables["event"]["surface"] == "apsis" else 1)
        judgement.within("time of the event (s)", float(time), float(roots[number - 1]),
                         1e-11 * abs(float(time)) + 30 * rounding / float(speed * turning)
                         + 1e-12 * float(scene.period))
    units = np.array([scene.length] * 3 + [scene.length / scene.time_unit] * 3)
    told = np.array(summary["state_canonical"], dtype=REAL) * units
    judgement.within("place at the event (m)", told[:3], state[:3],
                     30 * rounding + 1e-11 * orbit.norm(state[:3]))
    judgement.within("velocity at the event (m/s)", told[3:], state[3:],
                     (30 * rounding / orbit.norm(state[:3]) + 1e-11) * speed * 3)
    judge_polynomials(judgement, scene, folder, summary, units)


def judge_polynomials(judgement, scene, folder, summary, units):
    names = ["x", "y", "z", "px", "py", "pz"]
    series = ["time", *names]
    with open(os.path.join(folder, "out", "event-map.csv")) as file:
        rows = list(csv.DictReader(file))
    exponents = np.array([[int(r[f"e_{n}"]) for n in names] for r in rows])
    places = [series.index(r["component"]) for r in rows]
    coefficients = np.array([REAL(r["coefficient"]) for r in rows])
    random = np.random.default_rng(scene.draw.integer(0, 2 ** 31))
    rate = np.sqrt(scene.mu / orbit.norm(scene.chief[:3]) ** 3)
    reach = orbit.norm(np.array(summary["state_canonical"][:3], dtype=REAL)) * scene.length
    for misses in summary["misses"]:
        amplitude = misses["amplitude_m"]
        if misses["position_miss_m"] is None:
            judgement.mark(f"deputies of {amplitude:.3g} m were not flown")
            continue
        worst = worst_time = 0
        for _ in range(12):
            d = random.normal(size=6)
            d[:3] *= amplitude / np.linalg.norm(d[:3])
            d[3:] *= amplitude * float(rate) / np.linalg.norm(d[3:])
            point = np.array(d, dtype=REAL) / units
            told = np.zeros(7, dtype=REAL)
            np.add.at(told, places, coefficients * np.prod(point ** exponents, axis=1))
            start = scene.chief + np.array(d, dtype=REAL)
            end = scene.field.to(start, told[0] * scene.time_unit)
            worst = max(worst, orbit.norm(end[:3] - told[1:4] * scene.length))
            later = REAL(1e-4) * scene.period
            value = values(scene, end)
            slope = (values(scene, scene.field.to(end, later)) - value) / later
            worst_time = max(worst_time, abs(value / slope))
        order = scene.tables["jet"]["order"]
        # Told is the largest of random directions and of those that the polynomials' degrees choose;
        # the largest of twelve random ones may be a few times more.
        allowed = (10 * misses["position_miss_m"] + 30 * summary["position_rounding_m"]
                   + 1e-11 * reach)
        judgement.note("event: miss over told", worst / misses["position_miss_m"]
                       if misses["position_miss_m"] else 0)
        judgement.at_most(f"order {order}: miss at {amplitude:.4g} m (m)", worst, allowed)
        judgement.at_most(f"order {order}: miss in time at {amplitude:.4g} m (s)", worst_time,
                          10 * misses["time_miss_s"] + allowed * 10 / orbit.norm(scene.chief[3:])
                          + 1e-9 * float(scene.period))
