"""Relative states, transfers and validity: equal to what the command writes."""

import csv
import io

import numpy as np
import pytest

import hamjet
from conftest import ORBIT, OSCILLATOR, SOURCE, command, message, message_of_module, scene
from test_results import without_times

TRANSFER = scene(
    ORBIT, jet={"order": 3, "duration_orbits": 0.9},
    transfer={"frame": "RTN", "derivatives": "rotating", "count": 6, "refine": True,
              "start": {"position_m": [0, -1000, 500]}, "end": {"position_m": [0, -100, 0]}})

TRANSFER_SCENE = SOURCE / "data" / "scenes" / "transfer-earth-orbit.toml"
FEW_TIMES = ["transfer.count=6", "jet.order=3", "jet.duration_orbits=0.9"]


def columns(text):
    rows = list(csv.DictReader(io.StringIO(text)))
    return {name: [row[name] for row in rows] for name in rows[0]}


def numbers(fields):
    return np.array([float(field) if field else np.nan for field in fields])


@pytest.mark.parametrize("frame, derivatives, degree", [
    ("RTN", None, None), ("RTN", "inertial", None), ("inertial", None, 2)])
def test_relative_states_are_those_of_eval(tmp_path, frame, derivatives, degree):
    result = hamjet.run(ORBIT)
    jet = result.runs["gauss8"].jet
    result.write(tmp_path / "out")
    # The last is so far off that the degrees do not decay there.
    states = np.random.default_rng(4).uniform(-1, 1, (50, 6)) * ([5e3] * 3 + [5] * 3)
    states[-1] *= 10000
    names = {"RTN": "R_m,T_m,N_m,vR_m_s,vT_m_s,vN_m_s",
             "inertial": "x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s"}[frame]
    (tmp_path / "in.csv").write_text(
        names + "\n" + "".join(",".join(map(repr, map(float, row))) + "\n" for row in states))
    options = [*(["--derivatives", derivatives] if derivatives else []),
               *(["--degree", degree] if degree else [])]
    printed = command("eval", tmp_path / "out", "--deviations", tmp_path / "in.csv", "--frame",
                      frame, "-q", *options, directory=tmp_path)
    expected = columns(printed.stdout)
    with pytest.warns(RuntimeWarning, match="1 of 50 rows not inside"):
        found = jet.evaluate_relative(states, frame=frame, derivatives=derivatives, degree=degree)
    with pytest.raises(hamjet.NumericalError, match="1 of 50 rows not inside"):
        jet.evaluate_relative(states, degree=degree, strict=True)
    for i, name in enumerate(names.split(",")):
        assert (found.states[:-1, i] == numbers(expected[name])[:-1]).all(), name
        # Of the row that is outside its size alone is printed, one digit.
        assert np.isclose(found.states[-1, i], numbers(expected[name])[-1], rtol=0.5, atol=0), name
    assert list(found.support) == expected["support"]
    assert "outside" in found.support and "inside" in found.support
    miss = numbers(expected["miss_estimate_m"])
    # Three digits are printed.
    assert np.allclose(found.miss_m, miss, rtol=1e-2, atol=0, equal_nan=True)
    with pytest.raises(ValueError):
        found.states[0] = 0


@pytest.mark.parametrize("frame, to", [("curvilinear", "RTN"), ("RTN", "relative-elements"),
                                       ("element-differences", None)])
def test_other_forms_of_relative_states_are_those_of_eval(tmp_path, frame, to):
    result = hamjet.run(ORBIT)
    jet = result.runs["gauss8"].jet
    result.write(tmp_path / "out")
    scale = {"element-differences": [100, 1e-3, 1e-3, 1e-5, 1e-5, 1e-3]}.get(
        frame, [100] * 3 + [0.1] * 3)
    states = np.random.default_rng(5).uniform(-1, 1, (6, 6)) * scale
    found = jet.evaluate_relative(states, frame=frame, to=to)
    for row, state in zip(found.states, states):
        printed = command("eval", tmp_path / "out", "--deviation",
                          ",".join(map(repr, map(float, state))), "--frame", frame,
                          *(["--to", to] if to else []), "-q", directory=tmp_path)
        expected = columns(printed.stdout)
        assert found.columns == tuple(expected)[:6]
        assert [float(expected[name][0]) for name in found.columns] == list(row)


def test_frames_that_do_not_fit_are_refused(jet):
    oscillator = hamjet.run(OSCILLATOR).runs["gauss8"].jet
    momenta = hamjet.run(ORBIT, overrides={"jet.variables": ["px", "py", "pz"]}).runs["gauss8"].jet
    state = np.ones(6)
    for call, text in (
        (lambda: jet.evaluate_relative(state, frame="LVLH"), "^frame='LVLH': has two meanings"),
        (lambda: jet.evaluate_relative(state, frame="xyz"), "^frame='xyz': no such frame; "),
        (lambda: jet.evaluate_relative(state, to="RTM"), "^to='RTM': no such frame; did you mean"),
        (lambda: jet.evaluate_relative(state, to="canonical"),
         "^to='canonical': got frame='RTN', must both be canonical or neither"),
        (lambda: jet.evaluate_relative(state, derivatives="x"),
         "^derivatives='x': must be rotating or inertial"),
        (lambda: jet.evaluate_relative(state, frame="canonical"),
         "^frame='canonical': evaluate.. takes"),
        (lambda: jet.evaluate_relative(state, frame="inertial", derivatives="rotating"),
         "^derivatives: goes with RTN alone, as frame or to, got frame='inertial'"),
        (lambda: oscillator.evaluate_relative(state),
         "^frame='RTN': the model harmonic-oscillator is no orbit; evaluate.. takes"),
        (lambda: momenta.evaluate_relative(np.vstack([state * [0, 0, 0, 1, 1, 1], state]),
                                           derivatives="inertial"), "row 1: the deviation leaves"),
    ):
        with pytest.raises(hamjet.UsageError, match=text):
            call()


def table_of_command(directory, study, scene, overrides, table):
    """The columns of a table that the command writes into the folder `out` of a directory."""
    options = [word for text in overrides for word in ("--set", text)]
    printed = command(study, scene, "-o", directory / "out", "-q", *options, directory=directory)
    assert printed.returncode == 0, printed.stderr
    return columns((directory / "out" / table).read_text(encoding="utf-8"))


def test_transfers_are_those_of_the_command(tmp_path):
    expected = table_of_command(tmp_path, "transfer", TRANSFER_SCENE, FEW_TIMES, "transfers.csv")
    transfers = hamjet.transfer(TRANSFER_SCENE, overrides=FEW_TIMES)
    assert transfers.times_s.shape == (6,)
    assert list(transfers.kinds) == expected["kind"]
    for name, column in (("times_s", "time_s"), ("conditions", "condition"),
                         ("position_conditions", "position_condition"),
                         ("singular_distances_s", "singular_distance_s"),
                         ("total_change_m_s", "total_change_m_s"),
                         ("hamilton_jacobi_residuals", "hamilton_jacobi_residual")):
        assert (getattr(transfers, name) == numbers(expected[column])).all(), name
    for end, array in (("start", transfers.start_change_m_s), ("end", transfers.end_change_m_s)):
        for i, axis in enumerate("rtn"):
            assert (array[:, i] == numbers(expected[f"{end}_change_{axis}_m_s"])).all()
    assert transfers.miss_by_order_m.shape == (6, 3)
    assert transfers.start_change_by_order_m_s.shape == (6, 3, 3)
    for order in (1, 2, 3):
        assert (transfers.miss_by_order_m[:, order - 1]
                == numbers(expected[f"miss_m_order_{order}"])).all()
    assert [str(flag).lower() for flag in transfers.near_singular] == expected["near_singular"]
    assert (transfers.refined == (np.array(expected["answer"]) == "refined")).all()
    best = transfers.best
    assert transfers.total_change_m_s[best] == transfers.total_change_m_s[
        ~transfers.near_singular & ~transfers.beyond_tolerance].min()
    loaded = hamjet.load(tmp_path / "out")
    assert without_times(loaded.summary) == without_times(transfers.summary)
    assert (loaded.tables["transfers"]["time_s"] == transfers.times_s).all()
    near = loaded.tables["transfers"]["near_singular"]
    assert near.dtype == np.bool_ and (near == transfers.near_singular).all()
    singular = loaded.tables["singular_times"]
    assert (transfers.singular_times_s == singular["time_s"][singular["kind"] == "qqq-qqq"]).all()


def test_the_flown_deputy_starts_and_ends_where_it_shall(tmp_path):
    transfers = hamjet.transfer(TRANSFER)
    times, states = transfers.trajectory(transfers.best, 50)
    assert times.shape == (51,) and states.shape == (51, 6)
    assert times[0] == 0 and abs(times[-1] / transfers.times_s[transfers.best] - 1) < 1e-14
    assert np.abs(states[0, :3] - [0, -1000, 500]).max() < 1e-5
    end = np.linalg.norm(states[-1, :3] - [0, -100, 0])
    assert abs(end - transfers.miss_m[transfers.best]) < 1e-5
    # At rest before the first impulse: the velocity is the change.
    assert np.abs(states[0, 3:] - transfers.start_change_m_s[transfers.best]).max() < 1e-6
    transfers.write(tmp_path / "out")
    assert (tmp_path / "out" / "report.html").is_file()
    with pytest.raises(ValueError):
        transfers.miss_m[0] = 0


def test_times_without_an_answer_have_no_trajectory():
    # F1 does not exist where no time has passed to speak of.
    transfers = hamjet.transfer(TRANSFER, overrides={
        "transfer.count": None, "transfer.times_s": [1e-30, 1800], "transfer.kind": "F1"})
    assert np.isnan(transfers.miss_m[0]) and transfers.failures[0]
    with pytest.raises(hamjet.UsageError, match="^trajectory: this transfer time has no answer$"):
        transfers.trajectory(0)


@pytest.mark.parametrize("study, table", [
    ("transfer", {}), ("validity", {"validity": {"tolerance_m": 1, "count": 2}})])
def test_flows_in_arcs_are_refused_as_by_the_command(tmp_path, study, table):
    printed = command(study, TRANSFER_SCENE, "--set", "jet.arcs=2", directory=tmp_path)
    with pytest.raises(hamjet.SceneError) as raised:
        getattr(hamjet, study)(TRANSFER_SCENE, overrides={"jet.arcs": 2, **table})
    assert str(raised.value) == message_of_module(printed)


def test_scenes_without_the_table_are_refused_as_by_the_command(tmp_path):
    for study in ("transfer", "validity"):
        printed = command(study, SOURCE / "data" / "scenes" / "molniya.toml", directory=tmp_path)
        with pytest.raises(hamjet.SceneError) as raised:
            getattr(hamjet, study)(SOURCE / "data" / "scenes" / "molniya.toml")
        assert str(raised.value) == message(printed)
    with pytest.raises(hamjet.SceneError, match="^scene: transfer: missing, must be a table"):
        hamjet.transfer(ORBIT)


def test_validity_is_that_of_the_command(tmp_path):
    change = ["jet.order=2", "validity={tolerance_m=1, count=2, samples=10}"]
    scene_file = SOURCE / "data" / "scenes" / "sun-synchronous-formation.toml"
    expected = table_of_command(tmp_path, "validity", scene_file, change, "validity.csv")
    validity = hamjet.validity(scene_file, overrides=change)
    for name in ("predicted_m", "proved_m", "miss_m"):
        assert getattr(validity, name).shape == (2, 2)
        assert (getattr(validity, name).ravel() == numbers(expected[name])).all(), name
    assert (validity.time_s == numbers(expected["time_s"])[::2]).all()
    assert without_times(hamjet.load(tmp_path / "out").summary) == without_times(validity.summary)
