"""Watch files while somebody edits them.

Asked in each frame, it looks now and then, and reports a change once it has come to rest.
"""

from __future__ import annotations

import contextlib
import hashlib
import threading
from collections.abc import Iterator
from pathlib import Path

from lucida.renderer.editing.documents import are_versions
from lucida.renderer.files.reading import first_bytes
from lucida.renderer.scene import Scene
from lucida.renderer.scene.limits import TOML_BYTES
from lucida.renderer.system.file_dependencies import Noted, Stamp, noting, stamp

LOOK_S = 0.25  # from look to look, however many frames there are
REST_S = 0.15  # an editor may write a file in several goes: for how long a change must have rested
MOST = 64  # files that are looked at


class FilesWatch:
    """Watches files.

    files: their stamps when they were last read; None for a missing one.
    A missing file is no change, because editors replace files; a new one is.
    """

    def __init__(self, files: Noted) -> None:
        self._lock = threading.Lock()  # one thread looks, another reads
        self._known: Noted = {}
        self._files: tuple[Path, ...] = ()
        self._seen: tuple[Stamp | None, ...] | None = None
        self._since_s = 0.0
        self._looked_s = float("-inf")
        self.follow(files)

    @property
    def waiting(self) -> bool:
        """True if a change has been seen that has not come to rest: ask again soon."""
        return self._seen is not None

    def follow(self, files: Noted) -> None:
        """Watch these files from now on. Known stamps are kept, because they may be newer."""
        with self._lock:
            self._known = {**files, **self._known}
            self._files = tuple(files)[:MOST]
        self._seen = None

    def changed(self, time_s: float) -> bool:
        """Return True, once for each change, if a file has changed and come to rest."""
        if time_s - self._looked_s < LOOK_S:
            return False
        self._looked_s = time_s
        with self._lock:
            files, known = self._files, self._known
        now = tuple(stamp(file) or known[file] for file in files)
        if now == tuple(known[file] for file in files):
            self._seen = None
            return False
        if now != self._seen:
            self._seen, self._since_s = now, time_s
            return False
        if time_s - self._since_s < REST_S:
            return False
        self._seen = None
        self.know(dict(zip(files, now, strict=True)))
        return True

    @contextlib.contextmanager
    def reading(self) -> Iterator[None]:
        """Record and watch all files that are read inside, on any thread, also missing ones, even
        if reading fails.
        """
        with noting() as noted:
            try:
                yield
            finally:
                self.know(noted)
                with self._lock:
                    self._files = tuple(dict.fromkeys((*noted, *self._files)))[:MOST]

    def take_present(self) -> None:
        """Record the files as they are now: this program has written them."""
        self.know({file: stamp(file) for file in self._files})

    def know(self, files: Noted) -> None:
        """Record the files as they were read, or written, just now."""
        with self._lock:
            self._known = {**self._known, **files}  # not in place: it may be looked through


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


def fingerprint(path: Path) -> str:
    """Return a hash of a file's content; "" if it cannot be read."""
    try:
        return hashlib.sha256(first_bytes(path, TOML_BYTES)).hexdigest()
    except (OSError, ValueError):
        return ""
