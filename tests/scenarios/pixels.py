"""Into the pixels: marks, magnification, channels, resolutions, display; on the screen's pixels."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from imgui_bundle import imgui
from window_driver import Driver, Key

from app.images.placement import Placement
from app.pair.view import RASTER, RAY
from app.widgets.theme import framebuffer_scale
from renderer.images import to_srgb8
from renderer.images.display import picture

ALT, CTRL, SHIFT = int(Key.mod_alt), int(Key.mod_ctrl), int(Key.mod_shift)
MENU = "//##MainMenuBar/Image"


def choose(d: Driver, path: str) -> None:
    d.ctx.menu_click(f"{MENU}/{path}")
    d.settle()


def placement(d: Driver, name: str = RASTER) -> Placement:
    both = d.window.renderers
    return both.placed(d.window.state.images, both.common_room(both._panes_px[name]))


def without_overlays(image: np.ndarray) -> np.ndarray:
    """The middle of an image, where no legend, badge or ruler is."""
    height, width = image.shape[:2]
    return image[height // 4 : -height // 3, width // 4 : -width // 4]


def pixels(d: Driver, name: str, channel: str) -> np.ndarray:
    """What the middle of a fitted image must show: its own channel, as saved pictures have it."""
    request = d.window.renderers.agreement.pair
    assert request is not None
    frame = request[1 if name == RASTER else 2]
    return without_overlays(picture(frame, channel).astype(np.int16))


def drive_a_click_marks_a_pixel_in_both(d: Driver) -> None:
    window, before = d.window, d.agreeing_images()
    x, y, *_ = d.rect(RASTER)
    d.ctx.mouse_teleport_to_pos((x + 120, y + 150))
    d.ctx.yield_()
    d.ctx.mouse_click(0)
    d.ctx.yield_(2)
    assert window.state.marked == (150, 120)
    assert window.state.camera == d.start.camera
    assert len(window.history.past) == 1
    for was, now in zip(before, d.images(), strict=True):
        places = np.argwhere(np.abs(was - now).max(axis=2) > 40)
        assert len(places) > 20
        assert np.allclose((places.min(axis=0) + places.max(axis=0)) / 2, (150, 120), atol=1)
    # The keys move it, in the image that the mouse is over.
    d.ctx.mouse_teleport_to_pos(d.point(RAY, 0.5, 0.5))
    d.ctx.yield_(2)
    d.ctx.key_press(int(Key.right_arrow))
    d.ctx.key_press(SHIFT | int(Key.down_arrow))
    d.ctx.yield_(2)
    assert window.state.marked == (160, 121), window.state.marked
    d.ctx.key_press(SHIFT | int(Key.left_arrow), 20)
    d.ctx.key_press(int(Key.up_arrow))
    d.ctx.yield_(2)
    assert window.state.marked == (159, 0), "it stays in the image"
    d.ctx.key_press(SHIFT | int(Key.right_arrow), 3)
    d.ctx.yield_(2)
    d.ctx.key_press(int(Key.escape))
    d.ctx.yield_(2)
    assert window.state.marked is None
    window.undo()
    assert window.state.marked == (159, 30)
    # Clicked again, it is gone; a drag marks nothing.
    x, y, *_ = d.rect(RAY)
    d.ctx.mouse_teleport_to_pos((x + 30, y + 159))
    d.ctx.yield_()
    d.ctx.mouse_click(0)
    d.ctx.yield_(2)
    assert window.state.marked is None
    d.drag(d.point(RAY, 0.5, 0.5), d.point(RAY, 0.6, 0.5))
    assert window.state.marked is None
    assert window.state.camera != d.start.camera


def drive_the_mark_keeps_its_ray_when_the_size_changes(d: Driver) -> None:
    window, both = d.window, d.window.renderers
    size = both.size
    pixel = (size[1] // 3, size[0] // 4)
    window.change(window.state.with_options(marked=pixel))
    d.settle()
    ray = both.camera(window.state).ray(*pixel, both.size).direction
    steps = len(window.history.past)
    choose(d, "Resolution/64 x 36")
    row, column = window.state.marked
    there = both.camera(window.state).ray(row, column, both.size).direction
    nearby = both.camera(window.state).ray(row + 1, column + 1, both.size).direction
    assert (np.abs(there - ray) <= np.abs(nearby - there).max()).all()
    assert len(window.history.past) == steps + 1, "the resolution is the only step"
    window.undo()
    d.settle()
    assert window.state.marked == pixel
    window.redo()
    d.settle()
    assert window.state.marked == (row, column)


def drive_the_wheel_with_ctrl_magnifies_at_the_pointer(d: Driver) -> None:
    window = d.window
    choose(d, "Resolution/640 x 360")
    x, y = d.point(RASTER, 0.3, 0.6)
    x, y = round(x), round(y)
    d.ctx.mouse_teleport_to_pos((x, y))
    d.ctx.yield_(2)
    pixel = window._hovered[1]
    d.ctx.key_down(int(Key.mod_ctrl))
    for _ in range(6):
        d.ctx.mouse_wheel_y(1)
    d.ctx.yield_(2)
    assert window.state.images.magnification == 8
    assert window.state.camera == d.start.camera
    apart = np.subtract(window._hovered[1], pixel)
    assert np.abs(apart).max() <= 1, f"{pixel} under the pointer moves by {apart}"
    assert len(window.history.past) == 2, "one turn of the wheel is one step"
    center = window.state.images.center
    d.drag((x, y), (x - 80, y - 24))
    d.ctx.key_up(int(Key.mod_ctrl))
    assert window.state.camera == d.start.camera
    moved = window.state.images.center
    assert abs((moved[0] - center[0]) * 640 * 8 - 80) < 1
    assert abs((moved[1] - center[1]) * 360 * 8 - 24) < 1
    # A drag without Ctrl turns the camera, also where the image is magnified.
    d.drag((x, y), (x + 30, y))
    assert window.state.camera != d.start.camera
    assert window.state.images.center == moved
    window.undo()
    d.ctx.key_press(ALT | int(Key._0))
    d.ctx.yield_(2)
    assert window.state.images.magnification is None
    d.ctx.key_press(ALT | int(Key.a))
    d.ctx.yield_(2)
    assert window.state.images.magnification == 1


def drive_magnified_pixels_are_squares_with_a_grid(d: Driver) -> None:
    window = d.window
    choose(d, "Resolution/160 x 90")
    choose(d, "Magnification/8x")
    window.change(window.state.with_options(images={"center": (0.4, 0.6), "grid": False}))
    d.settle()
    plain = d.images()
    for name, image in zip((RASTER, RAY), plain, strict=True):
        expected = magnified(d, name, "color")
        difference = np.abs(without_overlays(image) - without_overlays(expected)).max(axis=2)
        assert (difference <= 1).all(), "nearest neighbour: nothing is blurred or shifted"
    d.ctx.key_press(ALT | int(Key.x))
    d.settle()
    for name, after in zip((RASTER, RAY), d.images(), strict=True):
        lines = np.abs(after - magnified(d, name, "color")).max(axis=2) > 4
        at, (height, width) = placement(d, name), lines.shape
        columns = (np.arange(width) + at.visible[0] - at.origin[0]) % 8 == 0
        rows = (np.arange(height) + at.visible[1] - at.origin[1]) % 8 == 0
        expected = columns[None, :] | rows[:, None]
        inner = without_overlays(np.dstack([lines, np.broadcast_to(expected, lines.shape)]))
        assert (inner[..., 0] <= inner[..., 1]).all(), "lines stand between pixels only"
        assert inner[..., 0].sum() > 0.9 * inner[..., 1].sum()
    choose(d, "Magnification/4x")
    fine = d.images()
    d.ctx.key_press(ALT | int(Key.x))
    d.settle()
    assert (np.abs(fine[0] - d.images()[0]) <= 1).all(), "no lines between smaller pixels"


def magnified(d: Driver, name: str, channel: str) -> np.ndarray:
    """What is seen of an image whose pixels are magnified by a whole number."""
    at, request = placement(d, name), d.window.renderers.agreement.pair
    frame, factor = request[1 if name == RASTER else 2], round(at.magnification)
    large = picture(frame, channel).repeat(factor, axis=0).repeat(factor, axis=1)
    (left, top, right, bottom), (x, y) = at.visible, at.origin
    return large[top - y : bottom - y, left - x : right - x].astype(np.int16)


def drive_rulers_stand_beside_the_image(d: Driver) -> None:
    """No number covers a pixel; both images have the same place, and picking is exact."""
    window, scale = d.window, framebuffer_scale()
    choose(d, "Resolution/16 x 9")
    at = placement(d)
    assert at == placement(d, RAY)
    assert at.magnification >= 8
    wide, high = at.margin
    assert wide > 0
    assert high > 0
    for name, image in zip((RASTER, RAY), d.images(), strict=True):
        covered = np.abs(image - magnified(d, name, "color")).max(axis=2) > 4
        side = round(at.magnification)
        covered[::side] = covered[:, ::side] = False  # the lines between pixels
        assert not covered.any(), f"pixels of {name} are covered"

    def rulers() -> tuple[np.ndarray, np.ndarray]:
        left, top, right, bottom = (round(edge * scale) for edge in d.rect(RASTER))
        whole = d.picture().astype(np.int16)
        return whole[top - high : top, left:right], whole[top:bottom, left - wide : left]

    from_one = rulers()
    assert all(np.ptp(ruler) > 100 for ruler in from_one), "there are no numbers"
    window.change(window.state.with_options(one_based=False))
    d.settle()
    for before, after in zip(from_one, rulers(), strict=True):
        assert np.abs(after - before).max() > 60, "they follow the way to count"
    # The pixel under the pointer is the one that is drawn there, to the corners.
    for row, column in ((0, 0), (8, 15), (4, 7)):
        d.ctx.mouse_teleport_to_pos(d.point(RASTER, (column + 0.5) / 16, (row + 0.5) / 9))
        d.ctx.yield_(3)
        assert window._hovered == (RASTER, (row, column))
    left, top, *_ = d.rect(RASTER)
    for place in ((left - 5, top + 5), (left + 5, top - 5)):
        d.ctx.mouse_teleport_to_pos(place)
        d.ctx.yield_(3)
        assert window._hovered is None, "a ruler is no pixel"
    # Where pixels become large enough for rulers, what is under the pointer stays there.
    choose(d, "Resolution/640 x 360")
    choose(d, "Magnification/4x")
    d.ctx.mouse_teleport_to_pos(tuple(map(round, d.point(RASTER, 0.4, 0.6))))
    d.ctx.yield_(3)
    pixel = window._hovered[1]
    d.ctx.key_down(int(Key.mod_ctrl))
    while not any(placement(d).margin):
        d.ctx.mouse_wheel_y(1)
        d.ctx.yield_(2)
        assert np.abs(np.subtract(window._hovered[1], pixel)).max() <= 1
    d.ctx.key_up(int(Key.mod_ctrl))
    assert placement(d).magnification == 8
    # Without lines between pixels there are no rulers; with large numbers in them there are.
    choose(d, "Magnification/64x")
    assert any(placement(d).margin)
    d.ctx.key_press(ALT | int(Key.x))
    d.settle()
    assert placement(d).margin == (0, 0)


def drive_values_are_written_into_large_pixels(d: Driver) -> None:
    window = d.window
    choose(d, "Resolution/64 x 36")
    choose(d, "Magnification/32x")
    for number, channel in enumerate(("color", "depth", "normal", "id")):
        d.ctx.key_press(ALT | (int(Key._1) + number))
        d.settle()
        assert window.state.images.channel == channel
        raster = d.images()[0]
        cell = without_overlays(np.abs(raster - magnified(d, RASTER, channel)).max(axis=2)) > 60
        assert cell.mean() > 0.02, "there are no numbers in the pixels"
    # Another way to write changes the numbers.
    d.ctx.key_press(ALT | int(Key._1))
    d.settle()
    counted = d.images()[0]
    d.ctx.key_press(ALT | int(Key.v))
    d.settle()
    assert np.abs(without_overlays(d.images()[0] - counted)).max() > 60
    # From 48 units a side on, each has its row and column too.
    window.change(window.state.with_options(images={"magnification": 64.0}))
    d.settle()
    large = d.images()[0]
    window.change(window.state.with_options(one_based=False))
    d.settle()
    assert np.abs(without_overlays(d.images()[0] - large)).max() > 60


def drive_channels_are_shown_in_both(d: Driver) -> None:
    for number, (name, channel) in enumerate(
        (("Depth", "depth"), ("Normal", "normal"), ("Object", "id"), ("Colour", "color"))
    ):
        if number % 2:
            choose(d, f"Channel/{name}")
        else:
            d.ctx.key_press(ALT | int((Key._2, Key._3, Key._4, Key._1)[number]))
            d.settle()
        assert d.window.state.images.channel == channel
        raster, ray = d.images()
        for pane, image in ((RASTER, raster), (RAY, ray)):
            difference = np.abs(without_overlays(image) - pixels(d, pane, channel)).max(axis=2)
            assert (difference <= 2).mean() > 0.999, (pane, channel)
        both = np.abs(raster - ray).max(axis=2)
        assert (both > 3).mean() < 0.002, "the same colours in both, the legend too"
    assert len(d.window.history.past) == 4


def drive_channels_follow_a_drag(d: Driver) -> None:
    """While the camera moves, coarse images have the channel too, and nothing is read back."""
    both = d.window.renderers
    d.ctx.key_press(ALT | int(Key._2))
    d.settle()
    assert both.textures is not None
    reads = counting(both.textures.raster, "read_back")
    center = d.ctx.item_info(d.field("w.x")).rect_full.get_center()
    d.ctx.mouse_teleport_to_pos((center.x, center.y))
    d.ctx.mouse_down(0)
    for step in range(1, 20):
        d.ctx.mouse_teleport_to_pos((center.x + 2 * step, center.y))
        d.ctx.yield_()
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
    frame = both.agreement.pair[1]
    hits = frame.depth[np.isfinite(frame.depth)]
    assert abs(near - hits.min()) < 1e-4
    assert abs(far - hits.max()) < 1e-3


def counting(owner: object, name: str) -> Callable[[], int]:
    """Counts the calls of a method from now on."""
    method, calls = getattr(owner, name), []

    def counted(*arguments: object) -> object:
        calls.append(arguments)
        return method(*arguments)

    setattr(owner, name, counted)
    return lambda: len(calls)


def drive_resolutions_are_fixed_and_fitted(d: Driver) -> None:
    window, both = d.window, d.window.renderers
    for text, size in (("16 x 9", (16, 9)), ("4 x 3", (4, 3)), ("1280 x 720", (1280, 720))):
        choose(d, f"Resolution/{text}")
        assert both.size == size
        for name in (RASTER, RAY):
            at = placement(d, name)
            assert at.sees_all
            left, top, right, bottom = d.rect(name)
            scale = framebuffer_scale()
            assert (round((right - left) * scale), round((bottom - top) * scale)) == at.extent
        assert at.whole == (size[0] < 1000)
    # Minified: the mean of what a screen pixel covers, in linear light.
    for number, (name, image) in enumerate(zip((RASTER, RAY), d.images(), strict=True)):
        expected = reduced(both.agreement.pair[1 + number].color, placement(d, name).extent)
        difference = np.abs(without_overlays(image) - without_overlays(expected))
        assert (difference <= 2).mean() > 0.999, name
    # A size of one's own.
    d.ctx.key_press(ALT | int(Key.s))
    d.ctx.yield_(3)
    d.ctx.key_chars_replace_enter("nonsense")
    d.ctx.yield_(3)
    assert both.size == (1280, 720)
    assert window._asked is not None and "nonsense" in window._asked.problem
    d.ctx.key_chars_replace_enter("37x23")
    d.ctx.yield_(3)
    d.settle()
    assert both.size == (37, 23)
    assert window._asked is None
    d.ctx.key_press(ALT | int(Key.w))
    d.settle()
    assert window.state.images.resolution is None
    while window.can_undo():
        window.undo()
    d.settle()
    assert window.state == d.start


def reduced(color: np.ndarray, extent: tuple[int, int]) -> np.ndarray:
    """Linear light averaged by area over (width, height) pixels, as sRGB, int16."""
    for axis, count in ((1, extent[0]), (0, extent[1])):
        size = color.shape[axis]
        edges = np.arange(count + 1) * (size / count)
        sums = np.concatenate(
            [np.zeros_like(np.take(color, [0], axis)), color.clip(0, 1).cumsum(axis, np.float64)],
            axis,
        )
        low = np.minimum(edges.astype(int), size - 1)
        shape = [1, 1, 1]
        shape[axis] = -1
        part = (edges - low).reshape(shape)
        at = np.take(sums, low, axis) * (1 - part) + np.take(sums, low + 1, axis) * part
        color = np.diff(at, axis=axis) / (size / count)
    return to_srgb8(color.astype(np.float32)).astype(np.int16)


def drive_a_large_image_is_seen_in_part(d: Driver) -> None:
    """4096 x 2160: at 1:1 only what is seen goes to the screen, and the window still answers."""
    window, both = d.window, d.window.renderers
    choose(d, "Resolution/4096 x 2160")
    assert both.size == (4096, 2160)
    choose(d, "Magnification/1:1")
    at = placement(d)
    assert not at.sees_all
    raster = d.images()[0]
    assert raster.shape[0] <= at.pane[1]
    assert raster.shape[1] <= at.pane[0]
    left, top, right, bottom = at.visible
    x, y = at.origin
    expected = picture(both.agreement.pair[1])[top - y : bottom - y, left - x : right - x]
    difference = np.abs(without_overlays(raster) - without_overlays(expected.astype(np.int16)))
    assert difference.max() <= 1
    window.undo()
    window.undo()
    d.settle()


def drive_single_channels_and_linear_light(d: Driver) -> None:
    window, (plain, _) = d.window, d.agreeing_images()
    for index, (key, name) in enumerate(((Key.r, "red"), (Key.g, "green"), (Key.b, "blue"))):
        d.ctx.key_press(ALT | int(key))
        d.settle()
        assert window.state.images.component == name
        gray, ray = d.images()
        assert (np.abs(gray - plain[..., index : index + 1]) <= 1).all()
        assert (np.abs(gray - ray).max(axis=2) > 3).mean() < 0.002
    d.ctx.key_press(ALT | int(Key.t))
    d.settle()
    blue = d.images()[0]
    assert (blue[..., :2] <= 1).all()
    assert (np.abs(blue[..., 2] - plain[..., 2]) <= 1).all()
    d.ctx.key_press(ALT | int(Key.t))
    d.ctx.key_press(ALT | int(Key.b))
    d.ctx.key_press(ALT | int(Key.l))
    d.settle()
    assert window.state.images.component == "rgb"
    linear = d.images()[0]
    frame = window.renderers.agreement.pair[1]
    assert np.abs(linear - np.clip(frame.color, 0, 1) * 255).max() <= 1.01
    assert linear.mean() < plain.mean() - 20


def drive_the_strip_does_the_same(d: Driver) -> None:
    d.ctx.set_ref(f"//###{RASTER}")
    for name, item, check in (
        ("channel", "Depth", lambda images: images.channel == "depth"),
        ("resolution", "160 x 90", lambda images: images.resolution == (160, 90)),
        ("magnification", "16x", lambda images: images.magnification == 16),
        ("transfer", "linear", lambda images: images.transfer == "linear"),
        ("component", "Red", lambda images: images.component == "red"),
    ):
        d.ctx.item_click(f"**/##{name}")
        d.ctx.yield_(2)
        d.ctx.item_click(f"//$FOCUSED/{item}")
        d.settle()
        assert check(d.window.state.images), name
    d.ctx.set_ref("")
    assert len(d.window.history.past) == 5
    assert imgui.get_io().display_size.x > 0


def drive_nothing_is_drawn_twice(d: Driver) -> None:
    """At rest, no frame draws or uploads an image again."""
    both = d.window.renderers
    choose(d, "Resolution/640 x 360")
    choose(d, "Magnification/32x")
    choose(d, "Channel/Depth")
    textures = both.textures
    assert textures is not None
    images = textures._shown_raster, textures._shown_ray
    shown = [counting(image._display, "show") for image in images]
    rasterizer = textures.rasterizer.of(d.window.state.scene)
    drawn = counting(rasterizer, "draw")
    read = counting(rasterizer, "read")
    d.ctx.yield_(10)
    assert [count() for count in (*shown, drawn, read)] == [0, 0, 0, 0]
