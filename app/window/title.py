"""What the window is called."""

from __future__ import annotations

from renderer.scene import Scene
from renderer.scene.outside import outside_files


def title(scene: Scene) -> str:
    """The window's title. It tells, once, where the scene's models are, if not beside it."""
    elsewhere = " (with models from outside its folder)" if outside_files(scene) else ""
    return f"Lucida: {scene.name}{elsewhere}" if scene.name else f"Lucida{elsewhere}"
