"""The loop stepper: both algorithms, line by line, over the window's scene and camera.

The view plays the recordings, makes the canvases' textures, and shows the current step in the
outside view. stepper/panel.py draws a run, stepper/model.py computes a step.
"""

from __future__ import annotations

import math
import time
from dataclasses import replace
from typing import Any

import moderngl
import numpy as np
from imgui_bundle import ImVec2, imgui
from numpy.typing import NDArray

from app.host.view import DockedView, Host
from app.outside.diagram import Dot, Face, Item, Segments, polyline
from app.outside.extent import end_parameter
from app.outside.frustum import image_point, pixel_corners
from app.outside.view import OutsideView
from app.stepper import model as stepper
from app.stepper import panel
from app.stepper.controls import Asked, Wish, controls, keys
from app.stepper.model import Moment, moment_at
from app.stepper.options import StepperOptions
from app.stepper.panel import BARE_SLIDER_EM
from app.stepper.recording import Order, Recording
from app.stepper.runs import Pair, Runs
from app.widgets import theme
from app.widgets.canvas import color_picture, depth_picture
from app.widgets.rows import follow
from app.widgets.uploads import Uploads
from renderer.camera import Camera, Size
from renderer.errors import describe
from renderer.memo import Memo

STEPPER = "Stepper"
LOW_EM = 18.0  # a view that is lower has one row of controls, and no words that it can do without
LEAST_EM = (18.0, 18.0)  # the width and height of an algorithm; more than there is room for scrolls
LONGEST_FRAME_S = 0.25  # what a frame that took longer is taken for
_EDGES = ((0, 1), (0, 2), (0, 4), (1, 3), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 6), (5, 7),
          (6, 7))  # fmt: skip  # of a box's corners, numbered by their bits


class StepperView(DockedView):
    name = STEPPER
    title = "Loop stepper"

    def __init__(self, outside: OutsideView) -> None:
        self._outside = outside
        self._runs: Runs | None = None
        self._uploads: Uploads | None = None
        self.playing = self._seen = False
        self._before_s = 0.0  # when the last frame of playing was
        self._owed = 0.0  # parts of a step that have not been taken
        self._moment = Memo(_moment, len(Order))
        self._color = {order: Memo(_put_color) for order in Order}
        self._depth = {order: Memo(_put_depth) for order in Order}
        self._items = Memo(_outside_items)
        self.moments: dict[Order, Moment] = {}
        self._asked: Wish = ""

    def ask(self, wish: Wish) -> None:
        """Ask for what a button or a key would, in the next frame."""
        self._asked = wish

    @property
    def settled(self) -> bool:
        waits = self._seen and self._runs is not None and self._runs.busy
        return not self.playing and not waits

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self._runs = Runs(host.animate)
        self._uploads = Uploads(context)

    def end(self) -> None:
        if self._runs is not None:
            self._runs.close()
        if self._uploads is not None:
            self._uploads.release()

    def unseen(self, host: Host) -> None:
        self.playing = self._seen = False
        self._asked = ""
        self._outside.show(STEPPER, ())

    def begin_anew(self) -> None:
        self.playing = False
        self._asked = ""

    def draw(self, host: Host) -> None:
        assert self._runs is not None and self._uploads is not None
        self._uploads.begin_frame()
        self._seen = True
        options = host.state.of(StepperOptions)
        is_low = imgui.get_content_region_avail().y < LOW_EM * imgui.get_font_size()
        now = Asked(options, host.state.options.language)
        asked = controls(now, self.playing, is_low) if host.has_tools else now
        host.apply(host.state.with_options(language=asked.language))
        wish = self._asked or keys() or asked.wish
        self._asked = ""
        if asked.options != options:
            options = asked.options
            host.apply(host.state.with_options(stepper=options))
        state = host.state
        camera = state.view.for_size(options.canvas)
        pair = self._runs.of(state.scene, camera, options.canvas)
        if self._runs.error is not None:
            imgui.text_colored(theme.ERROR, describe(self._runs.error))
            return
        if pair is None:
            imgui.text_colored(theme.DIM, "preparing the scene for the stepper ...")
            host.animate()
            return
        if not pair.complete:
            host.animate()
        orders = [one for one in Order if options.order in ("both", _key(one))]
        steps = self._moved(host, pair, orders, options, wish)
        self._panels(host, pair, orders, steps, is_low)
        self._show_outside(host, pair, orders)

    # The runs' steps.

    def _moved(
        self, host: Host, pair: Pair, orders: list[Order], options: StepperOptions, wish: Wish
    ) -> tuple[int, int]:
        """Return the steps after this frame's wishes."""
        if wish == "play":
            self.playing = not self.playing
            self._before_s, self._owed = time.monotonic(), 0.0
            at_end = all(options.steps[_at(one)] >= len(pair.runs[one]) - 1 for one in orders)
            if self.playing and at_end:
                options = replace(options, steps=(0, 0))
        elif wish:
            self.playing = False
        taken = self._taken(options.speed) if self.playing else 0
        if self.playing:
            host.animate()
        steps = list(options.steps)
        for order in orders:
            run, at = pair.runs[order], _at(order)
            # A place that the run has not come to yet is kept for when it has.
            if len(run) and ((wish and wish != "play") or taken):
                steps[at] = _after(run, min(steps[at], len(run) - 1), wish, taken)
        if self.playing and all(
            pair.complete and steps[_at(one)] >= len(pair.runs[one]) - 1 for one in orders
        ):
            self.playing = False
        if not (pair.complete or wish or taken):  # its target step may still be recorded
            return steps[0], steps[1]
        self._keep(host, steps)
        return steps[0], steps[1]

    def _taken(self, speed: float) -> int:
        """Return the number of steps for the time since the last frame."""
        now_s = time.monotonic()
        self._owed += min(now_s - self._before_s, LONGEST_FRAME_S) * speed
        self._before_s = now_s
        whole = int(self._owed)
        self._owed -= whole
        return whole

    def _keep(self, host: Host, steps: list[int]) -> None:
        """Put the steps into the state, for lectures and sessions. Undo is for scenes and cameras,
        and does not revisit steps.
        """
        if tuple(steps) != host.state.of(StepperOptions).steps:
            host.amend(host.state.with_options(stepper={"steps": tuple(steps)}))

    # The panels.

    def _panels(
        self, host: Host, pair: Pair, orders: list[Order], steps: tuple[int, int], is_low: bool
    ) -> None:
        state, wanted = host.state, list(steps)
        self.moments = {}
        for order in orders:
            run = pair.runs[order]
            if len(run):
                moment = self._moment(run, steps[_at(order)], len(run), run.complete)
                self.moments[order] = moment
                self._upload(run, moment, state.images.exposure_ev)
        shown = panel.Shown(
            tuple(orders),
            state.options.indexing,
            state.options.notation,
            state.options.language == "julia",
            is_low,
        )
        if shown.is_bare and self.moments:  # its slider is next to the controls
            follow(BARE_SLIDER_EM * imgui.get_font_size())
            order = orders[0]
            self._take(pair, order, panel.slider(pair.runs[order], self.moments[order]), wanted)
        room, spacing = imgui.get_content_region_avail(), imgui.get_style().item_spacing
        count, em = len(orders), imgui.get_font_size()
        width = (room.x - spacing.x * (count - 1)) / count
        beside = room.x > 1.1 * room.y and (count == 1 or width > LEAST_EM[0] * em)
        high = room.y if beside else (room.y - spacing.y * (count - 1)) / count
        least = 0.0 if is_low and count == 1 else LEAST_EM[1] * em
        size = ImVec2(width if beside else room.x, max(high, least))
        framed = imgui.ChildFlags_.none if is_low else imgui.ChildFlags_.borders
        for number, order in enumerate(orders):
            if number and beside:
                imgui.same_line()
            imgui.begin_child(order.value, size, framed | imgui.ChildFlags_.nav_flattened)
            answer = panel.run_panel(
                pair.runs[order], self.moments.get(order), self._picture(order), host.fonts, shown
            )
            imgui.end_child()
            self._take(pair, order, answer, wanted)
        if wanted != list(steps):
            self._keep(host, wanted)

    def _take(self, pair: Pair, order: Order, answer: panel.Answer, wanted: list[int]) -> None:
        """Take a step that a run is to go to, or a pixel, whose turn may never begin."""
        run, at = pair.runs[order], _at(order)
        if isinstance(answer, int):
            wanted[at] = answer
        elif answer is not None:
            turn = stepper.step_of_pixel(run, answer, wanted[at])
            wanted[at] = wanted[at] if turn is None else turn
        if answer is not None:
            self.playing = False

    def _upload(self, run: Recording, moment: Moment, exposure_ev: float) -> None:
        """Upload the canvas and the depth buffer if they have changed."""
        assert self._uploads is not None
        name, used = run.order.name, theme.used()
        self._color[run.order](self._uploads, f"color {name}", moment.canvas, exposure_ev, used)
        if moment.depth is not None:
            farthest = float(run.depth_t.upto(len(run.depth_t)).max(initial=0.0))
            self._depth[run.order](self._uploads, f"depth {name}", moment.depth, farthest, used)

    def _picture(self, order: Order) -> panel.RunTextures:
        assert self._uploads is not None
        color, depth = (self._uploads.get(f"{kind} {order.name}") for kind in ("color", "depth"))
        return color.glo if color else None, depth.glo if depth else None

    # In the outside view.

    def _show_outside(self, host: Host, pair: Pair, orders: list[Order]) -> None:
        """Show the current step there: rays, objects, and the canvas on the image plane. Point out
        its pixel in images of the canvas's size, unless the mouse points at something else.
        """
        shown = tuple((pair.runs[o], self.moments[o]) for o in orders if o in self.moments)
        end = end_parameter(pair.camera, host.focus.framed)
        last = orders[-1]
        is_live = pair.camera == host.renderers.camera(host.state) and last in self.moments
        self._outside.show(
            STEPPER,
            self._items(pair.camera, pair.size, shown, end),
            picture=self._uploads.get(f"color {last.name}") if is_live and self._uploads else None,
        )
        pixel = self.moments[last].pixel if is_live else None
        mine = not imgui.is_any_item_hovered() or imgui.is_window_hovered(
            imgui.HoveredFlags_.child_windows
        )
        if pixel is not None and mine and pair.size == host.renderers.size:
            host.hover(STEPPER, pixel)


def _moment(run: Recording, step: int, length: int, complete: bool) -> Moment:
    """Return moment_at(run, step) of a run that grows: its length, and whether it is complete."""
    return moment_at(run, step)


def _put_color(
    uploads: Uploads,
    name: str,
    canvas: NDArray[np.float64],
    exposure_ev: float,
    look: theme.WindowLook,
) -> None:
    uploads.put(name, color_picture(canvas, exposure_ev))


def _put_depth(
    uploads: Uploads, name: str, depth: NDArray[np.float64], farthest: float, look: theme.WindowLook
) -> None:
    uploads.put(name, depth_picture(depth, farthest))


def _outside_items(
    camera: Camera, size: Size, shown: tuple[tuple[Recording, Moment], ...], end: float
) -> tuple[Item, ...]:
    """Return what the outside view shows of runs at their moments.

    end: ray parameter at which a ray that hits nothing ends.
    """
    found = [_items(camera, size, run, moment, end) for run, moment in shown]
    return tuple(item for items in found for item in items)


def _after(run: Recording, step: int, wish: Wish, taken: int) -> int:
    """Return a run's step after a wish, or after this many steps of playing."""
    last = len(run) - 1
    if wish == "first":
        return 0
    if wish == "last":
        return last
    if wish == "pixel":
        return stepper.next_pixel(run, step)
    if wish == "object":
        return stepper.next_object(run, step)
    moved = {"back": -1, "step": 1}.get(wish, taken)
    return min(max(step + moved, 0), last)


def _items(camera: Camera, size: Size, run: Recording, moment: Moment, end: float) -> list[Item]:
    """Return the current pixel, its ray with the known hits, the current object's box, and its
    bounding box on the image plane.
    """
    items: list[Item] = []
    name = run.order.name.lower()
    if moment.triangle is not None:
        sides = polyline(np.array(moment.triangle.points), True)
        items.append(Segments(f"{name} triangle", "ray", sides, 2.5, layer=3))
    elif moment.object is not None:
        thing = next(o for o in run.model.objects if o.number == moment.object)
        items.append(Segments(f"{name} object", "extra", _box(thing.low, thing.high), 1.8, layer=2))
    if moment.box is not None and moment.box[0] and moment.box[1]:
        items.append(_plane_box(camera, size, moment.box))
    if moment.pixel is not None:
        corners = pixel_corners(camera, moment.pixel, size)
        edges = polyline(corners, True)
        items += [
            Face(f"{name} pixel", "mark", corners, 0.3, on_plane=True, layer=2),
            Segments(f"{name} pixel", "mark", edges, 2.0, on_plane=True, layer=3),
        ]
    if moment.ray is not None and moment.pixel is not None:
        hits = [test.t for test in moment.tests if test.pixel == moment.pixel]
        hits = [t for t in hits if t < math.inf]
        reach = min(hits, default=end)
        origin, direction = np.array(moment.ray.origin), np.array(moment.ray.direction)
        segment = np.stack([origin, origin + reach * direction])[None]
        items.append(Segments(f"{name} ray", "ray", segment, 2.5, layer=3))
        items += [
            Dot(f"{name} hit", "mark", origin + t * direction, 5.0 if t == reach else 3.0)
            for t in hits
        ]
    return items


def _box(low: Any, high: Any) -> np.ndarray:
    """Return the edges of a box, (12, 2, 3)."""
    sides = np.array([low, high], float)
    corners = np.array(
        [[sides[n & 1, 0], sides[n >> 1 & 1, 1], sides[n >> 2, 2]] for n in range(8)]
    )
    return corners[np.array(_EDGES)]


def _plane_box(camera: Camera, size: Size, box: tuple[range, range]) -> Segments:
    """Return a bounding box in pixels, on the image plane."""
    rows, columns = box
    i = np.array([rows.start, rows.start, rows.stop, rows.stop]) - 0.5
    j = np.array([columns.start, columns.stop, columns.stop, columns.start]) - 0.5
    points = image_point(camera, *camera.image_point(i, j, size))
    return Segments("bounding box", "extra", polyline(points, True), 2.0, on_plane=True, layer=2)


def _key(order: Order) -> str:
    return "image" if order is Order.IMAGE else "object"


def _at(order: Order) -> int:
    """Return the index of an algorithm in StepperOptions.steps."""
    return 1 if order is Order.IMAGE else 0
