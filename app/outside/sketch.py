"""The inputs of a vector drawing of the outside view, and the drawing, for a thread. Pure."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.outside.diagram import Item, RayEnd
from app.outside.frustum import plane_corners
from app.outside.growing import grown_diagram
from app.outside.hits import RayQuery, traced
from app.outside.options import OutsideOptions
from app.outside.outlines import outlines
from app.outside.projected import project
from app.outside.screen import OutsideScreen
from app.outside.vector import Drawing, Paint, PlaneImage, Size, drawing
from app.state.options import Notation
from renderer.camera import Camera
from renderer.raster.overlay import plane_on_screen
from renderer.scene.model import Scene

OPACITY = 0.9  # of the live image: things behind it are slightly visible
GRID_PARTS = 16  # of a side of the image plane


@dataclass(frozen=True, eq=False)
class Sketch:
    """The inputs of a vector drawing.

    looking: the outside camera, fitted to `size`. near, unit, symbol: see OutsideScreen. camera:
    the one in the scene, fitted to its image of image_size. end: the parameter at which the scene
    ends. hits, marked: as for diagram(); rays without a known t are traced. extra: of other
    instruments. t: (height, width), the scene's ray parameters for `looking`. picture: (height,
    width, 3), as displayed, for the image plane; None: that is empty. tracer: one that has prepared
    the scene; None: there is none yet.
    """

    scene: Scene
    looking: Camera
    size: Size
    near: float
    unit: float
    symbol: float
    camera: Camera
    image_size: Size
    options: OutsideOptions
    end: float
    hits: tuple[RayEnd, ...]
    marked: RayEnd | None
    extra: tuple[Item, ...]
    notation: Notation
    t: NDArray[np.float32] | None
    paint: Paint
    picture: NDArray[np.uint8] | None = None
    tracer: Any | None = None

    def draw(self) -> Drawing:
        """Return the drawing. Takes part of a second, longer if rays must be traced without
        a ready tracer.
        """
        hits, marked = self._known()
        screen = OutsideScreen(self.looking, self.size, self.near, self.unit, self.symbol)
        items = grown_diagram(
            self.camera, self.image_size, self.options, self.end, hits, marked, GRID_PARTS,
            self.notation,
        )  # fmt: skip
        found, left_out = outlines(self.scene, screen)
        primitives = project([*items, *self.extra], screen)
        return drawing(primitives, found, self.paint, screen, self.t, left_out, self._image())

    def _image(self) -> PlaneImage | None:
        if self.picture is None or not self.options.image:
            return None
        corners = plane_corners(self.camera)[[0, 1, 3]]
        behind = corners[0] + np.asarray(self.camera.w)  # the side from which it is upright
        plane = plane_on_screen(self.looking, self.size, corners, behind)
        return PlaneImage(self.picture, plane, OPACITY) if plane is not None else None

    def _known(self) -> tuple[tuple[RayEnd, ...], RayEnd | None]:
        """Return the hits with every t."""
        asked = [hit for hit in (*self.hits, self.marked) if hit is not None and hit.t is None]
        if not asked:
            return self.hits, self.marked
        pixels = tuple(dict.fromkeys(hit.pixel for hit in asked))
        question = RayQuery(self.scene, self.camera, self.image_size, pixels)
        if self.tracer is not None:
            t = traced(question, self.tracer)
        else:
            from renderer.trace import Tracer  # here: it loads the compiler

            with Tracer(self.scene) as tracer:
                t = traced(question, tracer)

        def known(hit: RayEnd) -> RayEnd:
            return replace(hit, t=t[hit.pixel]) if hit.t is None else hit

        return tuple(map(known, self.hits)), known(self.marked) if self.marked else None
