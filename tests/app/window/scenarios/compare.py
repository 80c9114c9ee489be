"""The compare view: false colours, wipe, counts, steps. The ray image is tampered with."""

from contextlib import contextmanager
from dataclasses import replace

import numpy as np
from window_driver import SIZE, Key

from lucida.app.images.compare import comparing
from lucida.app.images.compare.view import waiting
from lucida.app.images.progressive_ray import RayImage
from lucida.app.ui.theme import framebuffer_scale
from lucida.renderer.compare.raster_and_ray import LABEL_COLORS, SHADING
from lucida.renderer.images.difference import difference, false_color
from lucida.renderer.images.frame import Frame

NAME = "Compare"
WORST = (40, 60)
SHIFT = Key.mod_shift


def brightened(color):
    """A block that is brighter than it should be, and one pixel that is much brighter."""
    color[20:60, 30:90] += 0.05
    color[WORST] += 3.0


@contextmanager
def tampered(d, change):
    """As if the tracer had made a mistake, in full images only."""
    live, take = d.renderers.live, d.renderers.live.poll

    def poll():
        image = take()
        if image is None or image.factor > 1:
            return image
        color = image.frame.channel("color").copy()
        change(color)
        return replace(image, frame=replace(image.frame, color=color))

    live.poll = poll
    try:
        trace_again(d)
        yield
    finally:
        live.poll = take
        trace_again(d)


def trace_again(d):
    """Another camera, which differs by nothing that can be seen."""
    x, y, z = d.state.camera.eye
    camera = replace(d.state.camera, eye=(x + 1e-5, y, z))
    d.window.change(d.state.with_camera(camera))
    d.settle()


def show(d, **options):
    """The layout with the view in its middle, in some state of its options; a difference without
    marks, if they do not say."""
    d.change(compare={"mode": "absolute", "causes": False} | options)
    d.layout(NAME)


def shown(d):
    """The pixels of the view's image, int16, where they stand for the image's one to one."""
    if not d.stay:
        d.move_to((3, SIZE[1] - 3))
    screen, scale = d.window.views[NAME].screen, framebuffer_scale()
    window = d.picture()
    low, high = screen.visible
    box = [round(edge * scale) for edge in (low.x, low.y, high.x, high.y)]
    cut = window[box[1] : box[3], box[0] : box[2]].astype(np.int16)
    assert cut.shape[:2] == d.renderers.size[::-1], "not one to one"
    return cut


def comparison(d):
    verdict = d.renderers.verdict(d.state)
    return verdict.comparison


def pictures(d):
    """Both images as they must appear, uint8, from the numbers that were compared."""
    from lucida.renderer.images import to_srgb8

    both = comparison(d)
    return to_srgb8(both.raster.color), to_srgb8(both.ray.color)


def close(one, two, part=0.001):
    """Return True if two pictures are the same, up to rounding and labels over them."""
    return bool((np.abs(one - two.astype(np.int16)).max(axis=-1) > 2).mean() <= part)


def below_labels(image):
    """The part of a picture over which no label is written."""
    return image[60:]


def drive_a_wrong_block_is_shown_counted_marked_and_stepped_through(d):
    show(d)
    assert (shown(d).max(axis=2) > 40).mean() < 0.01, "a false alarm"
    with tampered(d, brightened):
        check_false_colours(d)
        check_causes(d)
        check_counts(d)
        check_steps(d)


def check_false_colours(d):
    show(d, gain=8.0)
    both = comparison(d)
    differing = difference(both.raster, both.ray)
    seen = shown(d)
    assert close(seen, false_color(differing, "color", 8.0))
    assert seen[45, 50].any() and not seen[80, 150].any()
    d.change(images={"channel": "depth"})
    d.settle()
    assert not shown(d)[45, 50].any(), "only the colour was changed"
    d.change(images={"channel": "color"})


def check_counts(d):
    both = comparison(d)
    counts = comparing.counts(both)
    assert counts[SHADING] >= 40 * 60 - 100
    assert counts[SHADING] == both.shading == (both.labels == SHADING).sum()
    count = len(d.window.history.past)
    d.click("//###Compare/###shading")
    assert d.state.marked is not None
    assert both.labels[d.state.marked] == SHADING
    d.settle()
    assert d.state.images.magnification == comparing.MARKED_MAGNIFICATION
    row, column = d.state.marked
    screen = d.window.views[NAME].screen
    low, high = screen.point(row, column), screen.point(row + 1, column + 1)
    pane_low, pane_high = screen.pane
    assert pane_low.x < low.x < high.x < pane_high.x, "it is in sight"
    assert pane_low.y < low.y < high.y < pane_high.y
    assert d.steps == count + 1
    d.undo()
    assert d.state.marked is None


def check_steps(d):
    both = comparison(d)
    first = comparing.next_differing(both, None)
    second = comparing.next_differing(both, first)
    for keys, expected in (
        (Key.n, first),
        (Key.n, second),
        (SHIFT | Key.n, first),
    ):
        d.press(keys)
        assert d.state.marked == expected
    for _ in range(3):
        d.undo()
    assert d.state.marked is None
    d.settle()


def check_causes(d):
    d.press(Key.k)
    d.settle()
    assert d.options.compare.causes
    assert (shown(d)[25:55, 35:55] == LABEL_COLORS[SHADING]).all()
    d.click("//###Compare/causes")
    assert not d.options.compare.causes
    assert (shown(d)[25:55, 35:55] != LABEL_COLORS[SHADING]).any(axis=2).all()


def drive_a_wipe_has_the_raster_image_first_and_the_ray_image_second(d):
    d.change(images={"resolution": (240, 160), "magnification": 1.0})
    show(d, mode="wipe", divider=0.5)
    with tampered(d, lambda color: np.multiply(color, 0.3, out=color)):
        raster, ray = (below_labels(picture) for picture in pictures(d))
        assert not close(raster, ray, 0.5)
        check_wipe(d, raster, ray)


def check_wipe(d, raster, ray):
    width, handle = d.renderers.size[0], 24

    def check(divider):
        seen = below_labels(shown(d))
        assert close(seen[:, : divider - handle], raster[:, : divider - handle])
        assert close(seen[:, divider + handle :], ray[:, divider + handle :])

    check(round(width / 2))
    low, high = d.window.views[NAME].screen.visible
    start, camera = ((low.x + high.x) / 2, low.y + 0.25 * (high.y - low.y)), d.state.camera
    d.drag(start, (start[0] - 0.3 * (high.x - low.x), start[1]))
    d.settle()
    assert d.state.camera == camera, "the divider was dragged"
    assert abs(d.options.compare.divider - 0.2) < 0.01
    check(round(d.options.compare.divider * width))
    for divider, expected in ((0.0, ray), (1.0, raster)):
        d.change(compare={"divider": divider})
        assert close(below_labels(shown(d))[:, handle:-handle], expected[:, handle:-handle])


def drive_the_status_line_shows_the_pixels_that_differ(d):
    d.change(compare={"mode": "wipe", "causes": False})
    d.layout("Side by side")
    d.settle()
    assert comparison(d).differing and not d.window.is_visible(NAME)
    d.click("//StatusBar/###differing")
    d.settle()
    assert d.window.is_visible(NAME)
    assert d.options.compare.mode == "absolute"
    found = np.argwhere((shown(d) == LABEL_COLORS[1]).all(axis=2))
    assert len(found) >= comparison(d).explained["edge"] > 0
    assert not d.ctx.item_exists("//###Compare/###clip"), "no cause that does not occur"


def drive_modes_have_keys(d):
    show(d)
    for key, mode in ((Key.f5, "wipe"), (Key.f6, "absolute")):
        d.press(key)
        assert d.options.compare.mode == mode
    d.click("//###Compare/Wipe")
    assert d.options.compare.mode == "wipe"
    d.press(Key.f6)
    slider = d.box("//###Compare/##gain")
    at = slider.get_center()
    d.drag((at.x, at.y), (slider.max.x - 10, at.y))
    assert d.options.compare.gain > 200
    assert not d.steps, "undo is not for what an instrument shows"


def drive_no_difference_is_shown_while_the_ray_image_is_coarse(d):
    show(d, gain=64.0)
    both = d.renderers
    live, take = both.live, both.live.poll

    def coarse():
        image = take()
        if image is None or image.factor > 1:
            return image
        frame = image.frame.channel("color")[::4, ::4].copy()
        frame = Frame(size=(frame.shape[1], frame.shape[0]), color=frame)
        return RayImage(image.request, frame, 4)

    live.poll = coarse
    try:
        camera = d.state.camera
        d.window.change(d.state.with_camera(replace(camera, eye=(0.5, 1.0, 6.0))))
        d.frames(3)
        d.until(lambda: both.ray_image is not None and both.ray_image.factor == 4)
        d.frames(3)
        assert "coarse" in waiting(both, d.state)
        seen = shown(d)
        assert seen.std() > 3 and seen.max() < 110, "the raster image, muted"
    finally:
        live.poll = take
    trace_again(d)
    assert waiting(both, d.state) == ""
