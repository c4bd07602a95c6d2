"""The analyses: each runs a command of the program in this process and gives its results."""

from __future__ import annotations

import os
import tempfile
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any, TypeVar

from . import _native
from ._case import Case, PathOrText, as_case
from ._errors import FrictionsimWarning, in_python, translate
from ._progress import ProgressChoice, Teller
from ._result import (
    CeaResult,
    CycleResult,
    FitResult,
    FrfResult,
    IdentifyResult,
    MatricesResult,
    Result,
    SweepResult,
    TransientResult,
    UncertaintyResult,
)

_R = TypeVar("_R", bound=Result)

# Commands whose interrupted folders are worth keeping.
_RESUMABLE = {"transient", "sweep", "uncertainty"}


def _run(
    kind: type[_R],
    command: str,
    case: Case | PathOrText,
    changes: dict[str, Any],
    *,
    folder: PathOrText | None,
    figures: bool,
    force: bool,
    threads: int,
    progress: ProgressChoice,
    inputs: Sequence[str] = (),
    options: Sequence[str] = (),
) -> _R:
    """Run a command on a case with changes and give its results."""
    effective = as_case(case, changes)
    words = [os.fspath(effective.path), *inputs, *options]
    for change in effective.changes:
        key = change.removeprefix(_native.without(""))
        words += ["--unset", key] if key != change else ["--set", change]
    return _execute(kind, command, words, folder, figures, force, threads, progress)


def _execute(
    kind: type[_R],
    command: str,
    words: Sequence[str],
    folder: PathOrText | None,
    figures: bool,
    force: bool,
    threads: int,
    progress: ProgressChoice,
) -> _R:
    """Run a command of the command line into a folder and give its results."""
    keeper = None
    if folder is None:
        keeper = tempfile.TemporaryDirectory(prefix=f"frictionsim-{command}-")
        folder = keeper.name
    arguments = [command, *words, "--out", os.fspath(folder), "-qq"]
    arguments += [] if figures else ["--no-figures"]
    arguments += ["--force"] if force else []
    with Teller(progress) as teller:
        try:
            log = _native.run(arguments, threads, teller.call)
        except _native.NativeFailure as failure:
            translate(failure)
        except KeyboardInterrupt as interrupt:
            _tell_interruption(interrupt, command, keeper)
    for line in log.splitlines():
        text = line.strip().removeprefix("WARN").strip()
        warnings.warn(text, FrictionsimWarning, stacklevel=4)
    return kind(Path(folder), keeper)


def _tell_interruption(
    interrupt: KeyboardInterrupt, command: str, keeper: tempfile.TemporaryDirectory[str] | None
) -> None:
    """Raise the interruption with what is kept, and how to go on."""
    message = getattr(interrupt, "frictionsim_message", None) or "interrupted; what is computed is being written"
    if keeper is not None and command in _RESUMABLE:
        keeper._finalizer.detach()  # type: ignore[attr-defined]
        message += f"; pass folder={keeper.name!r} with resume=True"
    raise KeyboardInterrupt(in_python(message)) from None


def _resumed(resume: bool) -> list[str]:
    return ["--resume"] if resume else []


def cea(
    case: Case | PathOrText,
    *,
    folder: PathOrText | None = None,
    figures: bool = True,
    force: bool = False,
    threads: int = 0,
    progress: ProgressChoice = None,
    **changes: Any,
) -> CeaResult:
    """Complex eigenvalues of steady sliding over the friction coefficient.

    Args:
        case: a :class:`Case` or the path of a case file.
        folder: where the results go; ``None`` for a temporary folder that goes with the result.
        figures: whether figures and report are drawn.
        force: replace the results of another case in the folder.
        threads: worker threads; 0 for all cores. Results do not depend on it.
        progress: ``None`` shows a line where somebody looks, in a terminal or a notebook, ``False`` nothing; or a function
            of message, done and total.
        **changes: keys of the case with new values, ``**{"contact.friction_coefficient": 0.3}``; ``None`` takes one away.

    Raises:
        CaseError: the case is not valid; line, key and remedy are its attributes.
        UsageError: a folder that is in use or holds other results, a file that cannot be read.
        RunError: the analysis failed.
        KeyboardInterrupt: within a second of Ctrl-C.
    """
    return _run(
        CeaResult, "cea", case, changes,
        folder=folder, figures=figures, force=force, threads=threads, progress=progress,
    )  # fmt: skip


def transient(
    case: Case | PathOrText,
    *,
    folder: PathOrText | None = None,
    resume: bool = False,
    figures: bool = True,
    force: bool = False,
    threads: int = 0,
    progress: ProgressChoice = None,
    **changes: Any,
) -> TransientResult:
    """Explicit contact transient. Ctrl-C keeps what is computed; ``resume=True`` with the same ``folder`` goes on from there
    to the same bytes.

    Arguments and exceptions as of :func:`cea`.
    """
    return _run(
        TransientResult, "transient", case, changes, options=_resumed(resume),
        folder=folder, figures=figures, force=force, threads=threads, progress=progress,
    )  # fmt: skip


def cycle(
    case: Case | PathOrText,
    *,
    folder: PathOrText | None = None,
    figures: bool = True,
    force: bool = False,
    threads: int = 0,
    progress: ProgressChoice = None,
    **changes: Any,
) -> CycleResult:
    """Limit cycles without time stepping. Arguments and exceptions as of :func:`cea`."""
    return _run(
        CycleResult, "cycle", case, changes,
        folder=folder, figures=figures, force=force, threads=threads, progress=progress,
    )  # fmt: skip


def frf(
    case: Case | PathOrText,
    *,
    folder: PathOrText | None = None,
    figures: bool = True,
    force: bool = False,
    threads: int = 0,
    progress: ProgressChoice = None,
    **changes: Any,
) -> FrfResult:
    """Frequency response. Arguments and exceptions as of :func:`cea`."""
    return _run(
        FrfResult, "frf", case, changes,
        folder=folder, figures=figures, force=force, threads=threads, progress=progress,
    )  # fmt: skip


def sweep(
    case: Case | PathOrText,
    *,
    folder: PathOrText | None = None,
    resume: bool = False,
    figures: bool = True,
    force: bool = False,
    threads: int = 0,
    progress: ProgressChoice = None,
    **changes: Any,
) -> SweepResult:
    """Analyses on a grid of parameters. ``resume=True`` with the same ``folder`` runs the points that are missing.

    Arguments and exceptions as of :func:`cea`.
    """
    return _run(
        SweepResult, "sweep", case, changes, options=_resumed(resume),
        folder=folder, figures=figures, force=force, threads=threads, progress=progress,
    )  # fmt: skip


def fit(
    case: Case | PathOrText,
    modes: PathOrText,
    *,
    folder: PathOrText | None = None,
    figures: bool = True,
    force: bool = False,
    threads: int = 0,
    progress: ProgressChoice = None,
    **changes: Any,
) -> FitResult:
    """Parameters of a case from measured modes.

    Args:
        case: a :class:`Case` or the path of a case file, with a ``[fit]`` section.
        modes: a table with ``frequency_hz`` and, where known, ``real_hz`` or ``damping_factor``, ``harmonic``, ``sigma_hz``.

    The other arguments and exceptions as of :func:`cea`.
    """
    return _run(
        FitResult, "fit", case, changes, inputs=[os.fspath(modes)],
        folder=folder, figures=figures, force=force, threads=threads, progress=progress,
    )  # fmt: skip


def identify(
    response: PathOrText,
    *,
    folder: PathOrText | None = None,
    figures: bool = True,
    force: bool = False,
    options: Sequence[str] = (),
) -> IdentifyResult:
    """Resonances and Rayleigh damping from a measured frequency response.

    Args:
        response: a text table, a universal file (UFF 58) or a MATLAB file.
        options: further options of ``frictionsim identify``, such as ``["--from", "1000", "--to", "9000"]``.

    The other arguments and exceptions as of :func:`cea`.
    """
    words = [os.fspath(response), *options]
    return _execute(IdentifyResult, "identify", words, folder, figures, force, 0, False)


def uncertainty(
    case: Case | PathOrText,
    *,
    folder: PathOrText | None = None,
    resume: bool = False,
    figures: bool = True,
    force: bool = False,
    threads: int = 0,
    progress: ProgressChoice = None,
    **changes: Any,
) -> UncertaintyResult:
    """How likely squeal is where parameters scatter, and which one decides it. Arguments and exceptions as of :func:`cea`."""
    return _run(
        UncertaintyResult, "uncertainty", case, changes, options=_resumed(resume),
        folder=folder, figures=figures, force=force, threads=threads, progress=progress,
    )  # fmt: skip


def convergence(
    case: Case | PathOrText,
    *,
    folder: PathOrText | None = None,
    figures: bool = True,
    force: bool = False,
    threads: int = 0,
    progress: ProgressChoice = None,
    **changes: Any,
) -> Result:
    """Analyses over mesh and time step, with limits and observed orders. Arguments and exceptions as of :func:`cea`."""
    return _run(
        Result, "convergence", case, changes,
        folder=folder, figures=figures, force=force, threads=threads, progress=progress,
    )  # fmt: skip


def basin(
    case: Case | PathOrText,
    *,
    folder: PathOrText | None = None,
    figures: bool = True,
    force: bool = False,
    threads: int = 0,
    progress: ProgressChoice = None,
    **changes: Any,
) -> Result:
    """Which of two limit cycles a transient ends on. Arguments and exceptions as of :func:`cea`."""
    return _run(
        Result, "basin", case, changes,
        folder=folder, figures=figures, force=force, threads=threads, progress=progress,
    )  # fmt: skip


def mesh(
    case: Case | PathOrText,
    *,
    folder: PathOrText | None = None,
    figures: bool = True,
    force: bool = False,
    threads: int = 0,
    progress: ProgressChoice = None,
    **changes: Any,
) -> Result:
    """The mesh of a case and its statistics. Arguments and exceptions as of :func:`cea`."""
    return _run(
        Result, "mesh", case, changes,
        folder=folder, figures=figures, force=force, threads=threads, progress=progress,
    )  # fmt: skip


def matrices(
    case: Case | PathOrText,
    *,
    friction: float | None = None,
    folder: PathOrText | None = None,
    force: bool = False,
    threads: int = 0,
    progress: ProgressChoice = None,
    **changes: Any,
) -> MatricesResult:
    """Mass, damping and stiffness of small motions around steady sliding as SciPy matrices, over the friction coefficient or at
    ``friction`` alone.

    Arguments and exceptions as of :func:`cea`.
    """
    return _run(
        MatricesResult, "matrices", case, changes,
        options=[] if friction is None else ["--friction", repr(float(friction))],
        folder=folder, figures=False, force=force, threads=threads, progress=progress,
    )  # fmt: skip


def check(case: Case | PathOrText, **changes: Any) -> dict[str, Any]:
    """Validate a case without running it: unknowns, steps, memory and time of its runs, and warnings.

    Raises:
        CaseError: the case is not valid.
    """
    return as_case(case, changes).check()


def open_results(folder: PathOrText) -> Result:
    """The results in a folder, whether Python or the command line has written them."""
    kinds: dict[str, type[Result]] = {
        "cea": CeaResult,
        "cycle": CycleResult,
        "fit": FitResult,
        "frf": FrfResult,
        "identify": IdentifyResult,
        "matrices": MatricesResult,
        "sweep": SweepResult,
        "transient": TransientResult,
        "uncertainty": UncertaintyResult,
    }
    result = Result(Path(folder))
    return kinds.get(result.summary.get("command", ""), Result)(Path(folder))
