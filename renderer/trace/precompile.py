"""Compiling kernels in processes of their own, into the cache that this process then loads from.

Owns these processes: what they compile, and their end. numba compiles one function at a time, and
holds Python's lock meanwhile; processes compile at once, and a window's loop goes on.

Nothing depends on it: what is not in the cache afterwards is compiled here, at its first call.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import llvmlite.binding as llvm
import numpy as np
from numba.core import config

from renderer import compiling
from renderer.scene.flat import flatten
from renderer.scene.model import Mesh, Scene, SceneObject
from renderer.trace.compiled import cache_folder
from renderer.trace.shortcuts import take_shortcuts
from renderer.trace.team import Team, default_threads

LIMIT_S = 120.0  # a process that takes longer is given up
_POLL_S = 0.01
_NICENESS = 2  # a window comes first
# Without collecting garbage: a tenth of the time, for 40 MB.
_START = "import gc, json, sys; gc.disable(); sys.path[:] = json.loads(sys.argv[2]); "
_START += "from renderer.trace.precompile import main; main(sys.argv[1])"


def parts_of(method: str, shadows: bool, mirror_depth: int) -> tuple[str, ...]:
    """What a Tracer's engine needs that is worth a process; what takes longest comes first."""
    if method != "packets":
        return ()
    return "write-effects" if shadows or mirror_depth else "write", "walk", "trees"


def compile_part(part: str) -> None:
    """Compiles a part, or finds it in the cache."""
    from renderer.trace.instances import Instances
    from renderer.trace.packet_engine import PacketEngine

    if part == "trees":
        corners, face = np.eye(3, dtype=np.float32), np.array([[0, 1, 2]], np.int32)
        scene = Scene((SceneObject(Mesh(corners, face)),))
        Instances(scene, flatten(scene), Team(1))
    else:
        kernel, _, effects = part.partition("-")
        mirror_depth = 1 if effects else 0
        PacketEngine(Scene(()), Team(1), bool(effects), mirror_depth, (kernel,))  # nothing to build


class Precompilation:
    """Processes that compile parts, as many as are not known to be in the cache.

    There are none where they would be of no use, or cannot be: no place for a cache, a single
    processor, a program that is not Python's interpreter.
    """

    def __init__(self, parts: tuple[str, ...]) -> None:
        folder, python = cache_folder(), _interpreter()
        self._processes: dict[Path, subprocess.Popen] = {}
        if folder is None or python is None or default_threads() == 1:
            return
        for part in parts:
            mark = folder / f"{part}-{_processor()}.done"
            if not mark.exists():
                with contextlib.suppress(OSError):
                    self._processes[mark] = _start(python, part)
                    compiling.begin(kept=True)

    def wait(self, is_closed: Callable[[], bool]) -> None:
        """Returns when all are done, or is_closed() says that nobody waits: that kills them."""
        end_s = time.monotonic() + LIMIT_S
        try:
            for mark, process in self._processes.items():
                while process.poll() is None:
                    if is_closed() or time.monotonic() > end_s:
                        return
                    time.sleep(_POLL_S)
                if process.returncode == 0:
                    with contextlib.suppress(OSError):
                        mark.touch()
        finally:
            self.end()

    def end(self) -> None:
        """Kills those that are still at work."""
        for process in self._processes.values():
            process.kill()
            process.wait()
            assert process.stdin is not None
            process.stdin.close()
        self._processes.clear()


def main(part: str) -> None:
    """What such a process does. Its input ends with the process that started it.

    It ends at once: to take a compiler's million objects down would take a sixth of its time.
    """
    threading.Thread(target=_end_with_parent, daemon=True).start()
    if hasattr(os, "nice"):
        os.nice(_NICENESS)
    take_shortcuts()
    compile_part(part)
    os._exit(0)


def _end_with_parent() -> None:
    os.read(0, 1)  # nothing is ever sent: it is the end
    os._exit(1)


def _interpreter() -> str | None:
    """Python's program, unless this process is some other, with Python inside."""
    if getattr(sys, "frozen", False) or not sys.executable:
        return None
    return sys.executable if Path(sys.executable).stem.lower().startswith("python") else None


def _start(python: str, part: str) -> subprocess.Popen:
    path = json.dumps([os.path.abspath(folder) for folder in sys.path])
    flags = 0
    if sys.platform == "win32":
        flags = subprocess.BELOW_NORMAL_PRIORITY_CLASS | subprocess.CREATE_NO_WINDOW
        flags |= subprocess.CREATE_NEW_PROCESS_GROUP
    environment = dict(os.environ)
    if config.CACHE_DIR:
        environment["NUMBA_CACHE_DIR"] = config.CACHE_DIR
    # A group of its own: Ctrl-C is this process' business, which ends the other.
    return subprocess.Popen(
        [python, "-c", _START, part, path],
        stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        env=environment, start_new_session=True, creationflags=flags,
    )  # fmt: skip


def _processor() -> str:
    """Names the processor that is compiled for: a folder may be shared by several."""
    try:
        features = llvm.get_host_cpu_features().flatten()
    except RuntimeError:
        features = ""
    text = repr((llvm.get_host_cpu_name(), features, config.CPU_NAME, config.CPU_FEATURES))
    return hashlib.sha256(text.encode()).hexdigest()[:12]
