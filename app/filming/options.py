"""The settings of the view "Film"."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from app.state.bounds import Accepted, Beside, OneOf, Range
from app.state.options import Lasting
from renderer.frame import check_size

PathName = Literal["orbit", "dolly-zoom", "to-parallel", "bookmarks", "file", "photographs"]
SAMPLES = (1, 4, 9, 16, 25, 36, 49, 64)


@dataclass(frozen=True)
class FilmingOptions(Lasting):
    """The settings of a film.

    path: the way of the camera. file: of the key cameras, as app.storage.paths.stored() writes it.
    timing: between bookmarks. size: of each image. form: the file's ending; "" for a folder.
    mirrors: show reflections.
    """

    path: PathName = "orbit"
    file: Annotated[str, Beside((".toml",))] = ""
    timing: Literal["eased", "constant", "cut"] = "eased"
    seconds: Annotated[float, Range(0.1, 600.0)] = 4.0
    fps: Annotated[int, Range(1, 60)] = 25
    size: Annotated[tuple[int, int], Accepted(check_size)] = (1280, 720)
    renderer: Literal["raster", "ray", "both"] = "raster"
    samples: Annotated[int, OneOf(SAMPLES)] = 4
    shadows: bool = False
    mirrors: bool = False
    form: Literal[".mp4", ".gif", ".webp", ""] = ".mp4"

    @property
    def count(self) -> int:
        """The number of frames."""
        return max(1, round(self.seconds * self.fps))


OPTIONS = FilmingOptions
