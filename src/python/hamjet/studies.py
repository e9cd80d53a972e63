"""What the results of studies of two spacecraft and more have in common."""

from __future__ import annotations

import dataclasses
import json
import os
import types
from typing import TYPE_CHECKING, Any, TypeVar

from . import _hamjet, arguments, scenes, shown
from .errors import UsageError
from .immutable import Immutable
from .results import Progress
from .tables import Table, data_frame

_AnyStudy = TypeVar("_AnyStudy")


def required_study(study: _AnyStudy | None, what: str) -> _AnyStudy:
    if study is None:
        raise UsageError(f"{what}: these results were unpickled, which leaves their study behind")
    return study


def of_table(table: str, scene: scenes.Scene, overrides: scenes.Overrides | None,
             progress: Progress | None, coordinates: str | None = None) -> _hamjet.PlainStudy:
    """Does the study of a scene's table; the one that works without a table for "".

    The study must have nothing to offer but its tables and its report.
    """
    given = scenes.read(scene, overrides, coordinates=coordinates)
    return _hamjet.study_of_table(table, given, arguments.progress(progress))


def described(table: str) -> str:
    """The columns of a table, a line each, as a docstring has them."""
    lines = []
    for name, (unit, meaning, dimensions) in _hamjet.declarations()[table].items():
        shape = f"({', '.join(map(str, dimensions))})" if dimensions else ""
        told = ", ".join(filter(None, (shape, unit)))
        lines.append(f"    {name}{': ' if told else ''}{told}: {meaning}")
    return "\n".join(lines)


class _Fixed(Immutable):
    """Attributes that are set once."""

    if TYPE_CHECKING:  # The columns are declared in the C++ library.
        def __getattr__(self, name: str) -> Any: ...

    def __setattr__(self, name: str, value: object) -> None:
        raise dataclasses.FrozenInstanceError(f"cannot assign to field {name!r}")

    def __delattr__(self, name: str) -> None:
        raise dataclasses.FrozenInstanceError(f"cannot delete field {name!r}")


class _Described(_Fixed):
    """A class that lists the columns of its table."""

    def __init_subclass__(cls, table: str = "", **keywords: Any) -> None:
        super().__init_subclass__(**keywords)
        if table:
            cls.__doc__ = f"{cls.__doc__}\n\n    Attributes:\n\n{described(table)}\n    "


class Columns(_Described):
    """The columns of a further table of a study, as attributes by name; immutable.

    ``table`` has them as the CSV file does, an entry for each of its rows; it is empty of what no
    CSV file has.
    """

    table: Table

    def __init__(self, columns: dict[str, Any], rows: dict[str, Any] | None = None) -> None:
        vars(self).update(columns, table=types.MappingProxyType(rows or {}))

    def __repr__(self) -> str:
        return shown.of(self, f": {shown.listed(name for name in vars(self) if name != 'table')}")

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame with the columns of ``table``.

        Raises ImportError where pandas is not installed.
        """
        return data_frame(self.table)


class Study(_Described):
    """The columns of a study's own table as attributes by name, and its further tables by theirs."""

    table: Table  #: the columns of the study's CSV file, by name, an entry for each of its rows
    _study: Any

    def __init__(self, study: _hamjet._Study) -> None:
        columns, rows = study.columns(), study.rows()
        own, *further = columns
        vars(self).update(columns[own], table=types.MappingProxyType(rows[own]), _study=study)
        vars(self).update({name: Columns(columns[name], rows[name]) for name in further})

    @property
    def summary(self) -> dict[str, Any]:
        """What the command writes as summary.json. Draws the report when first asked."""
        study: Any = required_study(self._study, "summary")
        return dict(json.loads(study.summary))

    def write(self, directory: str | os.PathLike[str]) -> None:
        """Writes what the command writes, the report among it. Raises InputOutputError."""
        study: Any = required_study(self._study, "write")
        study.write(arguments.path(directory, "directory"))

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame with the columns of ``table``, one row each of the command's CSV.

        Raises ImportError where pandas is not installed.
        """
        return data_frame(self.table)

    def __getstate__(self) -> dict[str, Any]:
        # The study, which trajectories are flown and files are written from, is the C++ library's.
        return {**super().__getstate__(), "_study": None}
