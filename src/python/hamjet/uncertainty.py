"""Moments of uncertain states to every order, and of polynomials of Gaussian variables."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _hamjet, arguments, scenes, shown
from .errors import UsageError
from .immutable import Immutable
from .results import Floats, Progress
from .studies import Study, required_study


class Uncertainty(Study, table="moments"):
    """Moments of S states at T times by the orders 1 to N; immutable, arrays read-only.

    Moments are of deviations from the chief's nominal, in m and m/s along the axes of the frame at
    each time. Further tables are attributes with columns of their own: ``cartesian`` has the moments
    by polynomials of positions and velocities along (T, S, N), ``charted`` those of the scene's
    other coordinates, canonical, ``split`` those by polynomials of domains (a row of ``domains`` is
    one), and ``flown``, along (T, S), those of samples that were flown with the full equations of
    motion; ``domains``, ``collision``, ``whole_passage``, ``least_separation``,
    ``approaches``, ``short_encounter`` and ``safety`` are there where the scene asks for them.
    """

    _study: _hamjet.UncertaintyStudy | None

    def __repr__(self) -> str:
        times = self.cartesian.time_s
        return shown.of(self, f": {shown.span(times)}, {', '.join(self.states)}, "
                        f"{self.frame}\n largest negentropy "
                        f"{shown.largest(self.cartesian.negentropy)} nats, in {self.coordinates} "
                        f"coordinates {shown.largest(self.charted.negentropy)}")

    @property
    def states(self) -> tuple[str, ...]:
        """S of "chief", "deputy" and "relative", the deputy less the chief."""
        return tuple(dict.fromkeys(self.state))

    @property
    def negentropy_in(self) -> dict[str, Floats]:
        """How non-Gaussian at the last time in coordinates themselves, by their name: (S, N), nats.

        They are the scene's own and those that ``uncertainty.coordinates`` asks for and the orbit
        has.
        """
        orders = self.cartesian.mean.shape[2]
        last = self.time_s == self.time_s[-1]
        return {name: self.negentropy[last & (np.array(self.polynomials) == name)
                                      & (np.array(self.told_in) == name)].reshape(-1, orders)
                for name in dict.fromkeys(self.told_in) if name in self.polynomials}

    def flown_states(self, time: int = -1, state: int = -1) -> Floats:
        """The samples' states at a time, by the places of both: (samples, 6), m and m/s.

        Raises UsageError.
        """
        times, states = self.cartesian.mean.shape[:2]
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

    The scene has a table [uncertainty]; with a table [uncertainty.collision] ``collision`` has the
    probability that chief and deputy hit each other, and with [uncertainty.safety] ``safety`` how
    near every pair of a formation comes where a burn fails.
    Arguments as of ``run``. Raises SceneError, UsageError,
    NumericalError, TooLargeError, InputOutputError.
    """
    study = _hamjet.study_uncertainty(scenes.read(scene, overrides), arguments.progress(progress))
    return Uncertainty(study)


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
    columns = _hamjet.polynomial_moments(rows, powers, matrix)
    return Moments(**{each.name: columns[each.name][0] for each in fields(Moments)})
