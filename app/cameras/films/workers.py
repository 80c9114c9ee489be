"""Pictures drawn by this process, by several on this machine, or on many machines (Dask).

Each worker is sent the scene once. A picture's result is its encoded file. A worker that dies loses
its pictures in progress; others draw them again.
"""

from __future__ import annotations

import logging
import os
from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from dataclasses import replace
from itertools import islice
from typing import Any

from lucida.renderer.raster.packages import installing
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import LucidaError

from .frames import Look, Shot, close_kept, draw_shot

PACKAGE = installing("av distributed")
AHEAD = 4  # pictures that each worker has been given
PATIENCE_S = 10

Pictures = Iterator[tuple[int, bytes]]


def drawn_here(scene: Scene, look: Look, shots: Mapping[int, Shot]) -> Pictures:
    """Yield each shot's number and picture, in order."""
    try:
        for number, shot in shots.items():
            yield number, draw_shot(scene, look, shot)
    finally:
        close_kept()


def drawn_by_workers(
    scene: Scene, look: Look, shots: Mapping[int, Shot], workers: int, scheduler: str = ""
) -> Pictures:
    """Yield each shot's number and picture, as they are finished.

    workers: the number of processes on this machine; with a scheduler's address, its workers are
    used instead. Raises LucidaError.
    """
    try:
        from dask.distributed import (
            CancelledError,
            Client,
            KilledWorker,
            LocalCluster,
            as_completed,
        )
    except ImportError:
        raise LucidaError("--workers", "needs the package distributed", PACKAGE) from None
    for name in ("distributed", "distributed.client"):  # the errors that they log are raised, too
        logging.getLogger(name).setLevel(logging.CRITICAL)
    with ExitStack() as opened:
        address: Any = scheduler
        field = "--scheduler" if scheduler else "--workers"
        if not scheduler:
            look = replace(look, threads=look.threads or max(1, (os.cpu_count() or 1) // workers))
            address = opened.enter_context(
                LocalCluster(
                    n_workers=workers,
                    threads_per_worker=1,
                    memory_limit=0,  # Dask's default limit pauses workers for good
                    dashboard_address=None,
                    silence_logs=50,
                )
            )
        try:
            client = opened.enter_context(Client(address, timeout=PATIENCE_S))
            client.wait_for_workers(1, timeout=PATIENCE_S)
        except (OSError, ValueError) as error:
            problem = f"{address!r} does not answer, or has no workers ({type(error).__name__})"
            remedy = "start `dask scheduler` there, and `dask worker` on a machine with Lucida"
            raise LucidaError(field, problem, remedy) from None
        sent = client.scatter(scene, broadcast=True, hash=False)
        waiting = iter(shots.items())
        numbers: dict[str, int] = {}
        running = as_completed(with_results=True, raise_errors=True)

        def give(count: int) -> None:
            for number, shot in islice(waiting, count):
                future = client.submit(draw_shot, sent, look, shot, pure=False, retries=3)
                numbers[future.key] = number
                running.add(future)

        give(AHEAD * max(1, len(client.scheduler_info()["workers"])))
        try:
            for future, content in running:
                if isinstance(content, CancelledError):
                    raise content
                give(1)
                yield numbers.pop(future.key), content
        except (CancelledError, KilledWorker, OSError) as error:
            problem = f"the workers were lost ({type(error).__name__})"
            remedy = "run the command again: it continues where it stopped"
            raise LucidaError(field, problem, remedy) from None
