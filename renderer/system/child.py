"""Python in a child process, for work that would hold this process's GIL, or must be killable.

The child ends with its parent. This module is light to import, since each child imports it.
"""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
import threading
from importlib import import_module
from importlib.resources import files
from pathlib import Path

from .errors import LucidaError

_NICENESS = 2  # lower priority than the window
_START = "import sys, json; sys.path[:] = json.loads(sys.argv[1]); "
_START += "from importlib import import_module; import_module(sys.argv[2]).main(*sys.argv[3:])"

REMEDY = "start processes by spawn: multiprocessing.get_context('spawn')"

_watching = 0  # id of the process that watches its parent, perhaps inherited by a fork


def interpreter() -> str | None:
    """Return the path of the Python executable; None if this process is another program with
    embedded Python.
    """
    if getattr(sys, "frozen", False) or not sys.executable:
        return None
    return sys.executable if Path(sys.executable).stem.lower().startswith("python") else None


def child_command(python: str, module: str, *arguments: str) -> list[str]:
    """Return the command that calls main(*arguments) of a module in a child process.

    The child runs in isolated mode. Otherwise, Python would first search the current folder for
    modules, where a user may have any file, even a `json.py`.
    """
    options = ["-I", "-X", f"utf8={sys.flags.utf8_mode}"]
    if sys.dont_write_bytecode:
        options.append("-B")
    if sys.pycache_prefix:
        options += ["-X", f"pycache_prefix={sys.pycache_prefix}"]
    return [python, *options, "-c", _START, json.dumps(import_path()), module, *arguments]


def import_path() -> list[str]:
    """Return this process's sys.path, absolute, without a current folder that lacks our packages.

    sys.path has the current folder in an interactive Python, in a notebook and with `python -m`.
    """
    try:
        here = os.path.realpath(os.getcwd())
    except OSError:  # it was deleted
        here = ""
    root = os.path.realpath(os.path.join(str(files("lucida")), ".."))
    folders = [os.path.join(here, folder) for folder in sys.path]
    return [
        folder
        for folder in folders
        if os.path.isabs(folder) and (os.path.realpath(folder) != here or here == root)
    ]


def start_child(python: str, module: str, *arguments: str) -> subprocess.Popen[bytes]:
    """Call main(*arguments) of a module in a child process. The module must call end_with_parent().

    python: interpreter(). Its output is discarded. Raises OSError.
    """
    flags = 0
    if sys.platform == "win32":
        flags = subprocess.BELOW_NORMAL_PRIORITY_CLASS | subprocess.CREATE_NO_WINDOW
        flags |= subprocess.CREATE_NEW_PROCESS_GROUP
    # The child has a separate process group, so that Ctrl-C goes only to this process.
    return subprocess.Popen(
        child_command(python, __name__, module, *arguments),
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
        creationflags=flags,
    )


def end_child(process: subprocess.Popen[bytes]) -> int:
    """Kill the process if it is still running, close its input, and return its exit status. Safe to
    call twice.
    """
    process.kill()
    status = process.wait()
    if process.stdin is not None:
        with contextlib.suppress(OSError):  # unread input is lost
            process.stdin.close()
    return status


def main(module: str, *arguments: str) -> None:
    """Run a child of start_child().

    Watch the parent first, because it may end during the imports.
    """
    if sys.platform != "win32":
        end_with_parent()
    import_module(module).main(*arguments)


def end_with_parent() -> None:
    """Lower the priority of this child process, and end it when its input ends.

    A child calls this as soon as its libraries are loaded. Only Windows needs to wait for that,
    because loading a library blocks there while a thread reads input. On other systems, main() has
    already called this.
    """
    global _watching
    if _watching == os.getpid():
        return
    is_copy, _watching = bool(_watching), os.getpid()
    threading.Thread(target=_watch_parent, daemon=True).start()
    if hasattr(os, "nice") and not is_copy:
        os.nice(_NICENESS)


def _watch_parent() -> None:
    os.read(0, 1)  # nothing is ever sent, so this returns at the end of the input
    os._exit(1)


def check_not_forked(owner_pid: int, field: str, what: str) -> None:
    """Raise LucidaError in a process forked from `owner_pid`, because locks of threads that the
    fork did not copy stay locked forever. what: e.g. "was made".
    """
    if os.getpid() != owner_pid:
        problem = f"{what} before this process was forked, and its threads stayed behind"
        raise LucidaError(field, problem, REMEDY)
