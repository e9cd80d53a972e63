"""What the tests share: the command beside the module, and small scenes."""

from __future__ import annotations

import copy
import os
import pathlib
import subprocess

import pytest

import hamjet

SOURCE = pathlib.Path(os.environ["HAMJET_SOURCE_DIR"])
COMMAND = os.environ["HAMJET_COMMAND"]

ORBIT = {
    "schema": 1,
    "title": "Orbit of the tests",
    "system": {"model": "zonal-gravity", "mu_km3_s2": 398600.4405, "radius_km": 6378.137,
               "J2": 1.082626675e-3, "J3": 2.532436e-6},
    "nominal": {"a_km": 10000, "e": 0.3, "i_deg": 60, "raan_deg": 0, "argp_deg": 0, "ta_deg": 0},
    "jet": {"order": 3, "duration_canonical": 5.0},
    "integrator": [{"label": "gauss8", "method": "gauss", "stages": 8, "tolerance": 1e-13}],
}

OSCILLATOR = {
    "schema": 1,
    "title": "Oscillator of the tests",
    "system": {"model": "harmonic-oscillator", "mass_kg": 1, "stiffness_N_per_m": 4},
    "nominal": {"position_m": [1], "momentum_kg_m_s": [0.5]},
    "jet": {"order": 2, "duration_canonical": 1.25},
    "integrator": [{"label": "gauss8", "method": "gauss", "stages": 8, "tolerance": 1e-14}],
}


def command(*arguments: object, directory: os.PathLike[str]) -> subprocess.CompletedProcess[str]:
    return subprocess.run([COMMAND, *map(str, arguments)], cwd=directory, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False, timeout=120)


def message(result: subprocess.CompletedProcess[str]) -> str:
    """The one line that the command says on standard error."""
    assert result.stderr.startswith("hamjet: ") and result.stderr.endswith("\n"), result.stderr
    return result.stderr[len("hamjet: "):-1]


def message_of_module(result: subprocess.CompletedProcess[str]) -> str:
    """The same with changes of the scene named as the argument of Python."""
    first, *rest = message(result).split("--set ")
    return first + ("override " if first else "overrides: ") + "override ".join(rest) if rest \
        else first


def scene(base: dict, **tables: object) -> dict:
    """A copy of a scene with other tables."""
    return {**copy.deepcopy(base), **tables}


@pytest.fixture(scope="session")
def jet() -> hamjet.Jet:
    return hamjet.run(ORBIT).runs["gauss8"].jet
