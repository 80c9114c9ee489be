"""Processes of Lucida, each forked from one that has imported its modules and loaded its kernels.

That takes more than half of a start. The window, the files and the exit are those of a process of
its own; only a test of the start itself needs one that begins with nothing.
"""

from __future__ import annotations

import atexit
import functools
import gc
import json
import os
import runpy
import select
import signal
import socket
import subprocess
import sys
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import Any

SUPPORT = str(Path(__file__).parent)
PATH = os.pathsep.join((str(Path(__file__).parents[2]), SUPPORT))
STREAMS = ("stdin", "stdout", "stderr")
SERVED = "LUCIDA_TESTS_LAUNCHING"  # the address of the server, for pytest's workers


def environment(folder: Path, display: str | None = None) -> dict[str, str]:
    """Return variables without a display unless one is given, and without the settings of whoever
    runs the tests."""
    variables = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    variables |= {"XDG_CONFIG_HOME": str(folder / "config"), "PYTHONPATH": PATH}
    return variables | ({"DISPLAY": display} if display else {})


def launch(
    arguments: list[str],
    folder: Path,
    display: str | None = None,
    fresh: bool = False,
) -> subprocess.CompletedProcess[str]:
    """Run Python in a folder, with `-c SCRIPT`, `-m lucida` or a script's name, and more arguments.

    Return the process once it has ended. It is killed if the test ends first, at pytest's limit for
    instance. fresh: True for a process that begins with no module imported.
    """
    variables = environment(folder, display)
    if fresh or not sys.platform.startswith("linux"):  # elsewhere, a library may not be forked
        command = [sys.executable, *arguments]
        return subprocess.run(command, cwd=folder, env=variables, capture_output=True, text=True)
    with tempfile.TemporaryDirectory() as streams:
        files = [Path(streams) / name for name in STREAMS]
        for file in files:
            file.touch()
        request = {
            "arguments": arguments,
            "folder": str(folder),
            "environment": variables,
            "streams": [str(file) for file in files],
        }
        address, status = os.environ.get(SERVED) or address_of_server(), b""
        try:
            with socket.socket(socket.AF_UNIX) as server, suppress(OSError):
                server.connect(address)
                server.sendall(json.dumps(request).encode() + b"\n")
                status = server.recv(9)
        finally:
            told = [file.read_text() for file in files[1:]]
            sys.stderr.write(told[1])  # pytest shows it if the test fails
    assert status, "the server of tests/support/launching.py has ended"
    return subprocess.CompletedProcess(arguments, int(status), *told)


@functools.cache
def address_of_server() -> str:
    """Start the process from which the others are forked, which ends with this one. Return the path
    of its socket."""
    is_long = len(tempfile.gettempdir()) > 80  # a socket's path has at most 107 characters
    folder = tempfile.TemporaryDirectory(dir="/tmp" if is_long else None)
    path = str(Path(folder.name) / "socket")
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind(path)
        listener.listen()
        server = subprocess.Popen(
            [sys.executable, "-P", __file__, str(listener.fileno())],
            env=os.environ | {"PYTHONPATH": PATH, "OPENBLAS_NUM_THREADS": "1"},
            stdin=subprocess.PIPE,
            pass_fds=[listener.fileno()],
        )
    atexit.register(folder.cleanup)
    atexit.register(server.communicate)
    return path


def _serve(listener: socket.socket) -> dict[str, Any]:
    """Answer each request with the exit status of a process. Return the request in that process."""
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # no process waits for a fork that has answered
    while sys.stdin not in select.select([listener, sys.stdin], [], [])[0]:
        with listener.accept()[0] as client:
            if os.fork():
                continue
            signal.signal(signal.SIGCHLD, signal.SIG_DFL)
            listener.close()
            request = client.makefile().readline()
            process = os.fork()
            if not process:
                return json.loads(request)
            if client in select.select([client, os.pidfd_open(process)], [], [])[0]:
                os.kill(process, signal.SIGKILL)  # its test has ended, and closed the client
            status = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
            with suppress(OSError):
                client.sendall(f"{status}\n".encode())
            os._exit(0)
    sys.exit()


def _become(request: dict[str, Any]) -> None:
    """Run what is asked for, as if this process had been started for it."""
    for number, name in enumerate(request["streams"]):
        opened = os.open(name, os.O_RDWR)
        os.dup2(opened, number)
        os.close(opened)
    os.chdir(request["folder"])
    os.environ.clear()
    os.environ.update(request["environment"])
    kind, *rest = request["arguments"]
    match kind:
        case "-c":
            script, *sys.argv[1:] = rest
            exec(script, {"__name__": "__main__"})
        case "-m":
            module, *sys.argv[1:] = rest
            runpy.run_module(module, run_name="__main__", alter_sys=True)
        case _:
            sys.argv = [kind, *rest]
            runpy.run_path(kind, run_name="__main__")


if __name__ == "__main__":
    import stepped  # noqa: F401  the window, and what tests do with it

    import lucida.app.window.launch  # noqa: F401
    from lucida.renderer.trace.parts import compile_part

    for part in ("trees", "walk-plain", "write-plain"):
        compile_part(part)
    gc.freeze()  # or a collection would write to all pages, which then are copied
    _become(_serve(socket.socket(fileno=int(sys.argv[1]))))
