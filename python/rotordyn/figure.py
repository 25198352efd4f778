"""Figures of results."""

from __future__ import annotations

import os
from typing import Union

from ._values import file_path, write
from .errors import InputError

__all__ = ["Figure"]


class Figure:
    """A figure of rotordyn as SVG, shown by itself in a notebook.

    ``name`` is that of the command's file, ``svg`` the document; ``save("campbell.svg")`` writes it.
    """

    def __init__(self, name: str, svg: str) -> None:
        self.name, self.svg = name, svg

    def _repr_svg_(self) -> str:
        return self.svg

    def _repr_html_(self) -> str:
        return f'<div style="max-width:100%">{self.svg}</div>'

    def __repr__(self) -> str:
        return f"<Figure {self.name}: SVG of {len(self.svg)} characters; .save(path) writes it>"

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the SVG document; the path ends in .svg."""
        name = file_path("save", path)
        if not name.lower().endswith(".svg"):
            raise InputError(f"figures are saved as SVG: {name!r} does not end in .svg")
        write(name, self.svg.encode())
