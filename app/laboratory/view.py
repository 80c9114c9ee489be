"""The image laboratory: the current image in the representations that the lecture names.

The rasterizer draws the image at the page's own size, a thread makes the page's pictures of it
(laboratory/pages.py), and this view puts them on the screen. The parts around the pictures are in
array_view.py, displays_view.py and vector_view.py.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import moderngl
from imgui_bundle import ImVec2, imgui

from app.host.view import DockedView, Host
from app.images.request import ImageRequest
from app.images.screen import available_px
from app.laboratory.array_view import ArrayPage, program_em
from app.laboratory.displays_view import LANES_EM, DisplaysPage
from app.laboratory.made_page import MadePage, PageKey, Source, drawn_image, made_page
from app.laboratory.options import LaboratoryOptions
from app.laboratory.pages import Image, PagePlan, Panel, plan
from app.laboratory.pictures import HEADING_EM, draw_panel
from app.laboratory.schemes import below_wall
from app.laboratory.tables import luminance_weights
from app.laboratory.tools import toolbar
from app.laboratory.vector_view import VectorPage
from app.outside.view import OutsideView
from app.state.app_state import AppState
from app.state.options import Pixel
from app.widgets import theme
from app.widgets.background import Background
from app.widgets.messages import wrapped
from app.widgets.theme import framebuffer_scale
from app.widgets.uploads import Uploads
from renderer.errors import LucidaError, describe
from renderer.memo import same

LABORATORY = "Laboratory"
SMALLEST_PX = 60
GAP_EM = 0.6
PROJECTORS_EM = 5.0  # below their pictures
ROWS_EM = 13.0  # of the pictures with their titles, two rows of them, at the least
LEAST_EM = {"heights": 8.0, "displays": 8.4, "array": 19.0}  # of pages that are otherwise
TWO_COLUMNS_EM = 30.0  # of the array page, whose parts stand below one another in less
PROGRAM_EM = 20.0  # of a part of it, which is without its program in less
ABOUT_A_PIXEL = ("displays", "array")  # a click on these pages chooses it


class LaboratoryView(DockedView):
    name = LABORATORY
    title = "Image laboratory"

    def __init__(self, outside: OutsideView) -> None:
        self.vector = VectorPage(outside)
        self.displays = DisplaysPage()
        self._vector_seen = False
        self._uploads: Uploads | None = None
        self._work: Background[MadePage] | None = None
        self.source: Source | None = None
        self._asked: PageKey | None = None
        self._made: MadePage | None = None
        self._error = ""
        self._seen = False
        self._others = (0, 0)  # the size of the other views' images

    @property
    def settled(self) -> bool:
        if not self._seen or self._error:
            return True
        if self._vector_seen:
            return self.vector.settled
        busy = self._work is not None and self._work.busy
        return not busy and self._made is not None and same(self._made.key, self._asked)

    @property
    def made(self) -> tuple[Panel, ...]:
        """The pictures that are shown; none on the page that is a view of its own."""
        if self._vector_seen:
            return ()
        return self._made.panels if self._made is not None else ()

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self._uploads = Uploads(context)
        self._work = Background("lucida-laboratory", host.animate)
        self.vector.begin(host)

    def end(self) -> None:
        self.vector.end()
        if self._work is not None:
            self._work.close()
        if self._uploads is not None:
            self._uploads.release()

    def unseen(self, host: Host) -> None:
        self._seen = False
        self.displays.unseen()
        self.source = None  # a large array; drawn anew when it is seen

    def draw(self, host: Host) -> None:
        assert self._uploads is not None
        self._uploads.begin_frame()
        self._seen = min(available_px()) >= SMALLEST_PX
        if not self._seen:
            return
        self._others = host.renderers.size
        options = toolbar(host) if host.has_tools else host.state.of(LaboratoryOptions)
        if options.page == "displays":
            now = self.displays.now
            options = self.displays.controls(host) if host.has_tools else now(host, options)
        else:
            self.displays.unseen()
        self._vector_seen = options.page == "vector"
        if self._vector_seen:
            self._vector_page(host, options)
        else:
            self._page(host, options)

    # The page.

    def _vector_page(self, host: Host, options: LaboratoryOptions) -> None:
        assert self._uploads is not None
        try:
            self.vector.draw(host, options, self._uploads)
            self._error = ""
        except (LucidaError, moderngl.Error) as error:
            self._error = describe(error)
            wrapped(self._error, theme.ERROR)

    def _page(self, host: Host, options: LaboratoryOptions) -> None:
        """Scrolled where the window is too low for it."""
        avail, em = imgui.get_content_region_avail(), imgui.get_font_size()
        below = self._below_px(options)
        least = below + LEAST_EM.get(options.page, ROWS_EM) * em
        is_short = False
        if options.page == "array":
            least, is_short = self._array_least(host, avail, least)
        if avail.y >= least:
            self._content(host, options, avail, below, is_short)
            return
        # The scrollbar is there by this alone: its width changes nothing that it depends on.
        flags = int(imgui.WindowFlags_.always_vertical_scrollbar)
        if imgui.begin_child("page", avail, imgui.ChildFlags_.nav_flattened, flags):
            corner = imgui.get_cursor_screen_pos()
            width = imgui.get_content_region_avail().x
            self._content(host, options, ImVec2(width, least), below, is_short)
            imgui.set_cursor_screen_pos(ImVec2(corner.x, corner.y + least))
            imgui.dummy(ImVec2(0.0, 0.0))
        else:
            self._seen = False  # no room for any of it
        imgui.end_child()

    def _array_least(self, host: Host, avail: ImVec2, least: float) -> tuple[float, bool]:
        """Return the least height of the array page, and True if its parts stand side by side in
        a page that is not wide, too. least: side by side, without the program.
        """
        em, size = imgui.get_font_size(), host.renderers.size
        half = avail.x / 2 - GAP_EM * em
        beside = least
        if half >= PROGRAM_EM * em:
            beside = max(least, (2 * program_em(host.state, size, half) + GAP_EM) * em)
        program = program_em(host.state, size, avail.x - imgui.get_style().scrollbar_size)
        stacked = max(2 * least, (4 * program + 3 * GAP_EM) * em)
        is_narrow = avail.x < TWO_COLUMNS_EM * em
        is_short = avail.y < stacked and not (is_narrow and avail.y < beside)
        return beside if is_short else stacked if is_narrow else beside, is_short

    def _content(
        self,
        host: Host,
        options: LaboratoryOptions,
        avail: ImVec2,
        below: float,
        is_short: bool = False,
    ) -> None:
        """Draw a page.

        avail: the room for all of it. below: how much of that is below the pictures. is_short:
        leave out what there is no room for.
        """
        state, scale, em = host.state, framebuffer_scale(), imgui.get_font_size()
        corner = imgui.get_cursor_screen_pos()
        room = max(1, int(avail.x * scale)), max(1, int((avail.y - below) * scale))
        heading = round(HEADING_EM * em * scale)
        gap, resolution = round(GAP_EM * em * scale), state.images.resolution
        divided = plan(options.page, room, heading, gap, resolution, options.apart, is_short)
        self._follow(host, divided, options)
        if self._error:
            wrapped(self._error, theme.ERROR)
            return
        if self._made is None or self.source is None:
            return
        if self._made.is_stale(state.scene, options, divided):
            return
        made = self._made.plan

        def place(number: int) -> ImVec2:
            row, column = divmod(number, made.columns)
            return ImVec2(
                corner.x + column * (made.cell[0] / scale + GAP_EM * em),
                corner.y + row * (made.cell[1] / scale + (HEADING_EM + GAP_EM) * em),
            )

        if options.page == "array":
            self._array_page(host, self._made, self.source.color, place)
            return
        for number, panel in enumerate(self._made.panels):
            self._panel(host, number, panel, place(number), made)
        if options.page == "projectors":
            at = place(0)
            below_wall(ImVec2(at.x, at.y + HEADING_EM * em), corner.y + avail.y, options, made)
        if options.page == "displays":
            imgui.set_cursor_screen_pos(ImVec2(corner.x, corner.y + avail.y - below + 0.4 * em))
            pixel = self._pixel(state, made)
            self.displays.lanes(host, options, made, self.source.color, pixel)
        if options.page == "kinds":
            extent = ImVec2(made.cell[0] / scale, made.cell[1] / scale + HEADING_EM * em)
            luminance_weights(place(len(self._made.panels)), extent, host.fonts)

    def _array_page(
        self, host: Host, made: MadePage, color: Image, place: Callable[[int], ImVec2]
    ) -> None:
        """The image, framed where the cells are from; the cells, the program, the memory."""
        scale, em = framebuffer_scale(), imgui.get_font_size()
        # The image may be newer than what the thread has made, and of another size.
        now = replace(made.plan, image=(color.shape[1], color.shape[0]))
        pixel = self._pixel(host.state, now)
        extent = ImVec2(made.plan.cell[0] / scale, made.plan.cell[1] / scale + HEADING_EM * em)
        page = ArrayPage(host.state, color, pixel, extent, host.fonts)
        table = page.table()
        region = (table[0][0].i, table[0][0].j, len(table), len(table[0]))
        for number, panel in enumerate(made.panels):
            self._panel(host, number, replace(panel, region=region), place(number), made.plan)
        chosen = page.cells(table, place(1))
        if made.plan.columns == 2 and extent.x < PROGRAM_EM * em:
            chosen = (
                replace(page, extent=ImVec2(2 * extent.x, extent.y)).in_memory(place(2)) or chosen
            )
        else:
            host.apply(host.state.with_options(language=page.program(place(2))))
            chosen = page.in_memory(place(3)) or chosen
        if chosen is not None:
            self._choose(host, chosen, now)

    def _panel(self, host: Host, number: int, panel: Panel, at: ImVec2, made: PagePlan) -> None:
        assert self._uploads is not None
        name, width = f"panel {number}", made.cell[0] / framebuffer_scale()
        is_about = host.state.of(LaboratoryOptions).page in ABOUT_A_PIXEL
        pixel = self._pixel(host.state, made) if is_about else None
        held = draw_panel(name, panel, self._uploads.get(name), at, width, host.fonts, pixel)
        if held is not None and is_about:
            row, column = held
            inside = min(max(row, 0), made.image[1] - 1), min(max(column, 0), made.image[0] - 1)
            self._choose(host, inside, made)

    # From the state to the pictures.

    def _follow(self, host: Host, divided: PagePlan, options: LaboratoryOptions) -> None:
        assert self._uploads is not None
        assert self._work is not None
        state = host.state
        camera = state.view.for_size(divided.image)
        request = ImageRequest(state.scene, camera, divided.image)
        try:
            if self.source is None or self.source.request != request:
                self.source = Source(request, drawn_image(host, request))
            outcome = self._work.poll()
            if outcome is not None and outcome.error is not None:
                raise outcome.error
            if outcome is not None and outcome.value is not None:
                self._made = outcome.value
                for number, panel in enumerate(self._made.panels):
                    self._uploads.put(f"panel {number}", panel.picture)
            self._error = ""
        except (LucidaError, moderngl.Error) as error:
            self._error = describe(error)
            return
        source, taken_ev = self.source, state.images.exposure_ev
        pixel = self._pixel(state, divided)
        # The other pages' options are none of this one's.
        self._asked = (source, divided, options, taken_ev, pixel)
        self._work.ask(made_page, *self._asked)

    def _pixel(self, state: AppState, divided: PagePlan) -> Pixel:
        """The marked pixel in this image, which may have another size than the other views'."""
        width, height = divided.image
        if state.marked is None:
            return height // 2, width // 2
        row, column = state.marked
        if state.images.resolution is None and min(self._others):
            row = int((row + 0.5) / self._others[1] * height)
            column = int((column + 0.5) / self._others[0] * width)
        return min(row, height - 1), min(column, width - 1)

    def _choose(self, host: Host, pixel: Pixel, divided: PagePlan) -> None:
        """Marks a pixel of this image in all views."""
        row, column = pixel
        if host.state.images.resolution is None and min(self._others):
            row = int((row + 0.5) / divided.image[1] * self._others[1])
            column = int((column + 0.5) / divided.image[0] * self._others[0])
        host.apply(host.state.with_options(marked=(row, column)))

    # Beside the pictures.

    def _below_px(self, options: LaboratoryOptions) -> float:
        page = options.page
        if page == "displays":
            return LANES_EM * imgui.get_font_size()
        if page == "projectors":
            return PROJECTORS_EM * imgui.get_font_size()
        return 0.0
