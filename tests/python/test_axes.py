"""States along other axes of the Earth: the Earth's angle of rotation, and what scenes do."""

import numpy as np
import pytest

import hamjet

NOON = "2000-01-01T12:00:00"
#: Of the Earth's angle of rotation at that noon of UT1, and its rate (IERS Conventions 2010, 5.15).
ANGLE = 2 * np.pi * 0.7790572732640
RATE = 2 * np.pi * 1.00273781191135448 / 86400
#: Precession of the half minute between UTC and TT, and nutation of J2000, are below this.
NUTATION = 1e-4


def test_what_rests_on_the_earth_turns_with_it():
    still = hamjet.change_axes([7000, 0, 0, 0, 0, 0], NOON, "ITRF")
    assert still.shape == (6,)
    assert np.allclose(still[:3], 7000 * np.array([np.cos(ANGLE), np.sin(ANGLE), 0]),
                       rtol=0, atol=7000 * NUTATION)
    assert abs(np.linalg.norm(still[:3]) - 7000) < 1e-9
    assert np.allclose(still[3:], np.cross([0, 0, RATE], still[:3]), rtol=0,
                       atol=7000 * RATE * NUTATION)
    dates = [NOON, "2000-01-01T13:00:00Z"]
    there = hamjet.change_axes([[7000, 0, 0, 0, 0, 0]] * 2, dates, "ITRF")
    cosine = there[0, :3] @ there[1, :3] / 7000**2
    assert abs(np.arccos(cosine) - 3600 * RATE) < NUTATION * 3600 * RATE


def test_the_way_there_and_back_is_none():
    states = np.random.default_rng(3).normal(size=(5, 6)) * ([7000] * 3 + [7] * 3)
    dates = [f"2026-03-{day:02d}T06:00:00" for day in (9, 1, 20, 3, 4)]
    for axes in ("EME2000", "MOD", "TOD", "TEME", "CIRF", "ITRF"):
        there = hamjet.change_axes(states, dates, "GCRF", axes, time_system="TAI")
        back = hamjet.change_axes(there, dates, axes, "GCRF", time_system="TAI")
        assert np.abs(there - states).max() > 1e-5
        assert np.allclose(back, states, rtol=0, atol=1e-9)


def test_scenes_are_turned_the_same_way():
    place, speed = [2046.25, 270.77, 6513.38], [-7.2394, -0.6730, 2.3094]
    scene = {"system": {"model": "earth"}, "jet": {"order": 1, "duration_s": 1},
             "nominal": {"epoch_gps": "2010-07-27T00:00:00", "axes": "ITRF", "position_km": place,
                         "velocity_km_s": speed}}
    jet = hamjet.run(scene).runs["gauss8"].jet
    start = jet.nominal_initial * ([jet.units.length_km] * 3 + [jet.units.velocity_km_s] * 3)
    turned = hamjet.change_axes(place + speed, "2010-07-27T00:00:00", "ITRF", time_system="GPS")
    assert np.allclose(start, turned, rtol=0, atol=1e-8)


@pytest.mark.parametrize("call, text", [
    (lambda: hamjet.change_axes([1, 2, 3], NOON, "ITRF"), "^states: wrong shape"),
    (lambda: hamjet.change_axes([1] * 6, [NOON, NOON], "ITRF"),
     "^epochs: wrong number, got 2, must be one of each of the 1 states$"),
    (lambda: hamjet.change_axes([1] * 6, "yesterday", "ITRF"),
     "^epochs: row 0: no date, got \"yesterday\""),
    (lambda: hamjet.change_axes([1] * 6, "1950-01-01T00:00:00", "ITRF"), "^epochs: row 0: .*1960"),
    (lambda: hamjet.change_axes([1] * 6, NOON, "RTN"),
     "^from_axes: axes that are not known, got \"RTN\", must be one of: GCRF, "),
    (lambda: hamjet.change_axes([1] * 6, NOON, "ITRF", "Mars"), "^to_axes: axes"),
    (lambda: hamjet.change_axes([1] * 6, NOON, "ITRF", time_system="CET"),
     "^time_system: not known, got \"CET\", must be one of: UTC, "),
])
def test_what_does_not_fit_is_refused(call, text):
    with pytest.raises(hamjet.UsageError, match=text):
        call()


def test_a_table_of_orientation_is_asked_for_its_dates(tmp_path):
    with pytest.raises(hamjet.MissingFileError, match="none.all"):
        hamjet.change_axes([1] * 6, NOON, "ITRF", orientation_file=tmp_path / "none.all")
