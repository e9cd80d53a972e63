"""Scenes as file, text and dict: the same results, and the texts of the command for mistakes."""

import copy
import pathlib

import numpy as np
import pytest

import hamjet
from conftest import ORBIT, OSCILLATOR, SOURCE, command, message, message_of_module, scene

TEXT = """
schema = 1
title = "Oscillator of the tests"
[system]
model = "harmonic-oscillator"
mass_kg = 1
stiffness_N_per_m = 4
[nominal]
position_m = [1]
momentum_kg_m_s = [0.5]
[jet]
order = 2
duration_canonical = 1.25
[[integrator]]
label = "gauss8"
method = "gauss"
stages = 8
tolerance = 1e-14
"""


def coefficients(*arguments, **keywords):
    return hamjet.run(*arguments, **keywords).runs["gauss8"].jet.coefficients


def test_file_text_and_dict_are_the_same_scene(tmp_path):
    file = tmp_path / "oscillator.toml"
    file.write_text(TEXT, encoding="utf-8")
    expected = coefficients(OSCILLATOR)
    for given in (file, str(file), TEXT):
        assert (coefficients(given) == expected).all()
    arrays = scene(OSCILLATOR, nominal={"position_m": np.array([1.0]),
                                        "momentum_kg_m_s": (np.float64(0.5),)},
                   jet={"order": np.int64(2), "duration_canonical": 1.25})
    assert (coefficients(arrays) == expected).all()


def test_a_scene_is_not_changed():
    given = copy.deepcopy(ORBIT)
    hamjet.run(given, overrides={"jet.order": 1, "nominal.e": 0.1})
    assert given == ORBIT


def test_overrides_are_those_of_the_command():
    expected = coefficients(scene(OSCILLATOR, jet={"order": 3, "duration_canonical": 0.5}))
    for overrides in ({"jet.order": 3, "jet.duration_canonical": 0.5},
                      ["jet.order=3", "jet.duration_canonical=0.5"],
                      {"jet": {"order": 3, "duration_canonical": 0.5}},
                      {"jet": {"order": 2, "duration_canonical": 0.5}, "jet.order": np.int64(3)}):
        assert (coefficients(OSCILLATOR, overrides=overrides) == expected).all()
        assert (coefficients(TEXT, overrides=overrides) == expected).all()
    tables = scene(ORBIT, reference={})
    assert hamjet.run(tables, overrides={"reference": None, "jet.order": 1}).summary["reference"] \
        is None
    # A string stays one, though it could be read as a number.
    with pytest.raises(hamjet.SceneError, match='^overrides: jet.order: wrong type, got the str'):
        hamjet.run(OSCILLATOR, overrides={"jet.order": "3"})
    with pytest.raises(hamjet.UsageError, match="^overrides: jet: replaces what override jet.ord"):
        hamjet.run(OSCILLATOR, overrides={"jet.order": 3, "jet": {"order": 2}})
    with pytest.raises(hamjet.UsageError, match="^overrides: a: wrong type, got set"):
        hamjet.run(OSCILLATOR, overrides={"a": {1}})
    for text in ("jet.order", "=3"):
        with pytest.raises(hamjet.UsageError, match="must be key=value"):
            hamjet.run(OSCILLATOR, overrides=[text])


@pytest.mark.parametrize("change, error", [
    ({"jet.order": 99}, hamjet.TooLargeError),
    ({"jet.ordr": 4}, hamjet.SceneError),
    ({"nominal.e": 1.5}, hamjet.SceneError),
    ({"system.model": "kepplr"}, hamjet.SceneError),
    ({"integrator.gauss9.stages": 4}, hamjet.UsageError),
    ({"jet.duration_canonical": float("inf")}, hamjet.SceneError),
])
def test_mistakes_have_the_class_and_text_of_the_command(tmp_path, change, error):
    file = SOURCE / "data" / "scenes" / "molniya.toml"
    ((key, value),) = change.items()
    printed = command("run", file, "--set", f"{key}={value}", directory=tmp_path)
    with pytest.raises(error) as raised:
        hamjet.run(file, overrides=[f"{key}={value}"])
    assert str(raised.value) == message_of_module(printed)
    assert raised.value.exit_code == printed.returncode
    assert isinstance(raised.value, hamjet.Error)


def test_mistakes_in_a_file_or_text_are_located(tmp_path):
    text = TEXT.replace("stages = 8", "stages = 80")
    file = tmp_path / "scene.toml"
    file.write_text(text, encoding="utf-8")
    printed = command("run", file, directory=tmp_path)
    with pytest.raises(hamjet.SceneError) as raised:
        hamjet.run(file)
    assert str(raised.value) == message(printed)
    with pytest.raises(hamjet.SceneError, match=r"^scene:17:10: integrator.0.stages: out of range"):
        hamjet.run(text)


@pytest.mark.parametrize("change, text", [
    ({"jet": {"order": 99, "duration_canonical": 1}}, r"^scene: jet.order: "),
    ({"jet": {"order": 2.0, "duration_canonical": 1}},
     r"^scene: jet.order: wrong type, got 2.0, must be"),
    ({"jet": {"order": 1}}, r"^scene: jet: missing, got none of a choice"),
    ({"jett": {}}, r"^scene: jett: unknown key, got jett, did you mean jet\?"),
    ({"jet": {"order": None}}, r"^scene: jet.order: wrong type, got NoneType, must be a bool"),
    ({"jet": {"order": 2**70}}, r"^scene: jet.order: out of range, got 1180591620717411303424, an"),
    ({"jet": {"order": float("nan"), "duration_canonical": 1}}, r"^scene: jet.order: wrong type"),
    ({"jet": {"order": 2, "duration_canonical": float("nan")}},
     r"^scene: jet.duration_canonical: not finite, got nan"),
    ({"title": "\ud800"}, r"^scene: title: not a text, got a string with a lone surrogate"),
    ({"integrator": [{"label": "a", "method": "gauss", "stages": 8, "tolerance": "x"}]},
     r'^scene: integrator.0.tolerance: wrong type, got the string "x"'),
    ({3: 4}, r"^scene: wrong key, got 3, must be a string"),
])
def test_mistakes_in_a_dict_name_the_key(change, text):
    with pytest.raises((hamjet.SceneError, hamjet.TooLargeError), match=text):
        hamjet.run({**scene(OSCILLATOR), **change})


def test_a_table_within_itself_is_refused():
    endless = scene(OSCILLATOR)
    endless["jet"]["jet"] = endless["jet"]
    with pytest.raises(hamjet.SceneError, match="nested too deep"):
        hamjet.run(endless)


def test_a_file_that_cannot_be_read_is_an_oserror(tmp_path):
    missing = tmp_path / "missing.toml"
    printed = command("run", missing, directory=tmp_path)
    with pytest.raises(OSError) as raised:
        hamjet.run(missing)
    assert isinstance(raised.value, hamjet.InputOutputError)
    assert str(raised.value) == message(printed)
    with pytest.raises(hamjet.UsageError, match="wrong type, got int"):
        hamjet.run(3)
    with pytest.raises(hamjet.UsageError, match="empty, must name a file"):
        hamjet.run("")
    with pytest.raises(hamjet.InputOutputError):
        hamjet.run(pathlib.Path("."))


def test_numerical_failures_are_in_the_result():
    # Beyond Verlet's limit of stability: step times frequency is 6.
    result = hamjet.run(scene(OSCILLATOR, integrator=[
        {"label": "verlet", "method": "velocity-verlet", "order": 2, "step_canonical": 3.0},
        {"label": "gauss8", "method": "gauss", "stages": 8, "tolerance": 1e-14}],
        jet={"order": 1, "duration_canonical": 30}))
    assert result.exit_code == 4
    assert result.runs["gauss8"].error is None
    failed = result.runs["verlet"]
    assert failed.error == result.summary["runs"][0]["error"]
    with pytest.raises(hamjet.NumericalError) as raised:
        failed.jet
    assert str(raised.value) == failed.error


def test_a_failed_check_is_in_the_result():
    result = hamjet.run(OSCILLATOR, overrides={"integrator.gauss8.require_symplecticity": 1e-30})
    assert result.exit_code == 1
    (check,) = result.runs["gauss8"].failed_checks
    assert check.startswith("require_symplecticity: ")
    assert result.runs["gauss8"].jet.order == 2
