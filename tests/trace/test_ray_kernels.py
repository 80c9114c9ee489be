"""Batches of rays whose kernels are not there yet: images do not wait for them."""

from __future__ import annotations

import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.scene import BUILTIN_SCENES, load_scene
from renderer.scene.model import Scene
from renderer.trace import Tracer
from renderer.trace.jobs import precompile, ray_kernels
from renderer.trace.jobs.compile_child import compile_part
from renderer.trace.jobs.precompile import part_of_rays
from renderer.trace.rays import query

PATIENT_S = 60.0
RAYS = np.full((2, 3), (0.0, 9.0, 0.0)), np.array([[0, 1, 0], [0, -1, 0]], np.float32)


class SlowCompilation:
    """Of a kernel that is there when a test says so."""

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


@pytest.fixture
def scene() -> Scene:
    return load_scene(BUILTIN_SCENES[0])


class Asked(threading.Thread):
    """Asks a Tracer for the closest hits, and keeps what it says."""

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


def test_images_come_meanwhile(scene: Scene, compilation: SlowCompilation) -> None:
    with Tracer(scene) as tracer:
        asked = Asked(tracer)
        assert compilation.asked.wait(PATIENT_S)
        assert tracer.render(Camera(), (8, 8)).complete
        tracer.set_scene(Scene(()))
        assert (tracer.render(Camera(), (8, 8), ("id",)).id == -1).all()
        assert asked.is_alive()
        compilation.over.set()
        asked.join(PATIENT_S)
        assert asked.primitives is not None
        assert (asked.primitives >= 0).tolist() == [False, True]  # of the scene that was asked
        assert (tracer.render(Camera(), (8, 8), ("id",)).id == -1).all()
    assert compilation.parts == [("rays-closest_hits-float64",)]


def test_a_closed_tracer_ends_what_waits(scene: Scene, compilation: SlowCompilation) -> None:
    with Tracer(scene) as tracer:
        asked = Asked(tracer)
        assert compilation.asked.wait(PATIENT_S)
    asked.join(PATIENT_S)
    assert asked.error is not None
    assert asked.error.field == "tracer"
    assert compilation.ended


@pytest.mark.parametrize("origins", ["float32", "float64"])
def test_what_is_compiled_is_what_every_scene_needs(origins: str) -> None:
    """Nothing is left for the tracer's thread to compile."""
    for method in ("closest_hits", "any_hits"):
        compile_part(part_of_rays(method, origins))
    before = len(query._closest.signatures), len(query._any.signatures)
    for name in BUILTIN_SCENES:
        with Tracer(load_scene(name)) as tracer:
            start, way = np.zeros((40, 3), origins), np.ones((40, 3), np.float32)
            tracer.closest_hits(start, way)
            tracer.any_hits(start, way, 0.5, 2.0)
            start.setflags(write=False)  # as a Camera's are
            tracer.closest_hits(start, way)
    assert (len(query._closest.signatures), len(query._any.signatures)) == before


class Children:
    """What compiling processes are replaced by: each ends with a status that a test sends."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, folder: Path) -> None:
        self.started: list[subprocess.Popen[bytes]] = []
        monkeypatch.setattr(precompile, "cache_folder", lambda: folder)
        monkeypatch.setattr(precompile, "default_threads", lambda: 2)
        monkeypatch.setattr(precompile, "start_child", self.start)
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


@pytest.mark.parametrize("status", [0, 1])
def test_a_compilation_is_over_when_its_process_is(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, status: int
) -> None:
    children = Children(monkeypatch, tmp_path)
    compilation = precompile.Precompilation((f"part-that-ends-with-{status}",))
    assert not compilation.is_over()
    children.end(status)
    assert compilation.is_over()
    assert len(list(tmp_path.glob("*.done"))) == (status == 0)


def test_a_compilation_that_takes_too_long_is_given_up(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    children = Children(monkeypatch, tmp_path)
    monkeypatch.setattr(precompile, "LIMIT_S", -1.0)
    assert precompile.Precompilation(("part-that-hangs",)).is_over()
    assert children.started[0].returncode is not None
    assert not list(tmp_path.iterdir())
