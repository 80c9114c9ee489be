"""The loop stepper: both algorithms, line by line, over the window's scene and camera.

The view plays the recordings, makes the canvases' textures, and shows the current step in the
outside view. stepper/panel.py draws a run, stepper/model.py computes a step.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace

import moderngl
from imgui_bundle import ImVec2, imgui

from lucida.app.instruments.outside.extent import end_parameter
from lucida.app.instruments.outside.view import OutsideView
from lucida.app.instruments.stepper import model as stepper
from lucida.app.instruments.stepper import panel
from lucida.app.instruments.stepper.controls import Asked, Wish, controls, keys
from lucida.app.instruments.stepper.model import Moment, moment_at
from lucida.app.instruments.stepper.outside_items import run_items
from lucida.app.instruments.stepper.pictures import LoopPictures
from lucida.app.instruments.stepper.recording import Order, Recording
from lucida.app.instruments.stepper.runs import Made, Prepared, recordings
from lucida.app.state.app_state import AppState
from lucida.app.state.options.stepper import StepperOptions
from lucida.app.ui import theme
from lucida.app.ui.canvas import color_picture, depth_picture
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument, view_of
from lucida.app.ui.uploads import Uploads
from lucida.renderer.system.errors import describe
from lucida.renderer.system.memo import Memo

STEPPER = "Stepper"
Pair = dict[Order, Recording]
LEAST_EM = 18.0  # the width and height of an algorithm; more than there is room for scrolls
LONGEST_FRAME_S = 0.25  # what a frame that took longer is taken for


class StepperView(Instrument):
    name = STEPPER
    title = "Loop stepper"

    def __init__(self, views: Sequence[Instrument]) -> None:
        self._outside = view_of(views, OutsideView)
        self._runs: Prepared[Pair] | None = None
        self._uploads: Uploads | None = None
        self._pictures: LoopPictures | None = None
        self._drawn: Prepared[Pair] | LoopPictures | None = None  # in the last frame
        self.playing = False
        self._before_s = 0.0  # when the last frame of playing was
        self._owed = 0.0  # parts of a step that have not been taken
        self._moment = Memo(moment_at, len(Order))
        self._put = {order: Memo(_put) for order in Order}
        self._items = Memo(run_items)
        self.moments: dict[Order, Moment] = {}
        self._asked: Wish = ""

    def ask(self, wish: Wish) -> None:
        """Ask for what a button or a key would, in the next frame."""
        self._asked = wish

    @property
    def settled(self) -> bool:
        return not (self.playing or (self._drawn is not None and self._drawn.busy))

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self._runs = Prepared("lucida-stepper", recordings, host.animate)
        self._uploads = Uploads(context)
        self._pictures = LoopPictures(context, host.animate)

    def end(self) -> None:
        if self._runs is not None:
            self._runs.close()
        if self._uploads is not None:
            self._uploads.release()
        if self._pictures is not None:
            self._pictures.release()

    def unseen(self, host: Host) -> None:
        self.playing, self._drawn = False, None
        self._asked = ""
        self._outside.show(STEPPER, ())

    def begin_anew(self) -> None:
        self.playing = False
        self._asked = ""

    def draw(self, host: Host) -> None:
        assert self._runs is not None and self._uploads is not None
        self._drawn = self._runs if host.has_tools else self._pictures
        if not host.has_tools:
            assert self._pictures is not None
            self._pictures.draw(host, self._outside, STEPPER)
            return
        self._uploads.begin_frame()
        options = host.state.options.stepper
        asked = controls(Asked(options, host.state.options.language), self.playing)
        host.edit(replace(host.options, language=asked.language))
        wish = self._asked or keys() or asked.wish
        self._asked = ""
        if asked.options != options:
            options = asked.options
            host.apply(host.state.with_options(options))
        state = host.state
        camera = state.view.for_size(options.canvas)
        made = self._runs.of(state.scene, camera, options.canvas)
        if self._runs.error is not None:
            imgui.text_colored(theme.ERROR, describe(self._runs.error))
            return
        if made is None:
            imgui.text_colored(theme.DIM, "preparing the scene for the stepper ...")
            host.animate()
            return
        orders = [one for one in Order if options.order in ("both", _key(one))]
        steps = self._moved(host, made, orders, options, wish)
        self._panels(host, made, orders, steps)
        self._show_outside(host, made, orders)

    # The runs' steps.

    def _moved(
        self, host: Host, made: Made[Pair], orders: list[Order], options: StepperOptions, wish: Wish
    ) -> tuple[int, int]:
        """Return the steps after this frame's wishes."""
        if wish == "play":
            self.playing = not self.playing
            self._before_s, self._owed = time.monotonic(), 0.0
            at_end = all(options.steps[_at(one)] >= len(made.value[one]) - 1 for one in orders)
            if self.playing and at_end:
                options = replace(options, steps=(0, 0))
        elif wish:
            self.playing = False
        taken = self._taken(options.speed) if self.playing else 0
        if self.playing:
            host.animate()
        steps = list(options.steps)
        for order in orders:
            run, at = made.value[order], _at(order)
            if (wish and wish != "play") or taken:
                steps[at] = _after(run, min(steps[at], len(run) - 1), wish, taken)
        if all(steps[_at(one)] >= len(made.value[one]) - 1 for one in orders):
            self.playing = False
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
        if tuple(steps) != host.state.options.stepper.steps:
            options = replace(host.state.options.stepper, steps=(steps[0], steps[1]))
            host.amend(host.state.with_options(options))

    # The panels.

    def _panels(
        self, host: Host, made: Made[Pair], orders: list[Order], steps: tuple[int, int]
    ) -> None:
        wanted, self.moments = list(steps), {}
        room, spacing = imgui.get_content_region_avail(), imgui.get_style().item_spacing
        count, least = len(orders), LEAST_EM * imgui.get_font_size()
        width = (room.x - spacing.x * (count - 1)) / count
        beside = room.x > room.y and (count == 1 or width > least)
        high = room.y if beside else (room.y - spacing.y * (count - 1)) / count
        size = ImVec2(width if beside else room.x, max(high, least))
        for number, order in enumerate(orders):
            run = made.value[order]
            moment = self.moments[order] = self._moment(run, steps[_at(order)])
            if number and beside:
                imgui.same_line()
            edges = imgui.ChildFlags_
            imgui.begin_child(order.value, size, edges.borders | edges.nav_flattened)
            texture = self._texture(host.state, run, moment)
            step = panel.run_panel(run, moment, texture, host.state, host.fonts)
            imgui.end_child()
            if step is not None:
                wanted[_at(order)], self.playing = step, False
        if wanted != list(steps):
            self._keep(host, wanted)

    def _texture(self, state: AppState, run: Recording, moment: Moment) -> int:
        """Return the canvas or the depth buffer, uploaded if it has changed."""
        assert self._uploads is not None
        name, exposure_ev = run.order.name, state.images.exposure_ev
        farthest = float(run.depth_t.upto(len(run.depth_t)).max(initial=0.0))
        depth = farthest if state.options.stepper.depth else None
        self._put[run.order](self._uploads, name, moment, depth, exposure_ev, theme.used())
        texture = self._uploads.get(name)
        assert texture is not None
        return texture.glo

    # In the outside view.

    def _show_outside(self, host: Host, made: Made[Pair], orders: list[Order]) -> None:
        """Show the current step there: rays, objects, and the canvas on the image plane. Point out
        its pixel in images of the canvas's size, unless the mouse points at something else.
        """
        shown = tuple(self.moments[o] for o in orders if o in self.moments)
        end = end_parameter(made.camera, host.focus.framed)
        last = orders[-1]
        is_live = made.camera == host.renderers.camera(host.state) and last in self.moments
        self._outside.show(
            STEPPER,
            self._items(made.camera, made.size, shown, end),
            picture=self._uploads.get(last.name) if is_live and self._uploads else None,
        )


def _put(
    uploads: Uploads,
    name: str,
    moment: Moment,
    farthest: float | None,
    exposure_ev: float,
    look: theme.WindowLook,
) -> None:
    """Upload a moment's canvas; its depth buffer if there is a farthest depth."""
    if farthest is None or moment.depth is None:
        uploads.put(name, color_picture(moment.canvas, exposure_ev))
    else:
        uploads.put(name, depth_picture(moment.depth, farthest))


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


def _key(order: Order) -> str:
    return "image" if order is Order.IMAGE else "object"


def _at(order: Order) -> int:
    """Return the index of an algorithm in StepperOptions.steps."""
    return 1 if order is Order.IMAGE else 0
