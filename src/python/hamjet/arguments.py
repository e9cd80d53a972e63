"""Arguments of calls, checked here because the compiled part refuses a wrong type in many lines."""

from __future__ import annotations

import math
import operator
import os
from typing import Any

from .errors import UsageError


def text(value: str, place: str) -> str:
    """Strings of Python can hold what is no text."""
    try:
        value.encode()
    except UnicodeEncodeError:
        shown = place.encode(errors="backslashreplace").decode()
        raise UsageError(f"{shown}: not a text, got a string with a lone surrogate, must be "
                         "Unicode") from None
    return value


def path(value: str | os.PathLike[str], place: str) -> str | os.PathLike[str]:
    try:
        name = os.fsencode(value)
    except TypeError:
        raise UsageError(f"{place}: wrong type, got {type(value).__name__}, must be a "
                         "path") from None
    except UnicodeEncodeError:
        raise UsageError(f"{place}: not a path, got a string with a lone surrogate") from None
    if b"\0" in name:
        raise UsageError(f"{place}: not a path, got a NUL character in it")
    return value


def integer(value: Any, place: str, least: int, most: int) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise UsageError(f"{place}: wrong type, got {type(value).__name__}, must be an integer "
                         f"from {least} to {most}") from None
    if not least <= number <= most:
        raise UsageError(f"{place}: out of range, got {number}, must be an integer from {least} to "
                         f"{most}")
    return number


def number(value: Any, place: str) -> float:
    try:
        result = float(value)
    except (TypeError, ValueError):
        raise UsageError(f"{place}: wrong type, got {type(value).__name__}, must be a "
                         "number") from None
    if not math.isfinite(result):
        raise UsageError(f"{place}: not finite, got {result}, must be a finite number")
    return result


def positive(value: Any, place: str) -> float:
    result = number(value, place)
    if not result > 0:
        raise UsageError(f"{place}: not positive, got {result:g}, must be a number above 0")
    return result


def progress(value: Any) -> Any:
    """Refused before the work, which else would stop at its first report."""
    if value is not None and not callable(value):
        raise UsageError(f"progress: wrong type, got {type(value).__name__}, must be a function of "
                         "(task, fraction), or None")
    return value


#: The most that the command's option --threads takes.
_MOST_THREADS = 1024


def threads(value: Any) -> int | None:
    """None: as many as the process may use at once."""
    if value is None:
        return None
    return integer(value, "threads", 1, _MOST_THREADS)
