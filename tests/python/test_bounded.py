"""Frozen orbits and deputies that stay: equal to what the command writes."""

import numpy as np
import pytest

import hamjet
from conftest import SOURCE
from test_relative_motion import numbers, table_of_command
from test_results import without_times

SCENE = SOURCE / "data" / "scenes" / "bounded-sun-synchronous.toml"
SHORT = ["jet.order=3", "bounded.revolutions=20", "bounded.sizes_km=[1, 50]"]


def test_frozen_orbit_is_that_of_the_command(tmp_path):
    expected = table_of_command(tmp_path, "poincare", SCENE, SHORT, "poincare.csv")
    frozen = hamjet.poincare(SCENE, overrides=SHORT)
    assert (frozen.amplitude_m == numbers(expected["amplitude_m"])).all()
    assert (frozen.rotation_number == numbers(expected["rotation_number"])).all()
    assert (frozen.miss == numbers(expected["miss"])).all()
    assert frozen.frozen_orbit.stable and frozen.frozen_orbit.residual < 1e-20
    assert not frozen.failure
    loaded = hamjet.load(tmp_path / "out")
    assert without_times(loaded.summary) == without_times(frozen.summary)
    assert loaded.summary["frozen_orbit"]["e"] == frozen.frozen_orbit.e
    assert loaded.summary["verdict"] == frozen.verdict
    assert "stable" in repr(frozen)


def test_bounded_deputies_are_those_of_the_command(tmp_path):
    expected = table_of_command(tmp_path, "bounded", SCENE, SHORT, "bounded.csv")
    bounded = hamjet.bounded(SCENE, overrides=SHORT)
    assert list(bounded.rule) == expected["rule"]
    assert (bounded.size_m == numbers(expected["size_m"])).all()
    assert (bounded.window_along_drift == numbers(expected["window_along_drift"])).all()
    assert (bounded.window_along_doubt == numbers(expected["window_along_doubt"])).all()
    for i, axis in enumerate("rtn"):
        assert (bounded.half_widths_m[:, i] == numbers(expected[f"half_width_{axis}_m"])).all()
    assert bounded.starts().shape == (8, 6) and np.isfinite(bounded.starts()).all()
    assert (bounded.starts("inertial")[:, 5] == numbers(expected["inertial.vz_m_s"])).all()
    with pytest.raises(hamjet.UsageError, match="no form 'RTN', must be one of RTN-rotating, "):
        bounded.starts("RTN")
    assert bounded.held == (True,) * 8 and bounded.box is None
    assert bounded.revolutions == 20
    assert hamjet.load(tmp_path / "out").summary["verdict"] == bounded.verdict
    assert "8 deputies" in repr(bounded)


def test_a_deputy_in_a_box_is_that_of_the_command(tmp_path):
    scene = SCENE.with_name("stationkeeping-follower.toml")
    short = ["bounded.revolutions=20", "bounded.box.days=2"]
    expected = table_of_command(tmp_path, "bounded", scene, short, "box.csv")
    kept = hamjet.bounded(scene, overrides=short)
    assert (kept.box.time_s == numbers(expected["time_s"])).all()
    assert (kept.box.duration_s == numbers(expected["duration_s"])).all()
    assert (kept.box.change_m_s == numbers(expected["change_m_s"])).all()
    assert len(kept.box.change_m_s) == kept.box.returns > 0 and kept.box.farthest_of_all < 1.001
    assert kept.box.change_m_s_a_day == pytest.approx(kept.box.change_m_s.sum() / 2, rel=1e-14)


def test_a_chief_in_the_equator_is_refused():
    with pytest.raises(hamjet.SceneError, match="equatorial"):
        hamjet.poincare(SCENE, overrides=["nominal.i_deg=0"])


EVENT = ["jet.order=3", "event.surface='equator'", "event.direction='rising'",
         "event.amplitudes_m=[100, 1000]"]


def test_an_event_is_that_of_the_command(tmp_path):
    expected = table_of_command(tmp_path, "poincare", SCENE, EVENT, "event.csv")
    event = hamjet.event(SCENE, overrides=EVENT)
    assert (event.position_miss_m == numbers(expected["position_miss_m"])).all()
    assert (event.linear_time_miss_s == numbers(expected["linear_time_miss_s"])).all()
    loaded = hamjet.load(tmp_path / "out")
    assert loaded.summary["time_s"] == event.time_s
    assert loaded.summary["state_canonical"] == event.state_canonical.tolist()
    assert event.exponents.shape == (84, 6) and event.coefficients.shape == (84, 7)


def test_a_neighbour_has_the_event_that_the_polynomials_say():
    """The neighbour's own event, from its own scene, is what the polynomials say."""
    event = hamjet.event(SCENE, overrides=EVENT)
    deviation = np.array([1, -2, 1, 2, 1, -1]) * 1e-5
    time, *state = event.evaluate(deviation)
    chief = hamjet.run(SCENE, overrides=["jet.order=1", "generating_function=null"]
                       ).runs["gauss8"].nominal.states[0]
    start = np.array(chief) + deviation
    speed = event.length_km / event.time_unit_s
    own = hamjet.event(SCENE, overrides=[
        *EVENT, "nominal={position_km=" + str((start[:3] * event.length_km).tolist())
        + ", velocity_km_s=" + str((start[3:] * speed).tolist()) + "}"])
    # Degree 4 contributes 1e-20 times coefficients of thousands at most, far below the rounding.
    assert abs(own.time_s - time * event.time_unit_s) < 1e-7
    scale = own.length_km / event.length_km
    assert np.allclose(own.state_canonical[:3] * scale, state[:3], atol=1e-11)
    assert np.allclose(event.evaluate(np.zeros((2, 6)))[:, 0] * event.time_unit_s, event.time_s,
                       rtol=1e-15, atol=0)
    with pytest.raises(hamjet.UsageError, match="6 numbers"):
        event.evaluate([1, 2])
    for wrong in ("abc", [[1, 2], [3]], np.full(6, np.nan)):
        with pytest.raises(hamjet.UsageError, match="deviations: no"):
            event.evaluate(wrong)


def test_an_event_that_does_not_happen_is_refused():
    with pytest.raises(hamjet.SceneError, match="has 1; must be at most 1"):
        hamjet.event(SCENE, overrides=[*EVENT, "event.number=7"])
    with pytest.raises(hamjet.SceneError, match="event: missing"):
        hamjet.event(SCENE)
