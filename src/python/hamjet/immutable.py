"""Copies and pickles of results that cannot change."""

from __future__ import annotations

import types
from collections.abc import Mapping
from typing import Any, TypeVar

import numpy as np

from . import _hamjet

_Self = TypeVar("_Self", bound="Immutable")


def _thawed(value: Any) -> Any:
    """What pickle knows of: a read-only mapping as a dict."""
    if isinstance(value, types.MappingProxyType):
        return {key: _thawed(entry) for key, entry in value.items()}
    return value


def _frozen(value: Any) -> Any:
    if isinstance(value, Mapping):
        return types.MappingProxyType({key: _frozen(entry) for key, entry in value.items()})
    if isinstance(value, np.ndarray):
        value.flags.writeable = False
    return value


def _restored(function: str, *state: Any) -> Any:
    """What pickle calls for the objects of the compiled part."""
    return getattr(_hamjet, function)(*state)


class Immutable:
    """A copy is the object itself; what comes out of a pickle is as read-only as what went in."""

    def __copy__(self: _Self) -> _Self:
        return self

    def __deepcopy__(self: _Self, memo: dict[int, Any]) -> _Self:
        return self

    def __getstate__(self) -> dict[str, Any]:
        return {name: _thawed(value) for name, value in vars(self).items()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        vars(self).update({name: _frozen(value) for name, value in state.items()})
