"""States along other axes of the Earth."""

from __future__ import annotations

import os
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from . import _hamjet, arguments
from .elements import _of_shape, _rows
from .errors import UsageError
from .results import Floats


def change_axes(states: npt.ArrayLike, epochs: str | Sequence[str], from_axes: str,
                to_axes: str = "GCRF", *, time_system: str = "UTC",
                orientation_file: str | os.PathLike[str] | None = None) -> Floats:
    """States about the Earth along other axes than those in which they are given.

    states: (6,) or (N, 6), x, y, z in km and their rates in km/s. epochs: as many dates, such as
    "2010-07-27T00:05:00", in ``time_system`` (UTC, TAI, TT, GPS, TDB). Axes: GCRF, EME2000, MOD,
    TOD, TEME, CIRF, ITRF, as in scenes (IAU 2006/2000A); velocities along ITRF are relative to the
    Earth that turns. orientation_file: the finals2000A of the IERS, for ITRF; without one UT1 is
    UTC and the pole does not move. Returns as many rows. Raises UsageError, InputOutputError.
    """
    rows = _rows(states, "states")
    dates = [epochs] if isinstance(epochs, str) else [str(epoch) for epoch in epochs]
    if len(dates) != len(np.atleast_2d(rows)):
        raise UsageError(f"epochs: wrong number, got {len(dates)}, must be one of each of the "
                         f"{len(np.atleast_2d(rows))} states")
    file = None if orientation_file is None else arguments.path(orientation_file,
                                                               "orientation_file")
    return _of_shape(_hamjet.change_axes(
        np.atleast_2d(rows), [arguments.text(date, "epochs") for date in dates],
        arguments.text(from_axes, "from_axes"), arguments.text(to_axes, "to_axes"),
        arguments.text(time_system, "time_system"), file), rows)
