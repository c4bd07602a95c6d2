"""Runs: the bytes of the command line, threads, memory, interruption."""

from __future__ import annotations

import ctypes
import gc
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import textwrap
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from conftest import COARSE, LONG, assert_same_files, command_line, options

import frictionsim
from frictionsim import _run


class Enough(Exception):
    """Ends a run from its progress."""


def test_an_analysis_gives_the_bytes_of_the_command_line(disc: frictionsim.Case, tmp_path: Path) -> None:
    command_line("cea", str(disc.path), "-o", "cli", *options(disc), folder=tmp_path)
    result = frictionsim.cea(disc, folder=tmp_path / "python")
    assert_same_files(tmp_path / "cli", result.folder)
    summaries = [frictionsim.open_results(tmp_path / name).summary for name in ("cli", "python")]
    for summary in summaries:
        del summary["wall_s"]
    assert summaries[0] == summaries[1]


def test_other_commands_give_the_bytes_of_the_command_line(tmp_path: Path) -> None:
    run = {**COARSE, "transient.duration": 1e-3, "output.probes": [1], "output.snapshots": [5e-4]}
    transient = frictionsim.Case.shipped("polycarbonate-610rpm").changed(run)
    frf = frictionsim.Case.shipped("hammer-test").changed({**COARSE, "frf.force_node": 4, "frf.response_node": 4})
    for command, case in {"transient": transient, "frf": frf}.items():
        command_line(command, str(case.path), "-o", command, "--no-figures", *options(case), folder=tmp_path)
        result = getattr(frictionsim, command)(case, figures=False)
        names = list(result.tables)
        assert names
        for name in names:
            ours = (result.folder / f"{name}.csv").read_bytes()
            assert ours == (tmp_path / command / f"{name}.csv").read_bytes(), name


def test_two_threads_at_once_get_their_own_results(disc: frictionsim.Case) -> None:
    frictions = [0.05, 0.1, 0.2, 0.3, 0.4, 0.5]

    def growth(friction: float) -> np.ndarray:
        own = disc.changed({"cea.friction_coefficients": [friction]})
        eigenvalues = frictionsim.cea(own, figures=False, progress=False).eigenvalues
        # The table has the case's own friction, 0.3, too.
        assert set(eigenvalues["friction_coefficient"]) == {friction, 0.3}
        return eigenvalues["growth_rate_per_s"][eigenvalues["friction_coefficient"] == friction]

    alone = [growth(friction) for friction in frictions]
    with ThreadPoolExecutor(2) as pool:
        together = list(pool.map(growth, frictions))
    for one, other in zip(alone, together, strict=True):
        np.testing.assert_array_equal(one, other)


def test_other_python_threads_go_on_during_a_run(long_transient: frictionsim.Case, tmp_path: Path) -> None:
    enough = threading.Event()

    def tell(*_: object) -> None:
        if enough.is_set():
            raise Enough

    def run() -> None:
        with pytest.raises(Enough):
            frictionsim.transient(long_transient, folder=tmp_path / "run", figures=False, progress=tell)

    thread = threading.Thread(target=run)
    thread.start()
    # A run that held the interpreter would let this loop go on only after its end, which takes minutes.
    for _ in range(200):
        time.sleep(1e-3)
        assert thread.is_alive()
    enough.set()
    thread.join()


def test_the_number_of_threads_changes_no_byte(disc: frictionsim.Case) -> None:
    one, two = (frictionsim.cea(disc, threads=threads, figures=False) for threads in (1, 2))
    assert (one.folder / "eigenvalues.csv").read_bytes() == (two.folder / "eigenvalues.csv").read_bytes()
    assert [result.summary["manifest"]["threads"] for result in (one, two)] == [1, 2]


def resident_bytes() -> int:
    """Memory of this process, where the system says it, without what the allocator keeps for later."""
    gc.collect()
    # Of the C library of GNU.
    getattr(ctypes.CDLL(None), "malloc_trim", lambda kept: kept)(0)
    pages = Path("/proc/self/statm").read_text().split()[1]
    return int(pages) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="this system does not say how much memory is taken")
def test_memory_does_not_grow_from_call_to_call(
    disc: frictionsim.Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    if Path("/dev/shm").is_dir():
        # Most of a small call is waiting for the disk.
        monkeypatch.setattr(tempfile, "tempdir", "/dev/shm")
    case = disc.changed({"cea.friction_coefficients": [0.3], "cea.modes": 2, "cea.max_frequency_hz": None})
    case["cea.shapes_at"] = []

    def call(count: int) -> int:
        for _ in range(count):
            result = frictionsim.cea(case, figures=False, progress=False, threads=1)
            assert len(result.eigenvalues["mode"]) == 2
        return resident_bytes()

    count = 1000 if LONG else 100
    before = call(100)
    growth = []
    # A leak of two kilobytes a call grows in every round; allocators may take pages once more.
    for _ in range(5):
        after = call(count)
        growth.append((after - before) / count)
        before = after
        if growth[-1] < 2e3:
            return
    pytest.fail(f"bytes a call: {growth}")


# Started in the background by a script, tests inherit that interrupts are ignored.
SCRIPT = """
import signal, sys, frictionsim
signal.signal(signal.SIGINT, signal.default_int_handler)
case = frictionsim.Case(sys.argv[1], eval(sys.argv[2]))
print("begin", flush=True)
try:
    run, folder = getattr(frictionsim, sys.argv[3]), sys.argv[4] or None
    run(case, folder=folder, figures=False, progress=lambda *told: print("told", flush=True))
except KeyboardInterrupt as interrupt:
    print("interrupted:", interrupt, flush=True)
"""


# What is promised where the machine has nothing else to do: a second. A loaded machine may take longer, but none of these runs
# would end by itself in that time. `FRICTIONSIM_PROMPT=1` holds the tests to the promise.
LONGEST = 1.0 if os.environ.get("FRICTIONSIM_PROMPT") else 20.0


def interrupted(case: frictionsim.Case, command: str, folder: Path | str) -> str:
    """Interrupt a run on its way, hold its return to the limit, and give what it says."""
    changes = repr(case._changes)
    words = [sys.executable, "-c", textwrap.dedent(SCRIPT), str(case.path), changes, command, str(folder)]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        # The first words come from the start of the run, those after them from its midst.
        for _ in range(4):
            while "told" not in (line := process.stdout.readline()):
                assert line, "the run ended before it was interrupted"
        begin = time.perf_counter()
        process.send_signal(signal.SIGINT)
        while (said := process.stdout.readline()).startswith("told"):
            pass
        wall = time.perf_counter() - begin
        process.communicate()
    assert wall < LONGEST, f"{wall:.2f} s"
    return said


def test_ctrl_c_ends_a_transient_at_once_and_it_resumes_to_the_same_bytes(
    long_transient: frictionsim.Case, tmp_path: Path
) -> None:
    said = interrupted(long_transient, "transient", tmp_path / "run")
    assert "resume=True" in said and "stopped at t =" in said, said
    stopped = frictionsim.open_results(tmp_path / "run")
    reached = stopped.table("energy")["time_s"][-1]
    # Goes on for a little more, to the bytes of a run that was never stopped.
    longer = long_transient.changed({"transient.duration": float(np.ceil(reached * 1e2) / 1e2 + 0.01)})
    resumed = frictionsim.transient(longer, folder=tmp_path / "run", resume=True, figures=False)
    whole = frictionsim.transient(longer, figures=False)
    for name in whole.tables:
        assert (resumed.folder / f"{name}.csv").read_bytes() == (whole.folder / f"{name}.csv").read_bytes(), name


def test_ctrl_c_ends_a_sweep_at_once_and_keeps_its_folder(long_transient: frictionsim.Case, tmp_path: Path) -> None:
    sweep = {"sweep": {"contact.friction_coefficient": [0.2, 0.3, 0.4], "analyses": ["transient"]}}
    said = interrupted(long_transient.changed(sweep), "sweep", tmp_path / "study")
    assert "resume=True" in said, said
    short = {**sweep, "transient.duration": 1e-3}
    with pytest.raises(frictionsim.UsageError, match="other"):
        frictionsim.sweep(long_transient.changed(short), folder=tmp_path / "study", figures=False)


def test_ctrl_c_ends_an_eigenvalue_analysis_at_once_and_keeps_its_folder() -> None:
    case = frictionsim.Case.shipped("polycarbonate-disc").changed({"cea.method": "sparse"})
    said = interrupted(case, "cea", "")
    kept = re.search("pass folder='(.+)' with resume=True", said)
    assert kept and Path(kept[1]).is_dir(), said
    shutil.rmtree(kept[1])


def test_commands_are_resumed_as_on_the_command_line_and_others_say_so(disc: frictionsim.Case) -> None:
    def help_of(command: str) -> str:
        words = [sys.executable, "-m", "frictionsim", command, "--help"]
        return subprocess.run(words, capture_output=True, text=True, check=True).stdout

    for command in ("basin", "cea", "convergence", "cycle", "frf", "improve", "mesh", "sweep", "transient", "uncertainty"):
        assert ("--resume" in help_of(command)) == (command in _run._RESUMABLE), command
        if command not in _run._RESUMABLE:
            with pytest.raises(TypeError, match="cannot be resumed"):
                getattr(frictionsim, command)(disc, resume=True)


def test_progress_is_told_and_may_stop_the_run(long_transient: frictionsim.Case) -> None:
    told: list[tuple[str, int, int | None]] = []

    def tell(message: str, done: int, total: int | None) -> None:
        told.append((message, done, total))
        if len(told) == 3:
            raise Enough

    with pytest.raises(Enough):
        frictionsim.transient(long_transient, figures=False, progress=tell)
    message, done, total = told[-1]
    assert "stick" in message and total == round(LONG / 1e-3) + 1 and 0 < done < total


def test_a_folder_in_use_is_refused_with_the_remedy(long_transient: frictionsim.Case, tmp_path: Path) -> None:
    begun, stop = threading.Event(), threading.Event()

    def tell(*_: object) -> None:
        begun.set()
        if stop.is_set():
            raise Enough

    def run() -> None:
        with pytest.raises(Enough):
            frictionsim.transient(long_transient, folder=tmp_path / "run", figures=False, progress=tell)

    thread = threading.Thread(target=run)
    thread.start()
    assert begun.wait(20)
    try:
        with pytest.raises(frictionsim.RunError, match="another folder with folder="):
            frictionsim.transient(long_transient, folder=tmp_path / "run", figures=False)
    finally:
        stop.set()
        thread.join()


def test_what_sets_runs_side_by_side_takes_folders_and_results(disc: frictionsim.Case, tmp_path: Path) -> None:
    first, second = (frictionsim.cea(disc.changed({"contact.interference": value})) for value in (25e-6, 30e-6))
    compared = frictionsim.compare(first, second.folder, folder=tmp_path / "compared")
    assert len(compared.differences) > 0
    assert "locus" in frictionsim.plot(first, width="column").figures
    study = disc.changed({"sweep": {"analyses": ["cea"], "material.density": [1200.0, 1300.0]}})
    points = frictionsim.sweep(study, folder=tmp_path / "study", figures=False).points
    gathered = frictionsim.collect(tmp_path / "study", figures=False).points
    np.testing.assert_array_equal(gathered["material.density"], points["material.density"])


def test_shapes_and_records_are_held_against_a_case(disc: frictionsim.Case, tmp_path: Path) -> None:
    angles = np.linspace(0.0, 2 * np.pi, 16, endpoint=False)
    rows = ["x,y,z,ux,uy,uz,mode,frequency_hz"]
    rows += [f"{0.0205 * np.cos(a)},{0.0205 * np.sin(a)},0,{-np.sin(a)},{np.cos(a)},0,1,7000" for a in angles]
    (tmp_path / "shapes.csv").write_text("\n".join(rows) + "\n")
    whole = disc.changed({"cea.method": "sparse"})
    assert len(frictionsim.mac(whole, tmp_path / "shapes.csv", figures=False).mac) > 0
    time_s = np.arange(4000) / 40000.0
    lines = ["time_s,pressure_pa", *(f"{t},{np.sin(2 * np.pi * 3000.0 * t)}" for t in time_s)]
    (tmp_path / "sound.csv").write_text("\n".join(lines) + "\n")
    peaks = frictionsim.signal(tmp_path / "sound.csv", figures=False).peaks
    assert np.any(np.abs(peaks["frequency_hz"] - 3000.0) < 10.0)
