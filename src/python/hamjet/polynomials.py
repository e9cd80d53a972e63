"""The polynomials of a scene, in the coordinates that it asks for."""

from __future__ import annotations

import os

import numpy.typing as npt

from . import _hamjet, arguments, scenes, shown
from .errors import UsageError
from .immutable import Immutable
from .relative_states import RelativeStates
from .results import Floats, Progress


class Polynomials(Immutable):
    """What a scene's polynomials say of deputies at the end of its duration; immutable.

    In other coordinates than Cartesian a deputy is carried into them at the start and out of them
    at the end, so that polynomials of the same order reach further: in "flow-box" ones tens to
    hundreds of kilometres. What comes out of a pickle has the same digits and is as what was
    loaded: it has no scene in which `reach` could fly deputies.
    """

    def __init__(self, study: _hamjet.PolynomialsStudy) -> None:
        self._study = study

    @classmethod
    def load(cls, path: str | os.PathLike[str], run: str | None = None, *,
             coordinates: str | None = None, end_coordinates: str | None = None,
             scene: scenes.Scene | None = None) -> Polynomials:
        """Reads what `hamjet run` has written in a scene's coordinates, or a file .h5.

        path: results of `hamjet run`, whose polynomials in the coordinates of their scene are taken
        where they are other than Cartesian, or a file that `hamjet convert` has written. run: the
        label of the run; by default the first that has a result. coordinates: what they are
        converted to, by composition, at both ends unless end_coordinates has others for the
        results; by default they stay as they are. scene: that of a jet that is converted to
        "flow-box", for its gravity field. Raises UsageError, InputOutputError, NumericalError where
        the orbit has no such coordinates, and as ``polynomials`` for the scene.
        """
        given = None if scene is None else scenes.read(scene, None)
        return cls(_hamjet.load_polynomials(arguments.path(path, "path"), run, coordinates,
                                            end_coordinates, given))

    @property
    def run(self) -> str:
        """The label of the integrator."""
        return self._study.run

    @property
    def order(self) -> int:
        """The highest degree of the polynomials."""
        return self._study.order

    @property
    def variables(self) -> int:
        """How many variables they have: six, of flow boxes four or five."""
        return self._study.variables

    @property
    def coordinates(self) -> str:
        """The coordinates of the deviations at the start; with "auto" those that were chosen."""
        return self._study.coordinates

    @property
    def end_coordinates(self) -> str:
        """The coordinates of the results."""
        return self._study.end_coordinates

    @property
    def duration_s(self) -> float:
        """The time from the start to the end, in s; negative if it goes backwards."""
        return self._study.duration_s

    def __repr__(self) -> str:
        ends = self.coordinates
        if self.end_coordinates != ends:
            ends += f" to {self.end_coordinates}"
        return shown.of(self, f" of order {self.order} in {self.variables} variables, {ends} "
                        f"coordinates: {self._study.scene}, {self.run}, {self.duration_s:.6g} s")

    def evaluate_relative(self, states: npt.ArrayLike, *, frame: str = "RTN",
                          to: str | None = None, derivatives: str | None = None,
                          degree: int | None = None, strict: bool = False) -> RelativeStates:
        """Carries relative states to the end, as `hamjet eval scene.toml` does, to the same digits.

        Arguments and result as of ``Jet.evaluate_relative``. Estimates of the miss cover what the
        missing degrees would add, rounding, and the error of the integration of degrees 0 and 1.
        Where the scene has a table [eval], deputies beyond reach are split into domains with
        polynomials of their own, which `domains` of the result tells.
        Raises UsageError, and NumericalError if strict.
        """
        return self._study.evaluate_relative(states, frame, to, derivatives, degree, strict)

    def reach(self, tolerance_m: float = 1.0, *, samples: int = 50,
              progress: Progress | None = None) -> Floats:
        """How far from the chief each order is right to a tolerance at the end: (order,), in m.

        It is what ``validity`` proves by flying so many random deputies, and the worst. Raises as
        ``transfer``, and UsageError for polynomials that were loaded or pickled.
        """
        tolerance = arguments.number(tolerance_m, "reach: tolerance_m")
        if not tolerance > 0:
            raise UsageError(f"reach: tolerance_m: out of range, got {tolerance:g}, must be above 0")
        return self._study.reach(tolerance, arguments.integer(samples, "reach: samples", 1, 10000),
                                 arguments.progress(progress))


def polynomials(scene: scenes.Scene, *, coordinates: str | None = None,
                end_coordinates: str | None = None, overrides: scenes.Overrides | None = None,
                progress: Progress | None = None) -> Polynomials:
    """Integrates the polynomials of a scene about an orbit, to the end of its duration.

    coordinates: in place of jet.coordinates, at both ends unless end_coordinates has others for the
    results: "cartesian", "spherical", "cylindrical", "poincare", "nodal", "flow-box" or "auto".
    Other arguments as of ``run``. Raises SceneError, UsageError, NumericalError, TooLargeError,
    InputOutputError.
    """
    given = scenes.read(scene, overrides, coordinates=coordinates, end_coordinates=end_coordinates)
    return Polynomials(_hamjet.integrate_polynomials(given, arguments.progress(progress)))
