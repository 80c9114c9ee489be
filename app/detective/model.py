"""The detective's findings: the readings of a text in a scene, the likeliest first, and their
pictures. Pure.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from app.detective import ranking
from app.detective.options import DetectiveOptions
from app.detective.printed import Pasted, pasted
from app.detective.ranking import Ranked, SceneSeen
from app.detective.readings import ReadAs, Up, is_same, readings, up_of
from app.images.ray_pictures import RayPainter
from app.state.app_state import AppState
from renderer.camera import Camera, Size
from renderer.errors import LucidaError
from renderer.focus import Focus
from renderer.intrinsics import PixelOrigin
from renderer.scene.model import View

Light = NDArray[np.float32]

MOST_SHOWN = 8  # readings with a picture
COLUMNS = 240  # of a picture


@dataclass(frozen=True)
class MatrixCase:
    """The input of the readings. here: the current view, moved to the origin; readings take from it
    what a matrix leaves open.
    """

    text: str
    pixel_origin: PixelOrigin
    here: View
    up: Up
    size: Size


@dataclass(frozen=True, eq=False)
class Findings:
    """The readings of a matrix.

    given: the matrix; None if there is an error.
    error: the reason why there is no matrix.
    shown: the best readings.
    others: the number of further ones.
    left_out: impossible readings, with the reason.
    """

    case: MatrixCase
    given: Pasted | None = None
    error: str = ""
    shown: tuple[Ranked, ...] = ()
    others: int = 0
    left_out: tuple[tuple[str, str], ...] = ()

    @property
    def counts_pixels(self) -> bool:
        """True if it matters whether integers are at the pixels' centres or corners."""
        return any(one.reading.size is not None for one in self.shown)

    def named(self, name: str) -> Ranked | None:
        """Return the reading of that name, among those shown."""
        up = self.case.up
        found = (one for one in self.shown if ranking.name(one.reading.convention, up) == name)
        return next(found, None)


def case_of(state: AppState, images: Size) -> MatrixCase:
    """Return the case of a state. images: the size of the window's own."""
    options = state.of(DetectiveOptions)
    images = images if min(images) else (4, 3)
    rows = max(1, min(2 * COLUMNS, round(COLUMNS * images[1] / images[0])))
    origin = Camera.canonical()
    here = replace(state.camera, eye=origin.eye, u=origin.u, v=origin.v, w=origin.w)
    return MatrixCase(
        options.text,
        options.pixel_origin,
        View(here, state.view.fit),
        up_of(state.scene.view),
        (COLUMNS, rows),
    )


def found_in(case: MatrixCase, focus: Focus) -> Findings:
    """Return the readings of the case's text. focus: of the scene."""
    try:
        given = pasted(case.text)
        around = ReadAs(case.here, case.up, case.pixel_origin, case.size)
        every = readings(given, around)
    except LucidaError as error:
        problem = f"{error.field}: {error.problem}" if error.field else f"The text {error.problem}"
        told = "; ".join(word for word in (problem, error.remedy) if word)
        return Findings(case, error=f"{told}.")
    if not every.found:
        reasons = "; ".join(f"{name}: {reason}" for name, reason in every.left_out)
        return Findings(case, error=f"No camera: {reasons}.", left_out=every.left_out)
    subject = SceneSeen(ranking.sample(focus.framed), case.up)
    order = ranking.ranked(every.found, subject, case.size)
    shown = tuple(order[:MOST_SHOWN])
    return Findings(case, given, "", shown, len(order) - len(shown), every.left_out)


def beyond(given: Pasted) -> str:
    """Return what of the camera no matrix holds; "" if the text has nothing of that."""
    if not given.lens:
        return ""
    numbers = ", ".join(f"{number:g}" for number in given.lens)
    return (
        f"This is not the whole camera: its lens ({numbers}) bends lines, and no matrix does. "
        "The pictures are the pinhole's."
    )


def pictures(painter: RayPainter, cameras: tuple[Camera, ...], size: Size) -> tuple[Light, ...]:
    """Return what each of the cameras sees, linear light (H, W, 3). Runs on a thread."""
    return tuple(painter.picture(*camera.rays(size), camera.t_range) for camera in cameras)


def is_here(one: Ranked, view: View, size: Size) -> bool:
    """Return True if the present camera is that reading's."""
    return is_same(one.reading.view.for_size(size), view.for_size(size))
