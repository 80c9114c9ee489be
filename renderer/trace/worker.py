"""A Tracer's own thread: it prepares the scene, then traces one task after the other.

Owns that thread, its team, and their end: when the Tracer is closed or dropped, or the interpreter
exits. Everything slow happens here: importing numba, compiling, building the BVH.
"""

from __future__ import annotations

import atexit
import contextlib
import queue
import threading
import weakref

from renderer.errors import LucidaError
from renderer.scene.model import Scene
from renderer.trace.jobs import Task
from renderer.trace.team import Team


class Worker:
    """Runs tasks in the order of their submission, in a thread that starts with the first."""

    def __init__(self, scene: Scene, threads: int) -> None:
        self._scene, self._threads = scene, threads
        self._tasks: queue.SimpleQueue[Task | None] = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._unfinished: list[Task] = []
        self._thread: threading.Thread | None = None
        self._closed = False

    def submit(self, task: Task) -> None:
        """Queues a task. Raises LucidaError once closed."""
        with self._lock:
            if self._closed:
                raise LucidaError("tracer", "is closed", "make a new Tracer")
            self._unfinished = [old for old in self._unfinished if not old.finished.is_set()]
            self._unfinished.append(task)
            if self._thread is None:
                # A daemon, so that the interpreter's exit reaches _end_all instead of waiting.
                self._thread = threading.Thread(
                    target=self._serve, name="lucida-trace-0", daemon=True
                )
                self._thread.start()
                _workers.add(self)
            self._tasks.put(task)

    def close(self) -> None:
        """Cancels all tasks and ends the thread, without waiting for it; see join()."""
        self._closed = True  # without the lock: a finalizer may run in the thread that holds it
        self._tasks.put(None)
        for task in list(self._unfinished):
            task.cancel()

    def join(self) -> None:
        """Waits for the thread to end."""
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join()

    def _serve(self) -> None:
        team = Team(self._threads)
        engine = None
        while (task := self._tasks.get()) is not None:
            try:
                if engine is None and not task.finished.is_set():
                    from renderer.trace.engine import Engine  # imports numba

                    engine = Engine(self._scene, team)
                if engine is not None:
                    task.trace(engine.trace)
            except BaseException as error:
                task.fail(error)
            del task  # its buffers, while waiting for the next
        team.close()


# Threads must have left their kernels before the interpreter takes the memory away.
_workers: weakref.WeakSet[Worker] = weakref.WeakSet()


@atexit.register
def _end_all() -> None:
    workers = list(_workers)
    for worker in workers:
        worker.close()
    for worker in workers:
        with contextlib.suppress(KeyboardInterrupt):
            worker.join()
