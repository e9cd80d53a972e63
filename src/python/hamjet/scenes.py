"""Scenes as Python gives them: a path, TOML text, or a dict."""

from __future__ import annotations

import os
import sys
import types
import warnings
from collections.abc import Iterable, Mapping
from typing import Any, Union

from . import _hamjet, arguments
from .errors import UsageError

#: A path (str or os.PathLike), TOML text (a str with a line break), or the tables as a mapping.
Scene = Union[str, "os.PathLike[str]", Mapping[str, Any]]

#: Changes of keys: a mapping from dotted key to value, or strings "key=value" as of ``--set``.
Overrides = Union[Mapping[str, Any], Iterable[str]]

#: The name of a scene that has no file, for messages.
_NAME = "scene"


def _toml_string(text: str, place: str) -> str:
    escaped = arguments.text(text, place).replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(f"\\u{ord(c):04x}" if c < " " or c == "\x7f" else c for c in escaped) + '"'


def _toml(value: Any, key: str) -> str:
    """The value as TOML, on one line."""
    if hasattr(value, "dtype") and hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return _toml_string(value, f"overrides: {key}")
    if isinstance(value, Mapping):
        entries = [_toml_string(str(k), f"overrides: {key}") + " = " + _toml(v, f"{key}.{k}")
                   for k, v in value.items()]
        return "{" + ", ".join(entries) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(v, f"{key}.{i}") for i, v in enumerate(value)) + "]"
    raise UsageError(f"overrides: {key}: wrong type, got {type(value).__name__}, must be a bool, "
                     "int, float, str, list, dict or NumPy array; None, which removes a key, must "
                     "be its whole value")


def _pairs(overrides: Overrides | None) -> list[tuple[str, str]]:
    if overrides is None:
        return []
    if isinstance(overrides, Mapping):
        return [(arguments.text(str(key), f"overrides: {key}"),
                 "null" if value is None else _toml(value, str(key)))
                for key, value in overrides.items()]
    if isinstance(overrides, str):
        overrides = [overrides]
    if not isinstance(overrides, Iterable):
        raise UsageError(f"overrides: wrong type, got {type(overrides).__name__}, must be a dict or "
                         "strings key=value")
    pairs = []
    for text in overrides:
        key, equals, value = arguments.text(str(text), f"overrides: {text}").partition("=")
        if not key or not equals:
            raise UsageError(f"overrides: {text}: must be key=value, for example jet.order=3")
        pairs.append((key, value))
    return pairs


def _of_ends(coordinates: str | None, end_coordinates: str | None) -> list[tuple[str, str]]:
    """The keys of the polynomials' coordinates, which one argument sets at both ends."""
    pairs = []
    if coordinates is not None:
        pairs = [("jet.coordinates", _toml_string(coordinates, "coordinates")),
                 ("jet.end_coordinates", "null")]
    if end_coordinates is not None:
        pairs.append(("jet.end_coordinates", _toml_string(end_coordinates, "end_coordinates")))
    return pairs


def _warn(text: str) -> None:
    """Warns at the line of the caller's that called the package."""
    package = os.path.dirname(os.path.abspath(__file__))
    frame: types.FrameType | None = sys._getframe()
    level = 0
    while frame is not None and os.path.abspath(frame.f_code.co_filename).startswith(package):
        frame, level = frame.f_back, level + 1
    warnings.warn(text, UserWarning, stacklevel=level + 1)


def read(scene: Scene, overrides: Overrides | None, name: str = _NAME, *,
         coordinates: str | None = None,
         end_coordinates: str | None = None) -> _hamjet.GivenScene:
    """Reads and checks a scene; raises SceneError, UsageError, InputOutputError, TooLargeError.

    Of what is almost surely a slip it warns (UserWarning), in the command's words.
    name: of tables, for messages. coordinates: of the polynomials, in place of the scene's.
    """
    given = _read(scene, _pairs(overrides) + _of_ends(coordinates, end_coordinates), name)
    for text in given.warnings:
        _warn(text.removeprefix("warning: "))
    return given


def _read(scene: Scene, pairs: list[tuple[str, str]], name: str) -> _hamjet.GivenScene:
    if isinstance(scene, Mapping):
        return _hamjet.scene_of_tables(scene, name, pairs)
    if isinstance(scene, str) and "\n" in scene:
        return _hamjet.scene_of_text(arguments.text(scene, _NAME), _NAME, pairs)
    if isinstance(scene, (str, os.PathLike)):
        if not os.fspath(scene):
            raise UsageError("scene: empty, must name a file")
        return _hamjet.scene_of_file(arguments.path(scene, _NAME), pairs)
    raise UsageError(f"scene: wrong type, got {type(scene).__name__}, must be a path, TOML text or "
                     "a dict")
