"""One camera, two renderers: everything below the window, usable from notebooks and tests.

Names are imported on first use, so that `import renderer` costs nothing and a program that
only rasterizes never loads the tracer's compiler.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from renderer.camera import Camera
    from renderer.camera_formats import read_cameras
    from renderer.errors import LucidaError
    from renderer.frame import Frame
    from renderer.images import picture, write_image
    from renderer.lenses import Lens
    from renderer.raster import Rasterizer
    from renderer.scene import Scene, View, load_scene, load_view, save_view
    from renderer.trace import Tracer

_HOME = {
    "Camera": "renderer.camera",
    "Frame": "renderer.frame",
    "Lens": "renderer.lenses",
    "LucidaError": "renderer.errors",
    "Rasterizer": "renderer.raster",
    "Scene": "renderer.scene",
    "Tracer": "renderer.trace",
    "View": "renderer.scene",
    "load_scene": "renderer.scene",
    "load_view": "renderer.scene",
    "picture": "renderer.images",
    "read_cameras": "renderer.camera_formats",
    "save_view": "renderer.scene",
    "write_image": "renderer.images",
}

__all__ = [
    "Camera",
    "Frame",
    "Lens",
    "LucidaError",
    "Rasterizer",
    "Scene",
    "Tracer",
    "View",
    "load_scene",
    "load_view",
    "picture",
    "read_cameras",
    "save_view",
    "write_image",
]


def __getattr__(name: str) -> Any:
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module 'renderer' has no attribute {name!r}")


def __dir__() -> list[str]:
    """Return the public names, including those not yet imported."""
    return sorted(__all__)
