"""hamjet validity: no deputy within a told reach may be missed by more than the tolerance. The
polynomials are those of hamjet run (evaluated here) or, in other coordinates, of hamjet eval;
deputies are random ones and what a search from the worst of them finds."""
import csv
import os

import numpy as np

import orbit
from command import Refused, Run
from flight import REAL
from refusal import judge_refusal

RANDOM = 300
RANDOM_OF_EARTH = 80  # whose flights take ten times as long
SEARCHES = 4
STEPS = 60


def draw(source):
    scene = source.scene(revolutions=(0.1, source.one_of([1.5, 4])), orders=(1, 2, 3, 4),
                  weights=(1, 3, 3, 1))
    table = scene.tables["validity"] = {"tolerance_m": source.logarithmic(0.01, 100)}
    scene.validity_frame = scene.frame(table)
    table["count"] = source.integer(1, 2)
    scene.axes = np.ones(3)
    if source.chance(0.3):
        scene.axes = np.array([source.uniform(0.2, 1) for _ in range(3)])
        scene.axes[source.integer(0, 2)] = 1.0
        table["semi_axes"] = list(scene.axes)
    if source.chance(0.5):
        table["samples"] = source.integer(10, 60)
    return scene


class Polynomials:
    """jet.csv of a run, up to a degree."""

    def __init__(self, path, scene):
        self.scene = scene
        names = ["x", "y", "z", "px", "py", "pz"]
        terms = {}
        with open(path) as file:
            for row in csv.DictReader(file):
                exponent = tuple(int(row[f"e_{n}"]) for n in names)
                terms.setdefault(exponent, np.zeros(6))[names.index(row["component"])] = float(
                    row["coefficient"])
        self.exponents = np.array([e for e in terms if sum(e)])
        self.coefficients = np.array([terms[tuple(e)] for e in self.exponents])
        velocity = scene.length / scene.time_unit
        self.units = np.array([scene.length] * 3 + [velocity] * 3)

    def positions(self, deviations, degree):
        """The positions for deviations [n, 6] in SI units, relative to the chief."""
        chosen = self.exponents.sum(axis=1) <= degree
        exponents, coefficients = self.exponents[chosen], self.coefficients[chosen]
        d = np.array(deviations / self.units, dtype=REAL)
        powers = [np.ones((len(d), 6), dtype=REAL)]
        for _ in range(degree):
            powers.append(powers[-1] * d)
        powers = np.array(powers)  # [power, deputy, variable]
        monomials = np.ones((len(d), len(exponents)), dtype=REAL)
        for v in range(6):
            monomials *= powers[exponents[:, v], :, v].T
        return monomials @ coefficients[:, :3].astype(REAL) * self.scene.length


def judge(judgement, scene, folder):
    run = Run(folder, ["validity", "scene.toml", "-o", "out"], limit=120)
    try:
        summary = run.summary("out")["validity"]
    except Refused as refused:
        judge_refusal(judgement, scene, refused)
        return
    if run.code == 1:
        judgement.mark("exit code 1: " + run.said.strip()[:200])
    rows = [r for r in run.table("out", "validity.csv")
            if abs(float(r["time_s"]) / float(scene.duration) - 1) < 1e-9]
    if not judgement.require("a row of each order at the end",
                             len(rows) == scene.tables["jet"]["order"]):
        return
    predict = predictor(judgement, scene, folder, summary["coordinates"],
                        summary["end_coordinates"])
    if predict is None:
        return
    floor = 20 * summary["flight_floor_m"]
    tolerance = scene.tables["validity"]["tolerance_m"]
    # A reach is an answer that grows with the order, most often; what is told is judged of each.
    for row in rows:
        order, reach = int(row["order"]), float(row["proved_m"])
        if reach == 0:
            judgement.mark(f"order {order} reaches nowhere")
            continue
        worst, deviation = search(scene, predict, order, reach)
        if worst is None:
            judgement.mark(f"order {order}: beyond what eval gives numbers of")
            continue
        judgement.note("validity: worst miss over tolerance", worst / tolerance)
        judgement.at_most(
            f"order {order}, reach {reach:.6g} m: miss of a deputy at (" + ", ".join(
                f"{float(x):.9g}" for x in deviation) + ") (m)", worst, tolerance * 1.02 + floor)


def predictor(judgement, scene, folder, coordinates, end_coordinates):
    if coordinates == end_coordinates == "cartesian":
        run = Run(folder, ["run", "scene.toml", "-o", "jets", "-q"])
        try:
            run.summary("jets")
        except Refused as refused:
            judge_refusal(judgement, scene, refused)
            return None
        label = next(d for d in os.listdir(os.path.join(folder, "jets"))
                     if os.path.isdir(os.path.join(folder, "jets", d)))
        jet = Polynomials(os.path.join(folder, "jets", label, "jet.csv"), scene)
        return lambda deviations, degree: jet.positions(deviations, degree)

    def evaluate(deviations, degree):
        with open(os.path.join(folder, "d.csv"), "w") as file:
            file.write("x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s\n")
            for d in deviations:
                file.write(",".join(repr(float(x)) for x in d) + "\n")
        done = Run(folder, ["eval", "scene.toml", "--deviations", "d.csv", "--frame", "inertial",
                            "--degree", str(degree), "-q", "-o", "e.csv", "--set",
                            f'jet.coordinates="{coordinates}"', "--threads", "1"])
        if done.code:
            raise RuntimeError(done.said)
        return np.array([[float(r[c]) if r[c] and r["support"] != "outside" else np.nan
                          for c in ("x_m", "y_m", "z_m")] for r in done.table("", "e.csv")])

    return evaluate


def deviations_of(scene, reach, unit):
    """Deviations [n, 6] of pairs of unit vectors: on the ellipsoid, and on that of velocities."""
    scaled = np.concatenate([unit[:, :3] * scene.axes, unit[:, 3:] * scene.axes * float(scene.rate)
                             ], axis=1) * reach
    return orbit.from_frame(scene.chief, scaled, *scene.validity_frame)


def search(scene, predict, order, reach):
    random = np.random.default_rng([int(reach * 1e6) % 2 ** 31, order])
    end = scene.chief_at(scene.duration)

    def misses(unit):
        deviations = deviations_of(scene, reach, unit)
        predicted = predict(deviations, order)
        flown = scene.field.to(scene.chief + deviations, scene.duration) - end
        return np.array(orbit.norm(predicted - flown[:, :3]), dtype=float)

    def normalised(unit):
        for first in (0, 3):
            part = unit[:, first:first + 3]
            part /= np.linalg.norm(part, axis=1)[:, None]
        return unit

    count = RANDOM_OF_EARTH if scene.is_earth else RANDOM
    units = normalised(random.normal(size=(count, 6)))
    # Inside the ellipsoid too.
    shrunk = units * np.repeat(random.uniform(0, 1, size=(count, 2)) ** 0.2, 3, axis=1)
    units = np.concatenate([units, shrunk[:count // 5]])
    found = misses(units)
    if np.all(np.isnan(found)):
        return None, None
    found = np.where(np.isnan(found), 0, found)
    best = units[np.argsort(found)[-SEARCHES:]].copy()
    values = np.sort(found)[-SEARCHES:]
    width = 0.4
    for _ in range((STEPS // 2 if scene.is_earth else STEPS) // 10):
        tries = np.repeat(best, 10, axis=0)
        tries = normalised(tries + width * random.normal(size=tries.shape))
        made = np.nan_to_num(misses(tries)).reshape(SEARCHES, 10)
        for k in range(SEARCHES):
            j = int(np.argmax(made[k]))
            if made[k, j] > values[k]:
                best[k], values[k] = tries[10 * k + j], made[k, j]
        width *= 0.7
    k = int(np.argmax(values))
    return values[k], deviations_of(scene, reach, best[k:k + 1])[0]
