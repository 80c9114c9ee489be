"""The process that traces for a picture of the window, beside the one that draws it.

The compiler's library and the window's take about as long to load, and neither needs the other.
Owns the start of that process, its end, and what it does: it reads questions, each with a number,
and answers them in their order. Knows nothing of who asks (tracer_apart.py). Light to import: it is
started first of all.
"""

from __future__ import annotations

import contextlib
import gc
import os
import queue
import subprocess
import sys
import threading
import traceback
from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, Any

from renderer import compile_note
from renderer.child import end_child, interpreter, start_child

if TYPE_CHECKING:
    from renderer.trace import TraceJob, Tracer

Process = subprocess.Popen[bytes]

NEWS_S = 0.05  # between two looks at whether something is being compiled
NOTE = 0  # the number of what answers no question: compile_note.note()


@contextlib.contextmanager
def tracing_process(wanted: bool) -> Iterator[Process | None]:
    """The process, as long as this context is entered; None where it is not wanted, or where none
    can be started: then everybody traces for themselves."""
    python = interpreter() if wanted else None
    process = None
    if python is not None:
        with contextlib.suppress(OSError):
            process = start_child(python, __name__, output=True, watched=False)
    try:
        yield process
    finally:
        if process is not None:
            end_child(process)


def main() -> None:
    """What the process does. It ends when nobody can ask it any more."""
    gc.disable()  # hardly anything is garbage here, and it ends soon
    questions, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever a library prints is no part of the answers
    from app.images.scene_tracer import make_tracer
    from renderer.scene.packing import read_value

    server = TracingServer(answers, make_tracer)
    if sys.platform == "win32":  # loading a library there waits for a thread that reads input
        server.prepared.wait()
    with contextlib.suppress(EOFError):
        while True:
            server.take(*read_value(questions))
    os._exit(0)  # also a compiler at work


class TracingServer:
    """Takes questions in one thread, and answers them in another. make: gives a Tracer of a scene,
    with shadows or not, and so many reflections."""

    def __init__(self, answers: Any, make: Callable[[Any, bool, int], Tracer]) -> None:
        import numpy as np

        from renderer.camera import Camera
        from renderer.scene.model import Mesh, Scene, SceneObject

        corners, face = np.eye(3, dtype=np.float32), np.array([[0, 1, 2]], np.int32)
        self._make, self._effects = make, (False, 0)
        self._tracer = make(Scene((SceneObject(Mesh(corners, face)),)), *self._effects)
        self.prepared = self._tracer.start(Camera.canonical(), (1, 1))  # all is loaded for that
        self._answers = answers
        self._told = ""
        self._jobs: dict[int, TraceJob] = {}
        self._queue: queue.SimpleQueue[tuple[int, Callable[[], Any]]] = queue.SimpleQueue()
        threading.Thread(target=self._answer, name="lucida-answers", daemon=True).start()

    def take(self, what: str, number: int, *given: Any) -> None:
        """One question, or what is to be done at once."""
        if what == "tracer":
            self._begin(*given)
        elif what == "scene":
            self._tracer.set_scene(*given)
        elif what == "cancel":
            if (job := self._jobs.get(number)) is not None:
                job.cancel()
        elif what == "start":
            try:
                self._jobs[number] = self._tracer.start(*given)
                self._queue.put((number, partial(self._image, number)))
            except Exception as error:
                self._queue.put((number, partial(_fail, error)))
        else:
            self._queue.put((number, partial(getattr(self._tracer, what), *given)))

    def _begin(self, scene: Any, *effects: Any) -> None:
        """A tracer of a scene: the one that there is, where it has these effects."""
        if effects == self._effects:
            self._tracer.set_scene(scene)
        else:
            self._effects = effects
            self._tracer = self._make(scene, *effects)

    def _answer(self) -> None:
        from renderer.scene.packing import write_value

        self._wait(self.prepared)
        while True:
            number, work = self._queue.get()
            try:
                answer = work()
            except BaseException as error:
                answer = _sendable(error)
            write_value(self._answers, (number, answer))

    def _image(self, number: int) -> Any:
        self._wait(self._jobs[number])
        return self._jobs.pop(number).result()

    def _wait(self, job: TraceJob) -> None:
        """Tells meanwhile if something is being compiled."""
        from renderer.scene.packing import write_value

        done = False
        while not done:
            done = job.wait(NEWS_S)
            if compile_note.note() != self._told:
                self._told = compile_note.note()
                write_value(self._answers, (NOTE, self._told))


def _fail(error: Exception) -> None:
    raise error


def _sendable(error: BaseException) -> BaseException:
    """With where it happened, which is shown where tracebacks are."""
    import pickle

    text = "".join(traceback.format_exception(error))
    try:
        pickle.loads(pickle.dumps(error))
    except Exception:
        error = RuntimeError(f"{type(error).__name__}: {error}")
    error.add_note(text)
    return error
