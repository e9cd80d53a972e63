"""What ``Jet.evaluate_relative`` returns."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import shown
from .tables import data_frame


class _RelativeStates(NamedTuple):
    states: npt.NDArray[np.float64]
    miss_m: npt.NDArray[np.float64]
    support: npt.NDArray[np.str_]


class RelativeStates(_RelativeStates):
    """Relative states at the end of a jet's duration, and how far the series can be trusted.

    It is a tuple (states, miss_m, support) of

      states   (N, 6) float64: positions in m, velocities in m/s, along the axes of the frame
      miss_m   (N,) float64: by how much the position may be wrong, in m: what the missing degrees
               add, rounding of coefficients and evaluation, and the errors of the coefficients
               where the run has measured or estimated them. An estimate and no bound; NaN where
               ``support`` is not "inside".
      support  (N,) str: "inside"; "outside", beyond the polynomial's reach, where the degrees do
               not decay and the states say nothing; or "unknown", where there is but one degree to
               judge by, or a number is not finite.
    """

    #: The names of the columns of ``states``, as `hamjet eval` has them.
    columns: tuple[str, ...]
    #: Where the scene's table [eval] asks for them, what the deputies were split into, else None:
    #: "tolerance_m", "count", "is_limited" (whether the limit was met), "not_right" (deputies, which
    #: are marked "outside"), "maps", "splits" (how often across "R" to "vT" and "vN"), and of up to
    #: 100 domains "centres" and "half_widths", (n, 6) along R, T, N in m and m/s, and "miss_m".
    domains: dict[str, Any] | None = None

    def __repr__(self) -> str:
        if len(self.states) == 1:
            named = ", ".join(f"{name} {x + 0:.6g}"
                              for name, x in zip(self.columns, self.states[0]))
            return shown.of(self, f": {named}\n {self.support[0]}, miss about "
                            f"{shown.largest(self.miss_m)} m")
        inside = int((self.support == "inside").sum())
        return shown.of(self, f" of {len(self.states)} deputies in {', '.join(self.columns)}\n "
                        f"{inside} inside, miss up to about {shown.largest(self.miss_m)} m")

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame with the columns that `hamjet eval` writes, a row a state.

        Raises ImportError where pandas is not installed.
        """
        named = dict(zip(self.columns, self.states.T))
        return data_frame({**named, "miss_estimate_m": self.miss_m, "support": self.support})


_SUPPORT = np.array(["inside", "outside", "unknown"])


def _relative_states(states: npt.NDArray[np.float64], miss_m: npt.NDArray[np.float64],
                     support: npt.NDArray[np.uint8], columns: tuple[str, ...],
                     domains: dict[str, Any] | None = None) -> RelativeStates:
    words = _SUPPORT[support]
    words.flags.writeable = False
    result = RelativeStates(states, miss_m, words)
    result.columns = columns
    result.domains = domains
    return result


def joined(parts: list[RelativeStates]) -> RelativeStates:
    """The rows of several, one after the other; they have the same columns."""
    arrays = [np.concatenate(part) for part in zip(*parts)]
    for array in arrays:
        array.flags.writeable = False
    result = RelativeStates(*arrays)
    result.columns = parts[0].columns
    return result
