"""Many orbits of one scene, integrated side by side."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from . import _hamjet, arguments, scenes, shown
from ._hamjet import Jet
from .errors import UsageError
from .results import Floats, Progress


class ManyJets:
    """The jets of many orbits, each about an initial state of its own; immutable.

    Of M orbits, with c components, v variables and k coefficients a component:

      coefficients   (M, c, k) float64, as ``Jet.coefficients`` of each; NaN where an orbit failed
      exponents      (k, v) uint8, those of ``Jet.exponents``
      failures       what ``hamjet.run`` would raise for an orbit alone, by the orbit's number
      steps          (M,) the steps that each took, of its own
      were_alone     (M,) True where lanes did not suffice and the orbit was integrated by itself
    """

    def __init__(self, study: _hamjet.ManyStudy) -> None:
        self._study = study
        self._coefficients = study.coefficients()

    @property
    def run(self) -> str:
        """The label of the integrator."""
        return self._study.label

    @property
    def duration_s(self) -> float:
        """How long each was integrated, in s; negative where the scene goes backwards."""
        return self._study.duration_s

    @property
    def coefficients(self) -> Floats:
        """(M, c, k), canonical; column 0 is the final state."""
        return self._coefficients

    @property
    def exponents(self) -> npt.NDArray[np.uint8]:
        """(k, v): the powers of the initial deviations."""
        return self._study.exponents()

    @property
    def final_states(self) -> Floats:
        """(M, c): where each orbit ends, canonical."""
        return self._coefficients[:, :, 0]

    @property
    def linear_parts(self) -> Floats:
        """(M, c, v): the state transition matrices, canonical. Raises UsageError at order 0."""
        variables = self.exponents.shape[1]
        if self._coefficients.shape[2] <= variables:
            raise UsageError("linear_parts: the order is 0, must be at least 1")
        return self._coefficients[:, :, 1:1 + variables]

    @property
    def failures(self) -> Mapping[int, str]:
        """The errors' lines, by orbit."""
        return self._study.failures

    @property
    def steps(self) -> npt.NDArray[np.int_]:
        """(M,): steps taken; 0 where an orbit failed."""
        return self._study.steps

    @property
    def were_alone(self) -> npt.NDArray[np.bool_]:
        """(M,): whether an orbit was integrated by itself."""
        return self._study.were_alone

    def __len__(self) -> int:
        return len(self._coefficients)

    def __repr__(self) -> str:
        failed = f", {len(self.failures)} failed" if self.failures else ""
        return shown.of(self, f": run {self.run}, {len(self)} orbits{failed}")

    def jet(self, orbit: int) -> Jet:
        """The jet of one orbit, with all that a Jet can.

        Raises what ``hamjet.run`` raises for an orbit that failed, UsageError for other numbers.
        """
        last = len(self) - 1
        if last < 0:
            raise UsageError("orbit: there are none")
        return self._study.jet(arguments.integer(orbit, "orbit", 0, last))


def propagate_many(scene: scenes.Scene, states: npt.ArrayLike | None = None, *,
                   states_km: npt.ArrayLike | None = None, run: str | None = None,
                   threads: int | None = None, overrides: scenes.Overrides | None = None,
                   progress: Progress | None = None) -> ManyJets:
    """The jets of a scene's flow from many initial states, in the place of the scene's own.

    states: (M, 2n), all components of the model, canonical; or states_km: (M, 6), in km and km/s,
    as ``hamjet.states_of_elements`` gives them. run: the label of an integrator, of the method
    gauss; None: the first that is. threads: by default as many as the process may use; no digit
    depends on them. The others as of ``hamjet.run``.

    At the orders 0 to 2 orbits go through the machine's vectors side by side, two to three times
    as fast as one at a time, each with steps of its own and each checked, as by ``hamjet.run``, to
    meet the tolerance at every degree; at higher orders they are integrated one at a time. What
    ``run`` does beyond the jet is skipped: self-checks, error estimates, references, generating
    functions. An orbit that fails spoils no other. Raises SceneError, UsageError, TooLargeError,
    InputOutputError.
    """
    if (states is None) == (states_km is None):
        raise UsageError("states: must be given, or states_km, and not both")
    place = "states" if states_km is None else "states_km"
    try:
        rows = np.asarray(states if states_km is None else states_km, dtype=np.float64)
    except (TypeError, ValueError):
        raise UsageError(f"{place}: wrong type, must be an array of numbers") from None
    if rows.ndim != 2:
        raise UsageError(f"{place}: wrong shape, got {rows.shape}, must be (M, 2n)")
    label = "" if run is None else arguments.text(run, "run")
    given = scenes.read(scene, overrides)
    return ManyJets(_hamjet.integrate_many(given, label, rows, states_km is not None,
                                           arguments.threads(threads),
                                           arguments.progress(progress)))
