"""A photograph over the images: opened, laid over, followed, compared with, closed."""

import numpy as np
from option_changes import with_options
from PIL import Image
from window_driver import SIZE, Key

from lucida.app.images.pair.view import RasterView, RayView
from lucida.app.images.photograph.model import closed
from lucida.app.state.paths import restored


def layers(d):
    return [d.window.view(kind).photograph for kind in (RasterView, RayView)]


def held(layer):
    return layer._photograph is not None


def laid(d, **changes):
    return with_options(d.state, photograph=changes)


def saved(d, pixels, name="photo.png"):
    path = d.folder / name
    Image.fromarray(pixels).save(path)
    return path


def noise(d):
    """As many pixels as the images have, each of another colour."""
    width, height = d.renderers.size
    return np.random.default_rng(1).integers(0, 256, (height, width, 3), dtype=np.uint8)


def opened(d, path):
    d.drop([str(path)])
    d.until(lambda: restored(d.options.photograph.file) == str(path))
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
    assert not d.options.photograph.shown
    d.press(Key.mod_alt | Key.p)
    assert d.options.photograph.shown
    d.window.change(closed(d.state))
    d.settle()
    assert not any(map(held, layers(d)))
    d.undo()
    d.settle()
    assert all(map(held, layers(d)))


def drive_nothing_is_drawn_anew_while_nothing_changes(d):
    opened(d, saved(d, noise(d)))
    d.ctx.mouse_teleport_to_pos((3, SIZE[1] - 3))
    d.settle()
    uploads = [d.window.views[name]._uploads for name in ("Raster", "Ray")]
    before = [one.get("photograph") for one in uploads]
    d.frames(6)
    assert None not in before
    assert [one.get("photograph") for one in uploads] == before
