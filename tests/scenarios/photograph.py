"""A photograph over the images: opened, laid over and behind, followed, compared with, closed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image
from window_driver import RASTER, Driver

from app.pair.view import RasterView
from app.photograph.layer import PhotographLayer
from app.state.app_state import AppState
from app.storage.paths import restored


def layer(d: Driver) -> PhotographLayer:
    found = d.window.views[RASTER]
    assert isinstance(found, RasterView)
    return found.linked.photograph


def laid(d: Driver, **changes: object) -> AppState:
    return d.window.state.with_options(photograph=changes)


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
    d.settle()


def drive_a_photograph_that_was_dropped_is_laid_over_both_images(d: Driver) -> None:
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
    d.window.change(laid(d, opacity=1.0))
    d.settle()
    for after in d.images():
        assert np.array_equal(after, pixels)
    d.window.change(laid(d, shown=False))
    d.settle()
    for before, after in zip(bare, d.images(), strict=True):
        assert np.array_equal(after, before)
