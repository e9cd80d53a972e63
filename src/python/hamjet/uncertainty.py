"""Moments of uncertain states to every order, and of polynomials of Gaussian variables."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _hamjet, arguments, scenes, shown
from .errors import UsageError
from .immutable import Immutable
from .results import Floats, Progress
from .studies import Study, required_study
from .tables import Table, read_table


@dataclass(frozen=True, eq=False)
class Uncertainty(Study):
    """Moments of S states at T times by the orders 1 to N; immutable, arrays read-only.

    Moments are of deviations from the chief's nominal, in m and m/s along the axes of the frame at
    each time; those that begin with ``charted_`` are of the scene's other coordinates, canonical,
    and NaN without such; those with ``flown_`` of samples that were flown with the full equations
    of motion, with what they scatter by (one standard deviation), and NaN without samples.
    """

    frame: str  #: of the results, in words
    coordinates: str  #: the scene's, for example "flow-box"
    states: tuple[str, ...]  #: S of "chief", "deputy" and "relative", the deputy less the chief
    components: tuple[str, ...]  #: the six of a state; of RTN: R, T, N, vR, vT, vN
    charted_components: tuple[str, ...]  #: those of the other coordinates at the last time
    samples: int  #: that were flown
    times_s: Floats  #: (T,)
    mean: Floats  #: (T, S, N, 6)
    standard_deviation: Floats  #: (T, S, N, 6)
    skewness: Floats  #: (T, S, N, 6)
    excess_kurtosis: Floats  #: (T, S, N, 6)
    covariance: Floats  #: (T, S, N, 6, 6)
    mardia_skewness: Floats  #: (T, S, N)
    mardia_excess_kurtosis: Floats  #: (T, S, N)
    #: (T, S, N): how non-Gaussian, in nats: of "chief" and "deputy" from the volume of the covariance,
    #: which a flow does not change of a Gaussian start; of "relative", with noise or of a singular
    #: start the leading terms, which say little above some tenths
    negentropy: Floats
    linear_error_of_probability: Floats  #: (T, S): the most by which the linear covariance errs
    charted_mean: Floats  #: (T, S, N, 6)
    charted_standard_deviation: Floats  #: (T, S, N, 6)
    charted_skewness: Floats  #: (T, S, N, 6)
    charted_excess_kurtosis: Floats  #: (T, S, N, 6)
    charted_covariance: Floats  #: (T, S, N, 6, 6)
    charted_mardia_skewness: Floats  #: (T, S, N)
    charted_mardia_excess_kurtosis: Floats  #: (T, S, N)
    charted_negentropy: Floats  #: (T, S, N)
    flown_mean: Floats  #: (T, S, 6)
    flown_standard_deviation: Floats  #: (T, S, 6)
    flown_skewness: Floats  #: (T, S, 6)
    flown_excess_kurtosis: Floats  #: (T, S, 6)
    flown_covariance: Floats  #: (T, S, 6, 6)
    flown_mardia_skewness: Floats  #: (T, S)
    flown_mardia_excess_kurtosis: Floats  #: (T, S)
    flown_negentropy: Floats  #: (T, S)
    flown_mean_scatter: Floats  #: (T, S, 6)
    flown_standard_deviation_scatter: Floats  #: (T, S, 6)
    flown_skewness_scatter: Floats  #: (T, S, 6)
    flown_excess_kurtosis_scatter: Floats  #: (T, S, 6)
    #: By name of the coordinates that ``uncertainty.coordinates`` asks for and the orbit has, at the
    #: last time: (S, N), nats.
    negentropy_in: dict[str, Floats]
    verdict: str  #: whether the linear covariance misleads: what ``hamjet uncertainty`` says first
    notes: tuple[str, ...]  #: what to know beside the numbers
    table: Table = field(repr=False)  #: the columns of ``moments.csv``, by name
    _study: _hamjet.UncertaintyStudy | None = field(repr=False)

    def __repr__(self) -> str:
        return shown.of(self, f": {shown.span(self.times_s)}, {', '.join(self.states)}, "
                        f"{self.frame}\n largest negentropy {shown.largest(self.negentropy)} "
                        f"nats, in {self.coordinates} coordinates "
                        f"{shown.largest(self.charted_negentropy)}")

    def flown_states(self, time: int = -1, state: int = -1) -> Floats:
        """The samples' states at a time, by the places of both: (samples, 6), m and m/s.

        Raises UsageError.
        """
        times, states = self.mean.shape[:2]
        return required_study(self._study, "flown_states").flown_states(
            arguments.integer(time, "time", -times, times - 1) % times,
            arguments.integer(state, "state", -states, states - 1) % states)


@dataclass(frozen=True, eq=False)
class Moments(Immutable):
    """Moments of m polynomials; immutable, arrays read-only."""

    mean: Floats  #: (m,)
    standard_deviation: Floats  #: (m,)
    skewness: Floats  #: (m,)
    excess_kurtosis: Floats  #: (m,)
    covariance: Floats  #: (m, m)
    mardia_skewness: float  #: of all components together, after Mardia (1970)
    mardia_excess_kurtosis: float  #: likewise; 0 of a Gaussian
    negentropy: float  #: how non-Gaussian, in nats: the leading terms, good to some tenths

    def __repr__(self) -> str:
        return shown.of(self, f": of {len(self.mean)}, largest skewness "
                        f"{shown.largest(self.skewness)}, excess kurtosis "
                        f"{shown.largest(self.excess_kurtosis)}, negentropy "
                        f"{self.negentropy:.3g} nats")


def uncertainty(scene: scenes.Scene, *, overrides: scenes.Overrides | None = None,
                progress: Progress | None = None) -> Uncertainty:
    """How a covariance grows, to every order, as ``hamjet uncertainty`` finds it.

    The scene has a table [uncertainty]; with a table [uncertainty.collision] the member
    ``collision`` of the summary has the probability that chief and deputy hit each other, and with
    [uncertainty.safety] ``safety`` how near every pair of a formation comes where a burn fails.
    Arguments as of ``run``. Raises SceneError, UsageError,
    NumericalError, TooLargeError, InputOutputError.
    """
    study = _hamjet.study_uncertainty(scenes.read(scene, overrides), arguments.progress(progress))
    return Uncertainty(**study.arrays(), table=read_table(study.csv), _study=study)


def _array(values: npt.ArrayLike, place: str, dtype: Any) -> npt.NDArray[Any]:
    try:
        array = np.asarray(values)
        result = array.astype(dtype)
    except (TypeError, ValueError):
        raise UsageError(f"{place}: wrong type, must be an array of numbers") from None
    if array.ndim != 2:
        raise UsageError(f"{place}: wrong shape, got {array.shape}, must have two dimensions")
    if not np.array_equal(result, array):
        raise UsageError(f"{place}: out of range, must be finite numbers, and exponents integers "
                         "from 0 to 60")
    return result


def polynomial_moments(coefficients: npt.ArrayLike, exponents: npt.ArrayLike,
                       covariance: npt.ArrayLike) -> Moments:
    """Moments of polynomials of Gaussian variables of mean zero, exact but for rounding.

    coefficients: (m, K), of m polynomials. exponents: (K, v), one row a monomial in v variables;
    both as a ``Jet`` has them. covariance: (v, v), of the variables. Raises UsageError.
    """
    rows = _array(coefficients, "coefficients", np.float64)
    powers = _array(exponents, "exponents", np.uint8)
    matrix = _array(covariance, "covariance", np.float64)
    if rows.shape[1] != powers.shape[0] or rows.size == 0:
        raise UsageError(f"coefficients: wrong shape, got {rows.shape}, must be (m, K) with the "
                         f"exponents' {powers.shape[0]} rows")
    if matrix.shape != (powers.shape[1], powers.shape[1]):
        raise UsageError(f"covariance: wrong shape, got {matrix.shape}, must be (v, v) with the "
                         f"exponents' {powers.shape[1]} columns")
    return Moments(**_hamjet.polynomial_moments(rows, powers, matrix))
