"""Progress of a run, in a terminal and in a notebook."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any, Union

ProgressChoice = Union[bool, None, Callable[[str, int, "int | None"], object]]


class _Terminal:
    """One line on stderr that is written anew."""

    def __init__(self) -> None:
        self._width = 0

    def __call__(self, message: str, done: int, total: int | None) -> None:
        text = line(message, done, total)
        sys.stderr.write("\r" + text.ljust(self._width))
        sys.stderr.flush()
        self._width = len(text)

    def close(self) -> None:
        if self._width:
            sys.stderr.write("\r" + " " * self._width + "\r")
            sys.stderr.flush()


class _Notebook:
    """One line below the cell that is written anew."""

    def __init__(self, display: Callable[..., Any]) -> None:
        self._display = display
        self._handle: Any = None

    def __call__(self, message: str, done: int, total: int | None) -> None:
        shown = {"text/plain": line(message, done, total)}
        if self._handle is None:
            self._handle = self._display(shown, raw=True, display_id=True)
        else:
            self._handle.update(shown, raw=True)

    def close(self) -> None:
        if self._handle is not None:
            self._handle.update({"text/plain": "done"}, raw=True)


class Teller:
    """Tells of a run what ``progress`` asks for: nothing, a line where somebody looks, or a call of the user's own."""

    def __init__(self, progress: ProgressChoice) -> None:
        self._own: _Terminal | _Notebook | None = None
        if callable(progress):
            self.call: Callable[[str, int, int | None], object] | None = progress
            return
        if progress is not False:
            self._own = _notebook() or (_Terminal() if progress or _is_terminal() else None)
        self.call = self._own

    def __enter__(self) -> Teller:
        return self

    def __exit__(self, *_: object) -> None:
        if self._own is not None:
            self._own.close()


def line(message: str, done: int, total: int | None) -> str:
    """One line of progress."""
    if not total:
        return f"{message} {done or ''}".rstrip()
    filled = 30 * done // total
    return f"{message} [{'=' * filled}{' ' * (30 - filled)}] {done}/{total}"


def _is_terminal() -> bool:
    return sys.stderr is not None and sys.stderr.isatty()


def _notebook() -> _Notebook | None:
    """The display of a notebook, if this is one."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    if shell is None or not hasattr(shell, "kernel"):
        return None
    from IPython.display import display  # type: ignore[import-not-found, unused-ignore]

    return _Notebook(display)
