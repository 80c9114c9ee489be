"""One camera, two renderers: the public names for notebooks, programs and tests.

Names are imported on first use, so that `import lucida` costs nothing and a program that
only rasterizes never loads the tracer's compiler.

In a checkout, app/, renderer/ and shaders/ lie beside this folder, which has links to them.
"""

from __future__ import annotations

import os
from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lucida.renderer.camera.camera import Camera
    from lucida.renderer.camera.lenses import Lens
    from lucida.renderer.files import load_scene, load_view, save_scene, save_view
    from lucida.renderer.files.cameras import read_cameras
    from lucida.renderer.images import picture, write_image
    from lucida.renderer.images.frame import Frame
    from lucida.renderer.notebook import explore
    from lucida.renderer.raster import Rasterizer
    from lucida.renderer.scene import Scene, SceneObject, View
    from lucida.renderer.system.errors import LucidaError
    from lucida.renderer.trace import Tracer

__version__ = "0.1.0"

_HOME = {
    "Camera": "lucida.renderer.camera.camera",
    "Frame": "lucida.renderer.images.frame",
    "Lens": "lucida.renderer.camera.lenses",
    "LucidaError": "lucida.renderer.system.errors",
    "Rasterizer": "lucida.renderer.raster",
    "Scene": "lucida.renderer.scene",
    "SceneObject": "lucida.renderer.scene",
    "Tracer": "lucida.renderer.trace",
    "View": "lucida.renderer.scene",
    "explore": "lucida.renderer.notebook",
    "load_scene": "lucida.renderer.files",
    "load_view": "lucida.renderer.files",
    "picture": "lucida.renderer.images",
    "read_cameras": "lucida.renderer.files.cameras",
    "save_scene": "lucida.renderer.files",
    "save_view": "lucida.renderer.files",
    "write_image": "lucida.renderer.images",
}

__all__ = [
    "Camera",
    "Frame",
    "Lens",
    "LucidaError",
    "Rasterizer",
    "Scene",
    "SceneObject",
    "Tracer",
    "View",
    "explore",
    "load_scene",
    "load_view",
    "picture",
    "read_cameras",
    "save_scene",
    "save_view",
    "write_image",
]

_HERE = os.path.dirname(__file__)
if not os.path.isdir(os.path.join(_HERE, "app")):  # a checkout by a Git that makes no links
    __path__.append(os.path.dirname(_HERE))


def __getattr__(name: str) -> Any:
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module 'lucida' has no attribute {name!r}")


def __dir__() -> list[str]:
    """Return the public names, including those not yet imported."""
    return sorted(__all__)
