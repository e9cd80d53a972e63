"""Wrong arguments: one line that says what would be right, whatever the compiled part says."""

import re
import warnings

import numpy as np
import pytest

import hamjet
from conftest import ORBIT, OSCILLATOR, scene

TRANSFER = scene(
    ORBIT, jet={"order": 2, "duration_orbits": 0.9},
    transfer={"frame": "RTN", "derivatives": "rotating", "count": 6, "refine": False,
              "start": {"position_m": [0, -1000, 500]}, "end": {"position_m": [0, -100, 0]}})


@pytest.fixture(scope="module")
def transfers():
    return hamjet.transfer(TRANSFER)


@pytest.mark.parametrize("arguments, text", [
    ((None,), "trajectory: index: wrong type, got NoneType, must be an integer from 0 to 5"),
    ((1.0,), "trajectory: index: wrong type, got float, must be an integer from 0 to 5"),
    ((-1,), "trajectory: index: out of range, got -1, must be an integer from 0 to 5"),
    ((6,), "trajectory: index: out of range, got 6, must be an integer from 0 to 5"),
    ((10**30,), f"trajectory: index: out of range, got {10**30}, must be an integer from 0 to 5"),
    ((0, 0), "trajectory: count: out of range, got 0, must be an integer from 1 to 1000000"),
    ((0, 10**10), "trajectory: count: out of range, got 10000000000, must be an integer from 1 to "
                  "1000000"),
    ((0, "5"), "trajectory: count: wrong type, got str, must be an integer from 1 to 1000000"),
])
def test_trajectories_that_do_not_exist_are_refused(transfers, arguments, text):
    with pytest.raises(hamjet.UsageError) as raised:
        transfers.trajectory(*arguments)
    assert str(raised.value) == text


def test_integers_of_numpy_are_integers(transfers):
    times, _ = transfers.trajectory(np.int64(transfers.best), np.uint8(3))
    assert times.shape == (4,)


NO_PROGRESS = "progress: wrong type, got int, must be a function of (task, fraction), or None"
SURROGATE = "not a text, got a string with a lone surrogate, must be Unicode"


@pytest.mark.parametrize("overrides, text", [
    ({"title": "a\udcff"}, f"overrides: title: {SURROGATE}"),
    ({"jet": {"b\ud800": 1}}, f"overrides: jet: {SURROGATE}"),
    ({"jet": {"order": ["c\ud800"]}}, f"overrides: jet.order.0: {SURROGATE}"),
    ({"d\ud800": 1}, f"overrides: d\\ud800: {SURROGATE}"),
    (["title='e\ud800'"], f"overrides: title='e\\ud800': {SURROGATE}"),
    ({"jet.variables": ["x", None]},
     "overrides: jet.variables.1: wrong type, got NoneType, must be a bool, int, float, str, list, "
     "dict or NumPy array; None, which removes a key, must be its whole value"),
    ({"jet": {"order": {2}}},
     "overrides: jet.order: wrong type, got set, must be a bool, int, float, str, list, dict or "
     "NumPy array; None, which removes a key, must be its whole value"),
])
def test_overrides_that_are_no_toml_are_refused(overrides, text):
    for given in (OSCILLATOR, "scene.toml", "schema = 1\n"):
        with pytest.raises(hamjet.UsageError) as raised:
            hamjet.run(given, overrides=overrides)
        assert str(raised.value) == text


@pytest.mark.parametrize("call, text", [
    (lambda: hamjet.run("title = '\ud800'\n"), f"scene: {SURROGATE}"),
    (lambda: hamjet.run("a\ud800"), "scene: not a path, got a string with a lone surrogate"),
    (lambda: hamjet.run("a\0b"), "scene: not a path, got a NUL character in it"),
    (lambda: hamjet.load("a\0b"), "directory: not a path, got a NUL character in it"),
    (lambda: hamjet.load(None), "directory: wrong type, got NoneType, must be a path"),
    (lambda: hamjet.run(OSCILLATOR, overrides=3),
     "overrides: wrong type, got int, must be a dict or strings key=value"),
    (lambda: hamjet.run(OSCILLATOR, progress=3), NO_PROGRESS),
    (lambda: hamjet.transfer(TRANSFER, progress=3), NO_PROGRESS),
    (lambda: hamjet.run(OSCILLATOR).write(3), "directory: wrong type, got int, must be a path"),
])
def test_what_is_no_path_or_text_is_refused(call, text):
    with pytest.raises(hamjet.UsageError) as raised:
        call()
    assert str(raised.value) == text


def masked(points, *places):
    result = np.ma.array(points)
    for place in places:
        result[place] = np.ma.masked
    return result


def test_masked_points_are_refused(jet):
    points = np.full((3, 6), 1e-3)
    function = jet.invert_partially("F1")
    row = masked(points[0], 2)
    for call, what in (
        (lambda: jet.evaluate(masked(points, (1, 2))), "deviations"),
        (lambda: jet(row), "deviations"),
        (lambda: jet([points[0], row]), "deviations"),
        (lambda: jet([[0.0] * 5 + [np.ma.masked]]), "deviations"),
        (lambda: jet.evaluate_relative(masked(points, (0, 0))), "states"),
        (lambda: function.gradient(masked(np.zeros((2, 6)), 1)), "w"),
    ):
        with warnings.catch_warnings(), pytest.raises(hamjet.UsageError) as raised:
            warnings.simplefilter("ignore")  # NumPy's, that a masked number becomes NaN
            call()
        assert str(raised.value) == f"{what}: has masked elements, must be numbers throughout"
    with pytest.raises(hamjet.UsageError, match="^out: must be a writable float64 array"):
        jet.evaluate(points, out=masked(points, 0))
    # A mask that covers nothing hides nothing.
    expected = jet.evaluate(points)
    for nothing in (np.ma.array(points), masked(points, slice(0, 0)), list(np.ma.array(points))):
        assert (jet.evaluate(nothing) == expected).all()


def test_help_shows_no_types_of_cpp():
    module = hamjet._hamjet
    members = [(name, value) for name, value in vars(module).items()]
    members += [(f"{name}.{part}", entry) for name, value in members if isinstance(value, type)
                for part, entry in vars(value).items()]
    assert len(members) > 50
    for name, member in members:
        assert not re.search(r"\w::\w", getattr(member, "__doc__", None) or ""), name
