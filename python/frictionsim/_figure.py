"""Figures of results, shown in notebooks."""

from __future__ import annotations

import base64
from collections.abc import Iterator, Mapping
from pathlib import Path


class Figure:
    """One figure, in the formats that the run has drawn."""

    def __init__(self, stem: Path, keeper: object = None) -> None:
        self._stem = stem
        # A temporary results folder stays as long as somebody has a figure of it.
        self._keeper = keeper

    @property
    def name(self) -> str:
        """Name of the figure."""
        return self._stem.name

    def path(self, extension: str = "svg") -> Path:
        """The file of one format: ``svg``, ``png`` or ``pdf``."""
        return self._stem.with_name(f"{self.name}.{extension}")

    @property
    def svg(self) -> str:
        """The figure as SVG."""
        return self.path("svg").read_text(encoding="utf-8")

    @property
    def png(self) -> bytes:
        """The figure as PNG."""
        return self.path("png").read_bytes()

    def _repr_svg_(self) -> str | None:
        return self.svg if self.path("svg").exists() else None

    def _repr_png_(self) -> bytes | None:
        return self.png if self.path("png").exists() else None

    def _repr_html_(self) -> str | None:
        # As an image: names inside several figures of one page must not meet.
        if not self.path("svg").exists():
            return None
        code = base64.b64encode(self.path("svg").read_bytes()).decode()
        return f'<img alt="{self.name}" src="data:image/svg+xml;base64,{code}"/>'

    def __repr__(self) -> str:
        return f"Figure({self.name})"


class Figures(Mapping[str, Figure]):
    """The figures of a results folder by name."""

    def __init__(self, folder: Path, keeper: object = None) -> None:
        files = sorted(folder.iterdir()) if folder.is_dir() else []
        drawn = (file.with_suffix("") for file in files if file.suffix in {".svg", ".png", ".pdf"})
        self._figures = {stem.name: Figure(stem, keeper) for stem in drawn}

    def __getitem__(self, name: str) -> Figure:
        try:
            return self._figures[name]
        except KeyError:
            raise KeyError(f"no figure {name}: there are {', '.join(self._figures) or 'none'}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._figures)

    def __len__(self) -> int:
        return len(self._figures)

    def _repr_html_(self) -> str:
        return "".join(figure._repr_html_() or "" for figure in self.values())
