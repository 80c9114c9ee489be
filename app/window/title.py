"""What the window is called."""

from __future__ import annotations

from renderer.scene import Scene
from renderer.scene.outside import outside_files
from renderer.scene_editing.documents import is_unsaved


def title(scene: Scene, is_a_steps: bool = False) -> str:
    """The window's title. It tells, once, where the scene's models are, if not beside it; a star:
    the scene was changed, and not saved; not where it is a lecture's step's, which nobody saves."""
    elsewhere = " (with models from outside its folder)" if outside_files(scene) else ""
    star = " *" if is_unsaved(scene) and not is_a_steps else ""
    return f"Lucida: {scene.name}{star}{elsewhere}" if scene.name else f"Lucida{star}{elsewhere}"
