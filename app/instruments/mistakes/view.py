"""The mistakes laboratory: wrong lines that can be switched on, and the pictures that they make."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import moderngl
import numpy as np
from imgui_bundle import ImVec2, imgui

from lucida.app.images.changed_pixels import changed_pixels, difference_picture
from lucida.app.images.ray_pictures import RayPictures
from lucida.app.instruments.outside.diagram import Item
from lucida.app.instruments.outside.extent import end_parameter
from lucida.app.instruments.outside.second_camera import second_camera, second_ray
from lucida.app.instruments.outside.view import OutsideView
from lucida.app.state.options.mistakes import MistakesOptions
from lucida.app.state.options.shared import Pixel
from lucida.app.ui import theme
from lucida.app.ui.checks import checkbox
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument, view_of
from lucida.app.ui.messages import wrapped
from lucida.app.ui.picture_grid import GridPicture, picture_grid
from lucida.app.ui.rows import button_width, follow
from lucida.app.ui.uploads import Uploads
from lucida.renderer.images import to_srgb8
from lucida.renderer.system.errors import LucidaError, describe
from lucida.renderer.system.memo import Memo

from . import model, panel
from .model import Compared, Situation

MISTAKES = "Mistakes"
STUDENTS = "student's"  # the name of the wrong picture, and of its camera in the outside view
LEAST_EM = 9.0  # the least height of the page; a lower view scrolls
WIDE = 1.2  # width / height from which the pictures are next to the text
TEXT_PART = 0.47  # the part of the width that the text then has
GAP_EM = 0.8
LEAST_PICTURES_EM = 8.0  # the least height of pictures below the text


class MistakesView(Instrument):
    """made: the pictures on screen; None before the first."""

    name = MISTAKES
    title = "Mistakes"

    def __init__(self, views: Sequence[Instrument]) -> None:
        self._outside = view_of(views, OutsideView)
        self._pictures: RayPictures[Compared] | None = None
        self._uploads: Uploads | None = None
        self._put = Memo(_put_pictures)
        self._items = Memo(_outside_items)
        self._seen = False
        self.made: Compared | None = None

    @property
    def settled(self) -> bool:
        return not self._seen or self._pictures is None or not self._pictures.busy

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self._pictures = RayPictures("lucida-mistakes", host.animate)
        self._uploads = Uploads(context)

    def end(self) -> None:
        if self._pictures is not None:
            self._pictures.close()
        if self._uploads is not None:
            self._uploads.release()

    def unseen(self, host: Host) -> None:
        if self._pictures is None or not self._seen:
            return
        self._pictures.forget()
        self._put.forget()
        self._seen, self.made = False, None
        self._outside.show(MISTAKES, ())

    def draw(self, host: Host) -> None:
        assert self._uploads is not None and self._pictures is not None
        self._uploads.begin_frame()
        self._seen = True
        host.renderers.need_size(host.state.images)
        now = model.situation_of(host.state, host.renderers.size)
        mistakes = model.named(now.program, host.state.options.mistakes.chosen)
        self.made = self._pictures.follow(
            (now, mistakes),
            host.state.scene,
            host.renderers.live,
            lambda painter: model.compared(painter, now, mistakes),
        )
        if host.has_tools:
            self._controls(host)
        for problem in self._problems(host.state.options.mistakes):
            wrapped(problem, theme.ERROR)
        room = imgui.get_content_region_avail()
        if imgui.begin_child("page", room, imgui.ChildFlags_.nav_flattened):
            # Always leave space for the scrollbar; otherwise it could flicker.
            width = room.x - imgui.get_style().scrollbar_size
            height = max(room.y, LEAST_EM * imgui.get_font_size())
            try:
                self._page(host, now, ImVec2(width, height))
            except LucidaError as error:  # no memory for the textures
                imgui.text_colored(theme.ERROR, describe(error))
        imgui.end_child()
        self._show_outside(host)

    def _controls(self, host: Host) -> None:
        options = host.state.options.mistakes
        _, on = checkbox("difference", options.difference)
        imgui.set_item_tooltip("a picture of the pixels that the wrong lines change")
        changed = replace(options, difference=on)
        if options.chosen:
            follow(button_width("Undo all mistakes"))
            if imgui.button("Undo all mistakes"):
                changed = replace(changed, chosen=())
            imgui.set_item_tooltip("make every line correct again")
        if changed != options:
            host.change(host.state.with_options(changed))

    def _problems(self, options: MistakesOptions) -> list[str]:
        assert self._pictures is not None
        if self._pictures.error is not None:
            return [describe(self._pictures.error)]
        return [
            f'There is no mistake "{name}"; the lines\' menus have their names.'
            for name in model.unknown(options.chosen)
        ]

    def _page(self, host: Host, now: Situation, room: ImVec2) -> None:
        """Draw the program, the explanations of its mistakes, and the pictures."""
        options = host.state.options.mistakes
        program = now.program.shown()
        mistakes = model.named(program, options.chosen)
        corner = imgui.get_cursor_screen_pos()
        is_wide = room.x > WIDE * room.y
        width = TEXT_PART * room.x if is_wide else room.x
        clicked = panel.program_lines(program, mistakes, width, host.fonts)
        for one in mistakes:
            wrapped(f"{one.hint} (lecture: {one.part})", width=width)
        if is_wide:
            left = width + GAP_EM * imgui.get_font_size()
            imgui.set_cursor_screen_pos(ImVec2(corner.x + left, corner.y))
            for_pictures = ImVec2(max(1.0, room.x - left), room.y)
        else:
            below = room.y - (imgui.get_cursor_screen_pos().y - corner.y)
            for_pictures = ImVec2(room.x, max(LEAST_PICTURES_EM * imgui.get_font_size(), below))
        pixel = self._draw_pictures(host, now, for_pictures)
        if clicked is not None:
            chosen = (
                model.without_line(program, options.chosen, clicked.key)
                if clicked.mistake is None
                else model.switched(program, options.chosen, clicked.mistake.name)
            )
            host.change(host.state.with_options(replace(options, chosen=chosen)))
        elif pixel is not None and self.made is not None:
            self._mark(host, self.made.of, pixel)

    def _draw_pictures(self, host: Host, now: Situation, room: ImVec2) -> Pixel | None:
        """Draw the correct picture, the wrong one, and their difference. Return the clicked pixel,
        or None.
        """
        made, uploads = self.made, self._uploads
        assert uploads is not None
        if made is None:
            imgui.text_colored(theme.DIM, "the first pictures are being traced ...")
            return None
        told = self._put(uploads, made, host.state.images.exposure_ev)
        pixel = now.pixel if made.of.size == now.size else None
        shown = [GridPicture("right", "correct", uploads.get("right"), pixel=pixel)]
        if made.mistakes:
            color, wrong = panel.wrong_color(), uploads.get("wrong")
            shown.append(GridPicture("wrong", STUDENTS, wrong, "", color, pixel))
            if host.state.options.mistakes.difference:
                difference = uploads.get("difference")
                shown.append(GridPicture("difference", "difference", difference, told))
        return picture_grid(shown, made.of.size, room, host.fonts)

    def _mark(self, host: Host, now: Situation, pixel: Pixel) -> None:
        """Mark a pixel in all views, or clear its mark."""
        images = host.renderers.size
        marked = None if now.pixel == pixel else model.scaled_pixel(pixel, now.size, images)
        host.change(host.state.with_options(replace(host.state.options, marked=marked)))

    def _show_outside(self, host: Host) -> None:
        """Show the camera of the wrong lines in the outside view, and the marked pixel's ray."""
        made = self.made
        if made is None or not made.mistakes:
            self._outside.show(MISTAKES)
            return
        items = self._items(made, end_parameter(made.of.camera, host.focus.framed))
        self._outside.show(MISTAKES, items)


def _put_pictures(uploads: Uploads, made: Compared, exposure_ev: float) -> str:
    """Upload the pictures. Return the size of their difference, in words.

    Raises LucidaError if there is no memory for them.
    """
    right, wrong = (to_srgb8(light, exposure_ev) for light in (made.right, made.wrong))
    changed = changed_pixels(right, wrong)
    uploads.put_pixels("right", right)
    uploads.put_pixels("wrong", wrong)
    uploads.put_pixels("difference", difference_picture(right, changed))
    return model.told_difference(changed)


def _outside_items(made: Compared, end: float) -> list[Item]:
    now = made.of
    middle = (now.size[1] - 1) / 2, (now.size[0] - 1) / 2
    reach = end * float(np.linalg.norm(now.camera.ray(*middle, now.size).direction))
    first = f"pixel {now.indexing.text((0, 0))}"
    items = second_camera(*made.corners, reach, STUDENTS, first)
    return items if made.ray is None else items + second_ray(made.ray, reach)
