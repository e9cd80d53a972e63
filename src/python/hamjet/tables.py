"""CSV files of results as columns."""

from __future__ import annotations

import csv
import io
import types
from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

#: Columns by name: float64 where all fields are numbers (an empty one is NaN), else str.
Table = Mapping[str, "npt.NDArray[np.float64] | npt.NDArray[np.str_]"]


def _column(fields: list[str]) -> npt.NDArray[np.float64] | npt.NDArray[np.str_]:
    try:
        column: npt.NDArray[np.float64] | npt.NDArray[np.str_] = np.array(
            [float(field) if field else np.nan for field in fields], dtype=np.float64)
    except ValueError:
        column = np.array(fields, dtype=np.str_)
    column.flags.writeable = False
    return column


def read_table(text: str) -> Table:
    rows = list(csv.reader(io.StringIO(text)))
    columns = {name: _column([row[i] if i < len(row) else "" for row in rows[1:]])
               for i, name in enumerate(rows[0])}
    return types.MappingProxyType(columns)
