"""Packages that only a part of hamjet needs, imported where they are used."""

from __future__ import annotations

import importlib
from typing import Any


def required(module: str, purpose: str) -> Any:
    """The module, or an ImportError that says what needs it and how it is installed."""
    package = module.partition(".")[0]
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name != package:
            raise
        raise ImportError(f"{purpose} needs {package}, which is not installed: pip install "
                          f"{package}, or on Debian apt install python3-{package}",
                          name=package) from None
