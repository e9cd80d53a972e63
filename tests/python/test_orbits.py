"""Scenes of orbits from keyword arguments, which are the keys of a scene."""

import inspect
import subprocess

import numpy as np
import pytest

import hamjet
from conftest import COMMAND, SOURCE
from hamjet import _hamjet

LOW = {"a_km": 7078, "e": 0.001, "i_deg": 98, "J2": 1.0826e-3, "order": 2, "duration_orbits": 0.1}

#: An answer of the scene's own reader, in which its name stands for %s.
MISSING_DURATION = ("%s: jet: missing, got none of a choice, must be exactly one of: duration_s, "
                    "duration_orbits, duration_canonical")


def test_keywords_make_the_scene_that_they_say():
    made = hamjet.orbit(**LOW, raan_deg=10, title="Low")
    assert made["title"] == "Low"
    assert made["nominal"] == {"a_km": 7078, "e": 0.001, "i_deg": 98, "raan_deg": 10,
                               "argp_deg": 0, "ta_deg": 0}
    assert made["jet"] == {"order": 2, "duration_orbits": 0.1}
    assert made["system"]["model"] == "zonal-gravity" and made["system"]["J2"] == 1.0826e-3
    # The Earth's values: mu of JPL, the radius of the IAU.
    assert made["system"]["mu_km3_s2"] == pytest.approx(398600.4355, rel=1e-9)
    assert made["system"]["radius_km"] == pytest.approx(6378.1366, rel=1e-7)
    assert set(made) == {"title", "nominal", "jet", "system"}
    jet = hamjet.run(made).runs["gauss8"].jet
    assert jet.order == 2
    period = 2 * np.pi * np.sqrt(7078**3 / made["system"]["mu_km3_s2"])
    assert jet.duration_s == pytest.approx(0.1 * period, rel=1e-12)


def test_what_is_given_stands_in_place_of_what_would_be_filled_in():
    system = hamjet.orbit(**LOW, mu_km3_s2=1.0e5, radius_km=5000)["system"]
    assert (system["mu_km3_s2"], system["radius_km"]) == (1.0e5, 5000)
    # Of another body neither is filled in.
    with pytest.raises(hamjet.SceneError, match="^orbit: system.radius_km: missing"):
        hamjet.orbit(**LOW, mu_km3_s2=42828.37)
    with pytest.raises(hamjet.SceneError, match="^orbit: system.mu_km3_s2: missing"):
        hamjet.orbit(**LOW, radius_km=3396.19)
    without = {**LOW, "J2": None}
    assert hamjet.orbit(**without, model="kepler", mu_km3_s2=2.0e5)["system"] == {
        "model": "kepler", "mu_km3_s2": 2.0e5}
    field = SOURCE / "data" / "gravity" / "EGM96-zonals.gfc"
    system = hamjet.orbit(**without, gravity_file=str(field), highest_zonal=4)["system"]
    assert system == {"model": "zonal-gravity", "gravity_file": str(field), "highest_zonal": 4}
    state = hamjet.orbit(position_km=np.array([7000.0, 0, 0]), velocity_km_s=(0, 7.5, 1),
                         duration_s=60)
    assert set(state["nominal"]) == {"position_km", "velocity_km_s"}
    assert hamjet.run(state).runs["gauss8"].jet.duration_s == pytest.approx(60, rel=1e-14)


def test_sizes_and_places_of_every_kind_get_the_angles_that_are_left_out():
    rest = {"i_deg": 98, "duration_s": 60}
    made = hamjet.orbit(**rest, height_km=500)["nominal"]
    assert made == {"height_km": 500, "i_deg": 98, "raan_deg": 0, "argp_deg": 0, "ta_deg": 0}
    for place in ("ta_deg", "ea_deg", "ma_deg", "u_deg"):
        made = hamjet.orbit(**rest, perigee_height_km=300, apogee_height_km=900, **{place: 90})
        assert made["nominal"] == {"perigee_height_km": 300, "apogee_height_km": 900, "i_deg": 98,
                                   "raan_deg": 0, "argp_deg": 0, place: 90}
    made = hamjet.orbit(**rest, period_s=5400, e=0, argp_deg=20, ma_deg=30)["nominal"]
    assert made == {"period_s": 5400, "e": 0, "i_deg": 98, "raan_deg": 0, "argp_deg": 20,
                    "ma_deg": 30}
    # What is left out besides is said alone.
    with pytest.raises(hamjet.SceneError, match="^orbit: nominal: no size of the orbit.*$"):
        hamjet.orbit(**rest)
    with pytest.raises(hamjet.SceneError, match="^orbit: nominal: no orbit"):
        hamjet.orbit(duration_s=60)


def test_other_tables_come_whole():
    validity = {"frame": "RTN", "derivatives": "rotating", "count": 2, "tolerance_m": 1.0}
    made = hamjet.orbit(**LOW, validity=validity)
    assert made["validity"] == validity
    assert hamjet.validity(made).proved_m.shape == (2, 2)


@pytest.mark.parametrize("change, text", [
    ({"duration_orbit": 1}, "orbit: jet.duration_orbit: unknown key, got duration_orbit, did you "
     "mean duration_orbits?"),
    ({"altitude_km": 500}, "orbit: nominal.altitude_km: unknown key, got altitude_km, must be "
     "height_km of a circle, or perigee_height_km with apogee_height_km"),
    ({"height_km": 500}, "orbit: nominal.height_km: size and shape given twice, got a_km and "
     "height_km, must be one of: a_km with e, perigee_height_km with apogee_height_km, period_s "
     "with e, height_km of a circle"),
    ({"integrators": []}, "orbit: integrators: unknown key, got integrators, did you mean "
     "integrator?"),
    ({"duration_orbits": None}, MISSING_DURATION % "orbit"),
    ({"e": 1.5}, "orbit: nominal.e: out of range, got 1.5, must be at least 0 and below 1 (other "
     "orbits are given by position_km and velocity_km_s)"),
    ({"transfer": {"frme": "RTN"}}, "orbit: transfer.frme: unknown key, got frme, did you mean "
     "frame?"),
])
def test_mistakes_get_the_answers_of_the_scene(change, text):
    with pytest.raises(hamjet.SceneError) as raised:
        hamjet.orbit(**{**LOW, **change})
    assert str(raised.value).splitlines()[0] == text


def test_a_keyword_like_no_other_gets_all_that_there_are():
    for keyword in ("colour", "system", "mass_kg"):
        with pytest.raises(hamjet.SceneError) as raised:
            hamjet.orbit(**LOW, **{keyword: 1})
        text = str(raised.value)
        assert text.startswith(f"orbit: {keyword}: unknown key, got {keyword}, must be one of: ")
        for key in ("a_km", "duration_orbits", "order"):
            assert f" {key}," in text


def test_keywords_are_the_keys_that_the_command_lists():
    listed = subprocess.run([COMMAND, "list", "keys"], check=True, capture_output=True,
                            text=True).stdout
    keys = _hamjet.orbit_keys()
    tables = {table for _, table, _ in keys}
    assert tables == {"", "system", "nominal", "jet"}
    names = [name for name, _, _ in keys]
    assert len(set(names)) == len(names), "a key of two tables would say two things"
    for name, table, text in keys:
        title = f"`[{table}]`" if table else "The top"
        section = listed.split(f"## {title}\n")[1].split("\n## ")[0]
        shown = (name in section or name[0] == "J" and "`J2` to `J20`" in section
                 or name.startswith("epoch_") and "`epoch_utc` to `epoch_gps`" in section)
        assert shown and text in section, name
    parameters = inspect.signature(hamjet.orbit).parameters
    assert list(parameters) == names
    assert all(p.default is None for p in parameters.values())
    assert "    a_km: semi-major axis ([nominal])\n" in hamjet.orbit.__doc__
    assert "    J2 to J20: not normalised: J_n = -C_n0 ([system])\n" in hamjet.orbit.__doc__


def test_likely_slips_are_warned_of_where_they_are_written():
    for call in (lambda: hamjet.orbit(**{**LOW, "a_km": 7e6}),
                 lambda: hamjet.run({**hamjet.orbit(**LOW)}, overrides={"nominal.a_km": 7e6})):
        with pytest.warns(UserWarning, match=r"nominal\.a_km: ") as caught:
            call()
        assert caught[0].filename == __file__
        assert not str(caught[0].message).startswith("warning")
