"""Moments of uncertain states, and of polynomials."""

import itertools
import json
import os
import pathlib
import subprocess

import numpy as np
import pytest

import hamjet
from conftest import COMMAND

SCENE = """
[system]
model = "zonal-gravity"
mu_km3_s2 = 398600.4415
radius_km = 6378.1363
J2 = 1.08262668355315e-3
[nominal]
a_km = 6878
e = 0.001
i_deg = 51.6
raan_deg = 0
argp_deg = 0
ta_deg = 0
[deputy]
position_m = [0, 1000, 0]
[jet]
order = 2
duration_orbits = 1
coordinates = "flow-box"
[uncertainty]
position_m = [1000, 1000, 1000]
velocity_m_s = [1, 1, 1]
count = 2
samples = 500
[uncertainty.deputy]
position_m = [10, 10, 10]
"""


@pytest.fixture(scope="module")
def result():
    return hamjet.uncertainty(SCENE)


def test_arrays_have_times_states_and_orders(result):
    assert result.states == ("chief", "deputy", "relative")
    assert result.component[0] == ("R", "T", "N", "vR", "vT", "vN")
    assert result.cartesian.mean.shape == (2, 3, 2, 6)
    assert result.cartesian.covariance.shape == (2, 3, 2, 6, 6)
    assert result.charted.negentropy.shape == (2, 3, 2)
    assert result.flown.skewness_scatter.shape == (2, 3, 6)
    assert result.flown_states().shape == (500, 6)
    assert not result.cartesian.mean.flags.writeable


def test_moments_of_samples_are_those_of_the_states(result):
    # NumPy takes the moments of the same states.
    states = result.flown_states(1, 0)
    deviations = states.std(axis=0)
    np.testing.assert_allclose(result.flown.standard_deviation[1, 0], deviations, rtol=1e-10)
    z = (states - states.mean(axis=0)) / deviations
    np.testing.assert_allclose(result.flown.skewness[1, 0], (z**3).mean(axis=0), atol=1e-8)
    np.testing.assert_allclose(result.flown.excess_kurtosis[1, 0], (z**4).mean(axis=0) - 3,
                               atol=1e-8)


def test_the_difference_of_two_has_the_sum_of_their_covariances(result):
    total = result.cartesian.covariance[:, 0] + result.cartesian.covariance[:, 1]
    np.testing.assert_allclose(result.cartesian.covariance[:, 2], total, rtol=1e-9,
                               atol=1e-9 * np.abs(total).max())


def test_the_table_and_the_summary_have_the_same_numbers(result):
    table = result.table
    rows = ((np.array(table["state"]) == "chief") & (np.array(table["polynomials"]) == "cartesian")
            & (table["order"] == 2) & (np.array(table["component"]) == "R"))
    np.testing.assert_array_equal(table["standard_deviation"][rows],
                                  result.cartesian.standard_deviation[:, 0, 1, 0])
    families = result.summary["times"][1]["states"][0]["families"]
    assert families[0]["orders"][1]["mean"] == list(result.cartesian.mean[1, 0, 1])
    assert result.summary["verdict"] == result.verdict


def polynomial(rows, exponents, points):
    monomials = np.prod(points[:, None, :] ** exponents[None, :, :], axis=2)
    return monomials @ rows.T


def test_polynomial_moments_are_those_of_a_product_rule():
    # Nodes of numpy's Gauss-Hermite rule, exact for the fourth power of order 2 with 5 nodes.
    generator = np.random.default_rng(4)
    exponents = np.array([e for e in itertools.product(range(3), repeat=3) if sum(e) <= 2])
    rows = generator.normal(size=(2, len(exponents)))
    factor = generator.normal(size=(3, 3))
    moments = hamjet.polynomial_moments(rows, exponents, factor @ factor.T)
    nodes, weights = np.polynomial.hermite_e.hermegauss(5)
    weights = weights / weights.sum()
    points = np.array(list(itertools.product(nodes, repeat=3)))
    weight = np.array([np.prod(w) for w in itertools.product(weights, repeat=3)])
    values = polynomial(rows, exponents, points @ factor.T)
    mean = weight @ values
    centred = values - mean
    covariance = centred.T @ (weight[:, None] * centred)
    np.testing.assert_allclose(moments.mean, mean, rtol=1e-11)
    np.testing.assert_allclose(moments.covariance, covariance, rtol=1e-10)
    z = centred / np.sqrt(np.diag(covariance))
    np.testing.assert_allclose(moments.skewness, weight @ z**3, rtol=1e-9)
    np.testing.assert_allclose(moments.excess_kurtosis, weight @ z**4 - 3, rtol=1e-8)


@pytest.mark.parametrize("rows, exponents, covariance, words", [
    ([[1.0, 2.0]], [[0], [1], [2]], [[1.0]], "coefficients: wrong shape"),
    ([[1.0, 2.0]], [[0], [1]], [[1.0, 0.0]], "covariance: wrong shape"),
    ([[1.0, 2.0]], [[1], [1]], [[1.0]], "stand twice"),
    ([[1.0, 2.0]], [[0], [1]], [[-1.0]], "variance -1 of x"),
    ([[1.0, np.nan]], [[0], [1]], [[1.0]], "coefficients: out of range"),
    ([[1.0, 2.0]], [[0], [-1]], [[1.0]], "exponents: out of range"),
])
def test_what_does_not_fit_is_refused(rows, exponents, covariance, words):
    with pytest.raises(hamjet.UsageError, match=words):
        hamjet.polynomial_moments(rows, exponents, covariance)


def test_a_scene_without_the_table_is_refused():
    with pytest.raises(hamjet.SceneError, match="uncertainty: missing"):
        hamjet.uncertainty(SCENE[:SCENE.index("[uncertainty]")])


def test_collisions_are_those_of_the_command(tmp_path):
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE + "[uncertainty.collision]\nradius_m = 50\nsamples = 5000\n")
    subprocess.run([COMMAND, "uncertainty", scene, "-q", "-o", tmp_path / "out"], check=True)
    result = hamjet.uncertainty(scene)
    of_command = hamjet.load(tmp_path / "out").summary["collision"]
    collision = result.summary["collision"]
    del of_command["seconds"], collision["seconds"]
    assert collision == of_command
    low, high = collision["interval"]
    assert 0 < low < collision["probability"] < high < 1
    result.write(tmp_path / "written")
    assert ((tmp_path / "written" / "collision.csv").read_bytes()
            == (tmp_path / "out" / "collision.csv").read_bytes())


def alfano_pair(case):
    """A published encounter; see data/references."""
    objects = case["objects_at_epoch"]
    states = [one["position_m"] + one["velocity_m_s"] for one in objects]
    middle, half = case["tca_s_after_epoch"], case["window_s_about_tca"]
    return states, [one["covariance_m_m_s"] for one in objects], [middle - half, middle + half]


def test_collision_probability_of_arrays_is_the_published_one():
    path = pathlib.Path(os.environ["HAMJET_SOURCE_DIR"]) / "data/references/alfano2009.json"
    cases = json.loads(path.read_text())[:2]
    states, covariances, windows = (np.array(list(part))
                                    for part in zip(*map(alfano_pair, cases)))
    result = hamjet.collision_probability(
        states, covariances, [case["hard_body_radius_m"] for case in cases], windows,
        system={"mu_km3_s2": 398600.4418}, event="entry", samples=5000)
    assert result.probability.shape == (2,) and result.interval.shape == (2, 2)
    assert result.probability_by_time.shape == (2, 201)
    for k, case in enumerate(cases):
        published = case["probability"]
        low, high = published["monte_carlo_95_percent"]
        # Two intervals of 95 % of which one is far the wider miss each other once in some twenty
        # seeds; this one is fixed.
        assert result.interval[k, 0] < high and result.interval[k, 1] > low
        np.testing.assert_allclose(result.short_encounter.alfano[k], published["short_encounter_2d"], rtol=1e-3)
        np.testing.assert_allclose(result.approach.time_s[k], case["tca_s_after_epoch"], atol=60)
    assert not result.probability.flags.writeable
    one = hamjet.collision_probability(
        states[0], covariances[0], cases[0]["hard_body_radius_m"], windows[0],
        system={"mu_km3_s2": 398600.4418}, event="entry", samples=5000)
    assert one.probability.shape == () and one.probability == result.probability[0]
    kepler = hamjet.collision_probability(
        states[0], covariances[0], cases[0]["hard_body_radius_m"], windows[0],
        system={"model": "kepler", "mu_km3_s2": 398600.4418}, event="entry", samples=5000)
    np.testing.assert_allclose(kepler.probability, one.probability, rtol=0.02)


@pytest.mark.parametrize("window_s", [(-60.0, 0.0), (-60.0, -0.001), (0.0, 60.0)])
def test_windows_may_end_before_the_epoch(window_s):
    """Two that cross at right angles, nearest at the epoch: whole passages have the integral of a
    round Gaussian over the disc, 1 - exp(-R^2 / (2 s^2))."""
    states = [[7e6, 0, 0, 0, 7546, 0], [7e6, 0, 0, 0, 0, 7546]]
    covariance = np.diag([25.0, 25, 25, 1e-6, 1e-6, 1e-6])
    found = hamjet.collision_probability(states, [covariance, covariance], 10, window_s, samples=20000)
    assert found.probability < found.whole_passage.probability
    np.testing.assert_allclose(found.whole_passage.probability, 1 - np.exp(-10 ** 2 / (2 * 50)), rtol=0.03)


@pytest.mark.parametrize("change, words", [
    ({"states": np.zeros((2, 5))}, r"states: wrong shape, got \(2, 5\), must end with \(2, 6\)"),
    ({"covariances": np.zeros((3, 2, 6, 6))}, "covariances: wrong shape"),
    ({"window_s": [1, 2, 3]}, "window_s: wrong shape"),
    ({"radius_m": np.nan}, "radius_m: not finite"),
])
def test_arrays_of_collisions_that_do_not_fit_are_refused(change, words):
    arguments = {"states": np.ones((2, 6)), "covariances": np.ones((2, 6, 6)), "radius_m": 1.0,
                 "window_s": [0, 10], **change}
    with pytest.raises(hamjet.UsageError, match=words):
        hamjet.collision_probability(**arguments)


def test_coordinates_are_compared():
    result = hamjet.uncertainty(
        SCENE.replace('samples = 500', 'samples = 0\ncoordinates = ["cartesian", "flow-box"]'))
    assert set(result.negentropy_in) == {"cartesian", "flow-box"}
    # The scene's own are flow boxes: the same numbers. No linear change of coordinates, as from
    # inertial axes to R, T, N, alters the negentropy.
    np.testing.assert_allclose(result.negentropy_in["flow-box"], result.charted.negentropy[-1],
                               rtol=1e-9, atol=1e-15)
    found, wanted = result.negentropy_in["cartesian"], result.cartesian.negentropy[-1]
    np.testing.assert_allclose(found[[0, 2]], wanted[[0, 2]], rtol=1e-6, atol=1e-12)
    # The deputy's own are about its own trajectory, those in coordinates about the chief's: series
    # about points 100 m apart on an orbit of 7000 km, cut at the same order.
    np.testing.assert_allclose(found[1], wanted[1], rtol=1e-4, atol=1e-12)
