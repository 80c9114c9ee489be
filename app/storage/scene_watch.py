"""Whether the files of the scene that is shown have been saved anew: its own, and its models.

Owns how often they are looked at. Knows nothing of what is done about it.
"""

from __future__ import annotations

from pathlib import Path

from app.storage.watching import Watch, signature
from renderer.scene import Scene
from renderer.scene.outside import scene_files

LOOK_S = 0.25  # from look to look, however many frames there are
MOST = 64  # files of a scene that are looked at


class SceneWatch:
    """For one window. Undo may bring back a scene of an older version of its file: that stays,
    until the file is saved again."""

    def __init__(self) -> None:
        self._scene: Scene | None = None
        self._files: tuple[Path, ...] = ()
        self._watch: Watch | None = None
        self._looked_s = 0.0

    @property
    def waiting(self) -> bool:
        """Whether a change has been seen that has not rested yet: ask again soon."""
        return self._watch is not None and self._watch.waiting

    def changed(self, scene: Scene, time_s: float) -> bool:
        """Whether the files of the scene have changed; True once for each time."""
        if scene is not self._scene:
            self._scene, self._looked_s = scene, time_s
            files = scene_files(scene)[:MOST]
            if files != self._files:  # otherwise what was saved during the reading would be missed
                self._files, self._watch = files, Watch(signature(*files)) if files else None
            return False
        if self._watch is None or time_s - self._looked_s < LOOK_S:
            return False
        self._looked_s = time_s
        return self._watch.changed(signature(*self._files), time_s)

    def take_present(self) -> None:
        """Whatever the files are now is known: this window has saved them."""
        if self._watch is not None:
            self._watch.known = signature(*self._files)
