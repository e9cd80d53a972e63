"""Polynomials in other coordinates: the digits of the command, and deputies as they fly."""

import numpy as np
import pytest

import hamjet
from conftest import OSCILLATOR, command, message_of_module
from test_relative_motion import columns, numbers

SCENE = """schema = 1
title = "Far apart"
[system]
model = "zonal-gravity"
mu_km3_s2 = 398600.4405
radius_km = 6378.137
J2 = 1.082626675e-3
[nominal]
a_km = 7000
e = 0.001
i_deg = 60
raan_deg = 0
argp_deg = 0
ta_deg = 0
[jet]
order = 3
duration_orbits = 1.3
[deputy]
position_m = [-700, -60000, 300]
[validity]
count = 1
samples = 10
"""
COLUMNS = "R_m,T_m,N_m,vR_m_s,vT_m_s,vN_m_s"


@pytest.fixture(scope="module", name="boxes")
def polynomials_of_flow_boxes():
    return hamjet.polynomials(SCENE, coordinates="flow-box")


@pytest.mark.parametrize("options, arguments", [
    ([], {}),
    (["jet.coordinates=flow-box"], {"coordinates": "flow-box"}),
    (["jet.coordinates=nodal", "jet.end_coordinates=poincare"],
     {"coordinates": "nodal", "end_coordinates": "poincare"})])
def test_states_are_those_of_eval(tmp_path, options, arguments):
    states = np.random.default_rng(4).uniform(-1, 1, (30, 6)) * ([1e3, 5e3, 1e3] + [1] * 3)
    (tmp_path / "scene.toml").write_text(SCENE)
    (tmp_path / "in.csv").write_text(
        COLUMNS + "\n" + "".join(",".join(map(repr, map(float, row))) + "\n" for row in states))
    changes = [word for option in options for word in ("--set", option)]
    printed = command("eval", "scene.toml", "--deviations", "in.csv", "-q", *changes,
                      directory=tmp_path)
    expected = columns(printed.stdout)
    polynomials = hamjet.polynomials(SCENE, **arguments)
    found = polynomials.evaluate_relative(states)
    assert found.columns == tuple(COLUMNS.split(","))
    for i, name in enumerate(COLUMNS.split(",")):
        assert (found.states[:, i] == numbers(expected[name])).all(), name
    assert list(found.support) == expected["support"]
    # Three digits are printed.
    assert np.allclose(found.miss_m, numbers(expected["miss_estimate_m"]), rtol=1e-2, atol=0)
    one = polynomials.evaluate_relative(states[0])
    assert np.allclose(one.states[0], found.states[0], rtol=1e-9, atol=1e-6)


def test_what_they_are_is_said(boxes):
    assert (boxes.coordinates, boxes.end_coordinates) == ("flow-box", "flow-box")
    assert (boxes.order, boxes.variables) == (3, 4)
    assert boxes.duration_s == pytest.approx(1.3 * 2 * np.pi * np.sqrt(7000**3 / 398600.4405))
    assert "order 3 in 4 variables, flow-box coordinates" in repr(boxes)
    mixed = hamjet.polynomials(SCENE, coordinates="nodal", end_coordinates="cartesian")
    assert mixed.variables == 6 and "nodal to cartesian coordinates" in repr(mixed)


def test_a_far_deputy_is_where_it_flies(boxes):
    end = hamjet.motion(SCENE).position_m[-1]  # flown, whatever the polynomials
    found = boxes.evaluate_relative([-700, -60000, 300, 0, 0, 0])
    assert np.linalg.norm(found.states[0, :3] - end) < 0.01
    plain = hamjet.polynomials(SCENE).evaluate_relative([-700, -60000, 300, 0, 0, 0], degree=1)
    assert np.linalg.norm(plain.states[0, :3] - end) > 100


def test_reach_is_that_of_validity(boxes):
    found = boxes.reach(1.0, samples=10)
    study = hamjet.validity(SCENE, coordinates="flow-box")
    assert (found == study.proved_m[-1]).all()
    assert (found > 5 * hamjet.validity(SCENE).proved_m[-1]).all()
    assert (boxes.reach(10.0, samples=10) > found).all()


def test_studies_take_coordinates():
    plain, boxes = hamjet.motion(SCENE), hamjet.motion(SCENE, coordinates="flow-box")
    assert boxes.summary["coordinates"] == "flow-box"
    assert boxes.error_m_by_order.max() < 0.01 < 1 < plain.error_m_by_order.max()
    transfer = SCENE + """[transfer]
times_s = [2500]
end = { position_m = [0, -50000, 0] }
"""
    found = hamjet.transfer(transfer, coordinates="flow-box")
    assert found.summary["coordinates"] == "flow-box" and found.kind == (None,)
    assert found.miss_m[0] < 1e-3


def test_mistakes_are_those_of_the_command(tmp_path, boxes):
    (tmp_path / "scene.toml").write_text(SCENE)
    expected = message_of_module(command(
        "eval", "scene.toml", "--deputy", "scene.toml", "--set", "jet.coordinates=polar",
        directory=tmp_path))
    with pytest.raises(hamjet.SceneError) as error:
        hamjet.polynomials(SCENE, coordinates="polar")
    assert str(error.value).split("must be one of")[1] == expected.split("must be one of")[1]
    with pytest.raises(hamjet.SceneError, match="jet.end_coordinates: different at the two ends"):
        hamjet.polynomials(SCENE, coordinates="flow-box", end_coordinates="nodal")
    with pytest.raises(hamjet.SceneError, match="orbit"):
        hamjet.polynomials(OSCILLATOR)
    with pytest.raises(hamjet.UsageError, match="degree: got 4, must be 1 to the order, 3"):
        boxes.evaluate_relative([0] * 6, degree=4)
    with pytest.raises(hamjet.UsageError, match="tolerance_m"):
        boxes.reach(0)


def test_what_a_run_stores_is_what_is_integrated(tmp_path, boxes):
    (tmp_path / "scene.toml").write_text(SCENE)
    command("run", "scene.toml", "-q", "-o", "out", "--set", "jet.coordinates=flow-box",
            directory=tmp_path)
    stored = hamjet.Polynomials.load(tmp_path / "out")
    assert (stored.coordinates, stored.variables, stored.order) == ("flow-box", 4, 3)
    states = np.random.default_rng(5).uniform(-1, 1, (30, 6)) * ([1e3, 5e3, 1e3] + [1] * 3)
    found, expected = stored.evaluate_relative(states), boxes.evaluate_relative(states)
    assert (found.states == expected.states).all()
    assert list(found.support) == list(expected.support)
    with pytest.raises(hamjet.UsageError, match="reach: deputies are flown in a scene"):
        stored.reach()
    with pytest.raises(hamjet.InputOutputError):
        hamjet.Polynomials.load(tmp_path / "nowhere")


def test_a_jet_that_is_converted_says_what_the_integrated_polynomials_say(tmp_path, boxes):
    (tmp_path / "scene.toml").write_text(SCENE)
    command("run", "scene.toml", "-q", "-o", "out", directory=tmp_path)
    states = np.random.default_rng(6).uniform(-1, 1, (30, 6)) * ([1e3, 5e3, 1e3] + [1] * 3)
    load = hamjet.Polynomials.load
    converted = load(tmp_path / "out", coordinates="flow-box", scene=SCENE)
    assert (converted.coordinates, converted.variables, converted.order) == ("flow-box", 4, 3)
    # The bound is some 1e-12 of 7000 km, for both integrations' errors and for rounding.
    found, expected = converted.evaluate_relative(states), boxes.evaluate_relative(states)
    assert np.abs(found.states[:, :3] - expected.states[:, :3]).max() < 1e-5
    nodal = load(tmp_path / "out", coordinates="nodal", end_coordinates="poincare")
    assert (nodal.coordinates, nodal.end_coordinates) == ("nodal", "poincare")
    integrated = hamjet.polynomials(SCENE, coordinates="nodal", end_coordinates="poincare")
    found, expected = nodal.evaluate_relative(states), integrated.evaluate_relative(states)
    assert np.abs(found.states[:, :3] - expected.states[:, :3]).max() < 1e-5
    with pytest.raises(hamjet.UsageError, match="coordinates='flow-box'.*gravity field.*scene"):
        load(tmp_path / "out", coordinates="flow-box")
    with pytest.raises(hamjet.UsageError, match="scene: .*another field"):
        load(tmp_path / "out", coordinates="flow-box", scene=SCENE.replace("1.08262", "1.1"))
    with pytest.raises(hamjet.UsageError, match="coordinates: got .*polar.*, must be cartesian"):
        load(tmp_path / "out", coordinates="polar")


@pytest.mark.filterwarnings("ignore:evaluate_relative")
@pytest.mark.parametrize("coordinates", ["flow-box", "nodal", "spherical"])
@pytest.mark.parametrize("size_m, tolerance", [(15e3, 0.06), (400e3, 1e-5)])
def test_a_miss_is_what_the_last_degrees_add(coordinates, size_m, tolerance):
    # Each degree goes through the curved ends: near the chief estimates have some percent of that,
    # by derivatives there, and far from it, or where a degree adds much, all digits.
    polynomials = hamjet.polynomials(SCENE, coordinates=coordinates)
    states = np.random.default_rng(5).uniform(-1, 1, (200, 6)) * ([size_m] * 3 + [size_m * 1e-4] * 3)
    third, second, first = (polynomials.evaluate_relative(states, degree=degree)
                            for degree in (3, 2, 1))
    change, below = (np.linalg.norm((a.states - b.states)[:, :3], axis=1)
                     for a, b in ((third, second), (second, first)))
    linear = np.linalg.norm(first.states[:, :3], axis=1)
    mean = np.maximum(np.sqrt(change / linear), below / linear)
    # Degree 2 alone that is small is a gap, over which the mean decay goes on.
    decay = np.where(below <= change * mean, mean, np.maximum(mean, change / below))
    decay = np.minimum(decay, np.where(change < below, 1, 2))
    decay = np.maximum(np.maximum(decay, 0.02), below / change * decay ** 2)
    # Polynomials of a scene know the next degree, and what the decay from it on adds.
    fourth = hamjet.polynomials(SCENE, coordinates=coordinates, overrides={"jet.order": 4})
    added = fourth.evaluate_relative(states).states - third.states
    share = np.linalg.norm(added[:, :3], axis=1) / change
    further = np.maximum(share / (1 - np.minimum(share, 0.5)), decay ** 2)
    expected = change * np.minimum(further, 10 * np.maximum(decay, 1))
    inside = (third.support == "inside") & (expected > 1e-4)  # above rounding
    if size_m > 1e5:
        distances = np.linalg.norm(third.states[:, :3], axis=1)
        inside &= distances > 0.04 * 7000e3
    assert inside.sum() > (30 if coordinates == "flow-box" else 5)
    ratios = third.miss_m[inside] / expected[inside]
    # Of places 7000 km away a double rounds 1e-9 m, which the curved ends make a hundred of.
    assert (np.abs(ratios - 1) < tolerance + 1e-7 / expected[inside]).all()
    # For small deviations the two ways do not give the same numbers.
    assert size_m > 1e5 or np.abs(ratios - 1).max() > 1e-4


def test_deputies_beyond_reach_have_domains_of_their_own(tmp_path):
    states = np.zeros((9, 6))
    states[:, 1] = np.linspace(-60e3, 60e3, 9)
    far = SCENE + "[eval]\ntolerance_m = 1\n"
    (tmp_path / "scene.toml").write_text(far)
    (tmp_path / "in.csv").write_text(
        COLUMNS + "\n" + "".join(",".join(map(repr, map(float, row))) + "\n" for row in states))
    printed = columns(command("eval", tmp_path / "scene.toml", "--deviations", tmp_path / "in.csv",
                              "-q", directory=tmp_path).stdout)
    found = hamjet.polynomials(far).evaluate_relative(states)
    for i, name in enumerate(COLUMNS.split(",")):
        assert (found.states[:, i] == numbers(printed[name])).all(), name
    assert (found.support == "inside").all() and (found.miss_m <= 1).all()
    domains = found.domains
    assert domains["count"] > 1 and domains["not_right"] == 0 and not domains["is_limited"]
    assert domains["centres"].shape == domains["half_widths"].shape == (domains["count"], 6)
    # What flow boxes say, whose reach is further, within both tolerances.
    boxes = hamjet.polynomials(SCENE, coordinates="flow-box").evaluate_relative(states)
    assert (np.abs(boxes.states - found.states)[:, :3] < 1.5).all()
    assert boxes.domains is None
