"""The zonal field written as one's own equations beside the built-in one: jets and their times."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from typing import Any

import numpy as np

import hamjet

REPEATS = 41
STEP = 0.75  # of Gauss with 8 stages; fixed, so that all do the same steps
MU, RADIUS, J2, J3 = 398600.4405, 6378.137, 1.082626675e-3, 2.532436e-6
INTEGRATOR = [{"label": "gauss8", "method": "gauss", "stages": 8, "step_canonical": STEP}]


def builtin(order: int) -> dict[str, Any]:
    """The paper's orbit of the Earth."""
    return {
        "schema": 1, "title": "Earth orbit of the paper",
        "system": {"model": "zonal-gravity", "mu_km3_s2": MU, "radius_km": RADIUS, "J2": J2,
                   "J3": J3},
        "nominal": {"a_km": 10000, "e": 0.3, "i_deg": 60, "raan_deg": 0, "argp_deg": 0,
                    "ta_deg": 0},
        "jet": {"order": order, "duration_canonical": 31.41592653589793},
        "integrator": INTEGRATOR,
    }


def hamiltonian(q: Any, p: Any, mu: Any, R: Any, J2: Any, J3: Any) -> Any:
    r = np.sqrt(q @ q)
    s = q[2] / r
    return (p @ p / 2 - mu / r * (1 - J2 * (R / r) ** 2 * (3 * s**2 - 1) / 2
                                  - J3 * (R / r) ** 3 * (5 * s**3 - 3 * s) / 2))


TEXT = {
    "hamiltonian": "(px^2 + py^2 + pz^2)/2 - mu/r*(1 - J2*(R/r)^2*(3*s^2 - 1)/2"
                   " - J3*(R/r)^3*(5*s^3 - 3*s)/2)",
    "definitions": {"r": "sqrt(x^2 + y^2 + z^2)", "s": "z/r"},
}
COORDINATES = ["x", "y", "z"]


def parameters(radius: float) -> dict[str, float]:
    return {"mu": 1.0, "R": radius, "J2": J2, "J3": J3}


def from_text(radius: float) -> hamjet.System:
    return hamjet.system(TEXT["hamiltonian"], COORDINATES, parameters=parameters(radius),
                         definitions=TEXT["definitions"])


def from_function(radius: float) -> hamjet.System:
    return hamjet.system(hamiltonian, COORDINATES, parameters=parameters(radius))


def seconds_of(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def worst_difference(jet: Any, other: Any) -> float:
    """The largest difference of a coefficient, relative to the largest of its degree."""
    degrees = np.asarray(jet.exponents).sum(axis=1)
    return max(float(np.abs(jet.coefficients[:, degrees == d] - other.coefficients[:, degrees == d]).max()
                     / np.abs(jet.coefficients[:, degrees == d]).max())
               for d in range(1, int(degrees.max()) + 1))


def compare(order: int) -> None:
    given = builtin(order)
    first = hamjet.run(given).runs["gauss8"]
    start = first.jet.nominal_initial  # in canonical units, in which mu is 1
    radius = RADIUS / first.jet.units.length_km
    scenes = {"built-in": given}
    for name, made in (("text", from_text(radius)), ("Python function", from_function(radius))):
        scene = made.scene(start, 31.41592653589793, order=order)
        scenes[name] = {**scene, "integrator": INTEGRATOR}
    runs = {name: hamjet.run(scene).runs["gauss8"] for name, scene in scenes.items()}
    times: dict[str, list[float]] = {name: [] for name in scenes}
    for _ in range(REPEATS):  # interleaved: a noisy machine hurts all alike
        for name, scene in scenes.items():
            times[name].append(hamjet.run(scene).runs["gauss8"].summary["wall_seconds"])
    for name, run in runs.items():
        ratio = statistics.median(b / a for a, b in zip(times["built-in"], times[name]))
        work = run.summary["operations"]
        print(f"{order:5}  {name:16} {work['nonlinear_operations_per_evaluation']:10} "
              f"{work['multiply_adds'] / 1e6:10.3f} {min(times[name]) * 1e3:9.3f} ms {ratio:7.3f} "
              f"{worst_difference(first.jet, run.jet):11.1e}")


def main() -> None:
    print("the paper's orbit of the Earth, J2 and J3, six variables, 42 steps of Gauss 8; least "
          "time, median\nof the ratios of interleaved runs, largest difference of a coefficient "
          "from the built-in jet's")
    print("order  equations        operations multiply-adds     time   ratio  difference")
    for order in (1, 4, 6):
        compare(order)
    radius = RADIUS / 7000
    for name, make in (("parsing the text", from_text), ("tracing the function", from_function)):
        samples = [seconds_of(lambda: make(radius)) for _ in range(201)]
        print(f"{name}: {statistics.median(samples) * 1e3:.3f} ms (least {min(samples) * 1e3:.3f})")


if __name__ == "__main__":
    main()
