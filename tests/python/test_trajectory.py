"""Jets at any time of one run, against runs of their own to that time."""

import numpy as np
import pytest

import hamjet
from conftest import ORBIT, scene


@pytest.fixture(scope="module")
def followed():
    return hamjet.trajectory(ORBIT)



def test_jets_are_those_of_runs_to_their_times(followed):
    whole = hamjet.run(ORBIT).runs["gauss8"].jet
    assert np.array_equal(followed.at(followed.duration_s).coefficients, whole.coefficients)
    assert followed.duration_s == whole.duration_s and followed.run == "gauss8"
    assert followed.step_times_s[0] == 0 and followed.step_times_s[-1] == followed.duration_s
    assert np.array_equal(followed.at(0).linear_part, np.eye(6))
    for time in np.random.default_rng(3).uniform(0, followed.duration_s, 6):
        jet = followed.at(time)
        alone = hamjet.run(scene(ORBIT, jet={"order": 3, "duration_s": float(time)}))
        expected = alone.runs["gauss8"].jet
        assert abs(jet.duration_s / time - 1) < 1e-15
        size = np.abs(whole.coefficients).max()
        # Ten times the tolerance, for less than a revolution.
        assert np.abs(jet.coefficients - expected.coefficients).max() < 10 * 1e-13 * size
        assert np.allclose(jet.nominal_final, expected.nominal_final, rtol=0, atol=1e-12)


def test_the_last_time_is_that_of_the_scene_to_its_rounding():
    rounded = 0
    for height in range(400, 430):
        of_scene = {"system": {"model": "kepler", "mu_km3_s2": 398600.4415},
                    "nominal": {"a_km": 6378.137 + height, "e": 0.001, "i_deg": 50, "raan_deg": 1,
                                "argp_deg": 0, "ta_deg": 2},
                    "jet": {"order": 1, "duration_s": 600.0}}
        last = hamjet.trajectory(of_scene)
        rounded += last.duration_s != 600.0
        assert np.array_equal(last.at(600.0).coefficients, last.at(last.duration_s).coefficients)
        with pytest.raises(hamjet.UsageError, match="out of range"):
            last.at(600.000001)
    assert rounded > 0


def test_of_several_times_there_is_a_jet_each(followed):
    times = np.linspace(0, followed.duration_s, 4)
    for given in (times, list(times), tuple(times)):
        jets = followed.at(given)
        assert [jet.duration_s for jet in jets] == [followed.at(t).duration_s for t in times]
    assert followed.at([]) == []
    with pytest.raises(hamjet.UsageError, match="^time_s: out of range, got -1"):
        followed.at([0, -1])
    with pytest.raises(hamjet.UsageError, match="^time_s: "):
        followed.at([[0.0]])


def test_a_deputy_along_the_time_is_that_of_each_jet(followed):
    times = np.linspace(0, followed.duration_s, 5)
    state = np.array([100.0, -500, 50, 0, 0.1, 0])
    found = followed.evaluate_relative(state, times)
    assert found.states.shape == (5, 6) and found.columns[0] == "R_m"
    assert np.allclose(found.states[0], state, rtol=0, atol=1e-9)
    for row, time in zip(found.states, times):
        assert np.array_equal(row, followed.at(time).evaluate_relative(state).states[0])


def test_what_does_not_fit_is_refused(followed):
    for call, text in (
        (lambda: followed.at(-1), "^time_s: out of range, got -1, must be a number from 0 to "),
        (lambda: followed.at("x"), "^time_s: wrong type, got str, must be a number$"),
        (lambda: followed.at(float("nan")), "^time_s: not finite"),
        (lambda: followed.evaluate_relative(np.ones((2, 6)), [0]), "^state: wrong shape"),
        (lambda: followed.evaluate_relative(np.ones(6), 0.0), "^times_s: wrong shape"),
        (lambda: hamjet.trajectory(ORBIT, run="x"), "no run has the label \"x\""),
    ):
        with pytest.raises(hamjet.UsageError, match=text):
            call()
    verlet = scene(ORBIT, integrator=[
        {"label": "verlet", "method": "velocity-verlet", "step_canonical": 0.1}])
    with pytest.raises(hamjet.SceneError, match="must have one of the method gauss"):
        hamjet.trajectory(verlet)
    with pytest.raises(hamjet.SceneError, match="verlet has no jets between its steps"):
        hamjet.trajectory(verlet, run="verlet")
    with pytest.raises(hamjet.SceneError, match="jet.arcs: a trajectory takes jets"):
        hamjet.trajectory(ORBIT, overrides={"jet.arcs": 2})


def test_extended_precision_and_backwards():
    backwards = hamjet.trajectory(scene(ORBIT, precision="extended",
                                        jet={"order": 1, "duration_canonical": -1.0}))
    half = backwards.at(backwards.duration_s / 2)
    assert half.precision == "extended" and half.duration_s < 0
    with pytest.raises(hamjet.UsageError, match="must be a number from 0 to -"):
        backwards.at(1.0)
