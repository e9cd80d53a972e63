"""Every form of a deputy, in and out, against a program of its own in longer arithmetic."""

import numpy as np
import pytest

import hamjet
from conftest import ORBIT, scene
from independent_forms import DEGREE, FORMS, Chief, Elements, Real

MU = 398600.4415e9

# a_km, e, then degrees: inclination, node, argument of perigee, true anomaly.
ORBITS = {
    "LEO": (6892.9, 0.0012, 97.44, 30.0, 90.0, 10.0),
    "GTO": (24400.0, 0.73, 7.0, 200.0, 178.0, 45.0),
    "GEO": (42164.2, 0.0003, 0.05, 80.0, 130.0, -100.0),
    "Molniya": (26600.0, 0.74, 63.4, 227.89, 281.5, 123.75),
}

KEYS = ("a_km", "e", "i_deg", "raan_deg", "argp_deg", "ta_deg")

# Of the separation: what must agree. States are rounded to doubles, 42000 km to 4 nm, and elements
# enlarge that: nodes of GEO by the inverse of the inclination, 1100.
ALLOWED = 1e-9


def state_of(orbit):
    """Metres and m/s, of elements with the true anomaly."""
    a, e, i, node, perigee, anomaly = map(Real, orbit)
    half = anomaly * DEGREE / 2
    E = 2 * np.arctan2(np.sqrt(1 - e) * np.sin(half), np.sqrt(1 + e) * np.cos(half))
    return Elements(1000 * a, e, i * DEGREE, node * DEGREE, perigee * DEGREE,
                    E - e * np.sin(E)).state(Real(MU))


def scene_at(orbit, **tables):
    return scene(ORBIT, system={"model": "kepler", "mu_km3_s2": MU / 1e9},
                 nominal=dict(zip(KEYS, orbit)), **tables)


def frame_of(form):
    frame, _, derivatives = form.partition(" ")
    return frame, derivatives or None


@pytest.fixture(scope="module", params=ORBITS)
def case(request):
    """A chief, and its jet over no time: what a row becomes is its conversion alone."""
    orbit = ORBITS[request.param]
    result = hamjet.run(scene_at(orbit, jet={"order": 1, "duration_canonical": 0.0}))
    return Chief(*state_of(orbit), MU), result.runs["gauss8"].jet


@pytest.mark.parametrize("given", FORMS)
@pytest.mark.parametrize("asked", FORMS)
def test_every_form_becomes_every_other(case, given, asked):
    if "RTN" in given and "RTN" in asked and given != asked:
        pytest.skip("one kind of derivatives holds at both ends")
    chief, jet = case
    generator = np.random.default_rng(8)
    (frame, derivatives), (to, derivatives_to) = frame_of(given), frame_of(asked)
    for separation in (100.0, 2000.0, 20000.0):
        rows = generator.uniform(-1, 1, (4, 6)) * chief.sizes(given, separation)
        found = jet.evaluate_relative(rows, frame=frame, to=to,
                                      derivatives=derivatives or derivatives_to)
        for row, states in zip(rows, found.states):
            expected = chief.coordinates(asked, *chief.deputy(given, row))
            error = np.abs(states - expected) / chief.sizes(asked, separation)
            assert (error <= ALLOWED).all(), (separation, error)


@pytest.mark.parametrize("name", ORBITS)
def test_orbits_of_deputies(name):
    """An absolute state, and elements, of which a scene's [deputy] speaks: relative at its start."""
    orbit = np.array(ORBITS[name])
    chief = Chief(*state_of(orbit), MU)
    other = orbit + [0.02, 1e-5, 0.003, 0.002, 0.01, -0.012]
    r, v = state_of(other)
    expected = chief.coordinates("RTN", r, v)
    separation = float(np.linalg.norm(expected[:3].astype(float)))
    deputies = (dict(zip(KEYS, map(float, other))),
                {"position_km": [float(x) for x in r / 1000],
                 "velocity_km_s": [float(x) for x in v / 1000]})
    for deputy in deputies:
        motion = hamjet.motion(scene_at(orbit.tolist(), deputy=deputy,
                                        jet={"order": 1, "duration_s": 60}))
        state = np.concatenate([motion.position_m[0], motion.velocity_m_s[0]])
        error = np.abs(state - expected) / chief.sizes("RTN", separation)
        assert (error <= ALLOWED).all(), error
