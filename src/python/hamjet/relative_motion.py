"""Motion of a deputy, transfers between places, and how far polynomials can be trusted."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _hamjet, arguments, plots, scenes, shown
from .immutable import Immutable
from .results import Floats, Progress
from .studies import Study, required_study
from .tables import Table, read_table

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


@dataclass(frozen=True, eq=False)
class Motion(Study):
    """How a deputy moves relative to its chief, at T times; immutable, arrays read-only.

    The times are equal steps of the chief's eccentric anomaly, so that perigee has as many of them
    as apogee.

    Places are those of the deputy as it flew with the full equations of motion, and errors the
    distances from there to where the polynomials of the orders 1 to N have it.
    """

    frame: str  #: the scene's, in words: "RTN with rotating derivatives" unless it says another
    times_s: Floats  #: (T,): the first is 0
    position_m: Floats  #: (T, 3): along the axes of the frame; of RTN: R, T, N
    velocity_m_s: Floats  #: (T, 3)
    separation_m: Floats  #: (T,): the distance of the two
    error_by_order_m: Floats  #: (T, N): of the polynomial orders 1 to N
    flight_floor_m: float  #: errors below this say nothing
    nearest: Separation  #: the least separation, between the times too
    farthest: Separation  #: the greatest, likewise
    verdict: str  #: how near, how far and how wrong: what ``hamjet motion`` says first
    table: Table = field(repr=False)  #: the columns of ``motion.csv``, by name
    _study: _hamjet.MotionStudy | None = field(repr=False)

    def __repr__(self) -> str:
        return shown.of(self, f": {shown.span(self.times_s)}, {self.frame}\n"
                        f" nearest {self.nearest.separation_m:.6g} m at {self.nearest.time_s:.6g} "
                        f"s, farthest {self.farthest.separation_m:.6g} m at "
                        f"{self.farthest.time_s:.6g} s\n"
                        f" order {self.error_by_order_m.shape[1]} is wrong by up to "
                        f"{shown.largest(self.error_by_order_m[:, -1])} m")

    def plot(self, axes: Any = None) -> Any:
        """Draws the separation along time, with its least and its greatest.

        axes: of matplotlib; None: those of a new figure. Returns the axes. Raises ImportError where
        matplotlib is not installed.
        """
        return plots.draw_motion(self, axes)


@dataclass(frozen=True, eq=False)
class Transfers(Study):
    """Velocity changes for T transfer times; immutable, arrays read-only.

    Velocity changes are along the axes of the scene's frame; misses are distances of the flown
    deputy from the wanted place. NaN stands where there is no answer.
    """

    times_s: Floats  #: (T,)
    #: The generating function used; None where no kind exists, or in other coordinates.
    kinds: tuple[str | None, ...]
    conditions: Floats  #: (T,): of its linear part
    position_conditions: Floats  #: (T,): of F1's; infinite where positions cannot be commanded
    singular_distances_s: Floats  #: (T,): to the nearest singularity of F1; NaN: there is none
    start_change_m_s: Floats  #: (T, 3): of the best answer, refined where the scene refines
    end_change_m_s: Floats  #: (T, 3)
    total_change_m_s: Floats  #: (T,): sum of the two magnitudes
    miss_m: Floats  #: (T,)
    start_change_by_order_m_s: Floats  #: (T, N, 3): of the polynomial orders 1 to N
    end_change_by_order_m_s: Floats  #: (T, N, 3)
    miss_by_order_m: Floats  #: (T, N)
    refined: Flags  #: (T,): whether the best answer was corrected by flying
    near_singular: Flags  #: (T,): nearer to a singularity than the scene's margin
    beyond_tolerance: Flags  #: (T,): the miss of the order N exceeds the scene's tolerance
    hamilton_jacobi_residuals: Floats  #: (T,): worst scaled residual over all degrees
    #: (T,): an impulse is above the scene's largest_impulse_m_s, or the way enters its keep_out_m
    forbidden: Flags
    failures: tuple[str, ...]  #: what failed at each time; empty where nothing did
    #: (K, 2): spans of time that take no more than the scene's budget_m_s; empty without one
    budget_windows_s: Floats
    singular_times_s: Floats  #: at which F1 does not exist, all within the span
    flight_floor_m: float  #: misses below this say nothing
    #: Index of the least total change among answers within the tolerance, away from singularities
    #: and not forbidden; None if there is none.
    best: int | None
    #: The command's exit code: 0; 1, if all answers are forbidden, optimal impulses asked for were
    #: not found, or strict and an answer is missing or too far off; 4, without answers.
    exit_code: int
    table: Table = field(repr=False)  #: the columns of ``transfers.csv``, by name
    _study: _hamjet.TransferStudy | None = field(repr=False)

    def __repr__(self) -> str:
        best = "no answer within the tolerance and away from singularities"
        if self.best is not None:
            best = (f"best={self.best}: {self.total_change_m_s[self.best]:.6g} m/s in "
                    f"{self.times_s[self.best]:.6g} s, missing by "
                    f"{self.miss_m[self.best]:.3g} m")
        answered = int(np.isfinite(self.total_change_m_s).sum())
        return shown.of(self, f": {shown.span(self.times_s)}, orders 1 to "
                        f"{self.miss_by_order_m.shape[1]}\n {answered} answered, "
                        f"{int(self.near_singular.sum())} near a singularity, "
                        f"{int(self.beyond_tolerance.sum())} beyond the tolerance\n {best}")

    def trajectory(self, index: int, count: int = 400) -> tuple[Floats, Floats]:
        """The flown deputy of one transfer time's best answer, at ``count`` equal intervals.

        index: of the transfer time, from 0. count: 1 to 1000000.
        Returns times in s, (count + 1,), and states, (count + 1, 6), in m and m/s along R, T, N of
        the chief with rotating derivatives. Raises UsageError, also if this time has no answer.
        """
        return required_study(self._study, "trajectory").fly(
            arguments.integer(index, "trajectory: index", 0, len(self.times_s) - 1),
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


@dataclass(frozen=True, eq=False)
class Assignment(Study):
    """Deputies sent to slots at the least total velocity change, K transfers; immutable."""

    deputies: Indices  #: (K,): of each transfer, from 0
    slots: Indices  #: (K,): where it goes
    times_s: Floats  #: (K,): transfer times
    start_change_m_s: Floats  #: (K, 3): along the axes of the scene's frame
    end_change_m_s: Floats  #: (K, 3)
    total_change_m_s: Floats  #: (K,): sum of the two magnitudes
    miss_m: Floats  #: (K,): of the deputy, flown, from its slot
    beyond_tolerance: Flags  #: (K,): the miss of the highest order exceeds the scene's tolerance
    costs_m_s: Floats  #: (deputies, slots): the least change of each; NaN where there is no answer
    pairs: Indices  #: (P, 2): two deputies each
    pair_separation_m: Floats  #: (P,): the least while both fly
    pair_times_s: Floats  #: (P,): when it is
    flight_floor_m: float  #: misses below this say nothing
    failure: str  #: not empty: there are not as many transfers as deputies or slots, and why
    #: The command's exit code: 0; 1, if a transfer is forbidden, deputies come nearer than the
    #: scene's keep_apart_m, or strict and one is too far off; 4, without an assignment.
    exit_code: int
    table: Table = field(repr=False)  #: the columns of ``assignment.csv``, by name
    _study: _hamjet.AssignmentStudy | None = field(repr=False)

    def __repr__(self) -> str:
        if self.failure:
            return shown.of(self, f": {self.failure}")
        nearest = ""
        if len(self.pairs):
            k = int(self.pair_separation_m.argmin())
            nearest = (f"\n nearest: deputies {self.pairs[k, 0]} and {self.pairs[k, 1]}, "
                       f"{self.pair_separation_m[k]:.6g} m at {self.pair_times_s[k]:.6g} s")
        return shown.of(self, f" of {len(self.deputies)} deputies: "
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
    nearest, farthest = (Separation(*place) for place in study.extremes())
    return Motion(**study.arrays(), nearest=nearest, farthest=farthest,
                  table=read_table(study.csv), _study=study)


def transfer(scene: scenes.Scene, *, coordinates: str | None = None,
             overrides: scenes.Overrides | None = None,
             progress: Progress | None = None) -> Transfers:
    """Velocity changes from one relative position to another, as ``hamjet transfer`` finds them.

    The scene has a table [transfer]; coordinates, of the polynomials at both ends, as of
    ``polynomials``; other arguments as of ``run``. Raises SceneError, UsageError,
    NumericalError, TooLargeError, InputOutputError.
    """
    study = _hamjet.study_transfers(scenes.read(scene, overrides, coordinates=coordinates), arguments.progress(progress))
    return Transfers(**study.arrays(), exit_code=study.exit_code,
                     table=read_table(study.csv), _study=study)


def validity(scene: scenes.Scene, *, coordinates: str | None = None,
             overrides: scenes.Overrides | None = None,
             progress: Progress | None = None) -> Validity:
    """How far from the chief the polynomials are right, as ``hamjet validity`` finds it.

    The scene has a table [validity]; coordinates, of the polynomials at both ends, as of
    ``polynomials``; other arguments as of ``run``. Raises as ``transfer``.
    """
    study = _hamjet.study_separations(scenes.read(scene, overrides, coordinates=coordinates), arguments.progress(progress))
    return Validity(study)


def assign(scene: scenes.Scene, *, coordinates: str | None = None,
           overrides: scenes.Overrides | None = None,
           progress: Progress | None = None) -> Assignment:
    """Which deputy goes to which slot, and when, as ``hamjet assign`` finds it.

    The scene has tables [transfer] and [assignment]; coordinates, of the polynomials at both ends,
    as of ``polynomials``; other arguments as of ``run``. Raises as ``transfer``.
    """
    study = _hamjet.study_assignment(scenes.read(scene, overrides, coordinates=coordinates), arguments.progress(progress))
    return Assignment(**study.arrays(), exit_code=study.exit_code, table=read_table(study.csv),
                      _study=study)
