"""States and elements, osculating and mean, against the program of test_forms and averages."""

import numpy as np
import pytest

import hamjet
from independent_forms import DEGREE, Elements, Real

MU, RADIUS, J2 = 398600.4418, 6378.137, 1.08262668e-3


def test_elements_are_those_of_the_state():
    generator = np.random.default_rng(2)
    given = np.column_stack([generator.uniform(7000, 40000, 20), generator.uniform(0.01, 0.8, 20),
                             generator.uniform(5, 175, 20), generator.uniform(5, 355, (20, 3))])
    given = given[:, [0, 1, 2, 3, 4, 5]]
    states = hamjet.states_of_elements(given, mu_km3_s2=MU)
    for row, state in zip(given, states):
        a, e, i, node, perigee, anomaly = map(Real, row)
        half = anomaly * DEGREE / 2
        E = 2 * np.arctan2(np.sqrt(1 - e) * np.sin(half), np.sqrt(1 + e) * np.cos(half))
        r, v = Elements(a, e, i * DEGREE, node * DEGREE, perigee * DEGREE,
                        E - e * np.sin(E)).state(Real(MU))
        # Rounded to doubles, by an angle of a few hundred degrees.
        assert np.abs(state[:3] - r).max() < 1e-15 * 40000 * 4
        assert np.abs(state[3:] - v).max() < 1e-15 * 10 * 4
    found = hamjet.elements_of_states(states, mu_km3_s2=MU)
    assert np.allclose(found, given, rtol=1e-12, atol=1e-10)
    assert hamjet.elements_of_states(states[0], mu_km3_s2=MU).shape == (6,)


def test_mean_elements_stay_where_osculating_ones_swing():
    scene = hamjet.orbit(a_km=7078, e=0.001, i_deg=98, J2=J2, mu_km3_s2=MU, radius_km=RADIUS,
                         order=1, duration_orbits=1)
    nominal = hamjet.run(scene).runs["gauss8"].nominal
    assert nominal is not None
    units = hamjet.run(scene).runs["gauss8"].jet.units
    states = nominal.states * ([units.length_km] * 3 + [units.velocity_km_s] * 3)
    mean = hamjet.mean_states(states, mu_km3_s2=MU, radius_km=RADIUS, J2=J2)
    back = hamjet.osculating_states(mean, mu_km3_s2=MU, radius_km=RADIUS, J2=J2)
    assert np.allclose(back, states, rtol=0, atol=1e-11)
    axis = hamjet.elements_of_states(states, mu_km3_s2=MU)[:, 0]
    mean_axis = hamjet.elements_of_states(mean, mu_km3_s2=MU)[:, 0]
    first = 1.5 * J2 * (RADIUS / 7078) ** 2
    assert np.ptp(axis) > first * 7078 * 0.5
    assert np.ptp(mean_axis) < 10 * first**2 * 7078
    assert abs(mean_axis.mean() - axis.mean()) < 0.5 * np.ptp(axis)


def test_a_scene_takes_mean_elements():
    keys = {"a_km": 7078, "e": 0.001, "i_deg": 98, "argp_deg": 90, "ta_deg": 0, "J2": J2,
            "mu_km3_s2": MU, "radius_km": RADIUS, "order": 1, "duration_canonical": 0.0}
    jet = hamjet.run(hamjet.orbit(elements="mean", **keys)).runs["gauss8"].jet
    start = jet.nominal_initial * ([jet.units.length_km] * 3 + [jet.units.velocity_km_s] * 3)
    mean = hamjet.mean_states(start, mu_km3_s2=MU, radius_km=RADIUS, J2=J2)
    found = hamjet.elements_of_states(mean, mu_km3_s2=MU)
    assert np.allclose(found[:3], [7078, 0.001, 98], rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("call, text", [
    (lambda: hamjet.elements_of_states([1, 2, 3], mu_km3_s2=MU),
     r"^states: wrong shape, got \(3,\), must be \(6,\) or \(N, 6\)$"),
    (lambda: hamjet.elements_of_states([np.nan] * 6, mu_km3_s2=MU), "^states: not finite"),
    (lambda: hamjet.elements_of_states("x", mu_km3_s2=MU), "^states: wrong type"),
    (lambda: hamjet.states_of_elements([7000, 1.2, 0, 0, 0, 0], mu_km3_s2=MU), "^row 0: "),
    (lambda: hamjet.states_of_elements([7000, 0.2, 0, 0, 0, 0], mu_km3_s2=-1),
     "^mu_km3_s2: not positive, got -1, must be a number above 0$"),
    (lambda: hamjet.mean_states([7000, 0, 0, 0, 7, 1], mu_km3_s2=MU, radius_km=RADIUS,
                                J2="x"), "^J2: wrong type, got str, must be a number$"),
])
def test_what_does_not_fit_is_refused(call, text):
    with pytest.raises(hamjet.UsageError, match=text):
        call()


def test_what_is_no_ellipse_has_no_elements():
    for function in (hamjet.elements_of_states,
                     lambda states, **keys: hamjet.mean_states(states, radius_km=RADIUS, J2=J2,
                                                               **keys)):
        with pytest.raises(hamjet.NumericalError, match="^row 1: .*ellipse"):
            function([[7000, 0, 0, 0, 7, 1], [7000, 0, 0, 0, 12, 0]], mu_km3_s2=MU)
