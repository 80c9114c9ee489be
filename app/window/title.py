"""The window's title."""

from __future__ import annotations

from renderer.scene import Scene
from renderer.scene.outside import outside_files
from renderer.scene_editing.documents import is_unsaved


def is_marked(scene: Scene, is_a_steps: bool = False) -> bool:
    """Return True if the scene has unsaved changes. Quick: called in each frame.

    The scene of a lecture's step is never marked, since nobody saves it.
    """
    return not is_a_steps and is_unsaved(scene)


def title(scene: Scene, is_a_steps: bool = False) -> str:
    """Return the window's title, with a star if the scene is_marked().

    If the scene's models are not next to it, it names their folder, once, which asks the file
    system.
    """
    elsewhere = " (with models from outside its folder)" if outside_files(scene) else ""
    star = " *" if is_marked(scene, is_a_steps) else ""
    return f"Lucida: {scene.name}{star}{elsewhere}" if scene.name else f"Lucida{star}{elsewhere}"
