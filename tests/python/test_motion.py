"""Motion of a deputy: equal to what the command writes, and to Kepler's circles."""

import dataclasses
import pickle

import numpy as np
import pytest

import hamjet
from conftest import ORBIT, SOURCE, command, message_of_module
from test_relative_motion import columns, numbers, table_of_command
from test_results import without_times

SATELLITES = SOURCE / "data" / "examples" / "two-satellites" / "two-satellites.toml"

MU_KM3_S2 = 398600.4415
RADIUS_KM = 7000.0
PHASE_DEG = -0.02
TILT_DEG = 0.01

_CIRCLE = {"a_km": RADIUS_KM, "e": 0, "raan_deg": 0, "argp_deg": 0}
CIRCLES = {
    "schema": 1, "title": "Circles of one size",
    "system": {"model": "kepler", "mu_km3_s2": MU_KM3_S2},
    "nominal": {**_CIRCLE, "i_deg": 0, "ta_deg": 0},
    "deputy": {**_CIRCLE, "i_deg": TILT_DEG, "ta_deg": PHASE_DEG},
    "jet": {"order": 3, "duration_orbits": 1.5},
}


@pytest.fixture(scope="module", name="circles")
def motion_on_circles():
    return hamjet.motion(CIRCLES)


def test_motion_is_that_of_the_command(tmp_path):
    expected = table_of_command(tmp_path, "motion", SATELLITES, [], "motion.csv")
    motion = hamjet.motion(SATELLITES)
    assert (motion.frame, motion.derivatives) == ("RTN", "rotating")
    for i, axis in enumerate("RTN"):
        assert (motion.position_m[:, i] == numbers(expected[f"{axis}_m"])).all()
        assert (motion.velocity_m_s[:, i] == numbers(expected[f"v{axis}_m_s"])).all()
    assert (motion.time_s == numbers(expected["time_s"])).all()
    assert (motion.separation_m == numbers(expected["separation_m"])).all()
    assert motion.error_m_by_order.shape == (len(motion.time_s), 4)
    for order in range(1, 5):
        assert (motion.error_m_by_order[:, order - 1]
                == numbers(expected[f"error_m_order_{order}"])).all()
    assert {name: list(column) for name, column in motion.table.items()} == {
        name: list(numbers(fields)) for name, fields in expected.items()}
    loaded = hamjet.load(tmp_path / "out")
    assert without_times(loaded.summary) == without_times(motion.summary)
    assert loaded.summary["verdict"] == motion.verdict
    assert loaded.summary["flight_floor_m"] == motion.flight_floor_m
    for name in ("nearest", "farthest"):
        place = dataclasses.asdict(getattr(motion, name))
        assert {key: np.asarray(value).tolist() for key, value in place.items()} == (
            loaded.summary[name])


def test_circles_of_one_size_are_those_of_kepler(circles):
    phase, tilt = np.radians([PHASE_DEG, TILT_DEG])
    rate = np.sqrt(MU_KM3_S2 / RADIUS_KM**3)
    size_m = RADIUS_KM * 1000
    assert np.isclose(circles.time_s[-1], 1.5 * 2 * np.pi / rate, rtol=1e-13, atol=0)
    chief = rate * circles.time_s
    deputy = chief + phase
    place = size_m * np.array([np.cos(deputy), np.sin(deputy) * np.cos(tilt),
                               np.sin(deputy) * np.sin(tilt)])
    velocity = rate * size_m * np.array([-np.sin(deputy), np.cos(deputy) * np.cos(tilt),
                                         np.cos(deputy) * np.sin(tilt)])
    radial = np.array([np.cos(chief), np.sin(chief), 0 * chief])
    transverse = np.array([-np.sin(chief), np.cos(chief), 0 * chief])
    expected = np.array([(place * radial).sum(axis=0), (place * transverse).sum(axis=0), place[2]])
    # The velocity as seen from axes that turn with the chief.
    turning = np.array([(velocity * radial).sum(axis=0) + rate * expected[1],
                        (velocity * transverse).sum(axis=0) - rate * expected[0], velocity[2]])
    expected[0] -= size_m
    # The rounding of 7000 km is a nanometre, that of the flights some hundred times as much.
    assert np.abs(circles.position_m - expected.T).max() < 1e-6
    assert np.abs(circles.velocity_m_s - turning.T).max() < 1e-9
    assert np.abs(circles.separation_m - np.linalg.norm(expected, axis=0)).max() < 1e-6
    # Each order more takes some thousandth, the separation over the radius, of the error.
    assert (circles.error_m_by_order[-1, 1:] < 0.01 * circles.error_m_by_order[-1, :-1]).all()


def test_circles_are_nearest_and_farthest_where_kepler_has_them(circles):
    # The cosine of the angle between the two, with the chief's angle w, is
    # (cos(phase) (1 + cos(tilt)) + cos(2 w + phase) (1 - cos(tilt))) / 2, and the separation
    # 2 radius sin(angle / 2): the squares of the sines of half the angles add up without a loss.
    phase, tilt = np.radians([PHASE_DEG, TILT_DEG])
    rate = np.sqrt(MU_KM3_S2 / RADIUS_KM**3)
    across = np.sin(tilt / 2)**2
    along = np.sin(phase / 2)**2 * (1 - across)
    for place, turn, square in ((circles.nearest, 0, along), (circles.farthest, np.pi,
                                                              along + across)):
        assert np.isclose(place.separation_m, 2e3 * RADIUS_KM * np.sqrt(square), rtol=0, atol=1e-6)
        assert np.isclose(np.linalg.norm(place.position_m), place.separation_m, rtol=1e-14, atol=0)
        angle = 2 * rate * place.time_s + phase - turn
        assert abs(np.angle(np.exp(1j * angle))) < 1e-5


def test_motion_is_a_data_frame_and_comes_back_from_a_pickle(tmp_path, circles):
    pandas = pytest.importorskip("pandas")
    circles.write(tmp_path / "out")
    assert (tmp_path / "out" / "report.html").is_file()
    frame = circles.to_dataframe()
    written = columns((tmp_path / "out" / "motion.csv").read_text(encoding="utf-8"))
    assert list(frame.columns) == list(written)
    assert (frame == pandas.DataFrame({key: numbers(value) for key, value in written.items()})
            ).all(axis=None)
    for array in (circles.position_m, circles.nearest.position_m):
        with pytest.raises(ValueError):
            array[0] = 0
    again = pickle.loads(pickle.dumps(circles))
    assert (again.position_m == circles.position_m).all() and again.verdict == circles.verdict
    assert again.farthest.separation_m == circles.farthest.separation_m
    assert not again.nearest.velocity_m_s.flags.writeable
    with pytest.raises(hamjet.UsageError, match="^write: these results were unpickled, which"):
        again.write(tmp_path / "again")


@pytest.mark.parametrize("file, option", [
    (SOURCE / "data" / "scenes" / "molniya.toml", "jet.order=3"), (SATELLITES, "jet.arcs=2"),
    (SATELLITES, "jet.duration_s=0"), (SATELLITES, "deputy.position_m=[0,1,0]")])
def test_scenes_without_a_motion_are_refused_as_by_the_command(tmp_path, file, option):
    printed = command("motion", file, "--set", option, directory=tmp_path)
    with pytest.raises(hamjet.SceneError) as raised:
        hamjet.motion(file, overrides=[option])
    assert str(raised.value) == message_of_module(printed)
    with pytest.raises(hamjet.SceneError, match="^scene: deputy: missing, must be a table"):
        hamjet.motion(ORBIT)


# A run's jets are in the unit that a scene asks for; what is told in metres does not depend on it.
@pytest.mark.parametrize("length_km", [0.001, 149597870.7])
def test_motion_is_the_same_in_any_unit_of_length(circles, length_km):
    other = hamjet.motion({**CIRCLES, "units": {"length_km": length_km}})
    assert (other.time_s == circles.time_s).all()
    assert (other.position_m == circles.position_m).all()
    assert (other.error_m_by_order == circles.error_m_by_order).all()
    jet = hamjet.run({**CIRCLES, "units": {"length_km": length_km}}).runs["gauss8"].jet
    assert jet.units.length_km == length_km
    assert np.linalg.norm(jet.nominal_initial[:3]) * length_km == pytest.approx(RADIUS_KM)
