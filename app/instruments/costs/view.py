"""The cost plot: the steps of both loops, against triangles or pixels."""

from __future__ import annotations

from dataclasses import replace

import moderngl
from imgui_bundle import ImVec2, imgui, implot

from lucida.app.ui import theme
from lucida.app.ui.checks import radio_button
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument
from lucida.app.ui.rows import follow

from . import plots
from .recorded import COSTS, GROWTH

COSTS_VIEW = "Costs"


class CostsView(Instrument):
    name = COSTS_VIEW
    title = "Costs"

    def begin(self, host: Host, context: moderngl.Context) -> None:
        if implot.get_current_context() is None:
            implot.create_context()

    def draw(self, host: Host) -> None:
        unit = host.state.options.costs.against
        if host.has_tools:
            imgui.align_text_to_frame_padding()
            imgui.text("against")
            for name in COSTS:
                follow(imgui.calc_text_size(name).x + 1.5 * imgui.get_frame_height())
                if radio_button(name, unit == name):
                    host.edit(replace(host.options.costs, against=name))
        room = imgui.get_content_region_avail()
        if not host.has_tools:
            plots.draw(unit, room)
            return
        notes = list(zip(GROWTH[unit], map(plots.color_of, (False, True)), strict=True))
        gap = imgui.get_style().item_spacing.y
        below = sum(imgui.calc_text_size(note, wrap_width=room.x).y + gap for note, _ in notes)
        plots.draw(unit, ImVec2(room.x, max(60.0, room.y - below - gap)))
        imgui.push_text_wrap_pos(0.0)
        for note, color in notes:
            imgui.text_colored(theme.legible(color), note)
        imgui.pop_text_wrap_pos()
