"""Plots: what is drawn is the numbers of the result."""

import numpy as np
import pytest

import hamjet
from conftest import ORBIT, scene
from test_relative_motion import TRANSFER
from test_to_dataframe import VALIDITY

pyplot = pytest.importorskip("matplotlib.pyplot")


MOTION = scene(ORBIT, deputy={"position_m": [0, -500, 100]})


def drawn(axes):
    """The points of each line by its label."""
    return {line.get_label(): line.get_xydata() for line in axes.get_lines()}


def test_transfers_are_drawn_with_the_least_and_the_singular_times():
    transfers = hamjet.transfer(TRANSFER)
    axes = transfers.plot()
    lines = drawn(axes)
    away = ~transfers.near_singular
    expected = np.column_stack([transfers.times_s / 3600, transfers.total_change_m_s])
    assert (lines["away from singularities"][away] == expected[away]).all()
    assert np.isnan(lines["away from singularities"][~away, 1]).all()
    assert (lines["least"] == expected[[transfers.best]]).all()
    assert ("near a singularity" in lines) == transfers.near_singular.any()
    at = {line[0, 0] for label, line in lines.items() if label.startswith("_")}
    assert at == set(transfers.singular_times_s / 3600)
    assert axes.get_yscale() == "log"
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("transfer time (h)", "velocity change (m/s)")


def test_validity_is_drawn_for_every_order():
    validity = hamjet.validity(VALIDITY)
    lines = drawn(validity.plot())
    assert list(lines) == ["order 1", "order 2"]
    for order, points in enumerate(lines.values()):
        assert (points[:, 0] == validity.time_s / 3600).all()
        proved = validity.proved_m[:, order]
        assert np.array_equal(points[:, 1], np.where(proved > 0, proved, np.nan), equal_nan=True)


def test_motion_is_drawn_with_its_extremes():
    motion = hamjet.motion(MOTION)
    axes = motion.plot()
    lines = drawn(axes)
    expected = np.column_stack([motion.times_s / 3600, motion.separation_m])
    assert (lines["separation"] == expected).all()
    for name, at in (("nearest", motion.nearest), ("farthest", motion.farthest)):
        assert (lines[name] == [[at.time_s / 3600, at.separation_m]]).all()
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time (h)", "separation (m)")


def test_axes_that_are_given_are_drawn_in():
    figure, (left, right) = pyplot.subplots(1, 2)
    assert hamjet.transfer(TRANSFER).plot(left) is left
    assert hamjet.validity(VALIDITY).plot(axes=right) is right
    assert pyplot.get_fignums()[-1] == figure.number
