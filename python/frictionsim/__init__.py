"""Friction-induced vibration by finite elements: complex eigenvalues, transients, limit cycles, frequency responses.

>>> import frictionsim
>>> case = frictionsim.Case.shipped("polycarbonate-disc")
>>> result = frictionsim.cea(case, figures=False, **{
...     "mesh.circumferential_elements": 24, "mesh.radial_elements": 4, "cea.friction_coefficients": [0.0, 0.5],
... })
>>> round(result.critical_friction, 3)
0.122

The commands of the program are functions, the keys of a case their arguments, the files of a results folder their results;
numbers and files are those of the command line ``frictionsim``, which is installed with this package.
"""

from __future__ import annotations

import atexit

from . import _native
from ._case import Case, case_keys, columns, init, shipped_cases, write_shipped_cases
from ._errors import (
    CaseError,
    CaseProblem,
    FrictionsimError,
    FrictionsimWarning,
    InternalError,
    RunError,
    UsageError,
)
from ._figure import Figure, Figures
from ._native import __version__
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
    Mode,
    Modes,
    Result,
    SignalResult,
    SweepResult,
    TransientResult,
    UncertaintyResult,
)
from ._run import (
    basin,
    cea,
    check,
    collect,
    compare,
    convergence,
    cycle,
    fit,
    frf,
    identify,
    improve,
    mac,
    matrices,
    mesh,
    open_results,
    plot,
    signal,
    sweep,
    transient,
    uncertainty,
)
from ._table import Table
from ._vtu import Cells, Field

# A run that was interrupted may still write what it has.
atexit.register(_native.wait_for_stopped)

__all__ = [
    "Case",
    "CaseError",
    "CaseProblem",
    "CeaResult",
    "Cells",
    "CompareResult",
    "CycleResult",
    "Field",
    "Figure",
    "Figures",
    "FitResult",
    "FrfResult",
    "FrictionsimError",
    "FrictionsimWarning",
    "IdentifyResult",
    "ImproveResult",
    "InternalError",
    "MacResult",
    "MatricesResult",
    "Mode",
    "Modes",
    "Result",
    "RunError",
    "SignalResult",
    "SweepResult",
    "Table",
    "TransientResult",
    "UncertaintyResult",
    "UsageError",
    "__version__",
    "basin",
    "case_keys",
    "cea",
    "check",
    "collect",
    "columns",
    "compare",
    "convergence",
    "cycle",
    "fit",
    "frf",
    "identify",
    "improve",
    "init",
    "mac",
    "matrices",
    "mesh",
    "open_results",
    "plot",
    "shipped_cases",
    "signal",
    "sweep",
    "transient",
    "uncertainty",
    "write_shipped_cases",
]
