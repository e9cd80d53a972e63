"""CSV files of results as columns."""

from __future__ import annotations

import csv
import io
import types
from collections.abc import Mapping
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from .optional_packages import required

_Column = Union["npt.NDArray[np.float64]", "npt.NDArray[np.bool_]", "npt.NDArray[np.str_]"]

#: Columns by name: float64 where all fields are numbers (an empty one is NaN), bool where all are
#: true or false, else str.
Table = Mapping[str, _Column]


def _column(fields: list[str]) -> _Column:
    column: _Column
    try:
        column = np.array([float(field) if field else np.nan for field in fields], dtype=np.float64)
    except ValueError:
        if set(fields) <= {"true", "false"}:
            column = np.array([field == "true" for field in fields], dtype=np.bool_)
        else:
            column = np.array(fields, dtype=np.str_)
    column.flags.writeable = False
    return column


def read_table(text: str) -> Table:
    """The columns of a CSV file with a header."""
    rows = list(csv.reader(io.StringIO(text)))
    columns = {name: _column([row[i] if i < len(row) else "" for row in rows[1:]])
               for i, name in enumerate(rows[0])}
    return types.MappingProxyType(columns)


def data_frame(columns: Mapping[str, Any]) -> Any:
    """A pandas.DataFrame of the columns; raises ImportError where pandas is not installed."""
    return required("pandas", "to_dataframe").DataFrame(dict(columns))
