"""Kernels compiled by other processes."""

from __future__ import annotations

import dataclasses
import os
import subprocess
import sys

import numpy as np
import pytest
from numba.core import event
from textured import noise, on_ball
from waiting import is_running, wait_for

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.files import BUILTIN_SCENES, load_scene
from lucida.renderer.images.frame import CHANNELS
from lucida.renderer.scene.model import Scene
from lucida.renderer.scene.texture import Texture
from lucida.renderer.trace import Tracer, compile_child, precompile
from lucida.renderer.trace.compile import compiled
from lucida.renderer.trace.compile_child import can_fork

LENS = Camera(lens=Lens("equidistant"))
STILL_LIFE = load_scene(BUILTIN_SCENES[0])
TEXTURED = on_ball(Texture(noise(9, 6), ("repeat", "clamp")))
TASKS = [
    ({}, STILL_LIFE, Camera()),
    ({}, TEXTURED, Camera()),
    ({"shadows": True, "mirror_depth": 2}, STILL_LIFE, Camera()),
    ({}, STILL_LIFE, LENS),
    ({"shadows": True}, TEXTURED, LENS),
    ({"method": "reference"}, TEXTURED, LENS),
    ({}, STILL_LIFE, None),
]


@pytest.mark.parametrize(("options", "scene", "camera"), TASKS)
def test_nothing_is_compiled_beyond_the_parts_of_a_task(options, scene, camera):
    def work(tracer):
        if camera is not None:
            tracer.render(camera, (8, 8), CHANNELS)
            return
        for dtype in (np.float32, np.float64):
            start, way = np.zeros((40, 3), dtype), np.ones((40, 3), dtype)
            tracer.closest_hits(start, way)
            start.setflags(write=False)  # as a Camera's are
            tracer.closest_hits(start, way, 0.5, 2.0)

    with Tracer(Scene(()), **options) as tracer:  # has the parts, or compiles them
        tracer.set_scene(dataclasses.replace(scene, objects=scene.objects[:1]))
        work(tracer)
    with Tracer(scene, **options) as tracer, event.install_recorder("numba:compile") as compiled:
        work(tracer)
    assert not compiled.buffer


class Children:
    """Replaces the compiling processes. Each ends with a status at once, or never (None)."""

    def __init__(self, monkeypatch, folder):
        self.status: int | None = None
        self.started: list[subprocess.Popen[bytes]] = []
        self.notes: list[bool] = []
        monkeypatch.setattr(precompile, "cache_folder", lambda: folder)
        monkeypatch.setattr(precompile, "default_threads", lambda: 2)
        monkeypatch.setattr(precompile, "start_child", self.start)
        monkeypatch.setattr(precompile.compile_note, "begin", lambda kept: self.notes.append(kept))

    def start(self, *arguments):
        code = "input()" if self.status is None else f"exit({self.status})"
        child = subprocess.Popen([sys.executable, "-c", code], stdin=subprocess.PIPE)
        self.started.append(child)
        return child


@pytest.fixture
def children(monkeypatch, tmp_path):
    children = Children(monkeypatch, tmp_path)
    yield children
    for child in children.started:
        child.kill()
        child.communicate()


@pytest.mark.parametrize("status", [0, 1])
def test_a_part_is_marked_when_its_process_succeeds(children, tmp_path, status):
    children.status = status
    precompile.precompile(["a-part"], lambda: False)
    assert len(list(tmp_path.glob("*.done"))) == (status == 0)
    precompile.precompile(["a-part"], lambda: False)
    assert len(children.started) == (1 if status == 0 else 2)
    assert children.notes == [True] * len(children.started)


def no_child(*arguments):
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
def test_without_processes_nothing_is_waited_for(children, monkeypatch, name, value):
    monkeypatch.setattr(precompile, name, value)
    precompile.precompile(["a-part"], lambda: False)
    assert not children.started
    assert children.notes == [name != "cache_folder"]


def test_closing_a_tracer_ends_the_compiling_processes(children, monkeypatch):
    monkeypatch.setattr(precompile.compile_note, "_progress", "")
    tracer = Tracer(Scene(()))
    job = tracer.start(Camera(), (5, 5))
    wait_for(precompile.compile_note.progress)
    assert tracer.is_compiling
    assert precompile.compile_note.progress().startswith("0 of ")
    tracer.close()
    assert not job.result().complete
    assert children.started
    assert all(child.returncode is not None for child in children.started)


@pytest.mark.parametrize("is_kept", [True, False])
def test_a_child_reports_a_cache_that_could_not_be_written(monkeypatch, is_kept):
    def exit_(status):
        raise SystemExit(status)

    monkeypatch.setattr(compile_child, "end_with_parent", lambda: None)
    monkeypatch.setattr(compile_child.gc, "disable", lambda: None)
    monkeypatch.setattr(compile_child, "compile_part", lambda part: None)
    monkeypatch.setattr(compiled, "is_cached", lambda: is_kept)
    monkeypatch.setattr(compile_child.os, "_exit", exit_)
    with pytest.raises(SystemExit) as ended:
        compile_child.main("trees")
    assert ended.value.code == int(not is_kept)


COPIED = """
import psutil, time
from lucida.renderer.system.child import interpreter, start_child
parts = "walk-plain", "trees"
child = start_child(interpreter(), "lucida.renderer.trace.compile_child", *parts)
process = psutil.Process(child.pid)
while not (copies := process.children()): time.sleep(0.01)
print(child.pid, *(copy.pid for copy in copies))
"""


@pytest.mark.skipif(not can_fork(), reason="each part has a process of its own")
def test_copies_of_a_compiling_process_end_with_its_parent(tmp_path):
    env = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    done = subprocess.run([sys.executable, "-c", COPIED], env=env, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    processes = [int(word) for word in done.stdout.split()]
    wait_for(lambda: not any(map(is_running, processes)))
