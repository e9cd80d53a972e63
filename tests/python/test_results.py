"""Results: equal to the command's files, written and loaded, and nobody can change them."""

import copy
import dataclasses

import numpy as np
import pytest

import hamjet
from conftest import OSCILLATOR, SOURCE, command, message

SCENE = SOURCE / "data" / "scenes" / "paper" / "earth-orbit.toml"
SHORT = ["jet.order=2", "jet.duration_canonical=3", "reference=null",
         "integrator=[{label=\"gauss8\", method=\"gauss\", stages=8, tolerance=1e-13}, "
         "{label=\"fehlberg78\", method=\"fehlberg78\", tolerance=1e-12}]"]


def without_times(value):
    """A summary without what differs from run to run."""
    if isinstance(value, dict):
        return {key: without_times(entry) for key, entry in value.items()
                if "seconds" not in key and key not in ("files", "crc32")}
    if isinstance(value, list):
        return [without_times(entry) for entry in value]
    return value


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    """A directory of the command's results."""
    directory = tmp_path_factory.mktemp("command")
    options = [word for text in SHORT for word in ("--set", text)]
    result = command("run", SCENE, "-o", directory / "out", "-q", *options, directory=directory)
    assert result.returncode == 0, result.stderr
    return directory / "out"


@pytest.fixture(scope="module")
def computed():
    return hamjet.run(SCENE, overrides=SHORT)


def assert_same_run(a, b, energy_digits):
    assert (a.label, a.error, a.failed_checks) == (b.label, b.error, b.failed_checks)
    for name in ("coefficients", "exponents", "nominal_initial", "nominal_final"):
        assert (getattr(a.jet, name) == getattr(b.jet, name)).all(), name
    for name in ("order", "variables", "components", "duration_canonical", "model", "precision",
                 "scene", "run"):
        assert getattr(a.jet, name) == getattr(b.jet, name), name
    assert a.jet.units.time_s == b.jet.units.time_s
    for name in ("times_canonical", "times_s", "states"):
        assert (getattr(a.nominal, name) == getattr(b.nominal, name)).all(), name
    assert np.allclose(a.nominal.energy_error, b.nominal.energy_error, rtol=energy_digits, atol=0)


def test_the_error_estimate_is_that_of_the_summary(computed):
    for run in computed.runs.values():
        rows = run.summary["error_estimate_by_degree"]
        assert [row["degree"] for row in rows] == [0, 1, 2]
        assert run.error_estimate_by_degree.tolist() == [row["relative"] for row in rows]
        # Gauss at 1e-13 and Fehlberg at 1e-12 over half a revolution: not worse than a local
        # tolerance a step, and never without rounding.
        assert (run.error_estimate_by_degree < 1e-9).all()
        assert (run.error_estimate_by_degree > 0).all()
        with pytest.raises(ValueError, match="read-only"):
            run.error_estimate_by_degree[0] = 0
    off = hamjet.run(SCENE, overrides=SHORT + ["checks.error-estimate=false"])
    assert off.runs["gauss8"].error_estimate_by_degree is None


def test_results_are_bit_by_bit_those_of_the_command(computed, stored):
    loaded = hamjet.load(stored)
    assert list(loaded.runs) == list(computed.runs) == ["gauss8", "fehlberg78"]
    assert loaded.exit_code == computed.exit_code == 0
    for label in computed.runs:
        assert_same_run(computed.runs[label], loaded.runs[label], 1e-5)
    assert without_times(loaded.summary) == without_times(computed.summary)
    assert "files" in loaded.summary


def test_what_is_watched_along_time_is_that_of_the_command(computed, stored):
    for label, run in hamjet.load(stored).runs.items():
        a, b = computed.runs[label].along_time, run.along_time
        assert (a.times_canonical == b.times_canonical).all()
        assert (a.times_s == b.times_s).all()
        for name in ("exactness", "energy_error"):
            assert np.allclose(getattr(a, name), getattr(b, name), rtol=1e-5, atol=0,
                               equal_nan=True), name
        assert (a.singular_times_canonical == b.singular_times_canonical).all()
        # The printed file leaves out what is infinite or 0.
        shown = np.isfinite(a.condition) & (a.condition > 0)
        assert np.allclose(a.condition[shown], b.condition[shown], rtol=1e-5, atol=0)
        assert np.isnan(b.condition[~shown]).all()


def test_singular_times_are_those_of_the_oscillator(tmp_path):
    # F1 of the oscillator with frequency 2 does not exist at multiples of pi / 2.
    result = hamjet.run(OSCILLATOR, overrides={
        "jet.duration_canonical": 4.0, "figure": {"quantity": "exactness", "kind": "F1"},
        "integrator.gauss8": {"label": "gauss8", "method": "gauss", "stages": 8,
                              "step_canonical": 0.01}})
    result.write(tmp_path / "out")
    for run in (result.runs["gauss8"], hamjet.load(tmp_path / "out").runs["gauss8"]):
        times = run.along_time.singular_times_canonical
        assert np.allclose(times, [np.pi / 2, np.pi], rtol=0, atol=1e-4)
        assert np.nanmax(run.along_time.exactness) < 1e-12


def test_what_is_written_is_what_the_command_writes(computed, stored, tmp_path):
    computed.write(tmp_path / "out")
    names = sorted(path.relative_to(stored) for path in stored.rglob("*") if path.is_file())
    assert names == sorted(path.relative_to(tmp_path / "out")
                           for path in (tmp_path / "out").rglob("*") if path.is_file())
    for name in names:
        if name.suffix == ".csv":
            assert (tmp_path / "out" / name).read_bytes() == (stored / name).read_bytes(), name
    printed = command("eval", tmp_path / "out", "--deviation", "1,2,3,0,0,0", "-q",
                      directory=tmp_path)
    assert printed.returncode == 0
    with pytest.raises(hamjet.UsageError, match="write: these results were read from files"):
        hamjet.load(stored).write(tmp_path / "again")


def test_one_run_can_be_loaded(stored):
    assert list(hamjet.load(stored, run="fehlberg78").runs) == ["fehlberg78"]
    with pytest.raises(hamjet.UsageError, match="no run has the label fehlberg"):
        hamjet.load(stored, run="fehlberg")


@pytest.mark.parametrize("name", ["summary.json", "gauss8/jet.csv", "gauss8/nominal.csv"])
def test_damaged_files_are_refused(computed, tmp_path, name):
    directory = tmp_path / "out"
    computed.write(directory)
    file = directory / name
    content = file.read_bytes()
    file.write_bytes(content.replace(b"7", b"8", 1))
    with pytest.raises(hamjet.InputOutputError) as raised:
        hamjet.load(directory)
    assert name.split("/")[-1] in str(raised.value)
    if name != "gauss8/nominal.csv":  # eval does not read that one
        printed = command("eval", directory, "--deviation", "1,2,3,0,0,0", directory=tmp_path)
        assert str(raised.value) == message(printed) and printed.returncode == 5
    file.unlink()
    with pytest.raises(OSError):
        hamjet.load(directory)


def test_results_cannot_be_changed(computed):
    run = computed.runs["gauss8"]
    with pytest.raises(TypeError):
        computed.runs["gauss8"] = run
    for target, name in ((computed, "exit_code"), (run, "label"), (run.nominal, "states")):
        with pytest.raises(dataclasses.FrozenInstanceError):
            setattr(target, name, None)
    for array in (run.nominal.times_s, run.nominal.times_canonical, run.nominal.states,
                  run.along_time.exactness, run.along_time.times_s):
        with pytest.raises(ValueError):
            array[0] = 0
    before = copy.deepcopy(computed.summary)
    computed.summary["runs"].clear()
    assert computed.summary == before


def test_studies_without_a_jet_have_tables(tmp_path):
    scene = SOURCE / "data" / "scenes" / "paper" / "double-well.toml"
    change = ["canonical_transformation.duration_canonical=5"]
    result = hamjet.run(scene, overrides=change)
    assert isinstance(result, hamjet.StudyResult)
    printed = command("run", scene, "-o", tmp_path / "out", "-q", "--set", *change,
                      directory=tmp_path)
    assert result.exit_code == printed.returncode == 0
    loaded = hamjet.load(tmp_path / "out")
    assert without_times(loaded.summary) == without_times(result.summary)
    assert sorted(result.tables) == sorted(loaded.tables) and result.tables
    for name, table in result.tables.items():
        assert list(table) == list(loaded.tables[name])
        for column, values in table.items():
            assert np.array_equal(values, loaded.tables[name][column],
                                  equal_nan=values.dtype.kind == "f"), (name, column)
    result.write(tmp_path / "written")
    assert without_times(hamjet.load(tmp_path / "written").summary) == without_times(result.summary)
