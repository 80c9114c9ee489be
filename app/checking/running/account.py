"""The user account that runs a student's program: `--as USER`, for root on Linux."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lucida.renderer.system.errors import LucidaError

_KILLING_S = 10.0
_EXECUTE, _WRITE, _READ = 1, 2, 4
_REMEDY = "make a user for the check alone: useradd --system student"


@dataclass(frozen=True)
class Account:
    """An unprivileged user, who had no processes when the check began."""

    name: str
    user: int
    group: int

    @property
    def options(self) -> dict[str, Any]:
        """The arguments of subprocess.Popen that start a program as this user."""
        return {"user": self.user, "group": self.group, "extra_groups": []}

    def kill(self) -> bool:
        """Kill all processes of this user. Return False if some are still running."""
        end = time.monotonic() + _KILLING_S
        while self.running():
            if time.monotonic() > end:
                return False
            try:  # A single call by the user itself also ends processes that keep forking.
                command = ["/bin/sh", "-c", "kill -KILL -1"]
                subprocess.run(command, check=False, timeout=1.0, **self.options)
            except (OSError, subprocess.TimeoutExpired):
                continue
        return True

    def running(self) -> bool:
        """Return True if a process has this user's id, as its real, effective or saved one."""
        for path in Path("/proc").glob("[0-9]*/status"):
            try:
                status = dict(line.split(":\t", 1) for line in path.read_text().splitlines())
            except (OSError, ValueError):  # it has ended
                continue
            if str(self.user) in status["Uid"].split() and not status["State"].startswith("Z"):
                return True
        return False

    def check_reach(self, read: Sequence[Path], written: Sequence[Path]) -> None:
        """Raise LucidaError if this user can read one of `read`, or replace one of `written`."""
        for path in map(Path.resolve, read):
            entered = all(self._may(folder, _EXECUTE) for folder in path.parents)
            if entered and self._may(path, _READ):
                raise LucidaError(str(path), f"{self.name} can read it", f"chmod 600 {path}")
        for path in map(Path.resolve, written):
            for one in (path, *path.parents):
                if one.exists() and self._may(one, _WRITE):
                    remedy = "choose a folder that is root's alone"
                    raise LucidaError(str(path), f"{self.name} can write to {one}", remedy)

    def _may(self, path: Path, right: int) -> bool:
        found = path.stat()
        if found.st_uid == self.user:
            return True
        if right == _WRITE and found.st_mode & 0o1000:  # sticky, as /tmp: only owners replace files
            return False
        return bool(found.st_mode >> (3 if found.st_gid == self.group else 0) & right)


def account(name: str) -> Account:
    """Return the user of that name. Raises LucidaError if it cannot run a student's program."""
    if sys.platform != "linux" or os.geteuid() != 0:
        raise LucidaError("--as", "needs root on Linux", "run the check as root, or leave --as out")
    import pwd

    try:
        found = pwd.getpwnam(name)
    except KeyError:
        raise LucidaError("--as", f"there is no user {name[:40]!r}", _REMEDY) from None
    if found.pw_uid == 0:
        raise LucidaError("--as", f"{name} may do everything", _REMEDY)
    made = Account(name, found.pw_uid, found.pw_gid)
    if made.running():
        raise LucidaError("--as", f"{name} has processes already", _REMEDY)
    return made
