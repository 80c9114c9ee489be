"""Scenes: their structure, shapes and textures.

    model       the structures: objects, materials, lights, Scene, View
    shapes      procedural meshes
    texture     an image that a surface shows
    flat        a scene as flat arrays, the form that both renderers read

This package knows nothing of renderers, pixels or windows.
"""

from . import shapes
from .flat import FlatScene, flatten
from .material import Material
from .model import (
    Checker,
    Color,
    DirectionalLight,
    Mesh,
    PointLight,
    Scene,
    SceneObject,
    Shape,
    Sphere,
    View,
)
from .origin import Origin
from .texture import Texture

__all__ = [
    "Checker",
    "Color",
    "DirectionalLight",
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
    "shapes",
]
