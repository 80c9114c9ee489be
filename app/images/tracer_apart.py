"""A Tracer whose work is done by a process of its own (tracing_process.py).

Owns the questions that are on their way there, and what becomes of them when the process ends.
Knows nothing of what the answers mean.
"""

from __future__ import annotations

import itertools
import threading
from collections.abc import Callable, Iterable
from typing import Any

from app.images.progressive_ray import AnyTracer
from app.images.request import ImageRequest
from app.images.scene_tracer import needs, tracer_for
from app.images.tracing_process import NOTE, Process
from renderer import compile_note
from renderer.camera import Camera
from renderer.child import end_child
from renderer.errors import LucidaError
from renderer.frame import Frame
from renderer.scene.model import Scene
from renderer.scene.packing import read_value, write_value


class TracingAnswer:
    """What comes of one question. Any thread may wait for it."""

    def __init__(self) -> None:
        self._come = threading.Event()
        self._value: Any = None

    def give(self, value: Any) -> None:
        self._value = value
        self._come.set()

    def wait(self, timeout_s: float | None = None) -> bool:
        return self._come.wait(timeout_s)

    def result(self) -> Any:
        """The answer, once there is one; raises the exception that there came instead."""
        self._come.wait()
        if isinstance(self._value, BaseException):
            raise self._value
        return self._value


class Questions:
    """Both pipes of a process. Thread-safe."""

    def __init__(self, process: Process) -> None:
        self._process = process
        self._lock = threading.Lock()
        self._numbers = itertools.count(NOTE + 1)
        self._open: dict[int, TracingAnswer] = {}
        self._error: LucidaError | None = None
        threading.Thread(target=self._take, name="lucida-answers", daemon=True).start()

    @property
    def ended(self) -> bool:
        """Whether nobody will answer any more."""
        return self._error is not None

    def ask(self, what: str, *given: Any) -> tuple[int, TracingAnswer]:
        """Sends a question; gives its number, and what comes of it."""
        answer = TracingAnswer()
        with self._lock:
            number = next(self._numbers)
            if self._error is None:
                self._open[number] = answer
            else:
                answer.give(self._error)
        self.tell(what, number, *given)
        return number, answer

    def tell(self, what: str, number: int, *given: Any) -> None:
        """Sends what has no answer."""
        with self._lock:
            if self._error is None:
                try:
                    assert self._process.stdin is not None
                    write_value(self._process.stdin, (what, number, *given))
                except (OSError, ValueError):
                    pass  # it has ended, which the other thread finds

    def _take(self) -> None:
        """The thread that reads the answers."""
        assert self._process.stdout is not None
        try:
            while True:
                number, value = read_value(self._process.stdout)
                if number == NOTE:
                    compile_note.begin(kept=value != compile_note.EACH_TIME)
                else:
                    self._open.pop(number).give(value)
        except (EOFError, OSError, ValueError):
            pass
        self._process.kill()
        with self._lock:
            problem = f"its process ended ({end_child(self._process)})"
            remedy = "close other programs: memory may have run out"
            self._error = LucidaError("ray tracer", problem, remedy)
            unanswered, self._open = self._open, {}
        for answer in unanswered.values():
            answer.give(self._error)


class ImageApart:
    """progressive_ray.Job: an image that was asked for."""

    def __init__(self, questions: Questions, number: int, answer: TracingAnswer) -> None:
        self._questions, self._number, self._answer = questions, number, answer

    @property
    def progress(self) -> float:
        """How far it is on the way, nobody is told."""
        return float(self._answer.wait(0))

    def cancel(self) -> None:
        self._questions.tell("cancel", self._number)

    def wait(self, timeout_s: float | None = None) -> bool:
        return self._answer.wait(timeout_s)

    def result(self) -> Frame:
        frame: Frame = self._answer.result()
        return frame


class TracerApart:
    """What the window needs of renderer.trace.Tracer. The process has one: the last that was made
    is the one that there is."""

    def __init__(self, questions: Questions, scene: Scene, shadows: bool, depth: int) -> None:
        self._questions = questions
        self.scene, self.scenes = scene, 1
        questions.tell("tracer", NOTE, scene, shadows, depth)

    def set_scene(self, scene: Scene) -> None:
        self.scenes += 1  # before, as there
        self.scene = scene
        self._questions.tell("scene", NOTE, scene)

    def start(
        self, camera: Camera, size: tuple[int, int], channels: Iterable[str] = ()
    ) -> ImageApart:
        number, answer = self._questions.ask("start", camera, size, tuple(channels))
        return ImageApart(self._questions, number, answer)

    def closest_hits(self, *rays: Any) -> Any:
        return self._questions.ask("closest_hits", *rays)[1].result()

    def any_hits(self, *rays: Any) -> Any:
        return self._questions.ask("any_hits", *rays)[1].result()

    def close(self) -> None:
        """Nothing: the process goes on, for the next one, until its context is left."""


def tracers_of(process: Process) -> Callable[[ImageRequest], AnyTracer]:
    """Makes the tracers of a LiveTrace: apart, as long as the process is there."""
    questions = Questions(process)

    def make(request: ImageRequest) -> AnyTracer:
        if questions.ended:
            return tracer_for(request)
        return TracerApart(questions, *needs(request))

    return make
