"""The compare view: false colours, wipe, counts, steps. The ray image is tampered with."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace

import numpy as np
from imgui_bundle import hello_imgui, imgui
from option_changes import with_options
from window_driver import SIZE, Driver, Key

from lucida.app.images.compare import comparing
from lucida.app.images.compare.view import waiting
from lucida.app.images.progressive_ray import RayImage
from lucida.app.state.options.shared import ImageOptions, Pixel
from lucida.app.ui.theme import framebuffer_scale
from lucida.renderer.compare.raster_and_ray import LABEL_COLORS, SHADING, Comparison
from lucida.renderer.images.difference import false_color, signed_difference
from lucida.renderer.images.frame import Frame

NAME = "Compare"
WORST: Pixel = (40, 60)
SHIFT = int(Key.mod_shift)


def brightened(color: np.ndarray) -> None:
    """A block that is brighter than it should be, and one pixel that is much brighter."""
    color[20:60, 30:90] += 0.05
    color[WORST] += 3.0


@contextmanager
def tampered(d: Driver, change: Callable[[np.ndarray], None]) -> Iterator[None]:
    """As if the tracer had made a mistake, in full images only."""
    live, take = d.window.renderers.live, d.window.renderers.live.poll

    def poll() -> RayImage | None:
        image = take()
        if image is None or image.factor > 1:
            return image
        color = image.frame.channel("color").copy()
        change(color)
        return replace(image, frame=replace(image.frame, color=color))

    live.poll = poll  # type: ignore[method-assign]
    try:
        trace_again(d)
        yield
    finally:
        live.poll = take  # type: ignore[method-assign]
        trace_again(d)


def trace_again(d: Driver) -> None:
    """Another camera, which differs by nothing that can be seen."""
    x, y, z = d.window.state.camera.eye
    camera = replace(d.window.state.camera, eye=(x + 1e-5, y, z))
    d.window.change(d.window.state.with_camera(camera))
    d.settle()


def show(d: Driver, **options: object) -> None:
    """The layout with the view in its middle, in some state of its options; absolute, if they do
    not say."""
    if hello_imgui.current_layout_name() != NAME:
        hello_imgui.switch_layout(NAME)
        d.ctx.yield_(3)
    d.window.change(with_options(d.window.state, compare={"mode": "absolute"} | options))
    d.settle()


def shown(d: Driver) -> np.ndarray:
    """The pixels of the view's image, int16, where they stand for the image's one to one."""
    if not d.stay:
        d.ctx.mouse_teleport_to_pos((3, SIZE[1] - 3))
        d.ctx.yield_(3)
    screen, scale = d.window.views[NAME].screen, framebuffer_scale()
    window = d.picture()
    low, high = screen.visible
    box = [round(edge * scale) for edge in (low.x, low.y, high.x, high.y)]
    cut = window[box[1] : box[3], box[0] : box[2]].astype(np.int16)
    assert cut.shape[:2] == d.window.renderers.size[::-1], "not one to one"
    return cut


def comparison(d: Driver) -> Comparison:
    verdict = d.window.renderers.verdict(d.window.state)
    assert verdict is not None
    return verdict.comparison


def pictures(d: Driver) -> tuple[np.ndarray, np.ndarray]:
    """Both images as they must appear, uint8, from the numbers that were compared."""
    from lucida.renderer.images import to_srgb8

    both = comparison(d)
    return to_srgb8(both.raster.color), to_srgb8(both.ray.color)


def close(one: np.ndarray, two: np.ndarray, part: float = 0.001) -> bool:
    """Return True if two pictures are the same, up to rounding and labels over them."""
    return bool((np.abs(one - two.astype(np.int16)).max(axis=-1) > 2).mean() <= part)


def below_labels(image: np.ndarray) -> np.ndarray:
    """The part of a picture over which no label is written."""
    return image[60:]


def drive_a_wrong_block_is_shown_counted_marked_and_stepped_through(d):
    show(d)
    assert (shown(d).max(axis=2) > 40).mean() < 0.01, "a false alarm"
    with tampered(d, brightened):
        check_false_colours(d)
        show(d)
        check_counts(d)
        check_steps(d)
        check_causes(d)
    show(d, mode="absolute")
    assert (shown(d).max(axis=2) > 40).mean() < 0.01


def check_false_colours(d):
    for gain in (1.0, 8.0):
        show(d, gain=gain)
        both = comparison(d)
        difference = signed_difference(both.raster, both.ray)
        seen = shown(d)
        assert close(seen, false_color(difference, "color", gain)), f"gain {gain}"
        assert seen[45, 50].any() and not seen[80, 150].any()
    d.window.change(with_options(d.window.state, images={"channel": "depth"}))
    d.settle()
    assert not shown(d)[45, 50].any(), "only the colour was changed"
    d.window.change(with_options(d.window.state, images={"channel": "color"}))


def check_counts(d):
    both = comparison(d)
    counts = comparing.counts(both)
    assert counts[SHADING] >= 40 * 60 - 100
    assert counts[SHADING] == both.shading == (both.labels == SHADING).sum()
    count = len(d.window.history.past)
    d.ctx.item_click("//###Compare/###shading")
    d.ctx.yield_(2)
    assert d.window.state.marked is not None
    assert both.labels[d.window.state.marked] == SHADING
    d.settle()
    assert d.window.state.images.magnification == comparing.MARKED_MAGNIFICATION
    row, column = d.window.state.marked
    screen = d.window.views[NAME].screen
    low, high = screen.point(row, column), screen.point(row + 1, column + 1)
    pane_low, pane_high = screen.pane
    assert pane_low.x < low.x < high.x < pane_high.x, "it is in sight"
    assert pane_low.y < low.y < high.y < pane_high.y
    assert len(d.window.history.past) == count + 1
    d.window.undo()
    assert d.window.state.marked is None


def check_steps(d):
    both = comparison(d)
    first = comparing.next_differing(both, None)
    second = comparing.next_differing(both, first)
    for keys, expected in (
        (int(Key.n), first),
        (int(Key.n), second),
        (SHIFT | int(Key.n), first),
    ):
        d.ctx.key_press(keys)
        d.ctx.yield_(2)
        assert d.window.state.marked == expected
    for _ in range(3):
        d.window.undo()
    assert d.window.state.marked is None
    d.settle()


def check_causes(d):
    fit = ImageOptions()  # undo has left the magnification
    assert d.window.state.images.magnification == comparing.MARKED_MAGNIFICATION
    whole = {"magnification": fit.magnification, "center": fit.center}
    d.window.change(with_options(d.window.state, images=whole))
    d.settle()
    d.ctx.key_press(int(Key.k))
    d.settle()
    assert d.window.state.options.compare.causes
    assert (shown(d)[25:55, 35:55] == LABEL_COLORS[SHADING]).all()
    d.ctx.item_click("//###Compare/causes")
    d.ctx.yield_(2)
    assert not d.window.state.options.compare.causes
    assert (shown(d)[25:55, 35:55] != LABEL_COLORS[SHADING]).any(axis=2).all()


def drive_a_wipe_has_the_raster_image_first_and_the_ray_image_second(d):
    show(d, mode="wipe", divider=0.5)
    with tampered(d, lambda color: np.multiply(color, 0.3, out=color)):
        raster, ray = (below_labels(picture) for picture in pictures(d))
        assert not close(raster, ray, 0.5)
        check_wipe(d, raster, ray)


def check_wipe(d, raster, ray):
    width, handle = d.window.renderers.size[0], 24

    def check(divider):
        seen = below_labels(shown(d))
        assert close(seen[:, : divider - handle], raster[:, : divider - handle])
        assert close(seen[:, divider + handle :], ray[:, divider + handle :])

    check(round(width / 2))
    count = len(d.window.history.past)
    low, high = d.window.views[NAME].screen.visible
    start = ((low.x + high.x) / 2, low.y + 0.25 * (high.y - low.y))
    d.drag(start, (start[0] - 0.3 * (high.x - low.x), start[1]))
    d.settle()
    assert d.window.state.camera == d.window.history.past[-1].camera, "the divider was dragged"
    assert abs(d.window.state.options.compare.divider - 0.2) < 0.01
    assert len(d.window.history.past) == count + 1, "a drag is one step"
    check(round(d.window.state.options.compare.divider * width))
    d.window.undo()
    assert d.window.state.options.compare.divider == 0.5
    for divider, expected in ((0.0, ray), (1.0, raster)):
        show(d, mode="wipe", divider=divider)
        seen = below_labels(shown(d))
        assert close(seen[:, handle:-handle], expected[:, handle:-handle])


def drive_modes_have_keys_and_can_be_undone(d):
    show(d)
    for key, mode in ((Key.f5, "wipe"), (Key.f6, "absolute")):
        d.ctx.key_press(int(key))
        d.ctx.yield_(2)
        assert d.window.state.options.compare.mode == mode
        d.window.undo()
        d.window.redo()
    d.ctx.item_click("//###Compare/Wipe")
    assert d.window.state.options.compare.mode == "wipe"
    d.window.undo()
    count = len(d.window.history.past)
    slider = d.ctx.item_info("//###Compare/##gain").rect_full
    at = slider.get_center()
    d.drag((at.x, at.y), (slider.max.x - 10, at.y))
    assert d.window.state.options.compare.gain > 200
    assert len(d.window.history.past) == count + 1


def drive_no_difference_is_shown_while_the_ray_image_is_coarse(d):
    show(d, gain=64.0)
    both = d.window.renderers
    live, take = both.live, both.live.poll

    def coarse() -> RayImage | None:
        image = take()
        if image is None or image.factor > 1:
            return image
        frame = image.frame.channel("color")[::4, ::4].copy()
        frame = Frame(size=(frame.shape[1], frame.shape[0]), color=frame)
        return RayImage(image.request, frame, 4)

    live.poll = coarse  # type: ignore[method-assign]
    try:
        camera = d.window.state.camera
        d.window.change(d.window.state.with_camera(replace(camera, eye=(0.5, 1.0, 6.0))))
        d.ctx.yield_(3)
        d.until(lambda: both.ray_image is not None and both.ray_image.factor == 4)
        d.ctx.yield_(3)
        assert "coarse" in waiting(both, d.window.state)
        seen = shown(d)
        assert seen.std() > 3 and seen.max() < 110, "the raster image, muted"
    finally:
        live.poll = take  # type: ignore[method-assign]
    trace_again(d)
    assert waiting(both, d.window.state) == ""


def drive_it_fits_small_and_large_windows(d):
    view = d.window.views[NAME]
    for size in ((1600, 1000), (1000, 500), (640, 400), (300, 100), SIZE):
        hello_imgui.change_window_size(size)
        d.ctx.yield_(5)
        show(d, mode="wipe" if size[0] == 640 else "absolute")
        window = imgui.internal.find_window_by_name(view.label)
        assert window is not None
        if size[0] >= 1000:
            low, high = view.screen.pane
            assert high.y - low.y > 0.25 * window.size.y, "the image keeps its share"
            cut = window.scroll_max.x, window.scroll_max.y
            assert cut == (0, 0), f"{size}: {cut} is cut off"
