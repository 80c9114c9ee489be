"""The cost plot as a view: it measures in the background while it is visible."""

from __future__ import annotations

from dataclasses import asdict, replace

import moderngl
from imgui_bundle import ImVec2, imgui, implot

from app.costs import panel, recorded
from app.costs.model import Case, Meter, cases, steps
from app.costs.options import CostOptions
from app.host.view import DockedView, Host
from app.widgets import theme

COSTS = "Costs"
POINTS = 6  # a curve
EXPLAINED = (
    "These count the work of the lecture's two loops, with a tree of boxes for the rays: the same"
    " on every machine. Where times are flat, they are what every image costs."
)


class CostsView(DockedView):
    name = COSTS
    title = "Costs"

    def __init__(self) -> None:
        self._meter: Meter | None = None
        self._asked: tuple[Case, ...] = ()

    @property
    def settled(self) -> bool:
        return self._meter is None or not self._meter.waiting

    @property
    def meter(self) -> Meter | None:
        return self._meter

    def begin(self, host: Host, context: moderngl.Context) -> None:
        if implot.get_current_context() is None:
            implot.create_context()
        self._meter = Meter(host.animate)

    def end(self) -> None:
        if self._meter is not None:
            self._meter.close()

    def unseen(self, host: Host) -> None:
        if self._meter is not None:
            self._meter.unwatch()
            self._meter.ask(())
            self._asked = ()

    def draw(self, host: Host) -> None:
        meter = self._meter
        assert meter is not None
        options = host.state.of(CostOptions)
        if options.against != "triangles":
            options = replace(options, recorded=False)
        wanted = _cases(options)
        samples = [one for one in meter.samples if one.case in wanted]
        images = dict.fromkeys(case.image for case in wanted)
        work = [meter.work[image] for image in images if image in meter.work]
        told = panel.CostReport(work, samples, meter.history, meter.waiting, meter.problems)
        if options.recorded:
            told = panel.CostReport(recorded.WORK, recorded.SAMPLES, (), 0, {}, "recorded")
        changed, again = panel.controls(options, told) if host.has_tools else (options, False)
        if changed != options:
            changed = replace(changed, recorded=False)
            host.apply(host.state.with_options(costs=asdict(changed)))
        if again and not options.recorded:
            meter.clear()
            self._asked = ()
        self._ask(meter, changed)
        for renderer, problem in told.problems.items():
            imgui.text_colored(theme.ERROR, f"{renderer}: {problem}")
        room = imgui.get_content_region_avail()
        said = panel.said(options, told)
        roomy = room.y > 20 * imgui.get_font_size()
        explained = EXPLAINED if roomy and options.against != "frames" else ""
        if options.recorded:
            explained = f"{recorded.MACHINE} {explained}".strip()
        notes = [line for _, line in said] + ([explained] if explained else [])
        gap = imgui.get_style().item_spacing.y
        below = sum(imgui.calc_text_size(note, wrap_width=room.x).y + gap for note in notes)
        panel.plot(options, told, ImVec2(room.x, max(60.0, room.y - below - gap)))
        imgui.push_text_wrap_pos(0.0)
        for renderer, line in said:
            imgui.text_colored(theme.legible(panel.color_of(renderer)), line)
        if explained:
            imgui.text_colored(theme.DIM, explained)
        imgui.pop_text_wrap_pos()

    def _ask(self, meter: Meter, options: CostOptions) -> None:
        """Request the cases to measure now."""
        if options.recorded:
            return
        if options.against == "frames":
            self._asked = ()
            meter.ask(())
            meter.watch(options.triangles, options.pixels)
            return
        meter.unwatch()
        wanted = tuple(_cases(options))
        # Not while a slider is dragged: each of its values would be measured.
        if wanted != self._asked and not imgui.is_any_item_active():
            self._asked = wanted
            meter.ask(wanted)


def _cases(options: CostOptions) -> list[Case]:
    """Return a curve for each renderer; none for frames, which are watched."""
    if options.against == "frames":
        return []
    counts = steps(*panel.extent(options.against), POINTS)
    if options.against == "triangles":
        return cases(counts, (options.pixels,))
    return cases((options.triangles,), counts)
