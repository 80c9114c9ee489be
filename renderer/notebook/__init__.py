"""Lucida in a notebook: the display of values in cells, and a live widget (`explore`)."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from lucida.renderer.system.errors import LucidaError

if TYPE_CHECKING:
    from lucida.renderer.camera.camera import Camera
    from lucida.renderer.scene import Scene

    from .widget import Explorer


def explore(
    scene: Scene | str | Path,
    camera: Camera | None = None,
    size: Iterable[int] = (640, 480),
    shadows: bool = False,
    mirror_depth: int = 0,
) -> Explorer:
    """Return a live widget: the ray image of a scene from a camera that the mouse moves.

    scene: a Scene, or an argument of load_scene(). camera: with or without a lens; None for the
    scene's own view. size: (width, height) in pixels. shadows, mirror_depth: as in Tracer. Raises
    LucidaError, also if anywidget is not installed.
    """
    try:
        from .widget import Explorer
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] not in ("anywidget", "ipywidgets", "traitlets"):
            raise
        from lucida.renderer.raster.packages import installing

        remedy = installing("anywidget")
        raise LucidaError("explore", f"{error.name} is not installed", remedy) from None
    return Explorer(scene, camera, size, shadows, mirror_depth)
