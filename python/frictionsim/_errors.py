"""Exceptions of the package."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import NoReturn

from . import _native


class FrictionsimError(Exception):
    """Base of every exception of this package."""


@dataclass(frozen=True)
class CaseProblem:
    """One thing that is wrong with a case."""

    message: str
    """What is wrong, with the key and the value."""
    suggestion: str | None
    """The remedy."""
    file: str | None
    """The case file, or ``--set`` for a value given in the call."""
    line: int | None
    """Line, counted from 1."""
    column: int | None
    """Column, counted from 1."""
    key: str | None
    """Dotted key."""


class CaseError(FrictionsimError, ValueError):
    """A case that is not valid: every problem in ``errors``, those of the first one as attributes."""

    def __init__(self, text: str, errors: tuple[CaseProblem, ...] = ()) -> None:
        super().__init__(text)
        self.errors = errors

    def __reduce__(self) -> tuple[type[CaseError], tuple[str, tuple[CaseProblem, ...]]]:
        return type(self), (str(self), self.errors)

    @property
    def _first(self) -> CaseProblem:
        nothing = CaseProblem(str(self), None, None, None, None, None)
        return self.errors[0] if self.errors else nothing

    @property
    def message(self) -> str:
        """What is wrong, in one line."""
        return self._first.message

    @property
    def suggestion(self) -> str | None:
        """The remedy."""
        return self._first.suggestion

    @property
    def file(self) -> str | None:
        """The case file, or ``--set`` for a value given in the call."""
        return self._first.file

    @property
    def line(self) -> int | None:
        """Line, counted from 1."""
        return self._first.line

    @property
    def column(self) -> int | None:
        """Column, counted from 1."""
        return self._first.column

    @property
    def key(self) -> str | None:
        """Dotted key."""
        return self._first.key


class UsageError(FrictionsimError, ValueError):
    """Any other bad input: a folder in use or with other results, a file that cannot be read, an unknown option."""


class RunError(FrictionsimError, RuntimeError):
    """The input was good, but the run failed."""


class InternalError(FrictionsimError, RuntimeError):
    """An error of the program itself; the interpreter goes on."""


class FrictionsimWarning(UserWarning):
    """What the program warns of: implausible values, keys that a command does not use."""


def in_python(text: str) -> str:
    """A message that names options of the command line, with the arguments that they are here."""
    for option, argument in {"--out": "folder=", "--force": "force=True", "--resume": "resume=True"}.items():
        text = text.replace(option, argument)
    return text


def translate(failure: _native.NativeFailure) -> NoReturn:
    """Raise the exception that a failure of the compiled part stands for."""
    found = json.loads(failure.args[0])
    text: str = found["text"]
    if found["kind"] != "case":
        text = in_python(text)
    if found["kind"] == "case":
        raise CaseError(text, tuple(CaseProblem(**problem) for problem in found["problems"])) from None
    if found["kind"] == "usage":
        raise UsageError(text) from None
    if found["kind"] == "interrupted":
        raise KeyboardInterrupt(text) from None
    if found["kind"] == "internal":
        raise InternalError(f"error of the program, please report it: {text}") from None
    raise RunError(text) from None
