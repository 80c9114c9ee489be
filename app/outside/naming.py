"""Find the parts of the outside view's drawing that its options name. Pure."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from app.images.picking import is_quick, nearest_hit
from app.outside.camera_diagram import Content
from app.outside.diagram import RayEnd
from app.outside.extent import end_parameter
from app.outside.growing import grown_diagram
from app.outside.options import LENS_STAGES, OutsideOptions
from app.outside.teaching import Subject, subject_of
from app.state.options import Pixel
from renderer.camera import Camera
from renderer.scene.model import Scene


def named(
    scene: Scene,
    inner: Camera,
    size: tuple[int, int],
    options: OutsideOptions,
    pixel: Pixel | None,
    framed: NDArray[np.float64],
) -> Subject:
    """Return what `options.see` names.

    inner: the camera in the scene, fitted to its image of `size` pixels. pixel: the marked one.
    framed: corners (8n, 3) of boxes around the scene's objects, as in Focus.
    """
    marked = None
    if options.ray and pixel is not None and is_quick(scene):
        ray = inner.ray(*pixel, size)
        if np.isfinite(ray.direction).all():  # inside of the lens
            t, _ = nearest_hit(scene, ray.origin, ray.direction)
            marked = RayEnd(pixel, t)
    # Whole, however far it has grown: the camera stays.
    options = replace(options, formula=len(LENS_STAGES) if "formula" in options.see else None)
    end = end_parameter(inner, framed)
    items = grown_diagram(Content(inner, size, options, end, marked=marked, grid_parts=1))
    return subject_of(items, options.see, framed.reshape(-1, 8, 3))
