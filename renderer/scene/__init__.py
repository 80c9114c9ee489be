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

Knows nothing of renderers, pixels or windows.
"""

from renderer.files.load import BUILTIN_SCENES, EMPTY_SCENE, SCENE_ENDINGS, SCENE_NAMES, load_scene
from renderer.files.saving import save_scene
from renderer.files.views import load_view, save_view, view_from_toml, view_to_toml
from renderer.scene import shapes
from renderer.scene.flat import FlatScene, flatten
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
from renderer.scene.texture import Texture

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
