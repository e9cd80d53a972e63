"""Assignments: equal to what the command writes."""

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
    for name, column in (("deputies", "deputy"), ("slots", "slot"), ("times_s", "time_s"),
                         ("total_change_m_s", "total_change_m_s"), ("miss_m", "miss_m")):
        assert (getattr(assigned, name) == np.array(table[column], dtype=float)).all(), name
    costs = columns(tmp_path / "out" / "costs.csv")
    expected = [float(x) if x else np.nan for x in costs["total_change_m_s"]]
    assert np.array_equal(assigned.costs_m_s.ravel(), expected, equal_nan=True)
    pairs = columns(tmp_path / "out" / "pairs.csv")
    assert (assigned.pairs == np.array([pairs["deputy"], pairs["other_deputy"]], dtype=int).T).all()
    assert (assigned.pair_separation_m == np.array(pairs["least_separation_m"],
                                                   dtype=float)).all()
    assert (assigned.pair_times_s == np.array(pairs["time_s"], dtype=float)).all()
    assert without_times(hamjet.load(tmp_path / "out").summary) == without_times(assigned.summary)
    assigned.write(tmp_path / "written")
    assert (tmp_path / "written" / "pairs.csv").is_file()
    assert assigned.to_dataframe()["slot"].tolist() == assigned.slots.tolist()
    assert f"{assigned.total_change_m_s.sum():.6g} m/s in all" in repr(assigned)


def test_deputies_that_come_too_near_fail(assigned):
    nearest = assigned.pair_separation_m.min()
    failed = hamjet.assign(SCENE, overrides=[*FEW_TIMES,
                                             f"assignment.keep_apart_m={1.01 * nearest}"])
    assert failed.exit_code == 1


def test_scenes_without_the_table_are_refused():
    with pytest.raises(hamjet.SceneError, match="assignment: missing, must be a table"):
        hamjet.assign(SOURCE / "data" / "scenes" / "molniya.toml")
