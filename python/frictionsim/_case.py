"""Case files as objects."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterator, Mapping, MutableMapping
from pathlib import Path
from typing import Any, Union

from . import _native
from ._errors import UsageError, translate
from ._toml import override

PathOrText = Union[str, "os.PathLike[str]"]

_ABSENT = object()


class Case(MutableMapping[str, Any]):
    """A case file and what is changed of it.

    ``case["contact.friction_coefficient"]`` reads a key by its dotted name, a section as a dictionary; assignment changes
    it, ``del`` takes it away. Nothing is written to the file: :meth:`write` makes a new one, with its comments.

    >>> case = Case.shipped("polycarbonate-disc")
    >>> case["contact.rotation_speed_rpm"]
    610.0
    >>> case["contact.rotation_speed_rpm"] = 1000.0
    >>> case.changes
    ['contact.rotation_speed_rpm=1000.0']
    """

    def __init__(self, path: PathOrText, changes: Mapping[str, Any] | None = None) -> None:
        """Read a case file; ``changes`` are keys with new values, ``None`` to take one away."""
        self.path = Path(path)
        """The case file."""
        try:
            self._text = self.path.read_bytes()
        except OSError as error:
            raise UsageError(f"cannot read {self.path}: {error.strerror}") from None
        self._changes: dict[str, Any] = {}
        self._folder: tempfile.TemporaryDirectory[str] | None = None
        self.update(changes or {})

    @classmethod
    def parse(cls, text: str, name: str = "case.toml") -> Case:
        """A case from its text, kept in a temporary file as long as the object lives."""
        return cls._kept([(name, text.encode())])

    @classmethod
    def shipped(cls, name: str) -> Case:
        """A case that comes with the program, with its meshes and tables; see :func:`shipped_cases`."""
        try:
            return cls._kept(_native.shipped_files(name))
        except _native.NativeFailure as failure:
            translate(failure)

    @classmethod
    def _kept(cls, files: list[tuple[str, bytes]]) -> Case:
        folder = tempfile.TemporaryDirectory(prefix="frictionsim-case-")
        for name, content in files:
            path = Path(folder.name, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        case = cls(Path(folder.name, files[0][0]))
        case._folder = folder
        return case

    @property
    def changes(self) -> list[str]:
        """What is changed of the file, as the command line has it behind ``--set``."""
        return [override(key, value) for key, value in self._changes.items()]

    @property
    def text(self) -> str:
        """The case with its changes, in TOML; comments stay."""
        try:
            return _native.edited(self._text, self.changes)
        except _native.NativeFailure as failure:
            translate(failure)

    def values_by_section(self) -> dict[str, Any]:
        """All values, sections as dictionaries."""
        try:
            return _native.values(str(self.path), self._text, self.changes)
        except _native.NativeFailure as failure:
            translate(failure)

    def changed(self, changes: Mapping[str, Any]) -> Case:
        """A copy with further changes."""
        copy = object.__new__(type(self))
        copy.path, copy._text, copy._folder = self.path, self._text, self._folder
        copy._changes = dict(self._changes)
        copy.update(changes)
        return copy

    def copy(self) -> Case:
        """A copy."""
        return self.changed({})

    def validate(self) -> list[str]:
        """Validate the case with its mesh; gives the warnings.

        Raises:
            CaseError: with every problem, its line, key and remedy.
        """
        try:
            return _native.validate(str(self.path), self._text, self.changes)
        except _native.NativeFailure as failure:
            translate(failure)

    def check(self) -> dict[str, Any]:
        """What the runs of the case would cost: unknowns, steps, memory, time; as ``frictionsim check --json``."""
        try:
            found: dict[str, Any] = json.loads(_native.check(self.path, self.changes))
        except _native.NativeFailure as failure:
            translate(failure)
        return found

    def write(self, path: PathOrText) -> Path:
        """Write the case with its changes. Meshes and tables that lie beside the old file are named from the new one's
        place.

        Returns:
            The new file, which is not overwritten by a half one if writing fails.
        """
        path = Path(path)
        moved = {}
        if path.resolve().parent != self.path.resolve().parent:
            for key, name in self.items():
                names_file = key.endswith((".file", ".table", ".gap")) or key.startswith("superelements.")
                beside = self.path.parent / str(name) if names_file else None
                if beside is not None and not Path(name).is_absolute() and beside.is_file():
                    moved[key] = Path(os.path.relpath(beside, path.parent)).as_posix()
        text = self.changed(moved).text
        scratch = path.with_name(f".{path.name}.{os.getpid()}.tmp")
        scratch.write_text(text, encoding="utf-8")
        scratch.replace(path)
        return path

    def __getitem__(self, key: str) -> Any:
        found: Any = self.values_by_section()
        rest = key
        while rest:
            # Keys of [sweep] and [fit] have dots of their own.
            if isinstance(found, dict) and rest.replace('"', "") in found:
                return found[rest.replace('"', "")]
            section, _, rest = rest.partition(".")
            found = found.get(section, _ABSENT) if isinstance(found, dict) else _ABSENT
            if found is _ABSENT:
                raise KeyError(f"{self.path.name} does not give {key}")
        raise KeyError("an empty key")

    def __setitem__(self, key: str, value: Any) -> None:
        override(key, value)
        self._changes.pop(key, None)
        self._changes[key] = value

    def __delitem__(self, key: str) -> None:
        if key not in self:
            raise KeyError(f"{self.path.name} does not give {key}")
        self._changes.pop(key, None)
        self._changes[key] = None

    def __iter__(self) -> Iterator[str]:
        return iter(_dotted(self.values_by_section(), ""))

    def __len__(self) -> int:
        return len(list(iter(self)))

    def __contains__(self, key: object) -> bool:
        try:
            self[str(key)]
        except KeyError:
            return False
        return True

    def __repr__(self) -> str:
        changes = "".join(f", {change}" for change in self.changes)
        return f"Case({str(self.path)!r}{changes})"


def _dotted(values: dict[str, Any], prefix: str) -> list[str]:
    """Names of the values by section; a mapping with dots in its keys, as [sweep] is, is written with quotes."""
    names: list[str] = []
    for key, value in values.items():
        name = prefix + (f'"{key}"' if "." in key else key)
        names += _dotted(value, f"{name}.") if isinstance(value, dict) and value else [name]
    return names


def as_case(case: Case | PathOrText, changes: Mapping[str, Any]) -> Case:
    """The case of an argument with further changes."""
    found = case if isinstance(case, Case) else Case(case)
    return found.changed(changes)


def shipped_cases() -> dict[str, str]:
    """Names and titles of the cases that come with the program, for :meth:`Case.shipped`."""
    return dict(_native.shipped_cases())


def write_shipped_cases(folder: PathOrText = "cases") -> list[Path]:
    """Write every shipped case with its meshes and tables to a folder; files that are there are left alone."""
    written = []
    for name, content in _native.shipped_files():
        path = Path(folder, name)
        if not path.exists():
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
            written.append(path)
    return written


def case_keys() -> list[dict[str, Any]]:
    """Every key of a case with its unit, default, bounds and meaning."""
    found: list[dict[str, Any]] = json.loads(_native.keys())
    return found


def columns(word: str = "") -> list[dict[str, str]]:
    """Columns of tables and keys of summaries whose name, meaning, file or command holds a word: with unit and meaning."""
    found: list[dict[str, str]] = json.loads(_native.columns(word))
    return found


def init(mesh: PathOrText, *, force: bool = False) -> Case:
    """The case that a mesh file suggests, written beside it; :meth:`Case.shipped` gives the shipped ones.

    Raises:
        FileExistsError: there is one already; ``force`` replaces it.
        UsageError: a file that is no mesh.
        CaseError: a mesh that leaves something to choose; the case is there.
    """
    path = Path(mesh).with_suffix(".toml")
    try:
        text = _native.case_from(os.fspath(mesh))
    except _native.NativeFailure as failure:
        translate(failure)
    with path.open("w" if force else "x", encoding="utf-8") as out:
        out.write(text)
    return Case(path)
