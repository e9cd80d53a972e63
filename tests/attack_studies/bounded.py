"""hamjet bounded: told starts are flown over the window, and their drifts, sizes and lowest points
compared; a box is flown through its told impulses."""
import numpy as np

import orbit
from command import Run
from flight import REAL, coast_times
from refusal import results


def draw(source):
    scene = source.scene(revolutions=(0.5, 1), orders=(3, 4), weights=(2, 1), largest_e=0.7,
                  coordinates=False, may_go_back=False)
    table = scene.tables["bounded"] = {
        "sizes_km": [source.logarithmic(0.1, 300)], "revolutions": source.one_of([10, 20, 60])}
    if source.chance(0.5):
        table["phase_deg"] = source.uniform(-180, 180)
    if source.chance(0.5):
        table["cross_track"] = source.uniform(-0.6, 0.6)
    if source.chance(0.3):
        table["along_track"] = source.uniform(-0.3, 0.3)
    table["refine"] = source.chance(0.7)
    # At rest beside a chief on an ellipse a deputy is nowhere near an orbit that stays.
    scene.has_box = scene.e < 0.05 and source.chance(0.7)
    if scene.has_box:
        draw_box(scene, table)
    return scene


def draw_box(scene, table):
    """A follower, at rest behind or ahead of the chief, in a box about that place or its orbit."""
    source = scene.draw
    distance = source.logarithmic(30, 1000)
    side = source.one_of([-1, 1]) * distance
    # On an ellipse a mean place ahead is by so much more away at times.
    size = float(f"{distance * (1 + float(scene.e)) * 1.02 / 1000:.9g}")
    table["sizes_km"] = [size]
    table["cross_track"], table["along_track"] = 0, side / 1000 / size
    scene.tables["deputy"] = {"position_m": [0.0, side, 0.0]}
    box = table["box"] = {"half_widths_m": [distance * source.logarithmic(0.01, 0.5)
                                            for _ in range(3)],
                          "days": max(0.01, source.uniform(1, 6) * float(scene.period) / 86400)}
    if source.chance(0.5):
        box.update(reference="rest", position_m=[0.0, side, 0.0])


def judge(judgement, scene, folder):
    run = Run(folder, ["bounded", "scene.toml", "-o", "out"], limit=120)
    true = [(r"node|inclination|depend|kepler|J2|zonal|frozen", lambda s: True),
            (r"cross_track and along_track alone", lambda s: True),
            (r"no amplitude|no orbit|eccentricity|none of the sizes", lambda s: True),
            (r"starts outside|no return of these|too small", lambda s: scene.has_box)]
    summary = results(judgement, scene, run, true)
    if summary is None:
        return
    period = REAL(summary["nodal_period_s"])
    for deputy in summary["deputies"]:
        if deputy["failure"]:
            judgement.mark(deputy["failure"])
            continue
        judge_deputy(judgement, scene, summary, deputy, period)
    if summary["box"]:
        judge_box(judgement, scene, run, summary)


def starts_of(deputy):
    """The told initial conditions by form, each by component."""
    forms = {}
    for name, value in deputy.items():
        if "." in name:
            form, component = name.split(".")
            forms.setdefault(form, {})[component] = value
    return forms


def judge_deputy(judgement, scene, summary, deputy, period):
    what = f"{deputy['wanted_m']:.6g} m, {deputy['rule']}"
    states = {}
    for key, numbers in starts_of(deputy).items():
        numbers = list(numbers.values())
        if key in orbit.FORMS:
            states[key] = orbit.from_form(scene.mu, scene.chief, key, numbers)
        else:
            frame, derivatives = {"RTN-rotating": ("RTN", "rotating"),
                                  "RTN-inertial": ("RTN", "inertial"),
                                  "inertial": ("inertial", "")}[key]
            states[key] = scene.chief + orbit.from_frame(scene.chief, numbers, frame, derivatives)
    start = states["inertial"]
    size = REAL(deputy["size_m"])
    for key, state in states.items():
        # Angles are told in degrees to 1e-16 of a turn.
        judgement.within(f"{what}: start in the form {key} (m)", state[:3], start[:3],
                         1e-12 * size + 1e-14 * orbit.norm(start[:3]))
    # The first revolution, equal in eccentric anomaly there; here in looks a few times as dense.
    times = coast_times(scene.field, scene.chief, period, 60)
    chief, flown = scene.field.fly(scene.chief, times), scene.field.fly(start, times)
    largest = np.max(orbit.norm((flown - chief)[:, :3]))
    judgement.within(f"{what}: size (m)", size, largest, 0.01 * float(largest))
    lowest = np.min(orbit.norm(flown[:, :3]))
    judgement.within(f"{what}: lowest distance (m)", deputy["lowest_m"], lowest,
                     2e-3 * float(lowest))
    if deputy["rule"] in ("poincare-map", "refined") and deputy["wanted_m"]:
        judgement.within(f"{what}: size, as it was wanted (m)", size, deputy["wanted_m"],
                         0.02 * deputy["wanted_m"])
    along, cross, spread = drifts(scene, summary, start, period, size)
    # The rounding of flights in double precision adds up along the track.
    revolutions = summary["revolutions"]
    e = float(scene.e)
    rounding = 3e-14 * float(scene.a) / (1 - e) ** 2 / float(size) * np.sqrt(revolutions)
    judgement.note("bounded: drift, in roundings",
                   abs(deputy["window_along_drift"] - along) / rounding)
    judgement.within(f"{what}: drift along the track", deputy["window_along_drift"], along,
                     10 * rounding + 1e-4 * abs(along))
    judgement.within(f"{what}: drift across", deputy["window_cross_drift"], cross,
                     10 * rounding + 1e-4 * abs(cross))
    judgement.within(f"{what}: range along the track", deputy["window_along_range"], spread,
                     100 * rounding * np.sqrt(revolutions) + 1e-3 * spread)


def drifts(scene, summary, start, period, size):
    """Slopes of least squares through the differences of passages at the looks of the window."""
    revolutions = summary["revolutions"]
    each = -(-revolutions // 50)
    parts = -(-revolutions // each)
    looks = np.array([k * each for k in range(parts + 1)], dtype=float)
    times = period * looks.astype(REAL)
    chiefs, deputies = (scene.field.fly(s, times) for s in (scene.chief, start))
    n = 2 * orbit.PI / REAL(summary["mean_nodal_period_s"])
    k = orbit.elements_of(scene.mu, scene.chief)
    along, cross, first = [], [], None
    for chief, deputy in zip(chiefs, deputies):
        delay, node = passage(scene, chief, deputy)
        if first is None:
            first = delay, node
        turn = orbit.wrapped(node - first[1])
        along.append(k["a"] * (-n * (delay - first[0]) + np.cos(k["i"]) * turn))
        cross.append(k["a"] * np.sin(k["i"]) * turn)
    along, cross = np.array(along) / size, np.array(cross) / size
    centred = looks - looks.mean()
    slope = lambda y: float(np.sum(centred * y) / np.sum(centred ** 2))
    return slope(along), slope(cross), float(np.max(along) - np.min(along))


def passage(scene, chief, deputy):
    """When the deputy passes the chief's mean argument of latitude, and its node then less the
    chief's."""
    k = orbit.elements_of(scene.mu, chief)
    delay, state = REAL(0), deputy
    for _ in range(12):
        d = orbit.elements_of(scene.mu, state)
        angle = orbit.wrapped(k["u"] - d["u"])
        if abs(angle) < 1e-17:
            break
        step = angle / np.sqrt(scene.mu / d["a"] ** 3)
        state = scene.field.to(state, step)
        delay += step
    d = orbit.elements_of(scene.mu, state)
    return delay, orbit.wrapped(d["node"] - k["node"])


def judge_box(judgement, scene, run, summary):
    box = summary["box"]
    widths = np.array(scene.tables["bounded"]["box"]["half_widths_m"], dtype=REAL)
    units = np.array([scene.length] * 3 + [scene.length / scene.time_unit] * 3)
    deputy = np.array(box["start_canonical"], dtype=REAL) * units
    side = scene.tables["deputy"]["position_m"]
    wanted = scene.chief + orbit.from_frame(scene.chief, side + [0] * 3, "RTN", "rotating")
    judgement.within("box: start (m)", deputy[:3], wanted[:3], 1e-14 * orbit.norm(deputy[:3]))
    member = None
    if box["reference"] == "member":
        told = starts_of(summary["deputies"][1 if scene.tables["bounded"]["refine"] else 0])
        member = scene.chief + np.array(list(told["inertial"].values()), dtype=REAL)
    rows = run.table("out", "box.csv")
    end = REAL(box["days"]) * 86400
    judgement.within("box: sum (m/s)", box["total_change_m_s"],
                     sum(float(r["change_m_s"]) for r in rows),
                     1e-9 * box["total_change_m_s"] + 1e-12)
    now, state, farthest, total = REAL(0), deputy, 0.0, 0.0
    for row in [*rows, None]:
        then = REAL(row["time_s"]) if row else max(end, now)
        farthest = max(farthest, farthest_part(scene, now, state, then, member, widths))
        state = scene.field.to(state, then - now) if then > now else state
        now = then
        if row is None:
            break
        for leg in ("first", "second"):
            if leg == "second":
                then = now + REAL(row["duration_s"])
                farthest = max(farthest, farthest_part(scene, now, state, then, member, widths))
                state = scene.field.to(state, then - now)
                now = then
            change = np.array([REAL(row[f"{leg}_{x}_m_s"]) for x in "rtn"])
            total += float(orbit.norm(change))
            axes = orbit.axes_of(scene.field.to(scene.chief, now) if now else scene.chief)[0]
            state = np.concatenate([state[:3], state[3:] + change @ axes])
    judgement.within("box: impulses (m/s)", box["total_change_m_s"], total, 1e-6 * total + 1e-12)
    # Errors of the flights' rounding add up from return to return, along the track.
    slack = 1e-3 + 1e-12 * float(scene.a) / float(np.min(widths)) * (1 + len(rows))
    judgement.note("box: farthest less told", farthest - box["farthest_of_all"])
    # Looks there are 96 a revolution and more near a face.
    judgement.at_most("box: farthest, in half widths", farthest,
                      box["farthest_of_all"] + 0.01 + slack)
    judgement.at_most("box: farthest as told, in half widths", box["farthest_of_all"],
                      farthest + 0.05 + slack)
    if farthest > 1.02 + slack:
        judgement.require("box: the deputy is outside, told as held", not box["held"])


def farthest_part(scene, begin, state, end, member, widths):
    """The largest share of a half width on the way, in looks 300 a revolution."""
    if end <= begin:
        return 0.0
    count = max(3, int(300 * float((end - begin) / scene.period)))
    times = (end - begin) * np.linspace(0, 1, count + 1).astype(REAL)
    chiefs = scene.field.fly(scene.field.to(scene.chief, begin) if begin else scene.chief, times)
    deputies = scene.field.fly(state, times)
    members = None
    if member is not None:
        members = scene.field.fly(scene.field.to(member, begin) if begin else member, times)
    most = 0.0
    for k, (c, d) in enumerate(zip(chiefs, deputies)):
        axes = orbit.axes_of(c)[0]
        middle = (np.array(scene.tables["bounded"]["box"].get("position_m", [0] * 3), dtype=REAL)
                  if members is None else axes @ (members[k] - c)[:3])
        most = max(most, float(np.max(np.abs((axes @ (d - c)[:3] - middle) / widths))))
    return most
