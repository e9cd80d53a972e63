"""Frozen orbits, and deputies that stay with their chief for long without fuel."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from . import _hamjet, arguments, scenes, shown
from .errors import UsageError
from .relative_motion import Flags
from .results import Floats, Progress
from .studies import Study
from .tables import Table, read_table


@dataclass(frozen=True, eq=False)
class FrozenOrbit(Study):
    """The frozen orbit of a chief's energy and angular momentum about the axis; immutable.

    What librates about it is told at C amplitudes of the eccentricity vector, by the normal form;
    without one the arrays are empty.
    """

    state_canonical: Floats  #: (6,): on the chief's mean argument of latitude, with its node
    a_km: float  #: osculating elements there
    e: float  #: eccentricity
    i_deg: float  #: inclination
    argp_deg: float  #: argument of the perigee
    nodal_period_s: float  #: from section to section
    residual: float  #: by how much a revolution moves it, in extended precision
    trace_less_2: float  #: the sum of the two multipliers less 2; stable between -4 and 0
    stable: bool
    amplitudes_m: Floats  #: (C,): of the eccentricity vector, times a
    is_chiefs: Flags  #: (C,): that of the scene's chief
    rotation_numbers: Floats  #: (C,): turns of the pericentre's pair a revolution
    mean_nodal_periods_s: Floats  #: (C,)
    node_deg_per_revolution: Floats  #: (C,)
    misses: Floats  #: (C,): of flown orbits from the normal form, in parts of the amplitude
    reach_m: float  #: the amplitude up to which that is below 0.001; NaN without a normal form
    failure: str  #: not empty: there is no normal form, and why
    verdict: str  #: what ``hamjet poincare`` says first
    table: Table = field(repr=False)  #: the columns of ``poincare.csv``, by name
    _study: _hamjet.PoincareStudy | None = field(repr=False)

    def __repr__(self) -> str:
        return shown.of(self, f": a={self.a_km:.7g} km, e={self.e:.6g}, i={self.i_deg:.7g} deg, "
                        f"argp={self.argp_deg:.6g} deg, {'' if self.stable else 'un'}stable")


@dataclass(frozen=True, eq=False)
class Event(Study):
    """When a condition holds along an orbit, and where, as polynomials; immutable.

    Of the M monomials of the deviations (x, y, z, px, py, pz) of the initial state, in canonical
    units: with ``time_unit_s`` and ``length_km`` the units of time and length.
    """

    time_s: float  #: of the chief's event, after the start
    state_canonical: Floats  #: (6,): the chief's then
    exponents: Floats  #: (M, 6): of each monomial
    coefficients: Floats  #: (M, 7): of the time, and of x, y, z, px, py, pz at the event
    length_km: float  #: the canonical unit of length
    time_unit_s: float  #: the canonical unit of time
    amplitudes_m: Floats  #: (A,): deviations of deputies that were flown
    misses_m: Floats  #: (A,): the largest, in position, of the polynomials; NaN: not flown
    misses_s: Floats  #: (A,): in time
    linear_misses_m: Floats  #: (A,): of the linear polynomials
    linear_misses_s: Floats  #: (A,)
    rounding_m: float  #: of a flown position
    verdict: str  #: what ``hamjet poincare`` says first
    table: Table = field(repr=False)  #: the columns of ``event.csv``, by name
    _study: _hamjet.EventStudy | None = field(repr=False)

    def evaluate(self, deviations: npt.ArrayLike) -> Floats:
        """Time and state of neighbours, canonical.

        ``deviations`` of the initial state, canonical, shape (6,) or (K, 6). Returns (7,) or
        (K, 7): time, x, y, z, px, py, pz. Raises UsageError for other shapes.
        """
        try:
            points = np.asarray(deviations, dtype=float)
        except (TypeError, ValueError) as error:
            raise UsageError(f"deviations: not numbers: {error}") from None
        if points.ndim not in (1, 2) or points.shape[-1] != 6:
            raise UsageError(f"deviations: no array of six numbers a row, got the shape "
                             f"{points.shape}, must be (6,) or (K, 6)")
        if not np.isfinite(points).all():
            raise UsageError("deviations: not finite, must be finite numbers")
        rows = points.reshape(-1, 6)
        values = np.empty((len(rows), self.coefficients.shape[1]))
        exponents = self.exponents.astype(int)
        for first in range(0, len(rows), 4096):  # of which the monomials fit a cache
            part = rows[first:first + 4096]
            powers = part[:, :, None] ** np.arange(exponents.max() + 1)
            monomials = powers[:, 0, exponents[:, 0]]
            for variable in range(1, 6):
                monomials *= powers[:, variable, exponents[:, variable]]
            values[first:first + 4096] = monomials @ self.coefficients
        return values.reshape((*points.shape[:-1], -1))

    def __repr__(self) -> str:
        return shown.of(self, f": after {self.time_s:.9g} s, {len(self.exponents)} monomials; "
                        f"misses up to {shown.largest(self.misses_m)} m for deviations up to "
                        f"{shown.largest(self.amplitudes_m)} m")


@dataclass(frozen=True, eq=False)
class Bounded(Study):
    """Deputies that stay with a chief, K of several sizes and rules; immutable.

    Drifts are mean ones a revolution, in parts of the size, over a tenth of the revolutions and
    over all. NaN stands where there is no such deputy.
    """

    rules: tuple[str, ...]  #: poincare-map, refined, j2-invariant or mean-elements
    wanted_m: Floats  #: (K,): the scene's sizes
    size_m: Floats  #: (K,): the largest distance over the first revolution
    half_widths_m: Floats  #: (K, 3): along R, T, N
    along_drifts: Floats  #: (K, 2)
    along_doubts: Floats  #: (K, 2): by how much these change where the window ends a look earlier
    cross_drifts: Floats  #: (K, 2)
    starts: Floats  #: (K, 6): position in m and velocity in m/s along R, T, N, rotating derivatives
    revolutions: int  #: over which all were flown
    failures: tuple[str, ...]  #: why there is no deputy; empty where there is one
    box_return_times_s: Floats  #: (J,): of the first impulses of the returns into [bounded.box]
    box_return_durations_s: Floats  #: (J,): to the second ones
    box_changes_m_s: Floats  #: (J,): of both impulses
    box_change_m_s_a_day: float  #: NaN without a box
    box_farthest: float  #: from the box's middle, in half widths, as flown; NaN without a box
    verdict: str  #: what ``hamjet bounded`` says first
    table: Table = field(repr=False)  #: the columns of ``bounded.csv``, by name
    _study: _hamjet.BoundedStudy | None = field(repr=False)

    def __repr__(self) -> str:
        return shown.of(self, f": {len(self.rules)} deputies over {self.revolutions} revolutions, "
                        f"{shown.listed(dict.fromkeys(self.rules))}\n along-track drift up to "
                        f"{shown.largest(self.along_drifts[:, 1])} of the size a revolution")


def poincare(scene: scenes.Scene, *, overrides: scenes.Overrides | None = None,
             progress: Progress | None = None) -> FrozenOrbit:
    """The frozen orbit of a scene's chief, as ``hamjet poincare`` finds it without a table [event].

    Arguments as of ``run``. Raises SceneError, UsageError, NumericalError (no frozen orbit, or a
    chief near the equatorial plane), TooLargeError, InputOutputError.
    """
    study = _hamjet.study_poincare(scenes.read(scene, overrides), arguments.progress(progress))
    return FrozenOrbit(**study.arrays(), table=read_table(study.csv), _study=study)


def event(scene: scenes.Scene, *, overrides: scenes.Overrides | None = None,
          progress: Progress | None = None) -> Event:
    """Time and state at a condition along the orbit, as ``hamjet poincare`` finds them.

    The scene has a table [event]; arguments as of ``run``. Raises SceneError (also for fewer
    events within the duration than asked for), UsageError, NumericalError (the orbit only touches
    the surface), TooLargeError, InputOutputError.
    """
    study = _hamjet.study_event(scenes.read(scene, overrides), arguments.progress(progress))
    return Event(**study.arrays(), table=read_table(study.csv), _study=study)


def bounded(scene: scenes.Scene, *, overrides: scenes.Overrides | None = None,
            progress: Progress | None = None) -> Bounded:
    """Deputies that stay with a scene's chief, as ``hamjet bounded`` finds them.

    The scene has a table [bounded]; arguments as of ``run``. Raises as ``poincare``.
    """
    study = _hamjet.study_bounded(scenes.read(scene, overrides), arguments.progress(progress))
    return Bounded(**study.arrays(), table=read_table(study.csv), _study=study)
