"""Scenes: what they are made of, and how they are read from files.

    model       the structures: objects, materials, lights, Scene, View
    shapes      procedural meshes
    load        load_scene: a built-in scene, a scene file, or a model file
    files       scene files (.toml); their format: schema
    models      model files (.obj .ply .stl .off .glb .gltf)
    views       view files: a camera written down
    saving      a scene written down
    texture     an image that a surface shows; images: how it is read from files
    flat        a scene as flat arrays, the form that both renderers read

Knows nothing of renderers, pixels or windows. Names are imported when first used: to draw a model
needs no reader of scene files.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from renderer.scene import shapes
    from renderer.scene.flat import FlatScene, flatten
    from renderer.scene.load import (
        BUILTIN_SCENES,
        EMPTY_SCENE,
        SCENE_ENDINGS,
        SCENE_NAMES,
        load_scene,
    )
    from renderer.scene.model import (
        Checker,
        Color,
        DirectionalLight,
        Material,
        Mesh,
        Origin,
        PointLight,
        Scene,
        SceneObject,
        Shape,
        Sphere,
        View,
    )
    from renderer.scene.saving import save_scene
    from renderer.scene.texture import Texture
    from renderer.scene.views import load_view, save_view, view_from_toml, view_to_toml

_HOME = {
    "BUILTIN_SCENES": "renderer.scene.load",
    "SCENE_ENDINGS": "renderer.scene.load",
    "Checker": "renderer.scene.model",
    "Color": "renderer.scene.model",
    "DirectionalLight": "renderer.scene.model",
    "EMPTY_SCENE": "renderer.scene.load",
    "FlatScene": "renderer.scene.flat",
    "Material": "renderer.scene.model",
    "Mesh": "renderer.scene.model",
    "Origin": "renderer.scene.model",
    "PointLight": "renderer.scene.model",
    "SCENE_NAMES": "renderer.scene.load",
    "Scene": "renderer.scene.model",
    "SceneObject": "renderer.scene.model",
    "Shape": "renderer.scene.model",
    "Sphere": "renderer.scene.model",
    "Texture": "renderer.scene.texture",
    "View": "renderer.scene.model",
    "flatten": "renderer.scene.flat",
    "load_scene": "renderer.scene.load",
    "load_view": "renderer.scene.views",
    "save_scene": "renderer.scene.saving",
    "save_view": "renderer.scene.views",
    "view_from_toml": "renderer.scene.views",
    "view_to_toml": "renderer.scene.views",
}

__all__ = [
    "BUILTIN_SCENES",
    "SCENE_ENDINGS",
    "SCENE_NAMES",
    "Checker",
    "Color",
    "DirectionalLight",
    "EMPTY_SCENE",
    "FlatScene",
    "Material",
    "Mesh",
    "Origin",
    "PointLight",
    "Scene",
    "SceneObject",
    "Shape",
    "Sphere",
    "Texture",
    "View",
    "flatten",
    "load_scene",
    "load_view",
    "save_scene",
    "save_view",
    "shapes",
    "view_from_toml",
    "view_to_toml",
]


def __getattr__(name: str) -> Any:
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    if name == "shapes":
        return import_module("renderer.scene.shapes")
    raise AttributeError(f"module 'renderer.scene' has no attribute {name!r}")


def __dir__() -> list[str]:
    """Return the public names, including those that have not been imported yet."""
    return sorted(__all__)
