"""A run's jets at any time of its duration."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, overload

import numpy as np
import numpy.typing as npt

from . import _hamjet, arguments, scenes, shown
from ._hamjet import Jet
from .errors import UsageError
from .relative_states import RelativeStates, joined
from .results import Floats, Progress


class Trajectory:
    """The jets of a flow at every time of its duration, from one run; immutable.

    The run keeps its jets at the ends of its steps; the jet at a time between two of them is one
    more step of the same symplectic method, as right as the ends are.
    """

    def __init__(self, study: _hamjet.TrajectoryStudy) -> None:
        self._study = study

    @property
    def run(self) -> str:
        """The label of the run."""
        return self._study.label

    @property
    def duration_s(self) -> float:
        """The last of the times, in s; negative where the scene goes backwards."""
        return self._study.duration_s

    @property
    def step_times_s(self) -> Floats:
        """Where the steps of the run begin and end, from 0 to the duration, in s."""
        return self._study.step_times_s

    def __repr__(self) -> str:
        return shown.of(self, f": run {self.run}, {shown.span(self.step_times_s, 'ends of steps')}")

    @overload
    def at(self, time_s: float) -> Jet: ...

    @overload
    def at(self, time_s: Sequence[float] | npt.NDArray[np.floating[Any]]) -> list[Jet]: ...

    def at(self, time_s: Any) -> Jet | list[Jet]:
        """The jet at a time, in s since the start, between 0 and the duration.

        time_s: a number, or several, (T,), of which it gives a list of jets. At the duration it is
        that of ``run``, bit by bit. Raises UsageError for other times.
        """
        if isinstance(time_s, (Sequence, np.ndarray)) and not isinstance(time_s, str):
            if np.ndim(time_s) == 1:
                return [self._at(time) for time in time_s]
        return self._at(time_s)

    def _at(self, time_s: float) -> Jet:
        time = arguments.number(time_s, "time_s")
        # The seconds that a scene was given are rounded in its canonical unit.
        if abs(time - self.duration_s) <= 4 * np.spacing(abs(self.duration_s)):
            time = self.duration_s
        if not min(0.0, self.duration_s) <= time <= max(0.0, self.duration_s):
            raise UsageError(f"time_s: out of range, got {time:g}, must be a number from 0 to "
                             f"{self.duration_s:g}")
        return self._study.at(time)

    def evaluate_relative(self, state: npt.ArrayLike, times_s: npt.ArrayLike, *,
                          frame: str = "RTN", to: str | None = None,
                          derivatives: str | None = None, degree: int | None = None,
                          strict: bool = False) -> RelativeStates:
        """Where one deputy is at each of several times.

        state: (6,), relative to the chief at the start. times_s: (T,), in s. The others as of
        ``Jet.evaluate_relative``, which is done at each time. Returns its result with a row a time;
        the distances are ``numpy.linalg.norm(result.states[:, :3], axis=1)`` in frames of lengths.
        Raises UsageError, and NumericalError if strict.
        """
        try:
            deputy = np.asarray(state, dtype=np.float64)
            times = np.asarray(times_s, dtype=np.float64)
        except (TypeError, ValueError):
            raise UsageError("state and times_s: wrong type, must be arrays of numbers") from None
        if deputy.shape != (6,):
            raise UsageError(f"state: wrong shape, got {deputy.shape}, must be (6,): of one deputy")
        if times.ndim != 1 or not len(times):
            raise UsageError(f"times_s: wrong shape, got {times.shape}, must be (T,), T at least 1")
        return joined([self._at(time).evaluate_relative(
            deputy[np.newaxis], frame=frame, to=to, derivatives=derivatives, degree=degree,
            strict=strict) for time in times])


def trajectory(scene: scenes.Scene, *, run: str | None = None,
               overrides: scenes.Overrides | None = None,
               progress: Progress | None = None) -> Trajectory:
    """The jets of a scene's flow at any time, from one run.

    run: the label of an integrator, of the method gauss; None: the first that is. The others as of
    ``hamjet.run``. Raises SceneError, UsageError, NumericalError, TooLargeError, InputOutputError.
    """
    label = "" if run is None else arguments.text(run, "run")
    given = scenes.read(scene, overrides)
    return Trajectory(_hamjet.follow(given, label, arguments.progress(progress)))
