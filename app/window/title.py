"""What the window is called."""

from __future__ import annotations

from renderer.scene import Scene
from renderer.scene.outside import outside_files
from renderer.scene_editing.documents import is_unsaved


def is_marked(scene: Scene, is_a_steps: bool = False) -> bool:
    """Whether the scene was changed, and not saved; a lecture's step's is not marked, since nobody
    saves it. Quick: asked in each frame."""
    return not is_a_steps and is_unsaved(scene)


def title(scene: Scene, is_a_steps: bool = False) -> str:
    """The window's title: with a star where the scene is_marked(). It tells, once, where the
    scene's models are, if not beside it, for which it asks the file system."""
    elsewhere = " (with models from outside its folder)" if outside_files(scene) else ""
    star = " *" if is_marked(scene, is_a_steps) else ""
    return f"Lucida: {scene.name}{star}{elsewhere}" if scene.name else f"Lucida{star}{elsewhere}"
