"""The places of sessions: one file for each open window, locked, and saved in the background.

A window takes the first place that no other one holds. The first window's session is therefore the
one that comes back, whatever a second window did. A lock ends with its process.
"""

from __future__ import annotations

import contextlib
import os
import sys
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from lucida.app.state.session import LARGEST_BYTES, NewerVersionError, Session, from_bytes, to_bytes
from lucida.app.ui.background import Background
from lucida.renderer.files.reading import read_file
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import LucidaError

MOST_WINDOWS = 16
QUIET_S = 2.0  # after the last change, before a session is saved
LONGEST_S = 10.0  # while changes go on
LAST_S = 5.0  # at the end, for what is being saved


@dataclass(frozen=True)
class Found:
    """The start of a window.

    session: None to start afresh.
    message: for the user; empty if there was nothing to restore, or all was well.
    """

    session: Session | None = None
    message: str = ""


class _TooLateError(Exception):
    """A newer session has been saved meanwhile."""


class SessionFile:
    """A session file that this process has for itself."""

    def __init__(self, path: Path, lock: int) -> None:
        self.path = path
        self._lock = lock
        self._order = threading.Lock()
        self._begun = self._saved = 0  # numbers of saves

    def load(self) -> Found:
        """Return the session that was left here. An unusable one is kept aside and reported."""
        if not self.path.exists():
            return Found()
        try:
            session = from_bytes(read_file(self.path, LARGEST_BYTES), str(self.path))
            return Found(session, "\n".join(session.notes))
        except LucidaError as error:
            ending = "newer" if isinstance(error, NewerVersionError) else "broken"
            kept = self.put_aside(ending)
            where = f" It is kept as {kept}." if kept else ""
            return Found(None, f"The last session could not be restored. {error}.{where}")

    def save(self, data: bytes) -> None:
        """Replace the file, unless a save that began later, in another thread, has replaced it, or
        the place was released. Raise LucidaError; the old file then stays."""
        with self._order:
            self._begun += 1
            number = self._begun
        with (
            contextlib.suppress(_TooLateError),
            contextlib.ExitStack() as held,
            atomic_write(self.path) as file,
        ):
            file.write(data)
            file.flush()
            os.fsync(file.fileno())  # this may take long: before the lock
            held.enter_context(self._order)
            if number < self._saved:
                raise _TooLateError
            self._saved = number

    def release(self) -> None:
        with self._order:
            self._saved = sys.maxsize
        if self._lock >= 0:
            os.close(self._lock)
            self._lock = -1

    def put_aside(self, ending: str) -> Path | None:
        """Move the file to a free name, so that nothing set aside is lost. Return that name, or
        None if this fails."""
        for number in range(1, 1000):
            target = self.path.with_suffix(f".{ending}-{number}.json")
            if not target.exists():
                with contextlib.suppress(OSError):
                    self.path.rename(target)
                    return target
                return None
        return None


def take_place(folder: Path | None = None) -> SessionFile | None:
    """Return the first place that no other window has; None if sessions cannot be kept.

    folder: of the files; None for the user's settings folder, created if necessary.
    """
    try:
        folder = folder or settings_folder()
        folder.mkdir(parents=True, exist_ok=True)
        for number in range(1, MOST_WINDOWS + 1):
            lock = _locked(folder / f"session-{number}.lock")
            if lock is not None:
                path = folder / f"session-{number}.json"
                return SessionFile(path, lock)
    except (OSError, RuntimeError):  # RuntimeError: there is no home
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
    """Saves a session some seconds after the last change, on its own thread, and at the end.

    wake: called on that thread when a save has failed. A failure is reported once: message.
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

    def close(self, session: Session | None) -> None:
        """Save at once, and release the place. None: what was saved last stays."""
        self._saving.close(LAST_S)
        data = to_bytes(session) if session is not None else self._saved
        with contextlib.suppress(LucidaError):
            if data is not None and data != self._saved:
                self._place.save(data)
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
