"""Scenes: what they are made of.

    model       the structures: objects, materials, lights, Scene, View
    shapes      procedural meshes
    texture     an image that a surface shows
    flat        a scene as flat arrays, the form that both renderers read

Knows nothing of renderers, pixels or windows.
"""

from renderer.scene import shapes
from renderer.scene.flat import FlatScene, flatten
from renderer.scene.model import (
    Checker,
    Color,
    DirectionalLight,
    Material,
    Mesh,
    PointLight,
    Scene,
    SceneObject,
    Shape,
    Sphere,
    View,
)
from renderer.scene.origin import Origin
from renderer.scene.texture import Texture

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
