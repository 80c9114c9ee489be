"""The mistakes: a laboratory of wrong lines, and a quiz on them, as a view.

Keeps the requests to the pictures' thread, the present question, and its drawing in the outside
view. model.py and question.py decide on the pictures; pages.py draws them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import moderngl
import numpy as np
from imgui_bundle import ImVec2, imgui

from app.images.ray_pictures import RayPictures
from app.instruments.mistakes import model, pages, panel, question
from app.instruments.mistakes.model import Compared, Situation
from app.instruments.mistakes.pages import Made, Page, put_pictures
from app.instruments.mistakes.question import CHOICES
from app.instruments.outside.diagram import Item
from app.instruments.outside.extent import end_parameter
from app.instruments.outside.second_camera import SecondCamera, second_camera
from app.instruments.outside.view import OutsideView
from app.state.options.mistakes import MistakesOptions
from app.state.options.shared import Pixel
from app.ui import theme
from app.ui.coded_text import coded_text
from app.ui.host import Host
from app.ui.instrument import Instrument, view_of
from app.ui.uploads import Uploads
from renderer.system.errors import LucidaError, describe
from renderer.system.memo import Memo

MISTAKES = "Mistakes"
LEAST_EM = 9.0  # the page's height, at least: lower ones are scrolled


class MistakesView(Instrument):
    """made: the pictures that are shown; None before the first."""

    name = MISTAKES
    title = "Mistakes"

    def __init__(self, views: Sequence[Instrument]) -> None:
        self._outside = view_of(views, OutsideView)
        self._pictures: RayPictures[Made] | None = None
        self._uploads: Uploads | None = None
        self._put = Memo(put_pictures)
        self._items = Memo(_outside_items)
        self._stands: tuple[Any, tuple[str, ...]] = (None, ())  # a question's key, and its names
        self._asked: list[panel.Wish | int | None] = []  # by keys and clicks, for the next frame
        self._seen = self._told = False
        self.made: Made | None = None

    def ask(self, wish: panel.Wish | int) -> None:
        """Ask for what a button, or the number of an answer, would do; for the next frame."""
        self._asked.append(wish)

    @property
    def settled(self) -> bool:
        if not self._seen or self._pictures is None:
            return True
        return not (self._pictures.busy or self._asked)

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
        self._asked.clear()
        self._outside.show(MISTAKES, ())

    def begin_anew(self) -> None:
        self._stands = (None, ())
        self._asked.clear()

    def draw(self, host: Host) -> None:
        assert self._uploads is not None
        self._uploads.begin_frame()
        self._seen = True
        host.renderers.need_size(host.state.images)
        self._draw(host, self._uploads)
        self._show_outside(host)

    def _draw(self, host: Host, uploads: Uploads) -> None:
        now = model.situation_of(host.state, host.renderers.size)
        options = host.state.options.mistakes
        self.made = self._follow(host, now, options)
        if host.has_tools:
            changed, wish = panel.controls(options, bool(self._names(options, now)))
            if changed != options:
                host.change(host.state.with_options(changed))
            self._grant(host, now, wish)
        error = self._problem(host.state.options.mistakes)
        if error:
            width = imgui.get_content_region_avail().x
            coded_text(error, width, theme.ERROR, host.fonts)
        room = imgui.get_content_region_avail()
        is_told = host.state.options.mistakes.revealed
        if imgui.begin_child("page", room, imgui.ChildFlags_.nav_flattened):
            if is_told and not self._told:
                imgui.set_scroll_y(0.0)  # where the reason stands
            self._told = is_told
            # What fits beside a scrollbar only must not take it away, and come back with it.
            width = room.x - imgui.get_style().scrollbar_size
            height = max(room.y, LEAST_EM * imgui.get_font_size())
            exposure_ev = host.state.images.exposure_ev
            try:
                size, aspect = ImVec2(width, height), now.size[0] / now.size[1]
                notation = host.state.options.notation
                page = Page(size, aspect, host.fonts, exposure_ev, uploads, self._put, notation)
                self._page(host, now, page)
            except LucidaError as problem:  # no memory for the textures
                imgui.text_colored(theme.ERROR, describe(problem))
        imgui.end_child()

    def _page(self, host: Host, now: Situation, page: Page) -> None:
        options = host.state.options.mistakes
        if options.mode != "laboratory":
            clicked = pages.quiz(page, self.made, options)
            if clicked is not None:
                self.ask(clicked)
                host.animate()
            return
        answer = pages.laboratory(page, now, self.made, options)
        if answer.chosen is not None:
            host.change(
                host.state.with_options(replace(host.state.options.mistakes, chosen=answer.chosen))
            )
        elif answer.pixel is not None and self.made is not None:
            self._mark(host, self.made.now, answer.pixel)

    def _mark(self, host: Host, now: Situation, pixel: Pixel) -> None:
        """Marks a pixel in all views, or takes the mark away."""
        images = host.renderers.size
        marked = None if now.pixel == pixel else model.scaled_pixel(pixel, now.size, images)
        host.change(host.state.with_options(replace(host.state.options, marked=marked)))

    def _problem(self, options: MistakesOptions) -> str:
        """Return the error in words, or ""."""
        assert self._pictures is not None
        if self._pictures.error is not None:
            return describe(self._pictures.error)
        names = (*options.chosen, *([options.asked] if options.asked else []))
        unknown = model.unknown(names)
        if unknown:
            return f'There is no mistake "{unknown[0]}"; the lines\' menus have their names.'
        return ""

    # From the state to the pictures.

    def _follow(self, host: Host, now: Situation, options: MistakesOptions) -> Made | None:
        """The pictures of this state, or the last ones while these are on their way."""
        assert self._pictures is not None
        scene, live = host.state.scene, host.renderers.live
        if options.mode == "laboratory":
            mistakes = model.named(now.program, options.chosen)
            made = self._pictures.follow(
                (now, mistakes),
                scene,
                live,
                lambda painter: Made(
                    None, now, mistakes, compared=model.compared(painter, now, mistakes)
                ),
            )
            return made if made is not None and made.compared is not None else None
        key, names = self._key(options, now), self._names(options, now)
        made = self._pictures.follow(
            (now, key, options.names),
            scene,
            live,
            lambda painter: Made(
                key, now, question=question.question(painter, now, options, names)
            ),
        )
        if made is None or made.question is None or made.of != key:
            return None
        if not names:
            self._stands = (key, made.question.names)
        return made

    def _key(self, options: MistakesOptions, now: Situation) -> Any:
        """Return what a question is drawn from, besides what the camera can distinguish."""
        return options.seed, options.asked, now.program

    def _names(self, options: MistakesOptions, now: Situation) -> tuple[str, ...]:
        """Return the names of the present question, which stays while the camera moves."""
        known = {mistake.name for mistake in now.program.mistakes}
        if len(options.names) == CHOICES and known.issuperset(options.names):
            return options.names
        key, names = self._stands
        return names if key == self._key(options, now) else ()

    # What was asked for.

    def _grant(self, host: Host, now: Situation, wish: panel.Wish) -> None:
        asked, self._asked = [*self._asked, wish], []
        if host.state.options.mistakes.mode != "laboratory":
            asked.append(panel.key_answer())
        for one in asked:
            options = host.state.options.mistakes
            changed = self._changed(options, self._names(options, now), one)
            if changed != options:
                host.change(host.state.with_options(changed))

    def _changed(
        self, options: MistakesOptions, names: tuple[str, ...], wish: panel.Wish | int | None
    ) -> MistakesOptions:
        """Return the options after a request."""
        if wish == "right":
            return replace(options, chosen=())
        if options.mode == "laboratory":
            return options
        if wish == "next":
            return question.next_question(options)
        if wish == "reveal":
            return question.revealed(options, names)
        return question.answered(options, names, wish) if isinstance(wish, int) else options

    # What the outside view shows.

    def _show_outside(self, host: Host) -> None:
        """The camera of the wrong lines, and its ray; not in the quiz: it would be the answer."""
        made = self.made
        if made is None or made.compared is None or not made.mistakes:
            self._outside.show(MISTAKES)
            return
        now = made.now
        end = end_parameter(now.camera, host.focus.framed)
        items = self._items(now, made.compared, end)
        self._outside.show(MISTAKES, items, answer=tuple(one.name for one in made.mistakes))


def _outside_items(now: Situation, compared: Compared, end: float) -> list[Item]:
    middle = (now.size[1] - 1) / 2, (now.size[0] - 1) / 2
    reach = end * float(np.linalg.norm(now.camera.ray(*middle, now.size).direction))
    first = f"pixel {now.indexing.text((0, 0))}"
    seen = SecondCamera(*compared.corners, compared.ray, pages.STUDENTS, first)
    return [*second_camera(seen, reach)]
