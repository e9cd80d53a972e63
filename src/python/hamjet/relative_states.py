"""What ``Jet.evaluate_relative`` returns."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt


class RelativeStates(NamedTuple):
    """Relative states at the end of a jet's duration, and how far the series can be trusted."""

    #: (N, 6) float64: positions in m, velocities in m/s, along the axes of the frame.
    states: npt.NDArray[np.float64]
    #: (N,) float64: by how much the position may be wrong, in m: what the missing degrees add,
    #: rounding of coefficients and evaluation, and the errors of the coefficients where the run has
    #: measured or estimated them. An estimate and no bound; NaN where ``support`` is not "inside".
    miss_m: npt.NDArray[np.float64]
    #: (N,) str: "inside"; "outside", beyond the polynomial's reach, where the degrees do not
    #: decay and the states say nothing; or "unknown", where there is but one degree to judge by, or
    #: a number is not finite.
    support: npt.NDArray[np.str_]


_SUPPORT = np.array(["inside", "outside", "unknown"])


def _relative_states(states: npt.NDArray[np.float64], miss_m: npt.NDArray[np.float64],
                     support: npt.NDArray[np.uint8]) -> RelativeStates:
    words = _SUPPORT[support]
    words.flags.writeable = False
    return RelativeStates(states, miss_m, words)
