"""What hamjet raises. The text is the one line that the command prints for the same mistake."""

from __future__ import annotations

import errno
import os


class Error(Exception):
    """The base of all; ``exit_code`` is the one that the command ends with."""

    exit_code: int = 4


class UsageError(Error, ValueError):
    """A call is wrong: an array of another shape, an unknown kind, jets that do not fit."""

    exit_code = 2


class SceneError(Error, ValueError):
    """The scene is wrong; the text names place, key, what was found and what would be right."""

    exit_code = 3


class NumericalError(Error, ArithmeticError):
    """No solution, no convergence, a singular matrix, a number that is not finite."""

    exit_code = 4


class InputOutputError(Error, OSError):
    """A file could not be read or written, or is not what was written once."""

    exit_code = 5


class _FileError(InputOutputError):
    """An error about one file, with what Python's own errors of this kind have."""

    _errno: int

    def __init__(self, text: str, filename: str | os.PathLike[str]) -> None:
        super().__init__(text)
        self.errno = self._errno
        self.strerror = os.strerror(self._errno)
        self.filename = os.fspath(filename)

    def __str__(self) -> str:
        return str(self.args[0])

    def __reduce__(self) -> tuple[type[_FileError], tuple[str, str]]:
        return type(self), (str(self), self.filename)


class MissingFileError(_FileError, FileNotFoundError):
    """A file to read, or a folder to write into, is not there; ``filename`` says which."""

    _errno = errno.ENOENT


class ExistingFileError(_FileError, FileExistsError):
    """A file to write is there already, and was not to be replaced; ``filename`` says which."""

    _errno = errno.EEXIST


class TooLargeError(Error):
    """The work does not fit this machine, or would not end."""

    exit_code = 6
