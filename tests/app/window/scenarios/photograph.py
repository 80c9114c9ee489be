"""A photograph over the images: opened, laid over, followed, compared with, closed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from option_changes import with_options
from PIL import Image
from window_driver import SIZE, Driver, Key

from lucida.app.images.pair.view import RasterView
from lucida.app.images.photograph.actions import PHOTOGRAPH, UNDISTORT
from lucida.app.images.photograph.layer import PhotographLayer
from lucida.app.images.photograph.model import closed
from lucida.app.images.renderers import Renderers
from lucida.app.state.app_state import AppState
from lucida.app.state.paths import restored
from lucida.renderer.camera.lenses import Lens


def layer(d: Driver) -> PhotographLayer:
    return d.window.view(RasterView).linked.photograph


def laid(d: Driver, **changes: object) -> AppState:
    return with_options(d.window.state, photograph=changes)


def saved(d: Driver, pixels: np.ndarray, name: str = "photo.png") -> Path:
    path = d.folder / name
    Image.fromarray(pixels).save(path)
    return path


def noise(d: Driver) -> np.ndarray:
    """As many pixels as the images have, each of another colour."""
    width, height = d.window.renderers.size
    return np.random.default_rng(1).integers(0, 256, (height, width, 3), dtype=np.uint8)


def opened(d: Driver, path: Path) -> None:
    d.drop([str(path)])
    d.until(lambda: restored(d.window.state.options.photograph.file) == str(path))
    d.ctx.yield_(2)
    d.window.shell.toasts.clear()  # one of them is in an image's place
    d.settle()


def drive_a_photograph_is_dropped_and_laid_over_both_images(d: Driver) -> None:
    d.window.change(d.window.state.with_fit(False))
    d.settle()
    bare, pixels = d.images(), noise(d)
    camera = d.window.state.camera
    opened(d, saved(d, pixels))
    assert d.window.state.camera == camera and d.window.state.scene is d.start.scene
    for before, after in zip(bare, d.images(), strict=True):
        assert before.shape == pixels.shape
        assert np.abs(after - (before + pixels.astype(int)) / 2).max() <= 1
    verdict = d.window.renderers.verdict(d.window.state)
    assert verdict is not None and not verdict.comparison.unexplained
    for changes, wanted in (
        ({"opacity": 1.0}, (pixels, pixels)),
        ({"shown": False}, bare),
    ):
        d.window.change(laid(d, **{"shown": True, **changes}))
        d.settle()
        for seen, after in zip(wanted, d.images(), strict=True):
            assert np.array_equal(after, seen)


def drive_it_is_switched_with_a_key_undone_and_closed(d: Driver) -> None:
    steps = len(d.window.history.past)
    opened(d, saved(d, np.full((30, 40, 3), 200, np.uint8)))
    assert len(d.window.history.past) == steps + 1
    d.press(int(Key.mod_alt) | int(Key.p))
    assert not d.window.state.options.photograph.shown
    d.press(int(Key.mod_alt) | int(Key.p))
    assert d.window.state.options.photograph.shown
    d.window.change(closed(d.window.state))
    d.settle()
    assert layer(d).file_size == (0, 0)  # it is not held any more
    d.window.undo()
    d.settle()
    assert layer(d).file_size == (40, 30)
    d.ctx.item_click("//Raster/**/##photograph")
    d.ctx.yield_(3)
    d.ctx.item_click("//$FOCUSED/Images of its size, 40 x 30")
    d.settle()
    assert d.window.renderers.size == (40, 30)


def drive_nothing_is_drawn_anew_while_nothing_changes(d: Driver) -> None:
    opened(d, saved(d, noise(d)))
    d.ctx.mouse_teleport_to_pos((3, SIZE[1] - 3))
    d.settle()
    made: dict[object, list[object]] = {}
    of, over = layer(d), layer(d).over

    def seen(both: Renderers, state: AppState, name: str, *rest: Any) -> Any:
        picture = over(both, state, name, *rest)
        made.setdefault(name, []).append(picture and picture.made)
        return picture

    of.over = seen  # type: ignore[method-assign]
    try:
        d.ctx.yield_(20)
    finally:
        of.over = over  # type: ignore[method-assign]
    assert len(made) == 2
    for pictures in made.values():  # each drawing has another one
        assert len(pictures) > 10 and all(one is pictures[0] for one in pictures)


def drive_a_photograph_through_a_lens_lines_up_and_is_undistorted(d: Driver) -> None:
    state = d.window.state.with_fit(False)
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
    assert d.window.state.camera.lens is None
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
    assert d.window.state.camera == camera
