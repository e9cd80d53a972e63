"""What load reads and refuses besides the runs of a scene: sweeps, files, runs that failed."""

import errno
import os
import pathlib
import pickle

import numpy as np
import pytest

import hamjet
from conftest import OSCILLATOR, SOURCE, command, message, scene

FAILING = scene(OSCILLATOR, jet={"order": 1, "duration_canonical": 30}, integrator=[
    # Beyond Verlet's limit of stability: step times frequency is 6.
    {"label": "verlet", "method": "velocity-verlet", "order": 2, "step_canonical": 3.0},
    {"label": "gauss8", "method": "gauss", "stages": 8, "tolerance": 1e-14}])

SWEEP = f"""
schema = 1
title = "Sweep of the tests"
[sweep]
scene = "{SOURCE}/data/scenes/sweeps/position-singularities-scene.toml"
command = "run"
[[axis]]
key = "jet.order"
values = [1, 2]
[[column]]
name = "order"
value = "/order"
"""

DOUBLE_WELL = SOURCE / "data" / "scenes" / "paper" / "double-well.toml"


def test_a_sweep_has_its_table(tmp_path):
    (tmp_path / "sweep.toml").write_text(SWEEP, encoding="utf-8")
    printed = command("sweep", "sweep.toml", "-o", "out", "-q", directory=tmp_path)
    assert printed.returncode == 0, printed.stderr
    loaded = hamjet.load(tmp_path / "out")
    assert isinstance(loaded, hamjet.StudyResult)
    assert loaded.summary["items"] == 2 and loaded.exit_code == 0
    assert list(loaded.tables["table"]["order"]) == [1, 2]
    with pytest.raises(hamjet.UsageError, match="^no run has the label 'gauss8'; these results"):
        hamjet.load(tmp_path / "out", run="gauss8")


def test_a_study_has_no_runs_to_choose_from(tmp_path):
    hamjet.run(DOUBLE_WELL, overrides=[
        "canonical_transformation.duration_canonical=5"]).write(tmp_path / "out")
    assert hamjet.load(tmp_path / "out").tables
    with pytest.raises(hamjet.UsageError) as raised:
        hamjet.load(tmp_path / "out", run="x\n")
    assert str(raised.value) == ("no run has the label 'x\\n'; these results are of a study "
                                 "without runs of a flow jet, leave run out")


def test_a_file_in_place_of_the_directory_is_refused(tmp_path):
    hamjet.run(OSCILLATOR).write(tmp_path / "out")
    file = tmp_path / "out" / "gauss8" / "jet.csv"
    with pytest.raises(hamjet.InputOutputError) as raised:
        hamjet.load(file)
    assert str(raised.value) == f"{file}: is a file, must be the directory of the results"


def test_a_run_that_failed_says_why(tmp_path):
    result = hamjet.run(FAILING)
    result.write(tmp_path / "out")
    loaded = hamjet.load(tmp_path / "out")
    assert loaded.runs["verlet"].error == result.runs["verlet"].error is not None
    assert list(hamjet.load(tmp_path / "out", run="gauss8").runs) == ["gauss8"]
    printed = command("eval", tmp_path / "out", "--run", "verlet", "--deviation", "1,2",
                      directory=tmp_path)
    with pytest.raises(hamjet.NumericalError) as raised:
        hamjet.load(tmp_path / "out", run="verlet")
    assert str(raised.value) == message(printed)
    assert result.runs["verlet"].error in str(raised.value)


def test_columns_of_truth_values_are_bool():
    table = hamjet.tables.read_table("a,b,c,d\ntrue,true,1,\nfalse,,2,\n")
    assert table["a"].dtype == np.bool_ and list(table["a"]) == [True, False]
    assert list(table["b"]) == ["true", ""]
    assert table["c"].dtype == np.float64
    assert np.isnan(table["d"]).all()
    assert hamjet.tables.read_table("a,b\n")["a"].dtype == np.float64
    with pytest.raises(ValueError):
        table["a"][0] = False


@pytest.mark.parametrize("call, missing", [
    (lambda folder: hamjet.run(folder / "none.toml"), "none.toml"),
    (lambda folder: hamjet.load(folder / "none"), "none/summary.json"),
    (lambda folder: hamjet.run(scene(OSCILLATOR, nominal={
        "oem_file": str(folder / "none.oem"), "epoch": "2026-03-01T00:00:00"},
        system={"model": "kepler", "mu_km3_s2": 398600.4415})), "none.oem"),
])
def test_what_is_not_there_is_a_file_not_found_error(tmp_path, call, missing):
    with pytest.raises(FileNotFoundError) as raised:
        call(tmp_path)
    error = raised.value
    assert isinstance(error, hamjet.InputOutputError) and error.exit_code == 5
    assert error.errno == errno.ENOENT and error.strerror == os.strerror(errno.ENOENT)
    assert pathlib.Path(error.filename) == tmp_path / missing
    assert str(tmp_path / missing) in str(error) and "No such file" in str(error)
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.errno, again.filename) == (str(error), error.errno, error.filename)


def test_other_files_that_cannot_be_read_are_no_missing_ones(tmp_path):
    with pytest.raises(hamjet.InputOutputError) as raised:
        hamjet.run(tmp_path)
    assert not isinstance(raised.value, FileNotFoundError)
