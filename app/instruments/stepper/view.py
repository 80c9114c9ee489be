"""The loop stepper: both algorithms, line by line, over the window's scene and camera.

The view steps through the recordings, and shows the current step in the outside view. panel.py
draws a run, model.py computes a step, pictures.py draws what a lecture shows.
"""

from __future__ import annotations

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
from .model import Moment, after, moment_at
from .outside_items import run_items
from .pictures import LoopPictures
from .recording import Recording
from .runs import Made, Prepared, recordings

STEPPER = "Stepper"
TITLES = "Object order: rasterization", "Image order: ray tracing"
LEAST_EM = 18.0  # the least width and height of an algorithm; a smaller window scrolls


class StepperView(Instrument):
    name = STEPPER
    title = "Loop stepper"
    keyboard = tuple((f"{step.shown} in the stepper", step.told) for step in panel.STEPS)

    def __init__(self, views: Sequence[Instrument]) -> None:
        self._outside = view_of(views, OutsideView)
        self._resources = ExitStack()
        self._drawn: Prepared[Any] | None = None  # in the last frame
        self._moment = Memo(moment_at, len(TITLES))
        self._items = Memo(run_items)
        self.moments: tuple[Moment, ...] = ()

    @property
    def settled(self) -> bool:
        return self._drawn is None or not self._drawn.busy

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self._canvases = Canvases(context)
        self._runs = Prepared("lucida-stepper", recordings, host.animate)
        self._pictures = LoopPictures(self._canvases, host.animate)
        for close in (self._canvases.release, self._runs.close, self._pictures.hits.close):
            self._resources.callback(close)

    def end(self) -> None:
        self._resources.close()

    def unseen(self, host: Host) -> None:
        self._drawn = None
        self._outside.show(STEPPER, ())

    def draw(self, host: Host) -> None:
        self._canvases.begin_frame()
        self._drawn = self._runs if host.has_tools else self._pictures.hits
        if not host.has_tools:
            self._pictures.draw(host, self._outside, STEPPER)
            return
        state, clicked = panel.controls(host.state)
        host.apply(state)
        wish = panel.keys() or clicked
        made = self._runs.current(host)
        if made is not None:
            if wish:
                steps = host.state.options.stepper.steps
                moved = (after(*one, wish) for one in zip(made.value, steps, strict=True))
                self._keep(host, tuple(moved))
            self._panels(host, made.value)
            self._show_outside(host, made)

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
            texture = self._canvases.texture(TITLES[number], moment.canvas, exposure_ev)
            step = panel.run_panel(TITLES[number], run, moment, texture.glo, host.state, host.fonts)
            imgui.end_child()
            if step is not None:
                steps = host.state.options.stepper.steps
                self._keep(host, (*steps[:number], step, *steps[number + 1 :]))

    def _show_outside(self, host: Host, made: Made[tuple[Recording, ...]]) -> None:
        """Show the current step in the outside view: rays, objects, the canvas."""
        end = end_parameter(made.camera, host.focus.framed)
        is_live = made.camera == host.renderers.camera(host.state)
        picture = self._canvases.get(TITLES[1]) if is_live else None
        items = self._items(made.camera, made.size, self.moments, end)
        self._outside.show(STEPPER, items, picture=picture)
