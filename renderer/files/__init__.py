"""Scenes, views, models and images as files.

    load         load_scene: a built-in scene, a scene file, or a model file
    scene_file   scene files (.toml); their format: schema
    saving       a scene written down
    views        view files: a camera written down
    models/      model files (.obj .ply .stl .off .glb .gltf)
    cameras/     cameras in other programs' files
    export/      scenes in other programs' files

Knows nothing of renderers, pixels or windows.
"""

from .load import BUILTIN_SCENES, EMPTY_SCENE, SCENE_ENDINGS, SCENE_NAMES, load_scene
from .saving import save_scene
from .views import load_view, save_view, view_from_toml, view_to_toml

__all__ = [
    "BUILTIN_SCENES",
    "EMPTY_SCENE",
    "SCENE_ENDINGS",
    "SCENE_NAMES",
    "load_scene",
    "load_view",
    "save_scene",
    "save_view",
    "view_from_toml",
    "view_to_toml",
]
