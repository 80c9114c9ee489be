"""One camera, two renderers: everything below the window, usable from notebooks and tests.

Names are imported on first use, so that `import renderer` costs nothing and a program that
only rasterizes never loads the tracer's compiler.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from renderer.camera.camera import Camera
    from renderer.camera.lenses import Lens
    from renderer.files import load_scene, load_view, save_view
    from renderer.files.cameras import read_cameras
    from renderer.images import picture, write_image
    from renderer.images.frame import Frame
    from renderer.raster import Rasterizer
    from renderer.scene import Scene, View
    from renderer.system.errors import LucidaError
    from renderer.trace import Tracer

_HOME = {
    "Camera": "renderer.camera.camera",
    "Frame": "renderer.images.frame",
    "Lens": "renderer.camera.lenses",
    "LucidaError": "renderer.system.errors",
    "Rasterizer": "renderer.raster",
    "Scene": "renderer.scene",
    "Tracer": "renderer.trace",
    "View": "renderer.scene",
    "load_scene": "renderer.files",
    "load_view": "renderer.files",
    "picture": "renderer.images",
    "read_cameras": "renderer.files.cameras",
    "save_view": "renderer.files",
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
