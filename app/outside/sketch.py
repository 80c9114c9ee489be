"""The inputs of a vector drawing of the outside view, and the drawing, for a thread. Pure."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.outside.camera_diagram import Content
from app.outside.diagram import Item, RayEnd
from app.outside.growing import grown_diagram
from app.outside.hits import RayQuery, traced
from app.outside.outlines import outlines
from app.outside.projected import project
from app.outside.screen import OutsideScreen, image_plane
from app.outside.vector import Drawing, Paint, PlaneImage, Size, drawing
from renderer.camera import Camera
from renderer.scene.model import Scene

OPACITY = 0.9  # of the live image: things behind it are slightly visible
GRID_PARTS = 16  # of a side of the image plane


@dataclass(frozen=True, eq=False)
class Sketch:
    """The inputs of a vector drawing.

    looking: the outside camera, fitted to `size`. near, unit, symbol: see OutsideScreen.
    content: rays in it without a known t are traced. extra: of other instruments. t: (height,
    width), the scene's ray parameters for `looking`. picture: (height, width, 3), as displayed, for
    the image plane; None: that is empty. tracer: one that has prepared the scene; None: there is
    none yet.
    """

    scene: Scene
    looking: Camera
    size: Size
    near: float
    unit: float
    symbol: float
    content: Content
    extra: tuple[Item, ...]
    t: NDArray[np.float32] | None
    paint: Paint
    picture: NDArray[np.uint8] | None = None
    tracer: Any | None = None

    def draw(self) -> Drawing:
        """Return the drawing. Takes part of a second, longer if rays must be traced without
        a ready tracer.
        """
        screen = OutsideScreen(self.looking, self.size, self.near, self.unit, self.symbol)
        items = grown_diagram(self._known())
        found, left_out = outlines(self.scene, screen)
        primitives = project([*items, *self.extra], screen)
        return drawing(primitives, found, self.paint, screen, self.t, left_out, self._image())

    def _image(self) -> PlaneImage | None:
        camera = self.content.camera
        if self.picture is None or not self.content.options.image:
            return None
        plane = image_plane(camera, self.looking, self.size)
        return PlaneImage(self.picture, plane, OPACITY) if plane is not None else None

    def _known(self) -> Content:
        """Return the content with every t."""
        content = self.content
        rays = *content.hits, content.marked
        asked = [ray for ray in rays if ray is not None and ray.t is None]
        if not asked:
            return content
        pixels = tuple(dict.fromkeys(hit.pixel for hit in asked))
        question = RayQuery(self.scene, content.camera, content.size, pixels)
        if self.tracer is not None:
            t = traced(question, self.tracer)
        else:
            from renderer.trace import Tracer  # here: it loads the compiler

            with Tracer(self.scene) as tracer:
                t = traced(question, tracer)

        def known(hit: RayEnd) -> RayEnd:
            return replace(hit, t=t[hit.pixel]) if hit.t is None else hit

        hits = tuple(map(known, content.hits))
        return replace(content, hits=hits, marked=known(content.marked) if content.marked else None)
