"""Frozen and periodic orbits, and deputies that stay with their chief for long without fuel."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from . import _hamjet, arguments, scenes, shown
from .errors import UsageError
from .results import Floats, Progress
from .studies import Columns, Study, of_table


class FrozenOrbit(Study, table="poincare"):
    """The frozen orbit of a chief's energy and angular momentum about the axis; immutable.

    What librates about it is told on circles of the normal form; without one the arrays are empty.
    The further table ``frozen_orbit`` has the orbit's elements, period and multipliers.
    """

    frozen_orbit: Columns

    def __repr__(self) -> str:
        orbit = self.frozen_orbit
        return shown.of(self, f": a={orbit.a_km:.7g} km, e={orbit.e:.6g}, i={orbit.i_deg:.7g} deg, "
                        f"argp={orbit.argp_deg:.6g} deg, {'' if orbit.stable else 'un'}stable")


class Event(Study, table="event"):
    """When a condition holds along an orbit, and where, as polynomials; immutable.

    Of the M monomials of the V deviations of the initial state, in canonical units: with
    ``time_unit_s`` and ``length_km`` the units of time and length. They are x, y, z, px, py, pz of
    an orbit (V = 6), and the coordinates and momenta of a system of one's own.
    """

    exponents: Floats  #: (M, V): of each monomial
    coefficients: Floats  #: (M, 1 + V): of the time, and of the state at the event
    length_km: float  #: the canonical unit of length
    time_unit_s: float  #: the canonical unit of time

    def __init__(self, study: _hamjet.EventStudy) -> None:
        super().__init__(study)
        vars(self).update(study.polynomials())

    def evaluate(self, deviations: npt.ArrayLike) -> Floats:
        """Time and state of neighbours, canonical.

        ``deviations`` of the initial state, canonical, shape (V,) or (K, V). Returns (1 + V,) or
        (K, 1 + V): the time, and the state. Raises UsageError for other shapes.
        """
        count = self.exponents.shape[1]
        try:
            points = np.asarray(deviations, dtype=float)
        except (TypeError, ValueError) as error:
            raise UsageError(f"deviations: not numbers: {error}") from None
        if points.ndim not in (1, 2) or points.shape[-1] != count:
            raise UsageError(f"deviations: no array of {count} numbers a row, got the shape "
                             f"{points.shape}, must be ({count},) or (K, {count})")
        if not np.isfinite(points).all():
            raise UsageError("deviations: not finite, must be finite numbers")
        rows = points.reshape(-1, count)
        values = np.empty((len(rows), self.coefficients.shape[1]))
        exponents = self.exponents.astype(int)
        for first in range(0, len(rows), 4096):  # of which the monomials fit a cache
            part = rows[first:first + 4096]
            powers = part[:, :, None] ** np.arange(exponents.max() + 1)
            monomials = powers[:, 0, exponents[:, 0]]
            for variable in range(1, count):
                monomials *= powers[:, variable, exponents[:, variable]]
            values[first:first + 4096] = monomials @ self.coefficients
        return values.reshape((*points.shape[:-1], -1))

    def __repr__(self) -> str:
        return shown.of(self, f": after {self.time_s:.9g} s, {len(self.exponents)} monomials; "
                        f"misses up to {shown.largest(self.position_miss_m)} m for deviations up "
                        f"to {shown.largest(self.amplitude_m)} m")


class Bounded(Study, table="bounded"):
    """Deputies that stay with a chief, of several sizes and rules; immutable.

    NaN or None stands where there is no such deputy. The further table ``box`` has the returns of
    a deputy that is kept in [bounded.box]; it is None without one.
    """

    box: Columns | None = None

    def starts(self, form: str = "RTN-rotating") -> Floats:
        """Initial conditions of the K deputies in a form, (K, 6): its columns in their order.

        Raises UsageError for a form that no column begins with.
        """
        columns = [column for name, column in self.table.items() if name.startswith(f"{form}.")]
        if not columns:
            forms = dict.fromkeys(name.split(".")[0] for name in self.table if "." in name)
            raise UsageError(f"starts: no form {form!r}, must be one of {', '.join(forms)}")
        return np.column_stack(columns)

    def __repr__(self) -> str:
        return shown.of(self, f": {len(self.rule)} deputies over {self.revolutions} revolutions, "
                        f"{shown.listed(dict.fromkeys(self.rule))}\n along-track drift up to "
                        f"{shown.largest(self.window_along_drift)} of the size a revolution")


class Periodic(Study, table="periodic"):
    """A periodic orbit, or a family of them; immutable.

    ``end`` says why a family does not reach its last value, and is None where it does.
    """

    def __repr__(self) -> str:
        along = f" along {self.along}" if self.along else ""
        return shown.of(self, f": {len(self.energy)} orbits{along}, periods up to "
                        f"{shown.largest(self.period_canonical)}, closing to "
                        f"{shown.largest(self.closing)}")


def poincare(scene: scenes.Scene, *, overrides: scenes.Overrides | None = None,
             progress: Progress | None = None) -> FrozenOrbit:
    """The frozen orbit of a scene's chief, as ``hamjet poincare`` finds it without a table [event].

    Arguments as of ``run``. Raises SceneError, UsageError, NumericalError (no frozen orbit, or a
    chief near the equatorial plane), TooLargeError, InputOutputError.
    """
    return FrozenOrbit(of_table("", scene, overrides, progress))


def event(scene: scenes.Scene, *, overrides: scenes.Overrides | None = None,
          progress: Progress | None = None) -> Event:
    """Time and state at a condition along the orbit, as ``hamjet poincare`` finds them.

    The scene has a table [event]; arguments as of ``run``. Raises SceneError (also for fewer
    events within the duration than asked for), UsageError, NumericalError (the orbit only touches
    the surface), TooLargeError, InputOutputError.
    """
    study = _hamjet.study_event(scenes.read(scene, overrides), arguments.progress(progress))
    return Event(study)


def bounded(scene: scenes.Scene, *, overrides: scenes.Overrides | None = None,
            progress: Progress | None = None) -> Bounded:
    """Deputies that stay with a scene's chief, as ``hamjet bounded`` finds them.

    The scene has a table [bounded]; arguments as of ``run``. Raises as ``poincare``.
    """
    return Bounded(of_table("bounded", scene, overrides, progress))


def periodic(scene: scenes.Scene, *, overrides: scenes.Overrides | None = None,
             progress: Progress | None = None) -> Periodic:
    """A scene's periodic orbit and its family, as ``hamjet periodic`` finds them.

    The scene has a table [periodic]; arguments as of ``run``. Raises as ``poincare``, NumericalError
    where no orbit is found.
    """
    return Periodic(of_table("periodic", scene, overrides, progress))
