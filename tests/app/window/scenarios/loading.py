"""Large models: read in a process of their own, which no frame waits for, and which is ended."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
from window_driver import Driver, Key, changed

from lucida.app.ui.messages import SHOWN_AFTER_S
from lucida.app.window.files import Files
from lucida.renderer.files.models import subprocess_reader as apart

FRAMES = 40
# Reads as the usual process does, once it may.
PATIENT_READER = """
import os, time
from pathlib import Path
from lucida.renderer.files.models import subprocess_reader as apart
read = apart.read_model

def wait(path):
    while not Path(path).with_suffix(".gate").exists():
        time.sleep(0.01)
    return read(path)

apart.read_model, main = wait, apart.main
"""


def wavy(path: Path, side: int = 150) -> Path:
    """A model of side x side vertices, more than is read in the window's own process."""
    u, v = np.meshgrid(*[np.linspace(-1, 1, side)] * 2)
    number = np.arange(side * side).reshape(side, side) + 1
    a, b, c, d = (n.ravel() for n in (number[1:, :-1], number[1:, 1:], number[:-1, 1:],
                                      number[:-1, :-1]))  # fmt: skip
    with path.open("w") as file:
        height = np.sin(5 * u) * np.cos(4 * v) / 5
        np.savetxt(file, np.stack([u, height, v], -1).reshape(-1, 3), "v %.9f %.9f %.9f")
        np.savetxt(file, np.stack([a, b, c, d], 1), "f %d %d %d %d")
    assert apart.is_large(path)
    return path


class Patiently:
    """Inside it, models are read once there is a file beside them that ends in .gate; and none in
    this process."""

    def __init__(self, folder: Path) -> None:
        own = folder / "patient"  # not the current folder, from which children take no modules
        own.mkdir(exist_ok=True)
        (own / "patient_reader.py").write_text(PATIENT_READER)
        self.folder = str(own)

    def __enter__(self) -> None:
        self.kept = apart.start_child, apart.read_model
        start = apart.start_child
        sys.path.append(self.folder)

        def start_child(
            python: str, module: str, *arguments: str, output: bool
        ) -> subprocess.Popen:
            return start(python, "patient_reader", *arguments, output=output)

        apart.start_child, apart.read_model = start_child, None  # type: ignore

    def __exit__(self, *_: object) -> None:
        apart.start_child, apart.read_model = self.kept
        sys.path.remove(self.folder)


def process_of(files: Files) -> subprocess.Popen | None:
    return files.models.process


def open_patiently(d: Driver, path: Path) -> subprocess.Popen:
    """Opens a model; gives the process that reads it."""
    files = d.window.files
    d.window.open(str(path))
    d.until(lambda: process_of(files) is not None)
    process = process_of(files)
    assert process is not None
    return process


def drive_frames_go_on_while_a_large_model_is_read(d: Driver) -> None:
    window, path = d.window, wavy(d.folder / "wavy.obj")
    with Patiently(d.folder):
        process = open_patiently(d, path)
        before = d.images()[0]
        d.ctx.yield_(FRAMES)
        d.drag_field("eye.x", 30)
        d.until(lambda: not window.renderers.textures.unfinished)
        assert changed(before, d.images()[0]) > 0.05
        assert window.files.loading == "wavy.obj"
        assert process.poll() is None
        d.until(lambda: window.files.loading_s > SHOWN_AFTER_S)
        d.ctx.yield_(3)
        d.picture()
        path.with_suffix(".gate").touch()
        d.until(lambda: window.state.scene.name == "wavy")
    assert process.returncode is not None
    d.agreeing_images()


def drive_cancelling_ends_the_process_that_reads(d: Driver) -> None:
    window, path = d.window, wavy(d.folder / "never.obj")
    with Patiently(d.folder):
        process = open_patiently(d, path)
        d.until(lambda: window.files.loading_s > SHOWN_AFTER_S)
        d.ctx.yield_(3)
        d.ctx.item_click("//##loading/Cancel")
        d.until(lambda: process.returncode is not None)
        assert not window.files.busy
        assert process_of(window.files) is None
        again = open_patiently(d, path)  # nothing is left of the first
        d.ctx.key_press(int(Key.escape))
        d.until(lambda: again.returncode is not None)
    d.ctx.yield_(3)
    d.picture()
    assert window.state == d.start
    assert window.files.message == ""
    window.shell.toasts.clear()  # they lie over an image
    window.open("spheres")
    d.until(lambda: window.state.scene.name == "spheres")
    d.agreeing_images()


def drive_a_scene_taken_back_is_drawn_without_being_prepared_again(d: Driver) -> None:
    window, path = d.window, wavy(d.folder / "twice.obj")
    window.open(str(path))
    d.until(lambda: window.state.scene.name == "twice")
    d.settle()
    opened = window.state.scene
    window.undo()
    d.settle()
    textures = window.renderers.textures
    assert textures is not None
    rasterizer = textures.rasterizer.of(window.state.scene)
    taken: list[bool] = []
    good = rasterizer.set_scene

    def set_scene(scene: object, prepared: object = None) -> None:
        taken.append(scene is opened and prepared is not None)
        good(scene, prepared)  # type: ignore[arg-type]

    rasterizer.set_scene = set_scene  # type: ignore[method-assign]
    window.redo()
    d.settle()
    del rasterizer.set_scene
    assert taken == [True]
    d.agreeing_images()
