"""hamjet run: the nominal and the polynomials of each degree, against flights along lines. A flight
from x0 + h u is, at the end, a function of h whose Taylor coefficients are those of the map along
u; they are found by Chebyshev's polynomials in h."""
import csv
import os

import numpy as np

import orbit
from command import Run
from flight import REAL, FlightFailed
from refusal import judge_surface, results

POINTS = 25
LINES = 2
# An estimate counts as right if the error is up to this many times as large.
MOST_OVER_ESTIMATE = 10
# Roundings of the start, in those of doubles between 1/2 and 1: of the numbers and the units; of a
# change of axes by a matrix, one of each product, sum and sine; and of the angle by which the Earth
# has turned, four of numbers up to 2 pi.
ROUNDING = 2.0 ** -53
OF_NUMBERS, OF_AXES, OF_ANGLE = 4, 16, 16


STATES = ["x", "y", "z", "px", "py", "pz"]


def draw(source):
    # A flight of the judge's through a fine field takes a second for each revolution.
    fine = source.chance(0.25)
    most = source.one_of([0.2, 0.5]) if fine else source.one_of([1, 3, 10])
    scene = source.scene(fine_field=fine, revolutions=(0.05, most), orders=(1, 2, 3, 4),
                         weights=(1, 2, 2, 3), coordinates=False)
    scene.parameters = {}
    if scene.is_earth:
        scene.parameters = {name: value for name, value in scene.coefficients().items()
                            if source.chance(0.5)}
    if scene.parameters:
        scene.tables["jet"]["variables"] = STATES + list(scene.parameters)
    return scene


class Jet:
    """jet.csv in units in which the chief's distance and the speed of a circle there are 1."""

    def __init__(self, path, scene):
        # Parameters are in units of their own.
        names = STATES + list(scene.parameters)
        distance = orbit.norm(scene.chief[:3])
        self.units = np.array([distance] * 3 + [np.sqrt(scene.mu / distance)] * 3)
        speed = scene.length / scene.time_unit
        told = np.append(np.array([scene.length] * 3 + [speed] * 3) / self.units,
                         [1] * len(scene.parameters))
        terms = {}
        with open(path) as file:
            for row in csv.DictReader(file):
                exponent = tuple(int(row[f"e_{n}"]) for n in names)
                c = names.index(row["component"])
                if c >= 6:
                    continue
                size = told[c] / np.prod(told ** np.array(exponent))
                terms.setdefault(exponent, np.zeros(6, dtype=REAL))[c] = REAL(
                    row["coefficient"]) * size
        self.exponents = np.array(list(terms))
        self.coefficients = np.array(list(terms.values()))
        self.degrees = self.exponents.sum(axis=1)

    def along(self, u, degree):
        """The form of a degree at u, and the sum of what its monomials are there."""
        chosen = self.degrees == degree
        monomials = np.prod(u[None] ** self.exponents[chosen], axis=1)
        return monomials @ self.coefficients[chosen], np.sum(np.abs(monomials))

    def largest(self, degree):
        return np.max(np.abs(self.coefficients[self.degrees == degree]))


def judge(judgement, scene, folder):
    run = Run(folder, ["run", "scene.toml", "-o", "out"], limit=90)
    summary = results(judgement, scene, run)
    if summary is None:
        return
    one = summary["runs"][0]
    jet = Jet(os.path.join(folder, "out", one["label"], "jet.csv"), scene)
    told = np.array(summary["nominal_initial"], dtype=REAL)[:6]
    speed = scene.length / scene.time_unit
    told *= np.array([scene.length] * 3 + [speed] * 3) / jet.units
    start = scene.chief / jet.units
    shift = ROUNDING * (OF_NUMBERS + OF_AXES * (scene.axes_name != "GCRF")
                        + OF_ANGLE * (scene.axes_name == "ITRF"))
    judgement.within("start (m and more)", told, start, shift * np.linalg.norm(
        np.asarray(start, dtype=float)))
    estimates = {row["degree"]: row["relative"] for row in one["error_estimate_by_degree"] or []}
    if not judgement.require("no estimate of each degree",
                             len(estimates) == scene.tables["jet"]["order"] + 1):
        return
    random = np.random.default_rng(len(jet.exponents))
    for _ in range(LINES):
        u = random.normal(size=6 + len(scene.parameters))
        u = np.asarray(u / np.linalg.norm(u), dtype=REAL)
        u[6:] *= np.array(list(scene.parameters.values()), dtype=REAL)
        judge_line(judgement, scene, jet, u, estimates, shift)
    judge_surface(judgement, scene, run, summary)


def judge_line(judgement, scene, jet, u, estimates, shift):
    order = max(estimates)
    true, uncertainty = taylor_coefficients(scene, jet.units, u, order)
    largest = [jet.largest(d) for d in range(order + 1)]
    # The largest coefficient of the next degree, which a shift of the start brings in.
    largest.append(largest[-1] ** 2 / largest[-2])
    for d in range(order + 1):
        form, monomials = jet.along(u, d)
        from_estimate = MOST_OVER_ESTIMATE * estimates[d] * largest[d] * monomials
        from_start = (d + 1) * largest[d + 1] * shift * monomials * 6
        allowed = float(from_estimate + from_start + uncertainty[d])
        judgement.within(f"degree {d} of the map, along a line", form, true[d], allowed)
        judgement.note(f"jet: degree {d}, error over allowance",
                       float(orbit.norm(form - true[d])) / allowed)
        judgement.note(f"jet: degree {d}, uncertainty of the judge over allowance",
                       float(uncertainty[d]) / allowed)


def taylor_coefficients(scene, units, u, order):
    """[degree, 6] of the end along u, and how uncertain they are."""
    flow = np.array(scene.field.transition(scene.chief, scene.duration))
    stretch = np.linalg.norm(np.asarray(flow * units[None] / units[:, None], dtype=float), 2)
    width = REAL(0.3 / max(1.0, stretch))
    while True:
        series = chebyshev_series(scene, units, u, width)
        if series is None:  # a start too far from the chief
            width /= REAL(4)
            continue
        sizes = orbit.norm(series)
        noise = np.max(sizes[-4:])
        # The series goes down to what the flights' own rounding leaves.
        if noise > 0.2 * np.max(sizes[-8:-4]) or noise < REAL(2) ** -60 * sizes[0]:
            break
        width /= REAL(1.5)
    true, uncertainty = from_chebyshev(series, width, order)
    if scene.is_earth and scene.field.air:
        # Flights to one side may enter a piece of the density that the chief does not see, so that
        # the series is another one for widths that are much narrower.
        narrower = width / REAL(3)
        other, _ = from_chebyshev(chebyshev_series(scene, units, u, narrower), narrower, order)
        uncertainty += orbit.norm(true - other)
    return true, uncertainty


def chebyshev_series(scene, units, u, width):
    """[k, 6] of the end as a function of h / width; None where a flight fails."""
    angles = np.pi * (np.arange(POINTS, dtype=REAL) + REAL(0.5)) / POINTS
    nodes = np.cos(angles)
    starts = scene.chief + np.outer(width * nodes, u[:6] * units)
    try:
        if scene.parameters:
            ends = np.array([scene.with_change(dict(zip(scene.parameters, x * u[6:]))).to(
                start, scene.duration) for x, start in zip(width * nodes, starts)]) / units
        else:
            ends = scene.field.to(starts, scene.duration) / units
    except FlightFailed:
        return None
    series = 2 * np.cos(np.outer(np.arange(POINTS), angles)) @ ends / POINTS
    series[0] /= 2
    return series


def from_chebyshev(series, width, order):
    """[degree, 6] of Taylor's series in h, and how uncertain they are."""
    sizes = orbit.norm(series)
    noise = np.max(sizes[-4:])
    kept = max(order, int(np.max(np.nonzero(sizes > 4 * noise)[0], initial=order)))
    polynomials = np.array([np.pad(np.polynomial.chebyshev.cheb2poly([0] * k + [1]),
                                   (0, kept - k)) for k in range(kept + 1)], dtype=REAL)
    # Where another number of steps is taken flights jump by what a step leaves out, whose series
    # falls as 1/k down to what is left at the end of it.
    below = 4 * noise * POINTS / np.maximum(np.arange(kept + 1), 1)
    true, uncertainty = [], []
    for d in range(order + 1):
        scale = width ** d
        true.append(polynomials[:, d] @ series[:kept + 1] / scale)
        uncertainty.append(np.sum(np.abs(polynomials[:, d]) * below) / scale)
    return np.array(true), np.array(uncertainty)
