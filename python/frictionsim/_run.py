"""The analyses: each runs a command of the program in this process and gives its results."""

from __future__ import annotations

import os
import tempfile
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Protocol, TypeVar

from . import _native
from ._case import Case, PathOrText, as_case
from ._errors import FrictionsimWarning, in_python, translate
from ._progress import ProgressChoice, Teller
from ._result import (
    CeaResult,
    CompareResult,
    CycleResult,
    FitResult,
    FrfResult,
    IdentifyResult,
    ImproveResult,
    MacResult,
    MatricesResult,
    Result,
    SignalResult,
    SweepResult,
    TransientResult,
    UncertaintyResult,
)

_R = TypeVar("_R", bound=Result)
_R_co = TypeVar("_R_co", bound=Result, covariant=True)

# Commands that go on where they were interrupted.
_RESUMABLE = {"cea", "cycle", "sweep", "transient", "uncertainty"}


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


class Analysis(Protocol[_R_co]):
    """A command that runs a case."""

    def __call__(
        self,
        case: Case | PathOrText,
        *,
        folder: PathOrText | None = None,
        resume: bool = False,
        figures: bool = True,
        force: bool = False,
        threads: int = 0,
        progress: ProgressChoice = None,
        **changes: Any,
    ) -> _R_co:
        """Run it."""


_ARGUMENTS = """

    Args:
        case: a :class:`Case` or the path of a case file.
        folder: where the results go; ``None`` for a temporary folder that goes with the result.
        resume: continue a stopped run in ``folder`` (cea, transient, cycle, sweep, uncertainty).
        figures: whether figures and report are drawn.
        force: replace the results of another case in the folder.
        threads: worker threads; 0 for all cores. Results do not depend on it.
        progress: ``None`` shows a line in a terminal or a notebook, ``False`` nothing; or a function of message, done and
            total.
        **changes: keys of the case with new values, ``**{"contact.friction_coefficient": 0.3}``; ``None`` takes one away.

    Raises:
        CaseError: the case is not valid; line, key and remedy are its attributes.
        UsageError: a folder that is in use or holds other results, a file that cannot be read.
        RunError: the analysis failed.
        KeyboardInterrupt: within a second of Ctrl-C.
    """


def _analysis(kind: type[_R], command: str, meaning: str) -> Analysis[_R]:
    """The function of a command that needs nothing but a case."""

    def run(
        case: Case | PathOrText,
        *,
        folder: PathOrText | None = None,
        resume: bool = False,
        figures: bool = True,
        force: bool = False,
        threads: int = 0,
        progress: ProgressChoice = None,
        **changes: Any,
    ) -> _R:
        if resume and command not in _RESUMABLE:
            raise TypeError(f"{command} cannot be resumed: it has nothing to go on from")
        return _run(
            kind, command, case, changes, options=["--resume"] if resume else [],
            folder=folder, figures=figures, force=force, threads=threads, progress=progress,
        )  # fmt: skip

    run.__name__ = run.__qualname__ = command
    run.__doc__ = meaning + _ARGUMENTS
    return run


cea = _analysis(CeaResult, "cea", "Complex eigenvalues of steady sliding over the friction coefficient.")
transient = _analysis(TransientResult, "transient", "Growth and saturation of the vibration, step by step in time.")
cycle = _analysis(CycleResult, "cycle", "Limit cycles without time stepping.")
frf = _analysis(FrfResult, "frf", "Frequency response between two nodes.")
sweep = _analysis(SweepResult, "sweep", "Analyses on a grid of parameters.")
uncertainty = _analysis(UncertaintyResult, "uncertainty", "How likely squeal is, and which parameter decides it.")
convergence = _analysis(Result, "convergence", "Analyses over mesh and time step, with limits and observed orders.")
basin = _analysis(Result, "basin", "Which of two limit cycles wins.")
improve = _analysis(ImproveResult, "improve", "Changes that silence the unstable modes, the best of them run again.")
mesh = _analysis(Result, "mesh", "The mesh of a case and its statistics.")


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
    """Mass, damping and stiffness of small motions around steady sliding as SciPy matrices.

    Args:
        case: a :class:`Case` or the path of a case file, with a ``[cea]`` section.
        friction: the matrices at this friction coefficient alone; left out, over the friction coefficient.

    The other arguments and exceptions as of :func:`cea`.
    """
    return _run(
        MatricesResult, "matrices", case, changes,
        options=[] if friction is None else ["--friction", repr(float(friction))],
        folder=folder, figures=False, force=force, threads=threads, progress=progress,
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


def mac(
    case: Case | PathOrText,
    shapes: PathOrText,
    *,
    scale: float = 1.0,
    folder: PathOrText | None = None,
    figures: bool = True,
    force: bool = False,
    threads: int = 0,
    progress: ProgressChoice = None,
    **changes: Any,
) -> MacResult:
    """Modal assurance criterion of measured shapes with the modes of a case.

    Args:
        case: a :class:`Case` or the path of a case file, with a ``[cea]`` section.
        shapes: a universal file with datasets 55, or a table x, y, z, ux, uy, uz with ``mode`` and ``frequency_hz``.
        scale: factor that takes the coordinates of the shapes to metres.

    The other arguments and exceptions as of :func:`cea`.
    """
    return _run(
        MacResult, "mac", case, changes, inputs=[os.fspath(shapes)], options=["--scale", repr(float(scale))],
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


def signal(
    record: PathOrText,
    *,
    case: Case | PathOrText | None = None,
    folder: PathOrText | None = None,
    figures: bool = True,
    force: bool = False,
    options: Sequence[str] = (),
    **changes: Any,
) -> SignalResult:
    """Spectrum of a sound or vibration, beside the modes of a case.

    Args:
        record: a text table, a universal file (UFF 58), a WAV or a MATLAB file.
        case: a case whose modes stand beside the lines; ``changes`` are changes of it.
        options: further options of ``frictionsim signal``, such as ``["--resolution", "20"]``.

    The other arguments and exceptions as of :func:`cea`.
    """
    words = [os.fspath(record), *options]
    if case is not None:
        effective = as_case(case, changes)
        words += ["--case", os.fspath(effective.path)]
        words += [word for change in effective.changes for word in ("--set", change)]
    elif changes:
        raise TypeError("changes need a case: signal(record, case=...)")
    return _execute(SignalResult, "signal", words, folder, figures, force, 0, False)


def compare(
    first: PathOrText | Result,
    *others: PathOrText | Result,
    folder: PathOrText | None = None,
    figures: bool = True,
    force: bool = False,
) -> CompareResult:
    """Finished runs side by side: every number that they share, with its difference from the first.

    Args:
        first: a results folder, or a result of this module.
        others: those that are compared with it.

    The other arguments and exceptions as of :func:`cea`.
    """
    words = [os.fspath(run.folder if isinstance(run, Result) else run) for run in (first, *others)]
    return _execute(CompareResult, "compare", words, folder, figures, force, 0, False)


def collect(folder: PathOrText, *, figures: bool = True) -> SweepResult:
    """Gather the finished points of a sweep that several processes share.

    Raises:
        RunError: points are missing; the table has the others.
    """
    words = ["collect", os.fspath(folder), "-qq", *([] if figures else ["--no-figures"])]
    try:
        _native.run(words, 0, None)
    except _native.NativeFailure as failure:
        translate(failure)
    return SweepResult(Path(folder), None)


def plot(folder: PathOrText | Result, *, dpi: float | None = None, width: float | str | None = None) -> Result:
    """Draw the figures of a results folder again, in another size where one is given.

    Args:
        dpi: resolution of the PNG figures, dots per inch.
        width: ``"column"``, ``"page"`` or mm.

    Raises:
        UsageError: the folder keeps no figures.
    """
    path = Path(folder.folder if isinstance(folder, Result) else folder)
    sizes = [("--dpi", dpi), ("--width", width)]
    options = [word for name, value in sizes if value is not None for word in (name, str(value))]
    try:
        _native.run(["plot", os.fspath(path), "-qq", *options], 0, None)
    except _native.NativeFailure as failure:
        translate(failure)
    return folder if isinstance(folder, Result) else open_results(path)


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
        "compare": CompareResult,
        "cycle": CycleResult,
        "fit": FitResult,
        "frf": FrfResult,
        "identify": IdentifyResult,
        "improve": ImproveResult,
        "mac": MacResult,
        "matrices": MatricesResult,
        "signal": SignalResult,
        "sweep": SweepResult,
        "transient": TransientResult,
        "uncertainty": UncertaintyResult,
    }
    result = Result(Path(folder))
    return kinds.get(result.summary.get("command", ""), Result)(Path(folder))
