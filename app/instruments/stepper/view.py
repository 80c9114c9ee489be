"""The loop stepper: both algorithms, line by line, over the window's scene and camera.

The view plays the recordings, and shows the current step in the outside view. panel.py draws a run,
model.py computes a step, pictures.py draws what a lecture shows.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import replace
from typing import Any

import moderngl
from imgui_bundle import ImVec2, imgui

from lucida.app.instruments.outside.extent import end_parameter
from lucida.app.instruments.outside.view import OutsideView
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument, view_of
from lucida.renderer.system.memo import Memo

from . import panel
from .drawing import Canvases
from .model import Moment, Wish, after, moment_at
from .outside_items import run_items
from .pictures import LoopPictures
from .recording import Recording
from .runs import Made, Prepared, recordings

STEPPER = "Stepper"
TITLES = "Object order: rasterization", "Image order: ray tracing"
LEAST_EM = 18.0  # the width and height of an algorithm; more than there is room for scrolls
LONGEST_FRAME_S = 0.25  # what a frame that took longer is taken for


class StepperView(Instrument):
    name = STEPPER
    title = "Loop stepper"
    keyboard = tuple((f"{step.shown} in the stepper", step.told) for step in panel.STEPS)

    def __init__(self, views: Sequence[Instrument]) -> None:
        self._outside = view_of(views, OutsideView)
        self._resources = ExitStack()
        self._drawn: Prepared[Any] | None = None  # in the last frame
        self.playing = False
        self._before_s = 0.0  # when the last frame of playing was
        self._owed = 0.0  # parts of a step that have not been taken
        self._moment = Memo(moment_at, len(TITLES))
        self._items = Memo(run_items)
        self.moments: tuple[Moment, ...] = ()

    @property
    def settled(self) -> bool:
        return not (self.playing or (self._drawn is not None and self._drawn.busy))

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self._canvases = Canvases(context)
        self._runs = Prepared("lucida-stepper", recordings, host.animate)
        self._pictures = LoopPictures(self._canvases, host.animate)
        for close in (self._canvases.release, self._runs.close, self._pictures.hits.close):
            self._resources.callback(close)

    def end(self) -> None:
        self._resources.close()

    def unseen(self, host: Host) -> None:
        self.begin_anew()
        self._drawn = None
        self._outside.show(STEPPER, ())

    def begin_anew(self) -> None:
        self.playing = False

    def draw(self, host: Host) -> None:
        self._canvases.begin_frame()
        self._drawn = self._runs if host.has_tools else self._pictures.hits
        if not host.has_tools:
            self._pictures.draw(host, self._outside, STEPPER)
            return
        state, clicked = panel.controls(host.state, self.playing)
        host.apply(state)
        wish = panel.keys() or clicked
        made = self._runs.current(host)
        if made is not None:
            self._move(host, made.value, wish)
            self._panels(host, made.value)
            self._show_outside(host, made)

    def _move(self, host: Host, runs: tuple[Recording, ...], wish: Wish) -> None:
        """Take this frame's steps."""
        options = host.state.options.stepper
        ends = tuple(len(run) - 1 for run in runs)
        steps = tuple(map(min, options.steps, ends))
        now_s, self._before_s = time.monotonic(), self._before_s
        if wish == "play":
            self.playing, self._before_s, self._owed = not self.playing, now_s, 0.0
            if self.playing and steps == ends:
                steps = (0, 0)
        elif wish:
            self.playing = False
            steps = tuple(after(run, step, wish) for run, step in zip(runs, steps, strict=True))
        elif not self.playing:
            return
        if self.playing:
            self._owed += min(now_s - self._before_s, LONGEST_FRAME_S) * options.speed
            taken, self._before_s = int(self._owed), now_s
            self._owed -= taken
            steps = tuple(min(step + taken, end) for step, end in zip(steps, ends, strict=True))
            self.playing = steps != ends
            host.animate()
        self._keep(host, steps)

    def _keep(self, host: Host, steps: tuple[int, ...]) -> None:
        """Put the steps into the state, for lectures and sessions. Undo is for scenes and cameras,
        and does not revisit steps.
        """
        options = replace(host.state.options.stepper, steps=(steps[0], steps[1]))
        host.amend(host.state.with_options(options))

    def _panels(self, host: Host, runs: tuple[Recording, ...]) -> None:
        options, exposure_ev = host.state.options.stepper, host.state.images.exposure_ev
        self.moments = tuple(map(self._moment, runs, options.steps))
        room, spacing = imgui.get_content_region_avail(), imgui.get_style().item_spacing
        least, width = LEAST_EM * imgui.get_font_size(), (room.x - spacing.x) / 2
        beside = room.x > room.y and width > least
        high = room.y if beside else (room.y - spacing.y) / 2
        size = ImVec2(width if beside else room.x, max(high, least))
        for number, (run, moment) in enumerate(zip(runs, self.moments, strict=True)):
            if number and beside:
                imgui.same_line()
            edges = imgui.ChildFlags_
            imgui.begin_child(TITLES[number], size, edges.borders | edges.nav_flattened)
            shown = moment.canvas, exposure_ev
            if options.depth and moment.depth is not None:
                shown = moment.depth, run.farthest
            texture = self._canvases.texture(TITLES[number], *shown)
            step = panel.run_panel(TITLES[number], run, moment, texture.glo, host.state, host.fonts)
            imgui.end_child()
            if step is not None:
                self.playing = False
                steps = host.state.options.stepper.steps
                self._keep(host, (*steps[:number], step, *steps[number + 1 :]))

    def _show_outside(self, host: Host, made: Made[tuple[Recording, ...]]) -> None:
        """Show the current step there: rays, objects, and the canvas on the image plane."""
        end = end_parameter(made.camera, host.focus.framed)
        is_live = made.camera == host.renderers.camera(host.state)
        picture = self._canvases.get(TITLES[1]) if is_live else None
        items = self._items(made.camera, made.size, self.moments, end)
        self._outside.show(STEPPER, items, picture=picture)
