"""Assignments from Python are equal to those that the command writes."""

import csv
import io

import numpy as np
import pytest

import hamjet
from conftest import SOURCE, command
from test_results import without_times

SCENE = SOURCE / "data" / "scenes" / "assignment-tetrahedron.toml"
FEW_TIMES = ["transfer.count=5"]


def columns(path):
    rows = list(csv.DictReader(io.StringIO(path.read_text(encoding="utf-8"))))
    return {name: [row[name] for row in rows] for name in rows[0]}


@pytest.fixture(scope="module")
def assigned():
    return hamjet.assign(SCENE, overrides=FEW_TIMES)


def test_assignments_are_those_of_the_command(tmp_path, assigned):
    printed = command("assign", SCENE, "-o", "out", "-q", "--set", *FEW_TIMES, directory=tmp_path)
    assert printed.returncode == assigned.exit_code == 0, printed.stderr
    table = columns(tmp_path / "out" / "assignment.csv")
    for name in ("deputy", "slot", "time_s", "total_change_m_s", "miss_m"):
        assert (getattr(assigned, name) == np.array(table[name], dtype=float)).all(), name
    costs = columns(tmp_path / "out" / "costs.csv")
    expected = [float(x) if x else np.nan for x in costs["total_change_m_s"]]
    assert np.array_equal(assigned.costs.total_change_m_s.ravel(), expected, equal_nan=True)
    pairs = columns(tmp_path / "out" / "pairs.csv")
    for name, fields in pairs.items():
        assert (getattr(assigned.pairs, name) == np.array(fields, dtype=float)).all(), name
    assert without_times(hamjet.load(tmp_path / "out").summary) == without_times(assigned.summary)
    assigned.write(tmp_path / "written")
    assert (tmp_path / "written" / "pairs.csv").is_file()
    assert assigned.to_dataframe()["slot"].tolist() == assigned.slot.tolist()
    assert f"{assigned.total_change_m_s.sum():.6g} m/s in all" in repr(assigned)


def test_deputies_that_come_too_near_fail(assigned):
    nearest = assigned.pairs.least_separation_m.min()
    failed = hamjet.assign(SCENE, overrides=[*FEW_TIMES,
                                             f"assignment.keep_apart_m={1.01 * nearest}"])
    assert failed.exit_code == 1


def test_scenes_without_the_table_are_refused():
    with pytest.raises(hamjet.SceneError, match="assignment: missing, must be a table"):
        hamjet.assign(SOURCE / "data" / "scenes" / "molniya.toml")
