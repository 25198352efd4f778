"""Exceptions and warnings."""

from __future__ import annotations

import warnings as _warnings
from typing import Any, Iterable, Sequence

__all__ = ["Error", "FileError", "InputError", "InternalError", "PhysicsError", "RotordynWarning"]


class Error(Exception):
    """What the exceptions of this module have in common.

    ``str(error)`` is the message that the command prints, for errors of a model with the lines that it refers to.
    ``problems`` are the problems of a model as dictionaries: ``kind``, ``source``, ``span`` [bytes], ``message``,
    ``expected``, ``hint``; empty for other errors.
    """

    problems: list[dict[str, Any]]

    def __init__(self, message: str, problems: str | Sequence[dict[str, Any]] = "[]") -> None:
        import json

        super().__init__(message, problems)
        self.problems = json.loads(problems) if isinstance(problems, str) else list(problems)

    def __str__(self) -> str:
        return str(self.args[0])


class InputError(Error, ValueError):
    """A model, a setting or data that are not valid; all problems at once."""


class PhysicsError(Error, ArithmeticError):
    """A model without a solution: no equilibrium, no convergence, a motion that nothing constrains."""


class FileError(Error, OSError):
    """A file that cannot be read or written."""


class InternalError(Error):
    """A bug of rotordyn; please report it."""


class RotordynWarning(UserWarning):
    """What restricts a result.

    ``code``: name that never changes, as listed in the book; ``item``: what it concerns, such as ``bearing.B``;
    ``severity``: ``caution`` (a figure holds with a restriction) or ``serious`` (the results do not hold);
    ``text``: what was found; ``advice``: what to do.
    """

    code: str
    severity: str
    item: str
    text: str
    advice: str

    def __init__(self, code: str, severity: str = "caution", item: str = "", text: str = "", advice: str = "") -> None:
        super().__init__(code, severity, item, text, advice)
        self.code, self.severity, self.item, self.text, self.advice = code, severity, item, text, advice

    def __str__(self) -> str:
        place = f"{self.item}: " if self.item else ""
        advice = f"; {self.advice}" if self.advice else ""
        return f"[{self.code}, {self.severity}] {place}{self.text}{advice}"


def _warn(found: Iterable[tuple[str, str, str, str, str]], stacklevel: int) -> None:
    """Gives each as a Python warning at the caller's line."""
    for code, severity, item, text, advice in found:
        _warnings.warn(RotordynWarning(code, severity, item, text, advice), stacklevel=stacklevel + 1)
