"""The page's fit of a density factor to the precise orbit of GRACE A, line by line. The orbits, of the
University of Bern, and the field are not part of the project: without them there is nothing to fit."""

import re
import shutil

import numpy as np
import pytest

from conftest import SOURCE

SHARED = SOURCE / ".." / "shared"
FILES = {"grace.csv": SHARED / "references/orbits/grace_2010-07-27_earth_fixed.csv",
         "finals2000A.all": SHARED / "references/orbits/finals2000A_extract.txt",
         "EGM2008.gfc": SHARED / "gravity/EGM2008_120.gfc",
         "grace.toml": SOURCE / "data/scenes/earth/grace.toml"}


def fitted(lines, craft, hours=25):
    """What the lines find for GRACE A or B from so many of the hours."""
    found = {}
    lines = lines.replace('"A_"', f'"{craft}_"')
    # Fitted to the first hours, flown over all.
    lines = lines.replace("flown[:, :, 1]", f"flown[:{hours}, :, 1]")
    lines = lines.replace("(seen - flown[:, :, 0])", f"(seen - flown[:, :, 0])[:{hours}]")
    exec(lines, found)  # noqa: S102
    return found["change"], found["flown"], found["seen"]


def test_one_factor_of_the_density_brings_a_day_of_grace_down_to_metres(tmp_path, monkeypatch):
    for name, file in FILES.items():
        if not file.exists():
            pytest.skip(f"{file.name} is not there")
        shutil.copy(file, tmp_path / name)
    page = (SOURCE / "data/scenes/earth/README.md").read_text()
    lines = re.search(r"```python\n(import csv.*?)```", page, re.DOTALL).group(1)
    # A call of three lines counts as one.
    assert len(lines.replace(",\n", ", ").splitlines()) <= 10
    monkeypatch.chdir(tmp_path)
    change, flown, seen = fitted(lines, "A")
    # Fitted before to the same day's end alone, by flights of another program: 0.224.
    assert abs(1 + change - 0.224) < 0.01
    errors_m = 1000 * np.linalg.norm(flown @ [1, change] - seen, axis=1)
    without_air_m = 1000 * np.linalg.norm(flown @ [1, -1] - seen, axis=1)
    assert len(errors_m) == 25 and 400 < without_air_m[-1] < 460
    assert errors_m.max() < without_air_m[-1] / 10
    # Of least squares: what is left is across the derivative.
    slope = np.sum(flown[:, :, 1] * (flown @ [1, change] - seen))
    assert abs(slope) < 1e-9 * np.sum(flown[:, :, 1] ** 2)

    own, flown_b, seen_b = fitted(lines, "B")
    ranges = np.linalg.norm(seen_b - seen, axis=1)

    def range_errors_m(of_a, of_b):
        distance = flown_b @ [1, of_b] - flown @ [1, of_a]
        return 1000 * (np.linalg.norm(distance, axis=1) - ranges)

    # One factor for both leaves the range, which a metre would tell apart, with 4 of its 5.4 m.
    assert abs(range_errors_m(-1, -1)[-1] - 5.4) < 0.1
    assert abs(range_errors_m(change, change)[-1] - 4.2) < 0.1
    assert np.abs(range_errors_m(change, own)).max() < 1
    half = [fitted(lines, craft, 13)[0] for craft in "AB"]
    assert np.abs(range_errors_m(*half)).max() < 1
