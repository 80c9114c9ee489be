"""A Tracer's own thread, which prepares the scene and then traces one task after another.

The thread and its team end when the Tracer is closed or dropped, or the interpreter exits.
All slow work happens on it: importing numba, compiling, building the BVH.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import queue
import threading
import weakref
from functools import partial
from typing import Any

from lucida.renderer.scene.model import Scene
from lucida.renderer.system.child import check_not_forked
from lucida.renderer.system.errors import LucidaError

from .image_job import Task
from .parts import compile_part, parts_of
from .ray_batch import RayBatch
from .threads.thread_pool import AbandonedError, Team

Work = Task | RayBatch

_imported_pid = os.getpid()


class Worker:
    """A thread that runs tasks in the order of their submission, and starts with the first."""

    def __init__(self, threads: int, method: str, shadows: bool, mirror_depth: int) -> None:
        self._team, self._method = Team(threads), method
        self._effects = shadows, mirror_depth
        self._engine: Any = None
        self._prepared: Scene | None = None  # the engine's
        self._compiled: set[str] = set()  # loaded parts
        self.is_compiling = False
        self._queue: queue.SimpleQueue[tuple[Scene, Work] | None] = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._tasks: weakref.WeakSet[Work] = weakref.WeakSet()
        self.current: Work | None = None
        self._newest: Scene | None = None  # the last task's
        self._thread: threading.Thread | None = None
        self.pid = os.getpid()  # the thread's
        self._closed = False

    def submit(self, scene: Scene, task: Work) -> None:
        """Queue a task on a scene.

        Raises LucidaError once closed, if the thread belongs to another process, or if another
        Tracer's thread may have left numba locked there.
        """
        self._check_process()
        with self._lock:
            if self._closed:
                raise LucidaError("tracer", "is closed", "make a new Tracer")
            self._tasks.add(task)
            self._newest = scene
            self._queue.put((scene, task))  # before the thread starts, so that it need not wait
            if self._thread is None:
                # A daemon thread, so that the interpreter's exit calls _end_all instead of waiting.
                self._thread = threading.Thread(
                    target=self._serve, name="lucida-trace-0", daemon=True
                )
                self.pid = os.getpid()
                self._thread.start()
                _workers.add(self)

    def close(self) -> None:
        """Cancel all tasks and let the thread end, without waiting for it; see join()."""
        with self._lock:
            self.abandon()
            for task in list(self._tasks):
                task.cancel()

    def abandon(self) -> None:
        """Let the thread end, and cancel all tasks, when the Tracer was dropped.

        Takes no locks: as a finalizer, it may interrupt a thread that holds them.
        """
        self._closed = True
        self._queue.put(None)
        current = self.current
        if current is not None:
            current.stop()

    def join(self) -> None:
        """Wait for the thread to end."""
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join()

    def _check_process(self) -> None:
        if self._thread is not None:
            check_not_forked(self.pid, "tracer", "has begun its work")
        elif os.getpid() != _imported_pid:
            for worker in list(_workers):
                if worker.current is not None:
                    check_not_forked(worker.pid, "tracer", "another one was at work")

    def _serve(self) -> None:
        while (item := self._queue.get()) is not None:
            scene, task = item
            self.current = task
            try:
                self._run(scene, task)
            except AbandonedError:
                task.cancel()
            except MemoryError:
                task.fail(LucidaError("scene", "exceeds the memory", "use a smaller model"))
            except BaseException as error:
                task.fail(error)
            del item, task  # frees their buffers while waiting for the next task
            self.current = None
        self._team.close()
        self._engine = self._prepared = None

    def _run(self, scene: Scene, task: Work) -> None:
        """Compile the task's parts, prepare its scene, and run it, unless it was cancelled."""
        if self._closed:
            task.cancel()
        if task.finished.is_set():
            return
        self._compile(scene, task)
        self._team.is_over = partial(self._is_unwanted, scene, task)
        if scene is not self._prepared:
            self._prepared = None  # stays None if preparing fails
            if self._engine is None:
                self._engine = self._new_engine(scene)
            else:
                self._engine.set_scene(scene)
            self._prepared = scene
        self._team.is_over = None  # a running image's own control cancels it
        task.run(self._engine)

    def _new_engine(self, scene: Scene) -> Any:
        """Return the scene prepared for this worker's method. Imports numba."""
        if self._method == "reference":
            from .reference_engine import ReferenceEngine

            return ReferenceEngine(scene, self._team)
        from .tiles.engine import PacketEngine

        return PacketEngine(scene, self._team, *self._effects)

    def _compile(self, scene: Scene, task: Work) -> None:
        """Compile the parts that a task needs, in other processes, and load them."""
        from .precompile import precompile

        parts = parts_of(self._method, any(self._effects), scene, task)
        new = [part for part in parts if part not in self._compiled]
        if not new:
            return
        self.is_compiling = True
        try:
            precompile(new, lambda: self._closed)
            for part in new:
                if self._closed:
                    raise AbandonedError
                compile_part(part)
                self._compiled.add(part)
        finally:
            self.is_compiling = False

    def _is_unwanted(self, scene: Scene, task: Work) -> bool:
        """Return True if another scene was requested since, so that this one is not needed."""
        return self._closed or (task.finished.is_set() and self._newest is not scene)


# Threads must leave their kernels before the interpreter frees the memory.
_workers: weakref.WeakSet[Worker] = weakref.WeakSet()


@atexit.register
def _end_all() -> None:
    workers = [worker for worker in _workers if worker.pid == os.getpid()]
    for worker in workers:
        worker.close()
    for worker in workers:
        with contextlib.suppress(KeyboardInterrupt):
            worker.join()
