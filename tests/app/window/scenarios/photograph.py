"""A photograph over the images: opened, laid over, followed, compared with, closed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from option_changes import with_options
from PIL import Image
from window_driver import Driver, Key

from lucida.app.images.pair.view import RasterView
from lucida.app.images.photograph.actions import PHOTOGRAPH, UNDISTORT
from lucida.app.images.photograph.layer import PhotographLayer
from lucida.app.images.photograph.model import closed
from lucida.app.state.app_state import AppState
from lucida.app.state.paths import restored
from lucida.renderer.camera.lenses import Lens


def layer(d: Driver) -> PhotographLayer:
    return d.window.view(RasterView).linked.photograph


def laid(d: Driver, **changes: object) -> AppState:
    return with_options(d.state, photograph=changes)


def saved(d: Driver, pixels: np.ndarray, name: str = "photo.png") -> Path:
    path = d.folder / name
    Image.fromarray(pixels).save(path)
    return path


def noise(d: Driver) -> np.ndarray:
    """As many pixels as the images have, each of another colour."""
    width, height = d.renderers.size
    return np.random.default_rng(1).integers(0, 256, (height, width, 3), dtype=np.uint8)


def opened(d: Driver, path: Path) -> None:
    d.drop([str(path)])
    d.until(lambda: restored(d.state.options.photograph.file) == str(path))
    d.frames(2)
    d.window.shell.toasts.clear()  # one of them is in an image's place
    d.settle()


def drive_a_photograph_is_dropped_and_laid_over_both_images(d):
    d.window.change(d.state.with_fit(False))
    d.settle()
    bare, pixels = d.images(), noise(d)
    camera = d.state.camera
    opened(d, saved(d, pixels))
    assert d.state.camera == camera and d.state.scene is d.start.scene
    for before, after in zip(bare, d.images(), strict=True):
        assert before.shape == pixels.shape
        assert np.abs(after - (before + pixels.astype(int)) / 2).max() <= 1
    verdict = d.renderers.verdict(d.state)
    assert not verdict.comparison.unexplained
    for changes, wanted in (
        ({"opacity": 1.0}, (pixels, pixels)),
        ({"shown": False}, bare),
    ):
        d.window.change(laid(d, **{"shown": True, **changes}))
        d.settle()
        for seen, after in zip(wanted, d.images(), strict=True):
            assert np.array_equal(after, seen)


def drive_it_is_switched_with_a_key_undone_and_closed(d):
    steps = d.steps
    opened(d, saved(d, np.full((30, 40, 3), 200, np.uint8)))
    assert d.steps == steps + 1
    d.press(Key.mod_alt | Key.p)
    assert not d.state.options.photograph.shown
    d.press(Key.mod_alt | Key.p)
    assert d.state.options.photograph.shown
    d.window.change(closed(d.state))
    d.settle()
    assert layer(d).file_size == (0, 0)  # it is not held any more
    d.window.undo()
    d.settle()
    assert layer(d).file_size == (40, 30)
    d.click("//Raster/**/##photograph")
    d.click("//$FOCUSED/Images of its size, 40 x 30")
    d.settle()
    assert d.renderers.size == (40, 30)


def drive_a_photograph_through_a_lens_lines_up_and_is_undistorted(d):
    state = d.state.with_fit(False)
    camera = replace(state.camera, lens=Lens("brown", {"k1": -0.2, "p1": 0.01}))
    d.window.change(state.with_camera(camera))
    d.settle()
    _, taken = d.images()
    opened(d, saved(d, taken.astype(np.uint8)))
    d.window.change(laid(d, opacity=1.0))
    d.settle()
    for after in d.images():  # of the raster image, too: it is laid pixel by pixel
        assert np.array_equal(after, taken)
    undistort = next(action for action in PHOTOGRAPH if action.name == UNDISTORT)
    undistort.run(d.window)
    d.settle()
    assert d.state.camera.lens is None
    _, flat = d.images()
    d.window.change(laid(d, shown=False))
    d.settle()
    _, pinhole = d.images()
    off = np.abs(flat.astype(int) - pinhole).max(axis=2)
    assert np.median(off) <= 1 and (off > 40).mean() < 0.05  # but for interpolated outlines
    across = np.abs(flat[:, 2:].astype(int) - pinhole[:, :-2]).max(axis=2)
    assert (across > 40).mean() > 2 * (off > 40).mean()  # two pixels aside, it would not line up
    undistort.run(d.window)
    d.settle()
    assert d.state.camera == camera
