# SPDX-License-Identifier: BSD-3-Clause
"""What can go wrong: the errors and warnings of this package."""

from __future__ import annotations

import sys
import warnings
from typing import Any


class Error(RuntimeError):
    """An error of a mesh, a file, the disk or a solve; its text is the sentence of the command line.

    Base class of the others.
    """


class InputError(Error, ValueError):
    """An argument is wrong: a name, an option, the shape or the type of an array."""


class MemoryLimitError(Error, MemoryError):
    """A memory limit is too low for a mesh, or there is no memory; the sentence names both figures."""


class NotConverged(Error):
    """With ``strict=True``: the job ended before it reached its tolerance.

    ``result`` is what it has found, as it would have been returned without ``strict``.
    """

    result: Any

    def __init__(self, message: str, result: Any = None) -> None:
        super().__init__(message)
        self.result = result


class NotConvergedWarning(UserWarning):
    """The job ended before it reached its tolerance; the result is its last values."""


class ReportWarning(UserWarning):
    """A warning of a report, or of the reader of a mesh: the result may not be what was meant."""


def warn(sentence: str, category: type) -> None:
    """A warning at the line of the program that has called this package."""
    level, frame = 1, sys._getframe()
    while frame.f_back and frame.f_globals.get("__name__", "").split(".")[0] == __package__:
        level, frame = level + 1, frame.f_back
    warnings.warn(sentence, category, stacklevel=level)
