"""The laboratory's page "Displays": its clock, its switches, and the light of one pixel over time.

Keeps the phase while it plays; laboratory/displays.py computes the picture. While nothing plays, or
the page is hidden, it asks for no frames.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from imgui_bundle import ImVec2, imgui
from numpy.typing import NDArray

from app.host.view import Host
from app.laboratory import displays
from app.laboratory.displays import DISPLAYS
from app.laboratory.light import CHANNELS
from app.laboratory.options import LaboratoryOptions
from app.laboratory.pages import Image, PageInput, PagePlan, display_part
from app.laboratory.schemes import NAMES, Scheme
from app.laboratory.tables import BARS
from app.state.bounds import range_of
from app.state.options import Pixel
from app.widgets import theme
from app.widgets.lettering import fitting_words, lettering
from app.widgets.rows import follow
from app.widgets.sliders import slider_float
from renderer.memo import Memo

LONGEST_FRAME_S = 0.25  # what a frame that took longer is taken for
LANES_EM = 8.0  # of the page, below the pictures
SLIDER_EM, CYCLE_EM, SCHEME_EM = 9.0, 6.0, 14.0
LAST_PHASE = 1.0 - 1e-6  # 1 is 0 of the next cycle
CLAMP = int(imgui.SliderFlags_.always_clamp)


@dataclass(frozen=True, eq=False)
class _Lit:
    """The light of a pixel over a cycle, (n, 3), and the part of the image that it is in.

    place: of the pixel in the part. pixel: in the image. side: see display_part().
    """

    course: NDArray[np.float32]
    part: Image
    place: Pixel
    pixel: Pixel
    side: int


class DisplaysPage:
    """The displays' clock and the parts around their pictures."""

    def __init__(self) -> None:
        self._from: tuple[str, float] = ("", 0.0)  # the display and the phase it began with
        self._phase = 0.0
        self._before_s: float | None = None  # when the last frame of playing was
        self._size = (1, 1)  # rows and columns of what is seen
        self._lit = Memo(_lit)

    def unseen(self) -> None:
        """The clock rests."""
        self._before_s = None

    def now(self, host: Host, options: LaboratoryOptions) -> LaboratoryOptions:
        """The options with the present phase; while it plays, a next frame is asked for."""
        begun = options.display, options.phase % 1.0
        if begun != self._from or not options.playing:
            self._from, self._phase = begun, begun[1]
        if not options.playing or not host.moves:
            self._before_s = None
            return replace(options, phase=self._phase)
        now_s = time.monotonic()
        passed_s = 0.0 if self._before_s is None else min(now_s - self._before_s, LONGEST_FRAME_S)
        self._before_s = now_s
        self._phase = (self._phase + passed_s / options.cycle_s) % 1.0
        host.animate()
        return replace(options, phase=self._phase)

    def controls(self, host: Host) -> LaboratoryOptions:
        """Draw the switches. Return the present options, with the present phase."""
        options = self.now(host, host.state.of(LaboratoryOptions))
        asked = self._transport(options)
        if asked is not None:  # no step of undo, as with the stepper's steps
            playing, phase = asked
            host.amend(host.state.with_options(laboratory={"playing": playing, "phase": phase}))
            self._from, self._phase = (options.display, phase), phase
            options = replace(options, playing=playing, phase=phase)
        changed = _chosen(options)
        if changed != options:
            kept = {"display": changed.display, "cycle_s": changed.cycle_s}
            host.apply(host.state.with_options(laboratory=kept))
        return changed

    def _transport(self, options: LaboratoryOptions) -> tuple[bool, float] | None:
        """Play, steps, the place in the cycle: whether it is to play, and from where."""
        padding = 2 * imgui.get_style().frame_padding.x
        wide = imgui.calc_text_size("Pause").x + padding
        pressed = _key()
        if imgui.button(f"{'Pause' if options.playing else 'Play'}###play", ImVec2(wide, 0)):
            pressed = "play"
        imgui.set_item_tooltip("play and pause (Space)")
        for name, tip in (("Back", "one step back (Left)"), ("Step", "one step on (Right)")):
            follow(imgui.calc_text_size(name).x + padding)
            if imgui.button(name):
                pressed = name.lower()
            imgui.set_item_tooltip(tip)
        width = SLIDER_EM * imgui.get_font_size()
        follow(width)
        imgui.set_next_item_width(width)
        slid, percent = slider_float(
            "##of the cycle", 100 * options.phase, 0.0, 100.0, "%.0f %% of the cycle", CLAMP
        )
        if slid:
            return False, min(percent / 100, LAST_PHASE)
        if pressed == "play":
            return not options.playing, options.phase
        if pressed:
            by = 1 if pressed == "step" else -1
            return False, displays.stepped(options.display, options.phase, *self._size, by)
        return None

    def lanes(
        self,
        host: Host,
        options: LaboratoryOptions,
        plan: PagePlan,
        color: Image,
        pixel: Pixel,
    ) -> None:
        """Draw one pixel's red, green and blue light over a cycle, into the rest of the page."""
        display = DISPLAYS[options.display]
        exposure_ev = host.state.images.exposure_ev
        lit = self._lit(color, plan, replace(options, phase=0.0), exposure_ev, pixel)
        self._size = lit.part.shape[0], lit.part.shape[1]
        seen, shown, side = lit.pixel, lit.part[lit.place], lit.side
        corner, avail = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail()
        em, draw = imgui.get_font_size(), imgui.get_window_draw_list()
        name = host.state.options.indexing.text(seen)
        with lettering(host.fonts.bold):
            title = f"The light of pixel {name} over a cycle"
            draw.add_text(corner, theme.u32(theme.TEXT), title)
            used = imgui.calc_text_size(title).x + em
        times = float(display.gain(side).mean())
        told = f"gray: {display.gray}; fully on: {times:.1f} times white"
        note = fitting_words(told, avail.x - used)
        note = "" if note.endswith("...") else note
        draw.add_text(ImVec2(corner.x + used, corner.y), theme.u32(theme.DIM), note)
        low = ImVec2(corner.x + 5.0 * em, corner.y + 1.5 * em)
        height = max(0.8 * em, min(2.4 * em, (avail.y - 1.6 * em) / 3))
        scheme_px = (
            SCHEME_EM * em if options.display in NAMES and avail.x > 3 * SCHEME_EM * em else 0
        )
        width = max(1.0, avail.x - 5.0 * em - scheme_px)
        for channel in range(3):
            y = low.y + channel * height
            with lettering(host.fonts.mono):
                text = f"{CHANNELS[channel][0].upper()} {shown[channel]:.2f}"
                draw.add_text(
                    ImVec2(corner.x, y + 0.5 * (height - 1.2 * em)), theme.u32(theme.TEXT), text
                )
            lane = lit.course[:, channel]
            _lane(draw, lane, ImVec2(low.x, y), ImVec2(width, height - 3), BARS[channel])
        x = low.x + options.phase * width
        far = low.y + 3 * height
        draw.add_line(ImVec2(x, low.y - 2), ImVec2(x, far), theme.u32(theme.PANEL), 5.0)
        draw.add_line(ImVec2(x, low.y - 2), ImVec2(x, far), theme.u32(theme.TEXT), 2.0)
        if scheme_px:
            beside = ImVec2(low.x + width + em, low.y)
            _scheme(options, lit, Scheme(beside, ImVec2(scheme_px - em, far - low.y)))
        imgui.dummy(ImVec2(avail.x, far - corner.y))


def _lit(
    color: Image, plan: PagePlan, options: LaboratoryOptions, exposure_ev: float, pixel: Pixel
) -> _Lit:
    part, first, side, place = display_part(PageInput(color, plan, options, exposure_ev, pixel))
    course = displays.course(DISPLAYS[options.display], part, place)
    return _Lit(course, part, place, (first[0] + place[0], first[1] + place[1]), side)


def _scheme(options: LaboratoryOptions, lit: _Lit, scheme: Scheme) -> None:
    """Draw how the pixel that is addressed is made."""
    if options.display == "tube":
        at_work = displays.at_work("tube", options.phase, *lit.part.shape[:2])
        assert at_work is not None
        scheme.tube(lit.part[at_work[:2]])
    else:
        light = DISPLAYS["dlp"].light(lit.part, options.phase)
        scheme.dlp(options.phase, bool(light[lit.place].any()))


def _lane(draw: imgui.ImDrawList, light: Any, low: ImVec2, extent: ImVec2, color: str) -> None:
    """Light over time as an area: equal values side by side are one rectangle."""
    far = ImVec2(low.x + extent.x, round(low.y + extent.y))
    draw.add_rect_filled(low, far, theme.u32(theme.FRAME))
    heights = np.round(light * extent.y)
    ends = [*(np.flatnonzero(np.diff(heights)) + 1).tolist(), len(heights)]
    begin = 0
    for end in ends:
        if heights[begin] > 0:
            edges = (np.round(low.x + extent.x * at / len(heights)) for at in (begin, end))
            left, right = (ImVec2(float(x), far.y) for x in edges)
            left.y -= float(heights[begin])
            draw.add_rect_filled(left, right, theme.u32(theme.rgb(color)))
        begin = end


def _chosen(options: LaboratoryOptions) -> LaboratoryOptions:
    """Which display, and how slowly."""
    width = CYCLE_EM * imgui.get_font_size()
    follow(width)
    imgui.set_next_item_width(width)
    limits = range_of(LaboratoryOptions, "cycle_s")
    timed, cycle_s = slider_float("##a cycle", options.cycle_s, *limits, "%.0f s a cycle", CLAMP)
    imgui.set_item_tooltip("a real one takes a hundredth of a second or less")
    return replace(options, cycle_s=cycle_s) if timed else options


def _key() -> str:
    """Return what a key asks for while the page has the keys, which are taken from ImGui's
    navigation.
    """
    focused = int(imgui.InputFlags_.route_focused)
    repeated = focused | int(imgui.InputFlags_.repeat)
    pressed = [
        name
        for name, key, flags in (
            ("play", imgui.Key.space, focused),
            ("step", imgui.Key.right_arrow, repeated),
            ("back", imgui.Key.left_arrow, repeated),
        )
        if imgui.shortcut(int(key), flags)
    ]
    return pressed[0] if pressed and not imgui.is_any_item_active() else ""
