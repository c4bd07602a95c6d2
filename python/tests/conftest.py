"""What the tests share: coarse cases that run in milliseconds."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import frictionsim

COARSE = {"mesh.circumferential_elements": 16, "mesh.radial_elements": 3}
LONG = 1000.0


@pytest.fixture
def disc() -> frictionsim.Case:
    """The paper's disc on a coarse mesh."""
    return frictionsim.Case.shipped("polycarbonate-disc").changed({**COARSE, "cea.friction_coefficients": [0.1, 0.3]})


@pytest.fixture
def long_transient() -> frictionsim.Case:
    """A transient of a hundred million steps: on no machine does it end before it is stopped."""
    case = frictionsim.Case.shipped("polycarbonate-610rpm")
    return case.changed({**COARSE, "transient.duration": LONG, "output.probes": [1], "output.sample_interval": 1e-3})


def command_line(*arguments: str, folder: Path) -> None:
    """Run the installed command line."""
    subprocess.run([sys.executable, "-m", "frictionsim", *arguments], check=True, cwd=folder, capture_output=True)


def options(case: frictionsim.Case) -> list[str]:
    """The changes of a case on the command line."""
    return [word for change in case.changes for word in ("--set", change)]


def assert_same_files(one: Path, other: Path) -> None:
    """Two results folders hold the same bytes, but for clocks and the manifest's record of the call."""
    names = [sorted(str(path.relative_to(folder)) for path in folder.rglob("*")) for folder in (one, other)]
    assert names[0] == names[1]
    for name in names[0]:
        path = one / name
        if path.is_file() and path.name not in {"summary.json", "manifest.json", "report.html", ".lock"}:
            assert path.read_bytes() == (other / name).read_bytes(), name
