"""A tracer in a process of its own, which sleeps until it is asked: no other's threads, memory or
garbage are in its way while it is timed.

Owns these processes and what is said to them: a function of this module and its arguments, pickled.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import time
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from multiprocessing.connection import Connection
from typing import Any

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from tools.benchmarks.measure import Call, Plan, Stopwatch, Turn, turn
from tools.benchmarks.peers import Hits, Peer
from tools.benchmarks.scenes import Subject

# Otherwise the threads of NumPy's OpenBLAS, which trimesh uses, wait at work for 26 ms and more.
QUIET = {"OPENBLAS_THREAD_TIMEOUT": "4"}  # 2 to the 4th clock cycles
IDLE_S = 0.2


class TracerProcess:
    """One kind of tracer and one scene."""

    def __init__(self, kind: type[Peer]) -> None:
        self.kind, self.name = kind, kind.name
        os.environ.update(QUIET)  # the process starts with these
        context = multiprocessing.get_context("spawn")
        self._connection, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(kind, theirs), daemon=True)
        self._process.start()
        theirs.close()

    def version(self) -> str:
        return str(self._ask(_version))

    def prepare(self, subject: Subject, threads: int | None = None) -> None:
        """Build the scene."""
        self._ask(_prepare, subject, threads)

    def release(self) -> None:
        """Free the scene."""
        self._ask(_release)

    def image(self, camera: Camera, size: Size) -> None:
        """Choose an image to be timed and read."""
        self._ask(_set_image, camera, size)

    def building(self, subject: Subject) -> None:
        """Choose the building of this scene, next to those already prepared, to be timed."""
        self._ask(_set_building, subject)

    def hits(self) -> Hits:
        """Return the hits of the image."""
        hits: Hits = self._ask(_hits)
        return hits

    def turn(self, plan: Plan, stopwatch: Stopwatch) -> Turn:
        """The turn of what was set, for measure.interleaved."""
        return partial(self._ask, _timed, plan, stopwatch)

    def idle_share(self) -> float:
        """Return the share of a processor, 0 to 1, that the process takes while it is idle."""
        return float(self._ask(_idle_share))

    def close(self) -> None:
        self._connection.close()
        self._process.join(5.0)
        self._process.kill()

    def _ask(self, function: Callable[..., Any], *arguments: Any) -> Any:
        try:
            self._connection.send((function, arguments))
            answer, failure = self._connection.recv()
        except (EOFError, OSError) as error:
            raise RuntimeError(f"the process of {self.name} has ended") from error
        if failure is not None:
            text, trace = failure
            error = RuntimeError(text)
            error.add_note(f"In the process of {self.name}:\n{trace}")
            raise error
        return answer


# In the process.


@dataclass
class _State:
    kind: type[Peer]
    tracer: Peer | None = None
    call: Call | None = None


def _serve(kind: type[Peer], connection: Connection) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for whoever asks
    state = _State(kind)
    while True:
        try:
            function, arguments = connection.recv()
        except EOFError:
            return
        try:
            answer = function(state, *arguments), None
        except Exception as error:
            answer = None, (str(error) or type(error).__name__, traceback.format_exc())
        connection.send(answer)


def _version(state: _State) -> str:
    return state.kind.version()


def _prepare(state: _State, subject: Subject, threads: int | None) -> None:
    state.tracer = state.kind(threads)
    state.tracer.prepare(subject.vertices, subject.faces)


def _release(state: _State) -> None:
    if state.tracer is not None:
        state.tracer.close()
    state.tracer = state.call = None


def _prepared(state: _State) -> Peer:
    if state.tracer is None:
        raise RuntimeError("no scene is prepared")
    return state.tracer


def _chosen(state: _State) -> Call:
    if state.call is None:
        raise RuntimeError("nothing is chosen to be timed")
    return state.call


def _set_image(state: _State, camera: Camera, size: Size) -> None:
    state.call = partial(_prepared(state).trace, camera, size)


def _set_building(state: _State, subject: Subject) -> None:
    def build() -> None:
        tracer = state.kind()
        tracer.prepare(subject.vertices, subject.faces)
        tracer.close()

    state.call = build


def _hits(state: _State) -> Hits:
    return _prepared(state).read(_chosen(state)())


def _timed(state: _State, plan: Plan, stopwatch: Stopwatch) -> tuple[float, ...]:
    return turn(_chosen(state), plan, stopwatch)


def _idle_share(state: _State) -> float:
    _chosen(state)()
    time.sleep(0.02)
    start = time.process_time()
    time.sleep(IDLE_S)
    return (time.process_time() - start) / IDLE_S
