# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What Rondel raises."""

from __future__ import annotations

import inspect
import warnings

__all__ = ["CrossingConstraints", "DistributedError", "FileError", "InvalidInput"]


class InvalidInput(ValueError):
    """An argument breaks its contract; degenerate input never does.

    Attributes
    ----------
    index : int or None
        The first offending position in the array that the message names; None where the message
        is about no array.

    """

    def __init__(self, message: str, index: int | None = None) -> None:
        super().__init__(message, index)
        self.index: int | None = index

    def __str__(self) -> str:
        return str(self.args[0])


class CrossingConstraints(InvalidInput):
    """Two constraints cross in the inside of both.

    Attributes
    ----------
    constraints : tuple of int
        The positions of both constraints, ascending. `index` is the larger one.
    place : tuple of float
        Longitude and latitude of the crossing in degrees, up to rounding.

    """

    def __init__(
        self, message: str, constraints: tuple[int, int], place: tuple[float, float]
    ) -> None:
        super().__init__(message, constraints[1])
        self.args = (message, constraints, place)
        self.constraints = constraints
        self.place = place


class FileError(OSError, ValueError):
    """A file is there, but not right: its content, its format or its name.

    Where the system refuses a file, it is another `OSError`, such as `FileNotFoundError`, with
    the number of the system in `errno`.
    """


class DistributedError(RuntimeError):
    """What one of several ranks could not do, raised on all of them in one line.

    Attributes
    ----------
    rank : int
        The lowest one of those that failed.

    """

    def __init__(self, message: str, rank: int = 0) -> None:
        super().__init__(message, rank)
        self.rank: int = rank

    def __str__(self) -> str:
        return str(self.args[0])


def warn_caller(text: str) -> None:
    """Warns in the name of the line that called this package."""
    frame, level = inspect.currentframe(), 1
    while frame is not None and frame.f_globals.get("__package__") == __package__:
        frame, level = frame.f_back, level + 1
    warnings.warn(text, UserWarning, stacklevel=level)
