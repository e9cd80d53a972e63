"""Motion of a deputy, transfers between places, and how far polynomials can be trusted."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _hamjet, arguments, plots, scenes, shown
from .immutable import Immutable
from .results import Floats, Progress
from .studies import Study, of_table, required_study

Flags = npt.NDArray[np.bool_]
Indices = npt.NDArray[np.int64]

#: Most intervals of one trajectory: more would be gigabytes of a smooth curve.
_MOST_INTERVALS = 1_000_000


@dataclass(frozen=True, eq=False)
class Separation(Immutable):
    """Where a deputy is beside its chief at one time; immutable, arrays read-only."""

    time_s: float  #: since the start
    separation_m: float  #: the distance of the two
    position_m: Floats  #: (3,): along the axes of the motion's frame
    velocity_m_s: Floats  #: (3,)

    def __repr__(self) -> str:
        return shown.of(self, f": {self.separation_m:.6g} m at {self.time_s:.6g} s")


class Motion(Study, table="motion"):
    """How a deputy moves relative to its chief; immutable, arrays read-only.

    The times are equal steps of the chief's eccentric anomaly, so that perigee has as many of them
    as apogee. Places are those of the deputy as it flew with the full equations of motion.
    """

    nearest: Separation  #: the least separation, between the times too
    farthest: Separation  #: the greatest, likewise

    def __init__(self, study: _hamjet.MotionStudy) -> None:
        super().__init__(study)
        nearest, farthest = (Separation(*place) for place in study.extremes())
        vars(self).update(nearest=nearest, farthest=farthest)

    def __repr__(self) -> str:
        kind = f" with {self.derivatives} derivatives" if self.derivatives else ""
        return shown.of(self, f": {shown.span(self.time_s)}, {self.frame}{kind}\n"
                        f" nearest {self.nearest.separation_m:.6g} m at {self.nearest.time_s:.6g} "
                        f"s, farthest {self.farthest.separation_m:.6g} m at "
                        f"{self.farthest.time_s:.6g} s\n"
                        f" order {self.error_m_by_order.shape[1]} is wrong by up to "
                        f"{shown.largest(self.error_m_by_order[:, -1])} m")

    def plot(self, axes: Any = None) -> Any:
        """Draws the separation along time, with its least and its greatest.

        axes: of matplotlib; None: those of a new figure. Returns the axes. Raises ImportError where
        matplotlib is not installed.
        """
        return plots.draw_motion(self, axes)


class Transfers(Study, table="transfers"):
    """Velocity changes by transfer time; immutable, arrays read-only.

    The further tables, attributes with columns of their own: ``singular_times``, ``conditions`` of
    all kinds, ``budget_windows``, ``impulses`` of the optimal plan and ``least_by_time``, what
    these cost, ``waypoints``, impulses of the way through them, and ``total_by_time``;
    ``energy_optimal``, transfers with a thrust that lasts, ``thrust_profile``, the thrust along
    the way of the least, ``feedback``, that thrust as polynomials of the deputy's state (powers and
    coefficients by instant and monomial), ``feedback_errors``, misses and costs of flights by it and
    as planned under errors, and ``feedback_samples``, each of these; ``fuel_optimal``, transfers by
    full thrust or none, ``fuel_optimal_burns`` of these and ``primer_profile``, the primer vector
    along the way of the least; ``burns`` of a thruster in place of impulses.
    """

    def __repr__(self) -> str:
        best = "no answer within the tolerance and away from singularities"
        if self.best is not None:
            best = (f"best={self.best}: {self.total_change_m_s[self.best]:.6g} m/s in "
                    f"{self.time_s[self.best]:.6g} s, missing by "
                    f"{self.miss_m[self.best]:.3g} m")
        answered = int(np.isfinite(self.total_change_m_s).sum())
        return shown.of(self, f": {shown.span(self.time_s)}, orders 1 to "
                        f"{self.miss_m_by_order.shape[1]}\n {answered} answered, "
                        f"{int(self.near_singular.sum())} near a singularity, "
                        f"{int(self.beyond_tolerance.sum())} beyond the tolerance\n {best}")

    def trajectory(self, index: int, count: int = 400) -> tuple[Floats, Floats]:
        """The flown deputy of one transfer time's best answer, at ``count`` equal intervals.

        index: of the transfer time, from 0. count: 1 to 1000000.
        Returns times in s, (count + 1,), and states, (count + 1, 6), in m and m/s along R, T, N of
        the chief with rotating derivatives. Raises UsageError, also if this time has no answer.
        """
        study: _hamjet.TransferStudy = required_study(self._study, "trajectory")
        return study.fly(
            arguments.integer(index, "trajectory: index", 0, len(self.time_s) - 1),
            arguments.integer(count, "trajectory: count", 1, _MOST_INTERVALS))

    def plot(self, axes: Any = None) -> Any:
        """Draws the least velocity change of each transfer time, with what is singular marked.

        axes: of matplotlib; None: those of a new figure. Returns the axes. Raises ImportError where
        matplotlib is not installed.
        """
        return plots.draw_transfers(self, axes)


class Validity(Study, table="validity"):
    """Separations up to which the polynomials are right; immutable, arrays read-only."""

    def __repr__(self) -> str:
        least = shown.listed(f"order {order} {proved_m.min():.4g} m"
                             for order, proved_m in enumerate(self.proved_m.T, start=1))
        return shown.of(self, f": {shown.span(self.time_s)}\n right at all times up to: {least}")

    def plot(self, axes: Any = None) -> Any:
        """Draws the proved separation of each order along time.

        axes: of matplotlib; None: those of a new figure. Returns the axes. Raises ImportError where
        matplotlib is not installed.
        """
        return plots.draw_validity(self, axes)


class Assignment(Study, table="assignment"):
    """Deputies sent to slots at the least total velocity change; immutable, arrays read-only.

    The further tables, attributes with columns of their own: ``costs`` of each deputy and slot, and
    ``pairs``, how near two deputies come to each other.
    """

    def __repr__(self) -> str:
        if self.not_assigned:
            return shown.of(self, f": {self.not_assigned}")
        nearest, pairs = "", self.pairs
        if len(pairs.deputy):
            k = int(pairs.least_separation_m.argmin())
            nearest = (f"\n nearest: deputies {pairs.deputy[k]} and {pairs.other_deputy[k]}, "
                       f"{pairs.least_separation_m[k]:.6g} m at {pairs.time_s[k]:.6g} s")
        return shown.of(self, f" of {len(self.deputy)} deputies: "
                        f"{self.total_change_m_s.sum():.6g} m/s in all{nearest}")


def motion(scene: scenes.Scene, *, coordinates: str | None = None,
           overrides: scenes.Overrides | None = None,
           progress: Progress | None = None) -> Motion:
    """Where a deputy goes by itself, as seen from its chief, as ``hamjet motion`` finds it.

    The scene has a table [deputy]; coordinates, of the polynomials at both ends, as of
    ``polynomials``; other arguments as of ``run``. Raises SceneError, UsageError,
    NumericalError, TooLargeError, InputOutputError.
    """
    study = _hamjet.study_motion(scenes.read(scene, overrides, coordinates=coordinates), arguments.progress(progress))
    return Motion(study)


def transfer(scene: scenes.Scene, *, coordinates: str | None = None,
             overrides: scenes.Overrides | None = None,
             progress: Progress | None = None) -> Transfers:
    """Velocity changes from one relative position to another, as ``hamjet transfer`` finds them.

    The scene has a table [transfer]; coordinates, of the polynomials at both ends, as of
    ``polynomials``; other arguments as of ``run``. Raises SceneError, UsageError,
    NumericalError, TooLargeError, InputOutputError.
    """
    study = _hamjet.study_transfers(scenes.read(scene, overrides, coordinates=coordinates), arguments.progress(progress))
    return Transfers(study)


def validity(scene: scenes.Scene, *, coordinates: str | None = None,
             overrides: scenes.Overrides | None = None,
             progress: Progress | None = None) -> Validity:
    """How far from the chief the polynomials are right, as ``hamjet validity`` finds it.

    The scene has a table [validity]; coordinates, of the polynomials at both ends, as of
    ``polynomials``; other arguments as of ``run``. Raises as ``transfer``.
    """
    return Validity(of_table("validity", scene, overrides, progress, coordinates))


def assign(scene: scenes.Scene, *, coordinates: str | None = None,
           overrides: scenes.Overrides | None = None,
           progress: Progress | None = None) -> Assignment:
    """Which deputy goes to which slot, and when, as ``hamjet assign`` finds it.

    The scene has tables [transfer] and [assignment]; coordinates, of the polynomials at both ends,
    as of ``polynomials``; other arguments as of ``run``. Raises as ``transfer``.
    """
    return Assignment(of_table("assignment", scene, overrides, progress, coordinates))
