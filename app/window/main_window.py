"""The open window, which runs frame after frame.

The window owns the views, the renderers, the threads and the files. Views read the state through
ui/host.py's Host, and request a new one, which edits.py keeps. viewer.py creates the window.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path

import moderngl
from imgui_bundle import hello_imgui

from lucida.app.checking.your_code.view import YourCode
from lucida.app.images.compare.actions import show_differing
from lucida.app.images.pair.view import RASTER
from lucida.app.images.renderers import Renderers
from lucida.app.lecture.view import LECTURE, LectureView
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import Pixel
from lucida.app.ui import theme
from lucida.app.ui.background import Background
from lucida.app.ui.entry_box import Box
from lucida.app.ui.host import T
from lucida.app.ui.instrument import Instrument
from lucida.renderer.scene.focus import Focus, scene_focus
from lucida.renderer.system.memo import Memo

from .action_table import run_shortcuts
from .edits import Edits
from .files import Files
from .instruments import make_views
from .menu_keys import MenuKeys
from .menus import menu_bar, menu_button
from .motions import Motions
from .platform import keep_open, on_drop, set_title
from .scene_saving import SceneSaving, is_marked, title
from .session_store import Keeper
from .shell import Shell
from .status import Status, is_good_news, status_line, told
from .taking import take_opened


class MainWindow(Edits):
    """The model of the window, and the Host of its views. Call methods on its thread, with its
    context current.

    smooth: keep the display's rate while tracing; not needed for a picture. keeper: saves the
    session; None saves none. folder: the user's settings folder; None keeps no settings.
    """

    def __init__(
        self,
        state: AppState,
        smooth: bool = True,
        keeper: Keeper | None = None,
        folder: Path | None = None,
    ) -> None:
        super().__init__(state)
        self.fonts = theme.Fonts()
        self.news = threading.Event()  # set when a thread has a result for the next frame
        Background.wake_window = self._wake
        self.files = Files(self._wake, folder)
        self.renderers = Renderers(self._wake, smooth)
        self.views = {view.name: view for view in make_views()}
        self.lecture = self.view(LectureView)
        views = list(self.views.values())
        self.shell = Shell(views, self.files, keeper, folder)
        self._hovered: tuple[str, Pixel] | None = None
        self._next_hovered: tuple[str, Pixel] | None = None
        self._titled = state.scene, is_marked(state.scene, state.step is not None)
        self.box: Box | None = None
        self.is_rearranging = True
        self._focus = Memo(scene_focus)
        self.motions = Motions(self, instant=not smooth)
        self.moves = smooth
        self.for_print = False
        self.menu_keys = MenuKeys()
        self._over: Instrument | None = None
        self.saving = SceneSaving(self.files, self._quit)
        self._closes = False

    # Requests of actions and views.

    def view(self, kind: type[T]) -> T:
        return next(view for view in self.views.values() if isinstance(view, kind))

    @property
    def focus(self) -> Focus:
        return self._focus(self.state.scene)

    @property
    def hovered(self) -> tuple[str, Pixel] | None:
        return self._hovered

    @property
    def settled(self) -> bool:
        """True if nothing will change by itself: both images are complete and compared."""
        views = self.shell.stage.settled
        moving = self.files.busy or self.motions.under_way
        return views and self.renderers.settled(self.state) and not moving

    def check(self) -> None:
        """Raise the error that keeps the images or a view incomplete."""
        for failure in (self.renderers.failure, *self.shell.stage.failed.errors.values()):
            if failure is not None:
                raise failure

    def end_layout(self) -> None:
        """Record whether the frame's layout is final. Call once a frame."""
        self.is_rearranging = self.shell.stage.place() or self.lecture.is_entering

    @property
    def has_tools(self) -> bool:
        return not (self.for_print or self.on_stage)

    @property
    def on_stage(self) -> bool:
        """True while a lecture is in presentation mode, which shows only pictures and text."""
        return self.lecture.is_given and self.state.preferences.presentation

    def hover(self, view: str, pixel: Pixel) -> None:
        self._next_hovered = (view, pixel)

    def show(self, view: str) -> None:
        if view not in self.shell.stage.rects:
            self.shell.stage.show(view)

    def show_in(self, view: str, layout: str) -> None:
        self.shell.stage.show_in(view, layout)

    def is_visible(self, view: str) -> bool:
        return view in self.shell.stage.rects

    def travel(self, state: AppState) -> None:
        self.motions.travel(self, state)

    @property
    def travelling(self) -> bool:
        return self.motions.transition.under_way

    def focus_object(self) -> None:
        self.motions.focus_object(self, self._over or self.views[RASTER])

    def undo(self) -> None:
        """Undo the last step. An invalid entry counts as the last step."""
        pending = [view for view in self.views.values() if view.has_pending]
        if pending:
            for view in pending:
                view.drop_pending()
            self.animate()
            return
        self._cancel_drags()
        self.motions.stop()
        self.history = self.history.undo()

    def redo(self) -> None:
        self._cancel_drags()
        self.motions.stop()
        self.history = self.history.redo()

    def can_undo(self) -> bool:
        return bool(self.history.past) or any(view.has_pending for view in self.views.values())

    def can_redo(self) -> bool:
        return bool(self.history.future)

    def open(self, source: str) -> None:
        self.files.open(source)

    def open_code(self, path: str) -> None:
        """Run the user's own Python file, in its view. path: absolute."""
        self.view(YourCode).open(self, path)

    def retry(self) -> None:
        """Retry rendering after a renderer has failed."""
        self.renderers.retry()
        self.animate()

    def quit(self) -> None:
        if self.saving.closes(self.state):
            self._quit()

    def _quit(self) -> None:
        self._closes = True
        hello_imgui.get_runner_params().app_shall_exit = True

    def _follow_closing(self) -> None:
        """Handle the window's close button: ask first if something would be lost."""
        params = hello_imgui.get_runner_params()
        if params.app_shall_exit and not self._closes and self.moves:
            if self.saving.closes(self.state):
                self._closes = True
            else:
                params.app_shall_exit = False
                keep_open()

    def leave_scene(self, then: Callable[[], None]) -> None:
        self.saving.leave(self.state, then)

    def save_scene(self) -> None:
        self.saving.save(self.state)

    def save_scene_as(self) -> None:
        self.saving.save_as(self.state)

    # HelloImGui's callbacks.

    def begin(self, context: moderngl.Context) -> None:
        """Prepare the views. Called once, when the window's context exists and is current."""
        self.renderers.begin(context)
        self.shell.documents.begin(context)
        for view in self.views.values():
            self.shell.stage.failed.begin(view, self, context)
        on_drop(self._dropped)

    def menus(self) -> None:
        self.menu_keys.frame()
        menu_bar(self, self.history, self.shell.stage)

    def _bars(self) -> None:
        """Show both bars, or none on the stage."""
        shown = hello_imgui.get_runner_params().imgui_window_params
        shown.show_menu_bar = shown.show_status_bar = not self.on_stage
        if self.on_stage and self.lecture.shows_controls:
            menu_button(self, self.history, self.shell.stage)

    def frame(self) -> None:
        """Begin a frame: take the threads' results, and handle the keys."""
        active = self.note_gesture()
        self._hovered, self._next_hovered = self._next_hovered, None
        self._follow_closing()
        self.saving.poll(self)
        scene, is_a_steps = self.state.scene, self.state.step is not None
        titled = scene, is_marked(scene, is_a_steps)
        if titled != self._titled:  # also by undo
            self._titled = titled
            set_title(title(scene, is_a_steps))
        self._over = self.shell.stage.take_hovered()
        self.motions.frame(self, active)
        if self.state.step is None and not self.saving.busy and self.files.follow(self.state.scene):
            hello_imgui.request_refresh()
        take_opened(self)
        moving = active or self.motions.under_way
        self.shell.proportion.keep(self.lecture.arrangements)
        self.shell.frame(self)
        if not self.lecture.is_given:
            self.shell.stage.begin_afresh()
        arrangements = self.lecture.arrangements
        self.lecture.follow(self)
        if self.lecture.arrangements != arrangements:
            begun, stage = self.lecture.take_begun(), self.shell.stage
            stage.give_keyboard(LECTURE if begun else stage.keyboard)
        typing = self.box is not None and self.box.focused  # its digits are not bookmarks
        if not typing:
            run_shortcuts(self)
        if self.box is not None and not self.box.draw():
            self.box = None
        self.renderers.update(self.state, moving)
        self._bars()
        self.shell.draw(self, typing, self.menu_keys.in_menus)
        if self.files.busy or self.renderers.unfinished(self.state):
            hello_imgui.request_refresh()

    def draw_view(self, view: Instrument) -> None:
        """Draw a view's ImGui window, if it is shown."""
        self.shell.stage.draw(view, self)

    def status(self) -> None:
        """Draw the status line."""
        both, state = self.renderers, self.state
        image = both.shown_ray(state) if both.is_tracing else None
        verdict, failure = both.verdict(state), both.agreement.error
        pixel = self._hovered[1] if self._hovered else state.marked
        pressed = status_line(
            Status(
                raster_s=both.raster_s,
                raster_factor=both.raster_factor,
                ray_s=image.frame.time_s if image else 0.0,
                size=both.size,
                factor=image.factor if image else 0,
                agreement=told(verdict, failure) or both.preparing(),
                agrees=is_good_news(verdict, failure),
                pixel=pixel,
                indexing=state.options.indexing,
                seen=both.seen_at(state, pixel) if pixel else "",
                loading=self.files.loading,
                brief=state.preferences.presentation,
                awaited=both.is_tracing,
                differing=bool(
                    verdict and verdict.agrees is not None and verdict.comparison.differing
                ),
            ),
            self.fonts,
        )
        if pressed:
            show_differing(self)

    def end(self) -> None:
        """Release everything. Called once, before the context is destroyed."""
        self.end_movement()
        self.shell.end(self, keeps_edits=not self.saving.discards)
        for view in self.views.values():
            view.end()
        self.shell.documents.end()
        self.renderers.end()
        self.files.close()
        self.saving.close()

    def _cancel_drags(self) -> None:
        for view in self.views.values():
            view.cancel()

    def _wake(self) -> None:
        """Request a frame, from any thread."""
        self.news.set()
        hello_imgui.request_refresh()

    def _dropped(self, paths: list[str]) -> None:
        self.files.open_all(paths, dropped=True)
        hello_imgui.request_refresh()
