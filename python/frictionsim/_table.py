"""Tables of results."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _native

if TYPE_CHECKING:
    import pandas

_SHOWN = 10


class Table(Mapping[str, "NDArray[Any]"]):
    """The columns of a table of results, NumPy arrays by their names; empty cells are NaN."""

    def __init__(self, path: Path) -> None:
        self.path = path
        """The file."""
        found = _native.read_table(path)
        self._columns: dict[str, NDArray[Any]] = {name: np.asarray(column) for name, column in found.items()}

    def __getitem__(self, name: str) -> NDArray[Any]:
        try:
            return self._columns[name]
        except KeyError:
            raise KeyError(f"{self.path.name} has no column {name}: {', '.join(self._columns)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    @property
    def rows(self) -> int:
        """Number of rows."""
        return len(next(iter(self._columns.values()), ()))

    def to_pandas(self) -> pandas.DataFrame:
        """The table as a pandas data frame."""
        import pandas

        return pandas.DataFrame(self._columns)

    def __repr__(self) -> str:
        return f"Table({self.path.name}: {self.rows} rows; {', '.join(self)})"

    def _repr_html_(self) -> str:
        head = "".join(f"<th>{escape(name)}</th>" for name in self)
        lines = []
        for row in range(min(self.rows, _SHOWN)):
            cells = (column[row] for column in self._columns.values())
            lines.append("<tr>" + "".join(f"<td>{escape(_shown(cell))}</td>" for cell in cells) + "</tr>")
        more = f"<p>{self.rows} rows</p>" if self.rows > _SHOWN else ""
        return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(lines)}</tbody></table>{more}"


def _shown(cell: Any) -> str:
    if isinstance(cell, (float, np.floating)):
        return "" if np.isnan(cell) else f"{cell:.6g}"
    return str(cell)
