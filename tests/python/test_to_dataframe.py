"""Results as data frames: the columns of the files that the command writes."""

import pickle

import numpy as np
import pytest

import hamjet
from conftest import ORBIT, SOURCE, command, scene
from test_load import SWEEP
from test_relative_motion import TRANSFER, columns, numbers

VALIDITY = scene(ORBIT, jet={"order": 2, "duration_orbits": 0.5},
                 validity={"frame": "RTN", "derivatives": "rotating", "count": 3,
                           "tolerance_m": 1.0})


@pytest.fixture(scope="module", name="transfers")
def some_transfers():
    return hamjet.transfer(TRANSFER)


@pytest.fixture(scope="module", name="validity")
def some_validity():
    return hamjet.validity(VALIDITY)


def expect_columns(frame, text):
    expected = columns(text)
    assert list(frame.columns) == list(expected)
    for name, fields in expected.items():
        column = frame[name].to_numpy()
        if column.dtype == bool:
            assert column.tolist() == [field == "true" for field in fields], name
        elif column.dtype.kind == "f":
            assert np.array_equal(column, numbers(fields), equal_nan=True), name
        elif column.dtype.kind == "i":
            assert column.tolist() == [int(field) for field in fields], name
        else:
            assert [text or "" for text in column] == fields, name


def test_frames_are_the_files_of_relative_motion(tmp_path, transfers, validity):
    pytest.importorskip("pandas")
    for result, name in ((transfers, "transfers"), (validity, "validity")):
        result.write(tmp_path / name)
        expect_columns(result.to_dataframe(),
                       (tmp_path / name / f"{name}.csv").read_text(encoding="utf-8"))
    frame = transfers.to_dataframe()
    assert (frame["time_s"] == transfers.time_s).all() and frame.index[transfers.best] >= 0
    assert list(validity.to_dataframe()["order"]) == [1, 2] * 3


def test_a_sweep_is_its_table(tmp_path):
    pytest.importorskip("pandas")
    (tmp_path / "sweep.toml").write_text(SWEEP, encoding="utf-8")
    printed = command("sweep", "sweep.toml", "-o", "out", "-q", directory=tmp_path)
    assert printed.returncode == 0, printed.stderr
    loaded = hamjet.load(tmp_path / "out")
    expect_columns(loaded.to_dataframe(),
                   (tmp_path / "out" / "table.csv").read_text(encoding="utf-8"))


def test_of_several_tables_one_is_named():
    pytest.importorskip("pandas")
    study = hamjet.run(SOURCE / "data" / "scenes" / "paper" / "double-well.toml",
                       overrides=["canonical_transformation.duration_canonical=5"])
    names = sorted(study.tables)
    assert len(names) > 1
    assert list(study.to_dataframe(names[0]).columns) == list(study.tables[names[0]])
    for wrong, got in ((None, "None"), ("tabel", "'tabel'")):
        with pytest.raises(hamjet.UsageError) as raised:
            study.to_dataframe(wrong)
        assert str(raised.value) == f"table: got {got}, must be one of: {', '.join(names)}"


@pytest.mark.parametrize("frame", ["RTN", "inertial"])
def test_relative_states_are_the_file_of_eval(tmp_path, jet, frame):
    pandas = pytest.importorskip("pandas")
    hamjet.run(ORBIT).write(tmp_path / "out")
    given = ["10,20,30,0.01,0.02,0.03", "-500,0,5,0,0,0.1"]
    states = np.array([[float(field) for field in line.split(",")] for line in given])
    printed = command("eval", tmp_path / "out", "--frame", frame, "--deviation", given[1], "-q",
                      directory=tmp_path)
    expected = columns(printed.stdout)
    found = jet.evaluate_relative(states, frame=frame)
    table = found.to_dataframe()
    assert list(table.columns) == list(expected) and len(table) == 2
    assert (table[list(found.columns)].to_numpy() == found.states).all()
    for name in found.columns:
        assert table[name][1] == numbers(expected[name])[0], name
    assert list(table["support"]) == list(found.support)
    assert (table["miss_estimate_m"] == found.miss_m).all()
    # The data frame is what evaluate_relative takes.
    again = jet.evaluate_relative(pandas.DataFrame(states, columns=found.columns)[
        list(reversed(found.columns))], frame=frame)
    assert (again.states == found.states).all()


def test_relative_states_are_still_a_tuple_and_come_back_from_a_pickle(jet):
    found = jet.evaluate_relative([[1.0] * 6])
    states, miss_m, support = found
    assert states is found.states and miss_m is found.miss_m and support is found.support
    again = pickle.loads(pickle.dumps(found))
    assert again.columns == found.columns == ("R_m", "T_m", "N_m", "vR_m_s", "vT_m_s", "vN_m_s")
    assert (again.states == found.states).all()


def test_relative_motion_comes_back_from_a_pickle_but_for_its_study(tmp_path, transfers, validity):
    for result in (transfers, validity):
        again = pickle.loads(pickle.dumps(result))
        for name, value in vars(result).items():
            if isinstance(value, np.ndarray):
                assert np.array_equal(getattr(again, name), value, equal_nan=True), name
                assert not getattr(again, name).flags.writeable
        assert list(again.table) == list(result.table)
        with pytest.raises(TypeError):
            again.table["other"] = 0
        for call in (lambda: again.summary, lambda: again.write(tmp_path / "out")):
            with pytest.raises(hamjet.UsageError, match="these results were unpickled, which"):
                call()
    again = pickle.loads(pickle.dumps(transfers))
    assert again.best == transfers.best
    with pytest.raises(hamjet.UsageError, match="^trajectory: these results were unpickled"):
        again.trajectory(again.best)


@pytest.mark.parametrize("package, purpose, ask", [
    ("pandas", "to_dataframe", lambda transfers: transfers.to_dataframe()),
    ("matplotlib", "plot", lambda transfers: transfers.plot()),
])
def test_a_package_that_is_not_there_is_named(monkeypatch, transfers, package, purpose, ask):
    def missing(name):
        raise ModuleNotFoundError(f"No module named {name!r}", name=package)

    monkeypatch.setattr("importlib.import_module", missing)
    with pytest.raises(ImportError) as raised:
        ask(transfers)
    assert str(raised.value) == (f"{purpose} needs {package}, which is not installed: pip install "
                                 f"{package}, or on Debian apt install python3-{package}")
    assert raised.value.name == package


def test_a_package_that_is_broken_is_not_called_missing(monkeypatch, transfers):
    def broken(name):
        raise ModuleNotFoundError("No module named 'pytz'", name="pytz")

    monkeypatch.setattr("importlib.import_module", broken)
    with pytest.raises(ModuleNotFoundError, match="pytz"):
        transfers.to_dataframe()
