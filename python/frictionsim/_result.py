"""Results of runs: folders as the command line writes them, read when they are asked for."""

from __future__ import annotations

import json
import shutil
import tempfile
from collections.abc import Sequence
from functools import cached_property
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import NDArray

from ._errors import UsageError
from ._figure import Figures
from ._table import Table
from ._vtu import Cells, Field, collection

if TYPE_CHECKING:
    import scipy.sparse


class Result:
    """The results of a run.

    Each table of the folder is an attribute of its name, ``probe-1621.csv`` is ``result.probe_1621``.
    """

    def __init__(self, folder: Path, keeper: tempfile.TemporaryDirectory[str] | None = None) -> None:
        self.folder = folder
        """The results folder, as the command line writes it; a temporary one goes with this object and what is taken of it."""
        self._keeper = keeper

    @cached_property
    def summary(self) -> dict[str, Any]:
        """``summary.json``: the numbers that matter, warnings, and what the results are made from."""
        path = self.folder / "summary.json"
        try:
            found: dict[str, Any] = json.loads(path.read_bytes())
        except FileNotFoundError:
            raise UsageError(f"{self.folder} holds no finished results: summary.json is missing") from None
        return found

    @cached_property
    def tables(self) -> dict[str, Path]:
        """The tables of the folder by name."""
        return {path.stem: path for path in sorted(self.folder.glob("*.csv"))}

    def table(self, name: str) -> Table:
        """A table by the name of its file, with or without extension."""
        path = self.folder / (name if name.endswith(".csv") else f"{name}.csv")
        if not path.exists():
            raise KeyError(f"no table {name}: there are {', '.join(self.tables)}")
        return Table(path)

    def __getattr__(self, name: str) -> Table:
        if not name.startswith("_"):
            for stem in self.tables:
                if stem.replace("-", "_") == name:
                    table = Table(self.tables[stem])
                    self.__dict__[name] = table
                    return table
        own = ", ".join(stem.replace("-", "_") for stem in self.tables) if "folder" in self.__dict__ else ""
        raise AttributeError(f"{type(self).__name__} has no attribute {name}; its tables are {own or 'none'}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(stem.replace("-", "_") for stem in self.tables)]

    @property
    def figures(self) -> Figures:
        """The figures by name; a notebook shows them."""
        return Figures(self.folder / "figures", self._keeper)

    @property
    def report(self) -> Path:
        """The page with every figure, for a browser."""
        return self.folder / "report.html"

    @cached_property
    def mesh(self) -> Field:
        """The mesh: ``points``, ``cells``."""
        named = [self.folder / "mesh.vtu", self.folder / "prestress.vtu"]
        found = [*named, *sorted(self.folder.glob("*/*.vtu")), *sorted(self.folder.glob("*.vtu"))]
        for path in found:
            if path.exists():
                return Field(path, self._keeper)
        raise AttributeError("these results have no fields: frictionsim.mesh(case).mesh is the mesh of their case")

    def save(self, folder: str | Path) -> Path:
        """Copy the results to a folder that does not exist yet."""
        return Path(shutil.copytree(self.folder, folder, ignore=shutil.ignore_patterns(".*")))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({str(self.folder)!r})"

    def _repr_html_(self) -> str:
        rows = [
            f"<tr><th>{escape(key)}</th><td>{escape(f'{value:.6g}' if isinstance(value, float) else str(value))}</td></tr>"
            for key, value in self.summary.items()
            if isinstance(value, (str, int, float)) and key not in {"title", "command"}
        ]
        title = escape(str(self.summary.get("title", "")))
        return f"<p><b>{title}</b></p><table>{''.join(rows)}</table>{self.figures._repr_html_()}"


class Mode:
    """A mode shape of a complex eigenvalue analysis."""

    def __init__(self, path: Path, keeper: object = None) -> None:
        self._field = Field(path, keeper)
        self.path = path
        """The VTU file."""
        numbers = self._field.numbers
        self.friction_coefficient: float = numbers["friction_coefficient"][0]
        """Friction coefficient at which it was solved."""
        self.frequency_hz: float = numbers["frequency_hz"][0]
        """Frequency, Hz."""
        self.real_hz: float = numbers["real_hz"][0]
        """Real part over 2 pi, Hz; positive: unstable."""

    @property
    def eigenvalue(self) -> complex:
        """Eigenvalue, rad/s, to the twelve digits of the file; :attr:`CeaResult.eigenvalues` has all."""
        return 2 * np.pi * complex(self.real_hz, self.frequency_hz)

    @cached_property
    def shape(self) -> NDArray[np.complex128]:
        """Complex displacement of each point along x, y, z."""
        data = self._field.point_data
        return data["displacement_real"] + 1j * data["displacement_imaginary"]

    @property
    def mesh(self) -> Field:
        """The mesh with the fields of the mode."""
        return self._field

    def __repr__(self) -> str:
        return f"Mode({self.frequency_hz:.1f} Hz, real part {self.real_hz:.3g} Hz, friction {self.friction_coefficient:g})"


class Modes(Sequence[Mode]):
    """Mode shapes in the order of the analysis: by friction coefficient, then frequency; read when asked for."""

    def __init__(self, paths: list[Path], keeper: object = None) -> None:
        self._paths = paths
        self._keeper = keeper

    @overload
    def __getitem__(self, number: int) -> Mode: ...
    @overload
    def __getitem__(self, number: slice) -> Modes: ...
    def __getitem__(self, number: int | slice) -> Mode | Modes:
        if isinstance(number, slice):
            return Modes(self._paths[number], self._keeper)
        return Mode(self._paths[number], self._keeper)

    def __len__(self) -> int:
        return len(self._paths)

    def __repr__(self) -> str:
        return f"Modes({len(self)})"


class CeaResult(Result):
    """Complex eigenvalues over the friction coefficient."""

    @cached_property
    def eigenvalues(self) -> Table:
        """One row for each mode and friction value."""
        return self.table("eigenvalues")

    @cached_property
    def stability(self) -> Table:
        """One row for each crossing into instability."""
        return self.table("stability")

    @cached_property
    def prestress(self) -> Table:
        """Contact pressure and shear of steady sliding."""
        return self.table("prestress")

    @cached_property
    def modes(self) -> Modes:
        """The mode shapes at the friction coefficients of ``cea.shapes_at``."""
        return Modes([path for _, path in collection(self.folder / "modes.pvd")], self._keeper)

    @property
    def critical_friction(self) -> float:
        """Lowest friction coefficient at which steady sliding is lost; infinite if it is not."""
        found = self.stability["critical_friction"]
        return float(np.min(found)) if len(found) else float("inf")


class TransientResult(Result):
    """Motion over time."""

    @cached_property
    def energy(self) -> Table:
        """Energies and powers over time."""
        return self.table("energy")

    @cached_property
    def contact(self) -> Table:
        """Fractions of the contact nodes that stick, slip, are open."""
        return self.table("contact")

    @property
    def probes(self) -> dict[str, Table]:
        """Motion of each probe, by its name."""
        names = [name for name in self.tables if name.startswith("probe-")]
        return {name.removeprefix("probe-"): self.table(name) for name in names}

    @cached_property
    def contact_history(self) -> dict[str, NDArray[Any]]:
        """Status, pressure and shear of every contact node over time."""
        with np.load(self.folder / "contact.npz") as found:
            return dict(found)

    @property
    def snapshots(self) -> list[tuple[float, Field]]:
        """Fields at the times of ``output.snapshots``, s."""
        return [(time, Field(path, self._keeper)) for time, path in collection(self.folder / "snapshots.pvd")]

    @property
    def settled(self) -> bool:
        """Whether amplitude, frequency and status no longer change."""
        return bool(self.summary["settled"])


class FrfResult(Result):
    """A frequency response."""

    @cached_property
    def response(self) -> Table:
        """``frequency_hz`` and the parts of the response."""
        return self.table("frf")

    @property
    def frequency_hz(self) -> NDArray[np.float64]:
        """Frequencies, Hz."""
        return self.response["frequency_hz"]

    @property
    def values(self) -> NDArray[np.complex128]:
        """Complex response at each frequency."""
        real, imaginary = (column for name, column in self.response.items() if name != "frequency_hz")
        return real + 1j * imaginary


class SweepResult(Result):
    """A parameter study."""

    @cached_property
    def points(self) -> Table:
        """One row for each point: the swept keys, then what came out."""
        return self.table("points")


class FitResult(Result):
    """Parameters fitted to measured modes."""

    @property
    def parameters(self) -> dict[str, dict[str, Any]]:
        """``value``, ``low`` and ``high`` (95 %) of each fitted key; no bounds where the data do not give them."""
        found: dict[str, dict[str, Any]] = self.summary["parameters"]
        return found

    @property
    def values(self) -> dict[str, float]:
        """The fitted values, to be laid over a case: ``frictionsim.cea(case, **result.values)``."""
        return {key: found["value"] for key, found in self.parameters.items()}

    @cached_property
    def residuals(self) -> Table:
        """Each measured line with its mode and their difference."""
        return self.table("fit")


class IdentifyResult(Result):
    """Damping identified from a measured frequency response."""

    @property
    def damping(self) -> dict[str, float]:
        """The damping of a case, to be laid over it: ``frictionsim.cea(case, **result.damping)``."""
        keys = ("mass_coefficient", "stiffness_coefficient")
        return {f"damping.{key}": self.summary[key]["value"] for key in keys}

    @cached_property
    def modes(self) -> Table:
        """Frequency and damping factor of each resonance."""
        return self.table("modes")


class ImproveResult(Result):
    """Changes that silence the unstable modes."""

    @cached_property
    def candidates(self) -> Table:
        """One row for each change, the best first, predicted and run again."""
        return self.table("candidates")


class MacResult(Result):
    """Measured shapes beside the modes of a case."""

    @cached_property
    def mac(self) -> Table:
        """One row for each measured shape and mode."""
        return self.table("mac")


class SignalResult(Result):
    """The lines of a sound or vibration."""

    @cached_property
    def peaks(self) -> Table:
        """One row for each line, with the mode that it may be."""
        return self.table("peaks")


class CompareResult(Result):
    """Finished runs side by side."""

    @cached_property
    def differences(self) -> Table:
        """One row for each number that the runs share."""
        return self.table("compare")


class UncertaintyResult(Result):
    """How likely squeal is."""

    @property
    def probability_unstable(self) -> dict[str, float]:
        """``value``, ``low`` and ``high`` at the friction coefficient of the case."""
        found: dict[str, float] = self.summary["probability_unstable"]
        return found

    @cached_property
    def samples(self) -> Table:
        """One row for each sample."""
        return self.table("samples")


class CycleResult(Result):
    """Limit cycles found without time stepping."""

    @property
    def cycles(self) -> list[dict[str, Any]]:
        """What is said of each cycle."""
        found: list[dict[str, Any]] = self.summary["cycles"]
        return found


class MatricesResult(Result):
    """The matrices of small motions around steady sliding, `(lambda^2 M + lambda C + K) x = 0`, in SciPy's compressed rows.

    Each is a polynomial in the distance from ``friction_coefficient``, valid within ``friction_range``; of
    ``matrices(case, friction=...)`` its value there alone.
    """

    @cached_property
    def description(self) -> dict[str, Any]:
        """What multiplies what: ``matrices.json``, or the summary of matrices at one friction coefficient."""
        path = self.folder / "matrices.json"
        found: dict[str, Any] = json.loads(path.read_bytes()) if path.exists() else self.summary
        return found

    @property
    def friction_coefficient(self) -> float:
        """Friction coefficient about which the matrices are given: that of the case, or the one asked for."""
        return float(self.description["friction_coefficient"])

    @property
    def friction_range(self) -> tuple[float, float]:
        """Friction coefficients between which the matrices hold."""
        low, high = self.description["friction_range"]
        return low, high

    @cached_property
    def coefficients(self) -> dict[str, dict[int, scipy.sparse.csr_array]]:
        """The coefficient of each power of the distance from ``friction_coefficient`` in ``M``, ``C``, ``K`` and the losses ``H``."""
        found: dict[str, dict[int, scipy.sparse.csr_array]] = {"M": {}, "C": {}, "K": {}, "H": {}}
        letters = {"mass": "M", "damping": "C", "stiffness": "K", "structural": "H"}
        for entry in self.description["matrices"]:
            if isinstance(entry["role"], dict):
                ((role, power),) = entry["role"].items()
                found[letters[role]][power["friction_power"]] = self._load(entry["name"])
        return found

    def at(self, friction_coefficient: float) -> tuple[Any, Any, Any]:
        """``M``, ``C`` and ``K`` at a friction coefficient within :attr:`friction_range`."""
        low, high = self.friction_range
        if not low <= friction_coefficient <= high:
            raise ValueError(
                f"friction coefficient {friction_coefficient}: other contact points are pressed outside [{low}, {high}]; "
                'ask for the matrices with **{"contact.friction_coefficient": ...}'
            )
        away = friction_coefficient - self.friction_coefficient
        mass, damping, stiffness = (
            sum(matrix * away**power for power, matrix in self.coefficients[letter].items())
            for letter in "MCK"
        )
        return mass, damping, stiffness

    @property
    def M(self) -> scipy.sparse.csr_array:
        """Mass at the friction coefficient of the case, kg/m in the plane."""
        return self.at(self.friction_coefficient)[0]

    @property
    def C(self) -> scipy.sparse.csr_array:
        """Damping there."""
        return self.at(self.friction_coefficient)[1]

    @property
    def K(self) -> scipy.sparse.csr_array:
        """Stiffness there; friction makes it unsymmetric."""
        return self.at(self.friction_coefficient)[2]

    @property
    def contact_normal(self) -> scipy.sparse.csr_array:
        """Motion of each contact point along the normal, out of the unknowns."""
        return self._load("contact_normal")

    @property
    def contact_slip(self) -> scipy.sparse.csr_array:
        """Motion of each contact point along the sliding."""
        return self._load("contact_slip")

    @cached_property
    def unknowns(self) -> Table:
        """Node, direction and place of each unknown."""
        return self.table("unknowns")

    @cached_property
    def contact(self) -> Table:
        """Node, status, length and normal force of each contact point."""
        return self.table("contact")

    def _load(self, name: str) -> scipy.sparse.csr_array:
        try:
            import scipy.sparse
        except ImportError:
            raise ImportError(
                f"the matrices are SciPy's: pip install scipy, or read the Matrix Market files in {self.folder}"
            ) from None
        if not (self.folder / f"{name}.npz").exists():
            import scipy.io

            return scipy.sparse.csr_array(scipy.io.mmread(self.folder / f"{name}.mtx"))
        return scipy.sparse.csr_array(scipy.sparse.load_npz(self.folder / f"{name}.npz"))


__all__ = [
    "CeaResult",
    "Cells",
    "CycleResult",
    "Field",
    "FitResult",
    "FrfResult",
    "IdentifyResult",
    "MatricesResult",
    "Mode",
    "Modes",
    "Result",
    "SweepResult",
    "TransientResult",
    "UncertaintyResult",
]
