"""Fields on meshes, from the VTU files of results."""

from __future__ import annotations

import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pyvista

_TYPES = {"Float64": "<f8", "Float32": "<f4", "Int64": "<i8", "Int32": "<i4", "UInt8": "u1", "Int8": "i1"}


@dataclass(frozen=True)
class Cells:
    """Elements of a mesh."""

    connectivity: NDArray[np.int64]
    """Points of every element, one element behind the other, counted from 0."""
    offsets: NDArray[np.int64]
    """Where each element ends in ``connectivity``."""
    types: NDArray[np.uint8]
    """VTK type of each: 5 triangle, 9 quadrilateral, 10 tetrahedron, 12 hexahedron, ..."""

    def __len__(self) -> int:
        return len(self.offsets)

    def __getitem__(self, number: int) -> NDArray[np.int64]:
        """The points of one element."""
        count = len(self)
        if not -count <= number < count:
            raise IndexError(f"element {number} of {count}")
        number %= count
        start = self.offsets[number - 1] if number else 0
        return self.connectivity[start : self.offsets[number]]


class Field:
    """A mesh with values at its points and in its elements."""

    def __init__(self, path: Path, keeper: object = None) -> None:
        """Read a VTU file as this program writes it: appended raw data, zlib-compressed blocks."""
        # A temporary results folder stays as long as somebody has a field of it.
        self._keeper = keeper
        self.path = path
        """The file."""
        content = path.read_bytes()
        start = content.index(b"<AppendedData")
        begin = content.index(b"_", start) + 1
        root = ElementTree.fromstring(content[:start] + b"</VTKFile>")
        self._data = memoryview(content)[begin:]
        piece = root.find(".//Piece")
        if piece is None:
            raise ValueError(f"{path} holds no mesh")
        self._piece = piece
        self.points: NDArray[np.float64] = self._array("Points")[0]
        """Places of the nodes, m, three coordinates each."""
        cells = {name: self._array("Cells", name)[0] for name in ("connectivity", "offsets", "types")}
        self.cells = Cells(**cells)
        """The elements."""
        self.numbers = {
            data.get("Name", ""): np.array((data.text or "").split(), dtype=float).tolist()
            for data in root.iterfind(".//FieldData/DataArray")
            if data.get("format") == "ascii"
        }
        """Numbers of the whole field: frequency, time, ...; each a list."""

    def _array(self, section: str, name: str | None = None) -> list[NDArray[Any]]:
        found = self._piece.find(section)
        arrays = [] if found is None else found.findall("DataArray")
        return [self._decoded(data) for data in arrays if name in (None, data.get("Name"))]

    def _decoded(self, data: ElementTree.Element) -> NDArray[Any]:
        kind = np.dtype(_TYPES[data.get("type", "")])
        offset = int(data.get("offset", "0"))
        blocks, _, _ = np.frombuffer(self._data, "<u8", 3, offset)
        sizes = np.frombuffer(self._data, "<u8", int(blocks), offset + 24)
        begin = offset + 24 + 8 * int(blocks)
        parts = []
        for size in sizes:
            parts.append(zlib.decompress(self._data[begin : begin + int(size)]))
            begin += int(size)
        values = np.frombuffer(b"".join(parts), kind)
        components = int(data.get("NumberOfComponents", "1"))
        return values.reshape(-1, components) if components > 1 else values

    def _named(self, section: str) -> dict[str, NDArray[Any]]:
        found = self._piece.find(section)
        arrays = [] if found is None else found.findall("DataArray")
        return {data.get("Name", ""): self._decoded(data) for data in arrays}

    @property
    def point_data(self) -> dict[str, NDArray[Any]]:
        """Values at the points by their names, which end in the unit."""
        return self._named("PointData")

    @property
    def cell_data(self) -> dict[str, NDArray[Any]]:
        """Values in the elements by their names."""
        return self._named("CellData")

    def to_pyvista(self) -> pyvista.UnstructuredGrid:
        """The field as a PyVista grid."""
        import pyvista

        return cast("pyvista.UnstructuredGrid", pyvista.read(str(self.path)))

    def __repr__(self) -> str:
        return f"Field({self.path.name}: {len(self.points)} points, {len(self.cells)} elements)"


def collection(path: Path) -> list[tuple[float, Path]]:
    """Time (or number) and file of each entry of a PVD file."""
    if not path.exists():
        return []
    entries = ElementTree.parse(path).iterfind(".//DataSet")
    return [(float(entry.get("timestep", "nan")), path.parent / entry.get("file", "")) for entry in entries]
