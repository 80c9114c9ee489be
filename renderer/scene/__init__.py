"""Scenes: their structure, shapes and textures.

    model       the structures: objects, materials, lights, Scene, View
    shapes      procedural meshes
    texture     an image that a surface shows
    flat        a scene as flat arrays, the form that both renderers read

This package knows nothing of renderers, pixels or windows.
"""

from lucida.renderer.scene import shapes
from lucida.renderer.scene.flat import FlatScene, flatten
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import (
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
from lucida.renderer.scene.origin import Origin
from lucida.renderer.scene.texture import Texture

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
