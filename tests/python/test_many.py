"""Compares many orbits side by side with runs of each alone and with Kepler's period."""

import numpy as np
import pytest

import hamjet
from conftest import ORBIT, OSCILLATOR, scene

TOLERANCE = 1e-11
ORBIT_1 = scene(ORBIT, jet={"order": 1, "duration_s": 8000.0},
                integrator=[{"label": "gauss8", "method": "gauss", "stages": 8,
                             "tolerance": TOLERANCE}])
KEPLER_1 = scene(ORBIT_1, system={"model": "kepler", "mu_km3_s2": 398600.4405})


def in_km(jet):
    """Final state and state transition matrix in km and s: each scene has a unit of its own."""
    units = jet.units
    scale = np.repeat([units.length_km, units.velocity_km_s], 3)
    return jet.nominal_final * scale, scale[:, np.newaxis] * jet.linear_part / scale


def elements(count):
    """Rows of a in km, e, and angles in degrees."""
    i = np.arange(count)
    return np.stack([10000.0 + 0 * i, 0.7 * i / count, 20.0 + 7 * i, 30.0 * i, 11.0 * i, 0.0 * i],
                    axis=1)


def test_an_orbit_of_many_is_that_of_a_run():
    rows = elements(11)
    states = hamjet.states_of_elements(rows, mu_km3_s2=398600.4405)
    many = hamjet.propagate_many(ORBIT_1, states_km=states)
    assert len(many) == 11 and many.run == "gauss8" and not many.failures
    assert many.coefficients.shape == (11, 6, 7) and many.linear_parts.shape == (11, 6, 6)
    assert not many.coefficients.flags.writeable
    for k in (0, 4, 10):
        keys = dict(zip(("a_km", "e", "i_deg", "raan_deg", "argp_deg", "ta_deg"), rows[k]))
        alone = hamjet.run(scene(ORBIT_1, nominal=keys)).runs["gauss8"].jet
        for found, wanted in zip(in_km(many.jet(k)), in_km(alone)):
            # Ten times the tolerance, for about a revolution.
            assert np.abs(found - wanted).max() < 10 * TOLERANCE * np.abs(wanted).max()
        jet = many.jet(k)
        assert np.array_equal(jet.coefficients, many.coefficients[k])
        assert np.array_equal(jet.exponents, many.exponents)
        assert abs(jet.duration_s / alone.duration_s - 1) < 1e-15
        assert jet.duration_s == many.duration_s
        assert many.steps[k] > 3
    # A circle's first trial does not suffice, and it is left to itself.
    assert many.were_alone.dtype == bool and not many.were_alone[[4, 10]].any()


def test_kepler_orbits_of_one_period_close_and_shear_along_themselves():
    period = 2 * np.pi * np.sqrt(10000.0**3 / 398600.4405)
    kepler = scene(KEPLER_1, jet={"order": 1, "duration_s": float(period)})
    states = hamjet.states_of_elements(elements(9), mu_km3_s2=398600.4405)
    many = hamjet.propagate_many(kepler, states_km=states, threads=2)
    for k in range(9):
        start = many.jet(k).nominal_initial
        assert np.allclose(many.final_states[k], start, rtol=0, atol=10 * TOLERANCE)
        q, p = start[:3], start[3:]
        r = np.linalg.norm(q)
        # A neighbour of another energy is late by the change of its period, dT = 3 T a dE.
        a = 1 / (2 / r - p @ p)
        late = 3 * 2 * np.pi * a**1.5 * a * np.concatenate([q / r**3, p])
        shear = np.eye(6) - np.outer(np.concatenate([p, -q / r**3]), late)
        assert np.abs(many.linear_parts[k] - shear).max() < 10 * TOLERANCE * np.abs(shear).max()


def test_no_digit_depends_on_company_or_threads():
    states = hamjet.states_of_elements(elements(20), mu_km3_s2=398600.4405)
    together = hamjet.propagate_many(ORBIT_1, states_km=states, threads=1)
    two = hamjet.propagate_many(ORBIT_1, states_km=states[::-1], threads=2)
    alone = hamjet.propagate_many(ORBIT_1, states_km=states[7:8])
    assert np.array_equal(together.coefficients, two.coefficients[::-1])
    assert np.array_equal(together.coefficients[7], alone.coefficients[0])


def test_failures_are_named_and_alone():
    states = np.array([[1, 0, 0, 0, 1.0, 0], [1, 0, 0, 0, 0, 0], [0, 1, 0, -0.8, 0, 0.5]])
    many = hamjet.propagate_many(KEPLER_1, states)
    assert list(many.failures) == [1] and "collision" in many.failures[1]
    assert np.isnan(many.coefficients[1]).all() and np.isfinite(many.coefficients[[0, 2]]).all()
    assert repr(many).endswith("3 orbits, 1 failed>") or "1 failed" in repr(many)
    with pytest.raises(hamjet.NumericalError, match="collision"):
        many.jet(1)


def test_other_systems_have_canonical_states():
    many = hamjet.propagate_many(OSCILLATOR, [[1.0, 0.5], [0, 1], [0, 0]])
    # A mass of 1 kg on 4 N/m turns by two radians in a second, of which the duration has 1.25.
    c, s = np.cos(2.5), np.sin(2.5)
    turn = np.array([[c, s / 2], [-2 * s, c]])
    for k, start in enumerate([[1.0, 0.5], [0, 1], [0, 0]]):
        assert np.allclose(many.final_states[k], turn @ start, rtol=0, atol=1e-12)
        assert np.allclose(many.linear_parts[k], turn, rtol=0, atol=1e-12)
    with pytest.raises(hamjet.UsageError, match="no states in km"):
        hamjet.propagate_many(OSCILLATOR, states_km=[[1.0, 0.5]])


def test_what_does_not_fit_is_refused():
    state = [[1.0, 0, 0, 0, 1, 0]]
    for arguments, text in (({}, "must be given"),
                            ({"states": state, "states_km": state}, "not both"),
                            ({"states": [1.0, 0, 0, 0, 1, 0]}, "wrong shape"),
                            ({"states": [["a"]]}, "wrong type"),
                            ({"states": [[1.0, 0, 0]]}, "state 0 has 3 numbers, must have 6"),
                            ({"states": state, "run": "none"}, "no run has the label"),
                            ({"states": state, "threads": 0}, "out of range")):
        with pytest.raises(hamjet.UsageError, match=text):
            hamjet.propagate_many(ORBIT_1, **arguments)
    with pytest.raises(hamjet.SceneError, match="must be double"):
        hamjet.propagate_many(ORBIT_1, state, overrides={"precision": "extended"})
    assert hamjet.propagate_many(ORBIT_1, np.empty((0, 6))).coefficients.shape == (0, 6, 7)
