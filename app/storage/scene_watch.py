"""Watch the files of the shown scene: its own, its models, and those that they name."""

from __future__ import annotations

from app.storage.watching import FilesWatch
from renderer.scene import Scene
from renderer.scene_editing.documents import are_versions


class SceneWatch(FilesWatch):
    """A watch for one window. Undo may bring back a scene of an older version of its file: that
    stays until the file is saved again.
    """

    def __init__(self) -> None:
        super().__init__({})
        self._scene: Scene | None = None

    def shown(self, scene: Scene) -> None:
        """Watch the files of this scene. Call once a frame."""
        if scene is not self._scene:
            self._scene = scene
            self.follow(scene.origin.files if scene.origin is not None else {})

    def shows_version_of(self, scene: Scene | None) -> bool:
        """Return True if the shown scene is that one, perhaps edited meanwhile."""
        shown = self._scene
        return shown is not None and scene is not None and are_versions(scene, shown)
