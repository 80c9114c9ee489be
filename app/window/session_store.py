"""The files of sessions: each open window locks one, and saves it in the background.

A window takes the first file that no other window holds. The first window's session is therefore
the one that is restored, regardless of a second window. A lock ends with its process.
"""

from __future__ import annotations

import contextlib
import os
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

from lucida.app.state.session import LARGEST_BYTES, NewerVersionError, Session, from_bytes, to_bytes
from lucida.app.ui.background import Background
from lucida.renderer.files.reading import read_file
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import LucidaError

from .capture import free_path

MOST_WINDOWS = 16
QUIET_S = 2.0  # after the last change, before a session is saved
LONGEST_S = 10.0  # between saves during continuous changes
LAST_S = 5.0  # at the end, to finish saving


class SessionFile:
    """A session file that this process has locked."""

    def __init__(self, path: Path, lock: int) -> None:
        self.path = path
        self._lock = lock
        self._saving = threading.Lock()

    def load(self) -> tuple[Session | None, str]:
        """Return the saved session, and a message for the user. Move an unusable file aside."""
        if not self.path.exists():
            return None, ""
        try:
            session = from_bytes(read_file(self.path, LARGEST_BYTES), str(self.path))
            return session, "\n".join(session.notes)
        except LucidaError as error:
            ending = "newer" if isinstance(error, NewerVersionError) else "broken"
            kept = self.put_aside(ending)
            where = f" It is kept as {kept}." if kept else ""
            return None, f"The last session could not be restored. {error}.{where}"

    def save(self, data: bytes) -> None:
        """Replace the file, unless the place was released. Raises LucidaError, in which case the
        old file is kept.
        """
        with self._saving:
            if self._lock >= 0:
                with atomic_write(self.path) as file:
                    file.write(data)

    def release(self) -> None:
        with self._saving:
            if self._lock >= 0:
                os.close(self._lock)
                self._lock = -1

    def put_aside(self, ending: str) -> Path | None:
        """Move the file to a free name, so that nothing set aside is lost. Return that name, or
        None if this fails.
        """
        target = free_path(self.path.with_suffix(f".{ending}.json"))
        try:
            self.path.rename(target)
        except OSError:
            return None
        return target


def take_place(folder: Path | None = None) -> SessionFile | None:
    """Return the first place that no other window has; None if sessions cannot be saved.

    folder: the files' folder; None for the user's settings folder, created if necessary.
    """
    try:
        folder = folder or settings_folder()
        folder.mkdir(parents=True, exist_ok=True)
        for number in range(1, MOST_WINDOWS + 1):
            lock = _locked(folder / f"session-{number}.lock")
            if lock is not None:
                path = folder / f"session-{number}.json"
                return SessionFile(path, lock)
    except (OSError, RuntimeError):  # RuntimeError: no home folder
        pass
    return None


def settings_folder() -> Path:
    """Return the user's settings folder, which may not exist."""
    import platformdirs

    return platformdirs.user_config_path("lucida", appauthor=False)


def _locked(path: Path) -> int | None:
    """Return an open, locked file; None if another process holds it. Raises OSError."""
    file = os.open(path, os.O_RDWR | os.O_CREAT, 0o600)
    try:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(file, msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(file)
        return None
    return file


class Keeper:
    """A saver of sessions: it saves some seconds after the last change, on its own thread, and at
    the end.

    wake: called on that thread when a save has failed. message: the failure, reported once.
    """

    def __init__(self, place: SessionFile, wake: Callable[[], None]) -> None:
        self._place = place
        self._saving: Background[bytes] = Background("lucida-session", wake)
        self._saved: bytes | None = None
        self._marked_s: float | None = None  # when the first unsaved change was seen
        self._changed_s = 0.0
        self._failed = False
        self.message = ""

    def mark(self) -> None:
        """Report a change."""
        self._changed_s = time.monotonic()
        if self._marked_s is None:
            self._marked_s = self._changed_s

    def due(self) -> bool:
        """True if it is time to save."""
        self._poll()
        if self._marked_s is None or self._saving.busy:
            return False
        now_s = time.monotonic()
        return now_s - self._changed_s > QUIET_S or now_s - self._marked_s > LONGEST_S

    def save(self, session: Session) -> None:
        """Save in the background."""
        self._marked_s = None
        data = to_bytes(session)
        if data != self._saved:
            self._saving.submit(lambda: self._write(data))

    def close(self, session: Session) -> None:
        """Save at once, and release the place."""
        self._saving.close(LAST_S)
        with contextlib.suppress(LucidaError):
            self._place.save(to_bytes(session))
        self._place.release()

    def _write(self, data: bytes) -> bytes:
        self._place.save(data)
        return data

    def _poll(self) -> None:
        outcome = self._saving.poll()
        if outcome is None:
            return
        if outcome.error is None:
            self._saved, self._failed = outcome.value, False
        elif not self._failed:
            self._failed = True
            self.message = f"The session cannot be saved. {outcome.error}"
