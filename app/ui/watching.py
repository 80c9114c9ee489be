"""Watch files while somebody edits them.

Poll a watch in each frame: it looks at the files now and then, and reports a change once they have
stopped changing.
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

LOOK_S = 0.25  # between looks, at any frame rate
REST_S = 0.15  # the least age of a change, because editors may write a file in several steps
MOST = 64  # files that are looked at


class FilesWatch:
    """A watch on files.

    files: each file's stamp when it was last read; None for a missing file.
    A file that disappears is not a change, because editors replace files; a new file is one.
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
        """True if files are still changing, so that the caller should poll again soon."""
        return self._seen is not None

    def follow(self, files: Noted) -> None:
        """Watch these files from now on. Known stamps are kept, because they may be newer."""
        with self._lock:
            self._known = {**files, **self._known}
            self._files = tuple(files)[:MOST]
        self._seen = None

    def changed(self, time_s: float) -> bool:
        """Return True, once for each change, if a file has changed and stopped changing."""
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
        """Record and watch all files that the block reads, on any thread, including missing ones,
        even if reading fails.
        """
        with noting() as noted:
            try:
                yield
            finally:
                self.know(noted)
                with self._lock:
                    self._files = tuple(dict.fromkeys((*noted, *self._files)))[:MOST]

    def take_present(self) -> None:
        """Record the files as they are now, because this program has written them."""
        self.know({file: stamp(file) for file in self._files})

    def know(self, files: Noted) -> None:
        """Record the files as they were read, or written, just now."""
        with self._lock:
            self._known = {**self._known, **files}  # a new dict: a thread may be reading the old


class SceneWatch(FilesWatch):
    """A watch for one window. Undo may restore a scene from an older version of its file; that
    scene stays until the file is saved again.
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
