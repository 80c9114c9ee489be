"""Kernels compiled by other processes, and batches of rays that wait for them."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from renderer import compile_note
from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.scene import BUILTIN_SCENES, load_scene
from renderer.scene.model import Scene
from renderer.trace import Tracer
from renderer.trace.jobs import compile_child, precompile, ray_kernels
from renderer.trace.jobs.compile_child import compile_part, is_copied
from renderer.trace.jobs.precompile import part_of_rays
from renderer.trace.packets.kernel import trace_packets
from renderer.trace.rays import query

PATIENT_S = 60.0
RAYS = np.full((2, 3), (0.0, 9.0, 0.0)), np.array([[0, 1, 0], [0, -1, 0]], np.float32)


class SlowCompilation:
    """The compilation of a kernel, which ends when a test says so."""

    def __init__(self) -> None:
        self.asked, self.over, self.ended = threading.Event(), threading.Event(), False
        self.parts: list[tuple[str, ...]] = []

    def __call__(self, parts: tuple[str, ...]) -> SlowCompilation:
        self.parts.append(parts)
        return self

    def is_over(self) -> bool:
        self.asked.set()
        return self.over.is_set()

    def end(self) -> None:
        self.ended = True


@pytest.fixture
def compilation(monkeypatch) -> SlowCompilation:
    slow = SlowCompilation()
    monkeypatch.setattr(ray_kernels, "Precompilation", slow)
    return slow


class Asked(threading.Thread):
    """Asks a Tracer for the closest hits."""

    def __init__(self, tracer: Tracer) -> None:
        super().__init__(daemon=True)
        self._tracer = tracer
        self.primitives: np.ndarray | None = None
        self.error: LucidaError | None = None
        self.start()

    def run(self) -> None:
        try:
            self.primitives = self._tracer.closest_hits(*RAYS)[1]
        except LucidaError as error:
            self.error = error


def test_images_do_not_wait_for_the_kernels_of_rays(compilation: SlowCompilation) -> None:
    with Tracer(load_scene(BUILTIN_SCENES[0])) as tracer:
        asked = Asked(tracer)
        assert compilation.asked.wait(PATIENT_S)
        assert tracer.render(Camera(), (8, 8)).complete
        tracer.set_scene(Scene(()))
        assert (tracer.render(Camera(), (8, 8), ("id",)).id == -1).all()
        assert asked.is_alive()
        compilation.over.set()
        asked.join(PATIENT_S)
        assert asked.primitives is not None
        assert (asked.primitives >= 0).tolist() == [False, True]  # in the scene when it was asked
        assert (tracer.render(Camera(), (8, 8), ("id",)).id == -1).all()
    assert compilation.parts == [("rays-closest_hits-float64",)]


def test_a_closed_tracer_ends_waiting_batches(compilation: SlowCompilation) -> None:
    with Tracer(Scene(())) as tracer:
        asked = Asked(tracer)
        assert compilation.asked.wait(PATIENT_S)
    asked.join(PATIENT_S)
    assert asked.error is not None
    assert asked.error.field == "tracer"
    assert compilation.ended


@pytest.mark.parametrize("origins", ["float32", "float64"])
def test_precompiled_ray_kernels_serve_every_scene(origins: str) -> None:
    for method in ("closest_hits", "any_hits"):
        compile_part(part_of_rays(method, origins))
    before = len(query._closest.signatures), len(query._any.signatures)
    for name in BUILTIN_SCENES[:3]:
        with Tracer(load_scene(name)) as tracer:
            start, way = np.zeros((40, 3), origins), np.ones((40, 3), np.float32)
            tracer.closest_hits(start, way)
            tracer.any_hits(start, way, 0.5, 2.0)
            start.setflags(write=False)  # as a Camera's are
            tracer.closest_hits(start, way)
    assert (len(query._closest.signatures), len(query._any.signatures)) == before


def test_a_tracer_finds_its_kernels_in_the_cache() -> None:
    with Tracer(Scene(())) as tracer:
        tracer.render(Camera(), (8, 8))
    if precompile.cache_folder() is not None and precompile.default_threads() > 1:
        assert not sum(trace_packets.stats.cache_misses.values())


class Children:
    """Replaces the compiling processes. Each ends with the status that a test sends."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, folder: Path) -> None:
        self.started: list[subprocess.Popen[bytes]] = []
        monkeypatch.setattr(precompile, "cache_folder", lambda: folder)
        monkeypatch.setattr(precompile, "default_threads", lambda: 2)
        monkeypatch.setattr(precompile, "start_child", self.start)
        monkeypatch.setattr(precompile, "_found", set())
        monkeypatch.setattr(precompile.compile_note, "begin", lambda kept: None)

    def start(self, *arguments: str) -> subprocess.Popen[bytes]:
        child = subprocess.Popen([sys.executable, "-c", "exit(int(input()))"], stdin=-1)
        self.started.append(child)
        return child

    def end(self, status: int) -> None:
        child = self.started[-1]
        assert child.stdin is not None
        child.stdin.write(f"{status}\n".encode())
        child.stdin.flush()
        child.wait(PATIENT_S)


@pytest.fixture
def children(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Children]:
    children = Children(monkeypatch, tmp_path)
    yield children
    for child in children.started:
        child.kill()
        child.communicate()


@pytest.mark.parametrize("status", [0, 1])
def test_a_part_is_marked_when_its_process_succeeds(
    children: Children, tmp_path: Path, status: int
) -> None:
    compilation = precompile.Precompilation(("a-part",))
    assert not compilation.is_over()
    children.end(status)
    assert compilation.is_over()
    assert len(list(tmp_path.glob("*.done"))) == (status == 0)
    assert precompile.Precompilation(("a-part",)).is_over() == (status == 0)


def test_a_compilation_that_takes_too_long_is_killed(
    children: Children, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(precompile, "LIMIT_S", -1.0)
    assert precompile.Precompilation(("a-part",)).is_over()
    assert children.started[0].returncode is not None
    assert not list(tmp_path.iterdir())


def no_child(*arguments: str) -> None:
    raise OSError


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("interpreter", lambda: None),
        ("start_child", no_child),
        ("cache_folder", lambda: None),
        ("default_threads", lambda: 1),
    ],
)
def test_without_processes_nothing_is_waited_for(
    children: Children, monkeypatch: pytest.MonkeyPatch, name: str, value: object
) -> None:
    monkeypatch.setattr(precompile, name, value)
    assert precompile.Precompilation(("a-part",)).is_over()
    assert not children.started


def test_closing_a_tracer_ends_the_compiling_processes(children: Children) -> None:
    tracer = Tracer(Scene(()))
    job = tracer.start(Camera(), (5, 5))
    end_s = time.monotonic() + PATIENT_S
    while not children.started and time.monotonic() < end_s:
        time.sleep(0.01)
    tracer.close()
    assert not job.result().complete
    assert children.started
    assert all(child.returncode is not None for child in children.started)


@pytest.mark.parametrize("kept", [True, False])
def test_a_child_reports_a_cache_that_could_not_be_written(
    monkeypatch: pytest.MonkeyPatch, kept: bool
) -> None:
    def exit_(status: int) -> None:
        raise SystemExit(status)

    monkeypatch.setattr(compile_note, "_note", "")
    monkeypatch.setattr(compile_child, "end_with_parent", lambda: None)
    monkeypatch.setattr(compile_child.gc, "disable", lambda: None)
    monkeypatch.setattr(compile_child, "compile_part", lambda part: compile_note.begin(kept))
    monkeypatch.setattr(compile_child.os, "_exit", exit_)
    with pytest.raises(SystemExit) as ended:
        compile_child.main("trees")
    assert ended.value.code == int(not kept)


COPIED = """
import os, time
from renderer.child import interpreter, start_child
child = start_child(interpreter(), "renderer.trace.jobs.compile_child", "walk", "trees", "write")
def copies():
    with open(f"/proc/{child.pid}/task/{child.pid}/children") as file:
        return len(file.read().split())
while copies() < 3: time.sleep(0.01)
print(child.pid)
"""


@pytest.mark.skipif(not is_copied(), reason="each part has a process of its own")
def test_copies_of_a_compiling_process_end_with_its_parent(tmp_path: Path) -> None:
    env = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-c", COPIED], env=env, capture_output=True, text=True, timeout=PATIENT_S
    )
    assert done.returncode == 0, done.stderr
    end_s = time.monotonic() + PATIENT_S
    while time.monotonic() < end_s:
        try:
            os.killpg(int(done.stdout), 0)
        except ProcessLookupError:
            return
        time.sleep(0.02)
    raise AssertionError("some are still there")
