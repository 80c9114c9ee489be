"""A Tracer's own thread: it prepares the scene, then traces one task after another.

Manages that thread and its team, and ends them when the Tracer is closed or dropped, or the
interpreter exits. Everything slow happens here: importing numba, compiling, building the BVH.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import queue
import threading
import weakref
from functools import partial
from typing import TYPE_CHECKING, Any

from renderer.child import check_not_forked
from renderer.errors import LucidaError
from renderer.scene.model import Scene, has_metals, has_textures
from renderer.trace.compile.gc_pause import no_full_collections
from renderer.trace.jobs.image_job import Task
from renderer.trace.jobs.ray_batch import RayBatch
from renderer.trace.threads.thread_pool import AbandonedError, Team

if TYPE_CHECKING:
    from renderer.trace.jobs.ray_kernels import RayKernels

Work = Task | RayBatch
_POLL_S = 0.02  # while other processes compile kernels

_imported_pid = os.getpid()


class Worker:
    """Runs tasks in the order of their submission, on a thread that starts with the first."""

    def __init__(self, threads: int, method: str, shadows: bool, mirror_depth: int) -> None:
        self._threads, self._method = threads, method
        self._effects = shadows, mirror_depth
        self._queue: queue.SimpleQueue[tuple[Scene, Work] | None] = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._tasks: weakref.WeakSet[Work] = weakref.WeakSet()
        self._current: Work | None = None
        self._newest: Scene | None = None  # of the last task
        self._thread: threading.Thread | None = None
        self._pid = os.getpid()  # the thread's
        self._closed = False
        self._compiled: set[str] = set()  # of parts_of() that are compiled
        self._rays: RayKernels | None = None  # created with the engine

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
                self._pid = os.getpid()
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
        current = self._current
        if current is not None:
            current.stop()

    def join(self) -> None:
        """Wait for the thread to end."""
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join()

    def _check_process(self) -> None:
        if self._thread is not None:
            check_not_forked(self._pid, "tracer", "has begun its work")
        elif os.getpid() != _imported_pid:
            for worker in list(_workers):
                if worker._current is not None:
                    check_not_forked(worker._pid, "tracer", "another one was at work")

    def _serve(self) -> None:
        team = Team(self._threads)
        engine = prepared = None
        while (item := self._take()) is not None:
            scene, task = item
            self._current = task
            team.is_over = partial(self._is_unwanted, scene, task)
            if self._closed:
                task.cancel()
            try:
                if scene is not prepared and not task.finished.is_set():
                    prepared = None  # stays None if preparing fails
                    if engine is None:
                        with no_full_collections():
                            engine = self._new_engine(scene, team)
                    else:
                        self._compile_more(scene, task)
                        engine.set_scene(scene)
                    prepared = scene
                team.is_over = None  # a running image is cancelled by its own control
                if engine is not None and self._rays is not None:
                    if not self._rays.keeps(scene, task):
                        self._compile_more(scene, task)
                        task.run(engine)
                elif self._closed:
                    task.cancel()
            except AbandonedError:
                task.cancel()
            except MemoryError:
                task.fail(LucidaError("scene", "exceeds the memory", "use a smaller model"))
            except BaseException as error:
                task.fail(error)
            team.is_over = None
            del item, task  # frees their buffers while waiting for the next task
            self._current = None
        if self._rays is not None:
            self._rays.end()
        team.close()

    def _take(self) -> tuple[Scene, Work] | None:
        """Return the next task, with its scene; None if there will be no more."""
        while self._rays is not None and self._rays.waiting:
            if (ready := self._rays.take_ready()) is not None:
                return ready
            with contextlib.suppress(queue.Empty):
                return self._queue.get(timeout=_POLL_S)
        return self._queue.get()

    def _is_unwanted(self, scene: Scene, task: Work) -> bool:
        """Return True if preparing a scene for a task is useless: another scene was requested
        since.
        """
        return self._closed or (task.finished.is_set() and self._newest is not scene)

    def _new_engine(self, scene: Scene, team: Team) -> Any:
        """Return the engine (engine.py) for a scene; None if this is closed while kernels are
        compiled.
        """
        from renderer.trace.jobs.precompile import Precompilation, parts_of  # imports LLVM
        from renderer.trace.jobs.ray_kernels import RayKernels

        self._rays = RayKernels()
        self._compiled.add(images_of(scene))
        compilation = Precompilation(parts_of(self._method, *self._effects, images_of(scene)))
        try:
            # This imports numba.
            from renderer.trace.jobs.engine import new_engine

            compilation.wait(lambda: self._closed)
        finally:
            compilation.end()
        if self._closed:
            return None
        return new_engine(scene, team, self._method, *self._effects)

    def _compile_more(self, scene: Scene, task: Work) -> None:
        """Compile, in other processes, the kernels for the first scene with textures or metals, and
        for the first camera with a lens.
        """
        has_lens = isinstance(task, Task) and task.camera.lens is not None
        variant = "-lens" * has_lens + images_of(scene)
        if variant in self._compiled or not variant or task.finished.is_set():
            return
        from renderer.trace.jobs.precompile import Precompilation, parts_of

        self._compiled.add(variant)
        compilation = Precompilation(parts_of(self._method, *self._effects, variant))
        compilation.wait(lambda: self._closed)


def images_of(scene: Scene) -> str:
    """Return the images of a scene, for parts_of()."""
    return "-metals" if has_metals(scene) else "-textures" * has_textures(scene)


# Threads must leave their kernels before the interpreter frees the memory.
_workers: weakref.WeakSet[Worker] = weakref.WeakSet()


@atexit.register
def _end_all() -> None:
    workers = [worker for worker in _workers if worker._pid == os.getpid()]
    for worker in workers:
        worker.close()
    for worker in workers:
        with contextlib.suppress(KeyboardInterrupt):
            worker.join()
