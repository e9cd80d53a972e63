"""Evaluation from Python beside the same from C++: a million deviations through a jet."""

from __future__ import annotations

import ctypes
import statistics
import sys
import time
from collections.abc import Callable

import numpy as np

import hamjet

POINTS = 1_000_000
REPEATS = 15
BLOCK = 4096  # of the C++ side


def scene(order: int) -> dict[str, object]:
    return {
        "schema": 1, "title": "Earth orbit of the paper",
        "system": {"model": "zonal-gravity", "mu_km3_s2": 398600.4405, "radius_km": 6378.137,
                   "J2": 1.082626675e-3, "J3": 2.532436e-6},
        "nominal": {"a_km": 10000, "e": 0.3, "i_deg": 60, "raan_deg": 0, "argp_deg": 0,
                    "ta_deg": 0},
        "jet": {"order": order, "duration_canonical": 5.0},
        "integrator": [{"label": "gauss8", "method": "gauss", "stages": 8, "tolerance": 1e-13}],
    }


def columns_first(rows: np.ndarray) -> np.ndarray:
    """The same points, each block a structure of arrays."""
    blocks = [rows[i:i + BLOCK].T.ravel() for i in range(0, len(rows), BLOCK)]
    return np.concatenate(blocks)


def seconds(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def compare(library: ctypes.CDLL, order: int) -> None:
    result = hamjet.run(scene(order))
    assert isinstance(result, hamjet.Result)
    jet = result.runs["gauss8"].jet
    points = np.random.default_rng(1).uniform(-1e-3, 1e-3, (POINTS, 6))
    blocks = columns_first(points)
    block_values = np.empty_like(blocks)
    out = np.empty_like(points)
    pointer = ctypes.POINTER(ctypes.c_double)
    library.hamjet_seconds_of_evaluation.restype = ctypes.c_double

    def from_cpp(values: np.ndarray | None) -> float:
        return float(library.hamjet_seconds_of_evaluation(
            jet.coefficients.ctypes.data_as(pointer), ctypes.c_size_t(6), ctypes.c_size_t(6), order,
            blocks.ctypes.data_as(pointer), None if values is None else
            values.ctypes.data_as(pointer), ctypes.c_size_t(POINTS)))

    works: dict[tuple[str, str], Callable[[], float]] = {
        ("given", "C++"): lambda: from_cpp(block_values),
        ("given", "Python"): lambda: seconds(lambda: jet.evaluate(points, out=out)),
        ("new", "C++"): lambda: from_cpp(None),
        ("new", "Python"): lambda: seconds(lambda: jet.evaluate(points)),
    }
    times: dict[tuple[str, str], list[float]] = {name: [] for name in works}
    for _ in range(REPEATS):  # interleaved: a noisy machine hurts all alike
        for name, work in works.items():
            times[name].append(work())
    assert (columns_first(out) == block_values).all()
    for memory in ("given", "new"):
        cpp, python = times[memory, "C++"], times[memory, "Python"]
        ratio = statistics.median(b / a for a, b in zip(cpp, python))
        nanoseconds = [statistics.median(samples) / POINTS * 1e9 for samples in (cpp, python)]
        print(f"{order:5} {memory:>8} {nanoseconds[0]:8.1f} ns {nanoseconds[1]:8.1f} ns "
              f"{ratio:8.3f}")


def main() -> None:
    library = ctypes.CDLL(sys.argv[1])
    print(f"{POINTS} deviations, 6 components in 6 variables, one thread; results into memory\n"
          f"that is given, or new; medians of {REPEATS} interleaved repeats, and of their ratios\n"
          f"{'order':>5} {'memory':>8} {'C++':>11} {'Python':>11} {'ratio':>8}")
    for order in (1, 2, 4, 6):
        compare(library, order)


if __name__ == "__main__":
    main()
