"""The compiled part of the package; private to it."""

from collections.abc import Callable, Sequence
from os import PathLike
from typing import Any

__version__: str

class NativeFailure(Exception):
    """A failure; ``args[0]`` is a JSON object with ``kind``, ``text`` and, of a case, ``problems``."""

def run(
    arguments: Sequence[str],
    threads: int = 0,
    progress: Callable[[str, int, int | None], object] | None = None,
) -> str:
    """Run one command of the command line, the command first, without the interpreter lock; gives its warnings."""

def wait_for_stopped() -> None:
    """Wait for runs that were interrupted and still write what they have."""

def command_line(arguments: Sequence[str]) -> int:
    """The command line: takes ``sys.argv``, gives the exit code."""

def values(name: str, text: bytes, overrides: Sequence[str]) -> dict[str, Any]:
    """The values of a case text under overrides, sections as dictionaries."""

def validate(name: str, text: bytes, overrides: Sequence[str]) -> list[str]:
    """Validate a case text, whose files lie beside ``name``; gives its warnings."""

def check(path: str | PathLike[str], overrides: Sequence[str]) -> str:
    """Examine a case file as ``frictionsim check --json`` does; gives JSON."""

def keys() -> str:
    """Every key of a case, in JSON."""

def columns(word: str) -> str:
    """Columns of tables and keys of summaries that a word finds, in JSON."""

def case_from(mesh: str | PathLike[str]) -> str:
    """The text of a case that lies beside a mesh file."""

def without(key: str) -> str:
    """The override that takes a key away."""

def edited(text: bytes, overrides: Sequence[str]) -> str:
    """A case text with overrides written into it; comments stay."""

def shipped_cases() -> list[tuple[str, str]]:
    """Name and title of every shipped case."""

def shipped_files(name: str | None = None) -> list[tuple[str, bytes]]:
    """A shipped case and the files that it reads, or every shipped file: relative paths and bytes."""

def read_table(path: str | PathLike[str]) -> dict[str, Any]:
    """The columns of a table of results."""
