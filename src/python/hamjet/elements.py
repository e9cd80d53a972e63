"""Orbits as states and as elements, osculating and mean."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from . import _hamjet, arguments
from .errors import UsageError
from .results import Floats


def _rows(values: npt.ArrayLike, place: str) -> Floats:
    """One row of six numbers, or rows of them, as rows."""
    try:
        rows = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise UsageError(f"{place}: wrong type, must be an array of numbers") from None
    if rows.ndim not in (1, 2) or rows.shape[-1] != 6:
        raise UsageError(f"{place}: wrong shape, got {rows.shape}, must be (6,) or (N, 6)")
    if not np.isfinite(rows).all():
        raise UsageError(f"{place}: not finite, must be finite numbers")
    return rows


def _of_shape(result: Floats, rows: Floats) -> Floats:
    return result.reshape(rows.shape)


def elements_of_states(states: npt.ArrayLike, *, mu_km3_s2: float) -> Floats:
    """Osculating elements of inertial states.

    states: (6,) or (N, 6), x, y, z in km and their rates in km/s. Returns as many rows of a in km,
    e, and in degrees inclination, node, argument of perigee and true anomaly, from 0 to 360; of a
    circle the perigee is the node, and of an equatorial orbit the node is the x axis. Raises
    UsageError, and NumericalError for what is no ellipse.
    """
    rows = _rows(states, "states")
    mu = arguments.positive(mu_km3_s2, "mu_km3_s2")
    return _of_shape(_hamjet.elements_of_states(np.atleast_2d(rows), mu), rows)


def states_of_elements(elements: npt.ArrayLike, *, mu_km3_s2: float) -> Floats:
    """Inertial states of osculating elements: the inverse of ``elements_of_states``.

    elements: (6,) or (N, 6), as it returns them. Returns x, y, z in km and their rates in km/s.
    Raises UsageError.
    """
    rows = _rows(elements, "elements")
    mu = arguments.positive(mu_km3_s2, "mu_km3_s2")
    return _of_shape(_hamjet.states_of_elements(np.atleast_2d(rows), mu), rows)


def mean_states(states: npt.ArrayLike, *, mu_km3_s2: float, radius_km: float,
                J2: float) -> Floats:
    """The mean states of osculating ones, by Brouwer's theory of first order in J2.

    states: (6,) or (N, 6), km and km/s; elements of what is returned, by ``elements_of_states``,
    are mean elements: without the terms of the period of the orbit and of the perigee. Near the
    critical inclinations, 63.43 and 116.57 degrees, the latter stay in them. What is left out is
    (1.5 J2 R^2/p^2)^2, some 1e-6, and J3 and higher harmonics. Raises UsageError, and
    NumericalError for what is no ellipse and where J2 is too large.
    """
    rows = _rows(states, "states")
    return _of_shape(_hamjet.mean_states(
        np.atleast_2d(rows), arguments.positive(mu_km3_s2, "mu_km3_s2"),
        arguments.positive(radius_km, "radius_km"), arguments.number(J2, "J2")), rows)


def osculating_states(states: npt.ArrayLike, *, mu_km3_s2: float, radius_km: float,
                      J2: float) -> Floats:
    """The osculating states of mean ones: the inverse of ``mean_states``, to rounding.

    states: (6,) or (N, 6), km and km/s. Raises UsageError, and NumericalError for what is no
    ellipse.
    """
    rows = _rows(states, "states")
    return _of_shape(_hamjet.osculating_states(
        np.atleast_2d(rows), arguments.positive(mu_km3_s2, "mu_km3_s2"),
        arguments.positive(radius_km, "radius_km"), arguments.number(J2, "J2")), rows)
