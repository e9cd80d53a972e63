"""Probabilities of collision of pairs that are given as arrays or as messages."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _hamjet, arguments, scenes, shown
from .errors import UsageError
from .results import Floats, Progress
from .studies import Columns

#: The name of the scene that a pair makes, for messages.
_NAME = "pair"
#: The key that a conjunction data message does not say.
_RADIUS = "uncertainty.collision.radius_m"


class Collisions(Columns, table="collision"):
    """Of pairs, whose dimensions come before those below; immutable, arrays read-only.

    Further tables are attributes with columns of their own, likewise: ``whole_passage``,
    ``least_separation``, and of the nearest approach of the means, NaN without one, ``approach`` and
    ``short_encounter``.
    """

    def __repr__(self) -> str:
        return shown.of(self, f": {self.probability.size} of them, largest probability "
                        f"{shown.largest(self.probability)}")


def _nearest(tables: dict[str, dict[str, Any]]) -> None:
    """Keeps of the approaches the nearest one, NaN without one."""
    distances = tables["approaches"]["distance_m"]
    for name in ("approaches", "short_encounter"):
        for column, values in tables[name].items():
            # Flags that may be missing come as True, False and None: 1, 0 and NaN here.
            array = np.array(values, dtype=float) if isinstance(values, tuple) else values
            none = np.full(array.shape[1:], np.nan)
            tables[name][column] = array[distances.argmin()] if len(distances) else none
    tables["approach"] = tables.pop("approaches")


def _numbers(values: npt.ArrayLike, place: str, tail: tuple[int, ...]) -> Floats:
    try:
        array = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise UsageError(f"{place}: wrong type, must be an array of numbers") from None
    if array.shape[array.ndim - len(tail):] != tail:
        wanted = ", ".join(str(length) for length in tail)
        raise UsageError(f"{place}: wrong shape, got {array.shape}, must end with ({wanted})")
    if not np.isfinite(array).all():
        raise UsageError(f"{place}: not finite, must be finite numbers")
    return array


def _collisions(found: list[dict[str, Any]], pairs: tuple[int, ...]) -> Collisions:
    """The columns of the pairs' tables, stacked in the shape of the pairs."""
    def stacked(table: str, column: str) -> npt.NDArray[Any]:
        array = np.array([one[table][column] for one in found])
        array = array.reshape(pairs + array.shape[1:])
        array.flags.writeable = False
        return array

    tables = {table: {column: stacked(table, column) for column in columns}
              for table, columns in found[0].items()}
    own = tables.pop("collision")
    return Collisions({**own, **{name: Columns(columns) for name, columns in tables.items()}})


def _scene(states: Floats, covariances: Floats, radius_m: float, window_s: Floats,
           frame: str, settings: Mapping[str, Any]) -> dict[str, Any]:
    difference = states[1] - states[0]
    # A scene lasts from the epoch on; its window may lie before that.
    duration_s = float(window_s[1] if window_s[1] > 0 else np.abs(window_s).max() or 1)
    return {
        "system": (settings["system"] if "model" in settings["system"]
                   else {**_hamjet.earth_system(), **settings["system"]}),
        "nominal": {"position_km": (states[0, :3] / 1000).tolist(),
                    "velocity_km_s": (states[0, 3:] / 1000).tolist()},
        "deputy": {"frame": "inertial", "position_m": difference[:3].tolist(),
                   "velocity_m_s": difference[3:].tolist()},
        "jet": {"order": settings["order"], "duration_s": duration_s},
        "uncertainty": {
            "frame": frame, "covariance_m_m_s": covariances[0].tolist(), "seed": settings["seed"],
            "gaussian_in": settings["gaussian_in"],
            "deputy": {"frame": frame, "covariance_m_m_s": covariances[1].tolist()},
            "collision": {"radius_m": radius_m, "window_s": window_s.tolist(),
                          **{key: settings[key]
                             for key in ("event", "sampling", "samples", "confidence")}}}}


def collision_probability(states: npt.ArrayLike, covariances: npt.ArrayLike,
                          radius_m: npt.ArrayLike, window_s: npt.ArrayLike, *,
                          frame: str = "inertial", system: Mapping[str, Any] | None = None,
                          order: int = 3, event: str = "nearer", sampling: str = "automatic",
                          samples: int = 200000, confidence: float = 0.95, seed: int = 1,
                          gaussian_in: str = "auto",
                          progress: Progress | None = None) -> Collisions:
    """How likely two spacecraft are to hit each other, as ``[uncertainty.collision]`` finds it.

    states: (..., 2, 6), positions in m and velocities in m/s of both at the epoch, along inertial
    axes. covariances: (..., 2, 6, 6), of these, independent; with ``frame="RTN"`` along each one's
    own R, T, N, velocities being inertial. radius_m: of both together, one number or one for each
    pair. window_s: from when to when after the epoch (negative before it), (2,) or (..., 2). system: the keys of a
    scene's [system], by default the Earth's mu alone. The others are the keys of a scene of these
    names.

    Raises UsageError for wrong shapes, SceneError for what is no covariance or no orbit,
    NumericalError, TooLargeError.
    """
    both = _numbers(states, "states", (2, 6))
    matrices = _numbers(covariances, "covariances", (2, 6, 6))
    pairs = both.shape[:-2]
    if matrices.shape[:-3] != pairs:
        raise UsageError(f"covariances: wrong shape, got {matrices.shape}, must be "
                         f"{pairs + (2, 6, 6)} as the states have it")
    given_radii = _numbers(radius_m, "radius_m", ())
    given_windows = _numbers(window_s, "window_s", (2,))
    try:
        radii = np.broadcast_to(given_radii, pairs)
        windows = np.broadcast_to(given_windows, pairs + (2,))
    except ValueError:
        raise UsageError(f"radius_m and window_s: wrong shapes, got {given_radii.shape} and "
                         f"{given_windows.shape}, must be those of the pairs, {pairs} and "
                         f"{pairs + (2,)}") from None
    settings = {"system": dict(system or {}), "order": order, "event": event,
                "sampling": sampling, "samples": samples, "confidence": confidence, "seed": seed,
                "gaussian_in": gaussian_in}
    found: list[dict[str, Any]] = []
    for index in np.ndindex(pairs):
        scene = _scene(both[index], matrices[index], float(radii[index]), windows[index], frame,
                       settings)
        found.append(_hamjet.study_collision(scenes.read(scene, None, _NAME),
                                             arguments.progress(progress)))
        _nearest(found[-1])
    if not found:
        raise UsageError(f"states: no pair, got {both.shape}, must have one at least")
    return _collisions(found, pairs)


def conjunctions(messages: Iterable[str | os.PathLike[str]], radius_m: npt.ArrayLike, *,
                 overrides: scenes.Overrides | None = None,
                 progress: Progress | None = None) -> Collisions:
    """How likely the objects of conjunction data messages are to hit each other.

    messages: paths of CDMs. radius_m: of both objects together, one number or one for each
    message. overrides: of the scenes that the messages make, as of ``hamjet uncertainty``.

    Raises SceneError for what a message lacks, InputOutputError for what is none, NumericalError,
    TooLargeError.
    """
    files: list[str | os.PathLike[str]] = (
        [messages] if isinstance(messages, (str, os.PathLike)) else list(messages))
    if not files:
        raise UsageError("messages: none, must be the paths of conjunction data messages")
    given = _numbers(radius_m, "radius_m", ())
    if given.shape not in ((), (len(files),)):
        raise UsageError(f"radius_m: wrong shape, got {given.shape}, must be one number or "
                         f"({len(files)},)")
    found = []
    for file, radius in zip(files, np.broadcast_to(given, (len(files),))):
        of_radius = [(_RADIUS, repr(float(radius)))]
        scene = scenes.read(file, [f"{key}={value}" for key, value
                                   in of_radius + scenes._pairs(overrides)])
        found.append(_hamjet.study_collision(scene, arguments.progress(progress)))
        _nearest(found[-1])
    return _collisions(found, (len(files),))
