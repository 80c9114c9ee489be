"""Python in a process of its own, for work that would hold this one's lock, or must be killable.

Owns how such a process starts, and that it ends with the one that started it. Knows nothing of the
work. Light to import: a child pays for it at each start.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
from collections.abc import Mapping
from pathlib import Path

_NICENESS = 2  # a window comes first
_START = "import sys, json; sys.path[:] = json.loads(sys.argv[1]); "
_START += "from {module} import main; main(*sys.argv[2:])"


def interpreter() -> str | None:
    """Python's program, unless this process is some other, with Python inside."""
    if getattr(sys, "frozen", False) or not sys.executable:
        return None
    return sys.executable if Path(sys.executable).stem.lower().startswith("python") else None


def start_child(
    python: str,
    module: str,
    *arguments: str,
    output: bool = False,
    environment: Mapping[str, str] | None = None,
) -> subprocess.Popen[bytes]:
    """Calls main(*arguments) of a module in a process of its own, which is to call end_with_parent.

    python: interpreter(). output: whether its standard output is read through the result's stdout;
    otherwise nobody sees it. environment: added to this process'. Raises OSError.
    """
    path = json.dumps([os.path.abspath(folder) for folder in sys.path])
    flags = 0
    if sys.platform == "win32":
        flags = subprocess.BELOW_NORMAL_PRIORITY_CLASS | subprocess.CREATE_NO_WINDOW
        flags |= subprocess.CREATE_NEW_PROCESS_GROUP
    # A group of its own: Ctrl-C is this process' business, which ends the other.
    return subprocess.Popen(
        [python, "-c", _START.format(module=module), path, *arguments],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE if output else subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        env=dict(os.environ) | dict(environment or {}),
        start_new_session=True,
        creationflags=flags,
    )


def end_child(process: subprocess.Popen[bytes]) -> int:
    """Kills it, if it is still at work, and gives its exit status; its pipes are closed."""
    process.kill()
    status = process.wait()
    for pipe in (process.stdin, process.stdout):
        if pipe is not None:
            pipe.close()
    return status


def end_with_parent() -> None:
    """What a child calls first: it gives way to its parent, and its input ends with it."""
    threading.Thread(target=_watch_parent, daemon=True).start()
    if hasattr(os, "nice"):
        os.nice(_NICENESS)


def _watch_parent() -> None:
    os.read(0, 1)  # nothing is ever sent: it is the end
    os._exit(1)
