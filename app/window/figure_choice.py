"""The choice of a figure's content, size, scale and background. Importing it loads no window."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from lucida.app.state.bounds import Range
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.system.errors import LucidaError

What = Literal["outside", "raster", "ray", "pair", "probe"]
Ground = Literal["shown", "white", "transparent"]
ENDINGS = (".svg", ".pdf", ".png")


@dataclass(frozen=True)
class FigureChoice:
    """A figure. size: the page's, in pixels. scale: the factor of lines and letters. ground: the
    page's background, as the window shows it or not.
    """

    what: What = "outside"
    size: Size = (1280, 960)
    scale: Annotated[float, Range(0.25, 8)] = 1.0
    ground: Ground = "white"


def check_ending(path: str | Path) -> str:
    """Return a file's ending. Raises LucidaError if it is not one of a figure."""
    ending = Path(path).suffix.lower()
    if ending not in (*ENDINGS, ".tex"):
        raise LucidaError(
            "", "is not a figure's name", "end it in .svg, .pdf, .png or .tex", str(path)
        )
    return ending
