"""The image windows: sizes and layouts, channels, resolutions, display."""

import numpy as np
from shown_pixels import ALT, choose, counting, pixels, without_overlays
from window_driver import SIZE, Key

from lucida.app.images.pair.view import RASTER, RAY
from lucida.renderer.raster import Display


def drive_pixels_can_be_large_and_are_marked(d):
    d.menu("Image/Resolution/64 x 36")
    d.press(Key.mod_alt | Key.x)  # without the pixel grid
    d.settle()
    assert d.renderers.size == (64, 36)
    raster, ray = d.images()
    side = raster.shape[0] // 36
    assert side > 4 and raster.shape[:2] == (36 * side, 64 * side)
    blocks = raster.reshape(36, side, 64, side, 3)
    assert (blocks == blocks[:, :1, :, :1]).all()  # nearest neighbour: no pixel is blurred
    x, y, *_ = d.rect(RASTER)
    d.move_to((x + side * 20 + side // 2, y + side * 30 + side // 2))
    assert d.window.hovered == (RASTER, (30, 20))
    d.stay = True
    marked = d.images()[1]
    places = np.argwhere(np.abs(marked - ray).max(axis=2) > 8)
    assert places.min(axis=0).tolist() == [side * 30 - 2, side * 20 - 2]
    assert places.max(axis=0).tolist() == [side * 31 + 1, side * 21 + 1]


def drive_windows_can_be_hidden(d):
    both = d.renderers.size
    d.ctx.window_close(f"//###{RAY}")
    d.frames(3)
    d.until(lambda: d.renderers.size[0] > both[0])
    d.menu("Instruments/###Ray")
    d.menu("###Layout/Reset the layout")
    d.frames(5)
    d.agreeing_images()
    assert abs(d.renderers.size[0] - both[0]) <= 2


def drive_the_window_is_resized(d):
    for size in ((1500, 640), (300, 60), SIZE):  # of which the second is too small for images
        d.resize(size)
        if size != (300, 60):
            d.agreeing_images()
            widths = [width for width, _ in d.renderers.panes_px.values()]
            assert abs(widths[0] - widths[1]) <= 2, "both images have half of the room"


def drive_channels_are_shown_in_both(d):
    for key, channel in (
        (Key._2, "depth"),
        (None, "normal"),
        (Key._4, "id"),
        (Key._1, "color"),
    ):
        if key is None:
            choose(d, "Channel/Normal")
        else:
            d.press(ALT | int(key))
            d.settle()
        assert d.state.images.channel == channel
        raster, ray = d.images()
        for pane, image in ((RASTER, raster), (RAY, ray)):
            difference = np.abs(without_overlays(image) - pixels(d, pane, channel)).max(axis=2)
            assert (difference <= 2).mean() > 0.999, (pane, channel)
        both = np.abs(raster - ray).max(axis=2)
        assert (both > 3).mean() < 0.002, "the same colours in both, the legend too"
    assert not d.window.can_undo()


def drive_channels_follow_a_drag(d):
    """While the camera moves, coarse images have the channel too, and nothing is read back."""
    both = d.renderers
    d.press(ALT | Key._2)
    d.settle()
    reads = counting(both.textures.raster, "read_back")
    center = d.box(d.field("w.x")).get_center()
    d.ctx.mouse_teleport_to_pos((center.x, center.y))
    d.ctx.mouse_down(0)
    for step in range(1, 8):
        d.ctx.mouse_teleport_to_pos((center.x + 5 * step, center.y))
        image = both.ray_image
        assert image is not None
        assert image.frame.depth is not None
        assert both.raster_error is None and both.ray_error is None  # never nothing
    while_moving = reads()
    d.ctx.mouse_up(0)
    d.settle()
    assert while_moving <= 1, "read back while dragging"
    assert reads() > while_moving
    near, far = both.depths() or (0, 0)
    frame = both.agreement.verdict.comparison.raster
    hits = frame.depth[np.isfinite(frame.depth)]
    assert abs(near - hits.min()) < 1e-4
    assert abs(far - hits.max()) < 1e-3
    d.change(images={"channel": "z"})
    d.settle()
    assert abs(both.depths()[0] - d.state.camera.distance * near) < 1e-3


def drive_nothing_is_drawn_twice(d):
    """At rest, no frame draws or uploads an image again."""
    both = d.renderers
    d.change(images={"resolution": (640, 360), "channel": "depth"})
    choose(d, "Magnification/32x")
    textures = both.textures
    shown = counting(Display, "show")
    rasterizer = textures.rasterizer.of(d.state.scene)
    drawn = counting(rasterizer, "draw")
    read = counting(rasterizer, "read")
    d.frames(10)
    assert [count() for count in (shown, drawn, read)] == [0, 0, 0]


def drive_images_are_on_the_screen_in_the_frame_of_their_change(d):
    found, seen, asked = d.renderers.textures, [], ["color"]
    left, top, right, bottom = (round(edge) for edge in d.rect(RASTER))
    raster_in = found.raster_in

    def ask(placement, wanted, look, *more, **named):
        asked.append(look.channel)
        return raster_in(placement, wanted, look, *more, **named)

    def look(target):
        seen.append((asked[-1], hash(target.read()[top:bottom, left:right].tobytes())))

    found.raster_in, d.run.on_drawn = ask, look
    try:
        d.frames(3)
        d.change(images={"channel": "id"})
        d.frames(3)
    finally:
        d.run.on_drawn = None
        del found.raster_in
    colors = {number for channel, number in seen if channel == "color"}
    others = {number for channel, number in seen if channel == "id"}
    assert colors and others
    assert not colors & others
    assert len(others) == 1
