"""What objects show of themselves: how much there is and what matters of it, not all numbers."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
import numpy.typing as npt


def span(times_s: npt.NDArray[np.float64], noun: str = "times") -> str:
    """A text such as "97 times from 0 s to 8.64e+04 s"."""
    if len(times_s) == 0:
        return f"no {noun}"
    return f"{len(times_s)} {noun} from {times_s[0]:.6g} s to {times_s[-1]:.6g} s"


def largest(values: npt.NDArray[np.float64]) -> str:
    """The largest magnitude of what are numbers."""
    there = np.abs(values[~np.isnan(values)])
    return f"{there.max():.3g}" if there.size else "unknown"


def listed(words: Iterable[str]) -> str:
    """The first of them, and how many more there are."""
    most = 8
    all_words = list(words)
    more = [f"{len(all_words) - most} more"] if len(all_words) > most else []
    return ", ".join(all_words[:most] + more) or "none"


def of(shown: Any, text: str) -> str:
    return f"<hamjet.{type(shown).__name__}{text}>"
