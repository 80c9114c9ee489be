"""The visibility of views: shown, hidden, or in front.

This module draws the views' ImGui windows, and keeps the focus and the place of each.
"""

from __future__ import annotations

from imgui_bundle import imgui

from lucida.app.state.session import Arrangement

from . import layout
from .failing import FailedViews
from .host import Host
from .instrument import Instrument

Rect = tuple[float, float, float, float]  # left, top, right, bottom, ImGui's pixels
LAID_OUT = 3  # frames that it takes until every window has its place


class Stage:
    """All views of a window.

    rects: the content rectangles of the views drawn in this frame or the last one.
    """

    def __init__(self, views: list[Instrument]) -> None:
        self.views = {view.name: view for view in views}
        self.rects: dict[str, Rect] = {}
        self.failed = FailedViews()
        self._next_focus = ""
        self._by_key = False  # whether to show the next focus
        self._next_shown = "", ""  # a view, and the layout to show it in
        self._keyboard = self._next_keyboard = ""  # the view that has it; "" for none
        self._hovered: Instrument | None = None
        self._restoring: Arrangement | None = None
        self._keyboard_for: str | None = None  # the view that gets it once all have their places
        self._frames = 0
        self._layout = ""  # in the previous frame
        self._placing = LAID_OUT  # frames until the windows have their places

    @property
    def settled(self) -> bool:
        """True if the views are laid out, and nothing visible will change by itself."""
        if self._frames < LAID_OUT or self.failed.errors or self._next_shown[0]:
            return False
        return all(self.views[name].settled for name in self.rects)

    def place(self) -> bool:
        """Return True if windows are still on their way to their places. Call once a frame, after
        layout.
        """
        name = layout.current().name
        if name != self._layout or self._restoring is not None or layout.is_to_be_made():
            self._placing = LAID_OUT
        else:
            self._placing = max(0, self._placing - 1)
        self._layout = name
        return self._placing > 0 or not all(layout.is_placed(view) for view in self.shown)

    # Requests of actions.

    @property
    def shown(self) -> list[Instrument]:
        """The views that are visible, or tabs behind others."""
        return [view for view in self.views.values() if layout.window_of(view).is_visible]

    def is_shown(self, name: str) -> bool:
        return layout.window_of(self.views[name]).is_visible

    def show(self, name: str, shown: bool = True) -> None:
        """Show a view and focus it; or hide it."""
        layout.window_of(self.views[name]).is_visible = shown
        if shown:
            self._next_focus = name

    def show_in(self, name: str, wanted: str) -> None:
        """Show a view in a layout that has a place for it; in a lecture, next to the step's own."""
        self._next_shown = name, wanted

    def _show_next(self) -> None:
        name, wanted = self._next_shown
        if not name or self._restoring is not None:
            return
        if layout.current().name in (wanted, layout.LECTURE):
            self._next_shown = "", ""
            self.show(name)
            self.give_keyboard(name)  # at the start, the windows have no places yet
        else:
            layout.switch(wanted)

    def follow(self) -> None:
        """Carry out requests, and move the focus. Call once a frame, before the views."""
        self._frames += 1
        self._restore()
        self._show_next()
        self._give_keyboard()
        self._begin_tab()
        if self._next_focus:
            label, self._next_focus = self.views[self._next_focus].label, ""
            imgui.set_window_focus(label)
            if self._by_key:
                imgui.internal.nav_init_window(imgui.internal.find_window_by_name(label), False)
                imgui.set_nav_cursor_visible(True)
            self._by_key = False

    def _begin_tab(self) -> None:
        """Let Tab enter the first view if ImGui has no control to continue from."""
        if self._keyboard or imgui.get_current_context().nav_id or not self.shown:
            return
        io = imgui.get_io()
        if imgui.is_key_pressed(imgui.Key.tab) and not (io.key_ctrl or io.key_alt):
            self._next_focus, self._by_key = self.shown[0].name, True

    @property
    def keyboard(self) -> str:
        """The view that has the keyboard, or will get it; "" for none."""
        return self._keyboard if self._keyboard_for is None else self._keyboard_for

    def give_keyboard(self, name: str) -> None:
        """Focus a view, "" for none, once all windows have their places: ImGui focuses each window
        that it docks.
        """
        self._keyboard_for, self._placing = name, max(self._placing, 1)

    def _give_keyboard(self) -> None:
        if self._keyboard_for is None or self._placing > 0:
            return
        name, self._keyboard_for = self._keyboard_for, None
        if not name:
            imgui.set_window_focus(None)
        elif self.is_shown(name):
            self._next_focus = name

    def take_hovered(self) -> Instrument | None:
        """Return the view that the mouse was over in the last frame. Call once a frame."""
        hovered, self._hovered = self._hovered, None
        self._keyboard, self._next_keyboard = self._next_keyboard, ""
        return hovered

    # Sessions.

    def arrangement(self) -> Arrangement:
        """Return the current arrangement."""
        visible = tuple(view.name for view in self.shown)
        views = self.views.values()
        sections = {view.name: view.sections for view in views if view.sections}
        name = layout.current().name
        return Arrangement(name, visible, sections, self._keyboard)

    def restore(self, arrangement: Arrangement) -> None:
        """Restore an arrangement, in the next frames."""
        self._restoring = arrangement
        for name, opened in arrangement.sections.items():
            if name in self.views:
                self.views[name].open_sections(opened)

    def begin_afresh(self) -> None:
        """Start without a session.

        HelloImGui shows the layout of the last window, which may be a lecture's.
        """
        is_lectures = layout.current().name == layout.LECTURE
        if self._frames == 2 and self._restoring is None and is_lectures:
            layout.switch(layout.LAYOUTS[0].name)

    def _restore(self) -> None:
        if self._restoring is None or self._frames < 2:
            return
        if self._frames == 2 and self._restoring.layout:
            layout.switch(self._restoring.layout)
            return
        if layout.current().name == self._restoring.layout:
            # A session may name views that this version does not have.
            visible = self.views.keys() & set(self._restoring.visible)
            for view in self.views.values():
                layout.window_of(view).is_visible = view.name in visible
            focused = self._restoring.focused
            self.give_keyboard(focused if focused in visible else "")
        self._restoring = None

    # Drawing.

    def leave_out_hidden(self, host: Host) -> None:
        """Notify hidden views, which HelloImGui does not draw. Call once a frame."""
        for view in self.views.values():
            if not layout.window_of(view).is_visible:
                self._leave_out(view, host)

    def draw(self, view: Instrument, host: Host) -> None:
        """Draw a view's ImGui window, if it is visible."""
        window = layout.window_of(view)
        padding = view.padding
        if padding is not None:
            imgui.push_style_var(imgui.StyleVar_.window_padding, padding)
        opened, visible = imgui.begin(view.label, True, view.flags | view.placed(host))
        if not visible:  # closed; does not overrule a simultaneous hide
            window.is_visible = False
        if padding is not None:
            imgui.pop_style_var()
        try:
            if imgui.is_window_focused(imgui.FocusedFlags_.root_and_child_windows):
                self._next_keyboard = view.name
            if opened:
                self._draw_content(view, host)
            else:
                self._leave_out(view, host)
        finally:
            imgui.end()

    def _draw_content(self, view: Instrument, host: Host) -> None:
        corner, room = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail()
        if imgui.is_window_hovered(imgui.HoveredFlags_.root_and_child_windows):
            self._hovered = view
        self.rects[view.name] = (corner.x, corner.y, corner.x + room.x, corner.y + room.y)
        self.failed.draw(view, host)

    def _leave_out(self, view: Instrument, host: Host) -> None:
        """Notify a view that is not visible in this frame, and fit no image to it any more."""
        self.rects.pop(view.name, None)
        host.renderers.forget_pane(view.name)
        view.unseen(host)
