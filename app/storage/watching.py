"""Whether a file has changed, while somebody edits it.

Pure but for one stat(): it is asked now and then, and says yes once a change has come to rest.
Knows nothing of what is done about it.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from pathlib import Path

REST_S = 0.15  # an editor may write a file in several goes

Signature = tuple[int, ...]


@dataclass
class Watch:
    """known: the file as it was last read. rest_s: for how long a change must have rested."""

    known: Signature | None
    rest_s: float = REST_S
    _seen: Signature | None = field(default=None, init=False)
    _since_s: float = field(default=0.0, init=False)

    def changed(self, now: Signature | None, time_s: float) -> bool:
        """Whether the file has become another one and stays so; True once for each change.

        now: its signature; None while it is not there, as when an editor replaces it.
        """
        if now is None or now == self.known:
            self._seen = None
            return False
        if now != self._seen:
            self._seen, self._since_s = now, time_s
            return False
        if time_s - self._since_s < self.rest_s:
            return False
        self.known, self._seen = now, None
        return True

    @property
    def waiting(self) -> bool:
        """Whether a change has been seen that has not rested yet: ask again soon."""
        return self._seen is not None


def signature(*paths: Path) -> Signature | None:
    """What tells a version of files from another: their times, sizes and numbers; None where one
    is not there."""
    try:
        found = [path.stat() for path in paths]
    except (OSError, ValueError):
        return None
    return tuple(n for s in found for n in (s.st_mtime_ns, s.st_size, s.st_ino))


def fingerprint(path: Path) -> str:
    """What tells a file's content from another's, however often it was copied; "" without it."""
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()
    except OSError:
        return ""
