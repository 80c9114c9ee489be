"""Python in a process of its own, for work that would hold this one's lock, or must be killable.

Owns how such a process starts, and that it ends with the one that started it. Knows nothing of the
work. Light to import: a child pays for it at each start.
"""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
import threading
from importlib import import_module
from pathlib import Path

_NICENESS = 2  # a window comes first
_START = "import sys, json; sys.path[:] = json.loads(sys.argv[1]); "
_START += "from importlib import import_module; import_module(sys.argv[2]).main(*sys.argv[3:])"

_watching = 0  # the process that watches its parent: this one, or the one that it is a copy of


def interpreter() -> str | None:
    """Python's program, unless this process is some other, with Python inside."""
    if getattr(sys, "frozen", False) or not sys.executable:
        return None
    return sys.executable if Path(sys.executable).stem.lower().startswith("python") else None


def child_command(python: str, module: str, *arguments: str) -> list[str]:
    """The command that calls main(*arguments) of a module in a process of its own.

    Isolated: left to itself, Python looks for modules in the current folder first, where anything
    may lie beside a user's files, a `json.py` too.
    """
    options = ["-I", "-X", f"utf8={sys.flags.utf8_mode}"]
    if sys.dont_write_bytecode:
        options.append("-B")
    if sys.pycache_prefix:
        options += ["-X", f"pycache_prefix={sys.pycache_prefix}"]
    return [python, *options, "-c", _START, json.dumps(import_path()), module, *arguments]


def import_path() -> list[str]:
    """This process' sys.path, absolute; without the current folder, unless our packages lie in it.

    An interactive Python, a notebook and `python -m` have the current folder in theirs.
    """
    try:
        here = os.path.realpath(os.getcwd())
    except OSError:  # it has been removed
        here = ""
    root = os.path.realpath(Path(__file__).parent.parent)
    folders = [os.path.join(here, folder) for folder in sys.path]
    return [
        folder
        for folder in folders
        if os.path.isabs(folder) and (os.path.realpath(folder) != here or here == root)
    ]


def start_child(
    python: str, module: str, *arguments: str, output: bool = False
) -> subprocess.Popen[bytes]:
    """Calls main(*arguments) of a module in a process of its own, which is to call end_with_parent.

    python: interpreter(). output: whether its standard output is read through the result's stdout;
    otherwise nobody sees it. Raises OSError.
    """
    flags = 0
    if sys.platform == "win32":
        flags = subprocess.BELOW_NORMAL_PRIORITY_CLASS | subprocess.CREATE_NO_WINDOW
        flags |= subprocess.CREATE_NEW_PROCESS_GROUP
    # A group of its own: Ctrl-C is this process' business, which ends the other.
    return subprocess.Popen(
        child_command(python, __name__, module, *arguments),
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE if output else subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
        creationflags=flags,
    )


def end_child(process: subprocess.Popen[bytes]) -> int:
    """Kills it, if it is still at work, and gives its exit status; its pipes are closed. May be
    called again."""
    process.kill()
    status = process.wait()
    for pipe in (process.stdin, process.stdout):
        if pipe is not None:
            with contextlib.suppress(OSError):  # what it has not read is lost
                pipe.close()
    return status


def main(module: str, *arguments: str) -> None:
    """What a child of start_child's begins with: its parent may end before it has imported all."""
    if sys.platform != "win32":
        end_with_parent()
    import_module(module).main(*arguments)


def end_with_parent() -> None:
    """What a child calls as soon as its libraries are loaded: it gives way to its parent, and ends
    when its input does. Only Windows has to wait for that: loading a library there waits for a
    thread that reads input. Elsewhere it was done at the start."""
    global _watching
    if _watching == os.getpid():
        return
    is_copy, _watching = bool(_watching), os.getpid()
    threading.Thread(target=_watch_parent, daemon=True).start()
    if hasattr(os, "nice") and not is_copy:
        os.nice(_NICENESS)


def _watch_parent() -> None:
    os.read(0, 1)  # nothing is ever sent: it is the end
    os._exit(1)
