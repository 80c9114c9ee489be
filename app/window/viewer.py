"""One run of the window: HelloImGui's parameters, settings, screenshot.

main_window.py runs the frames, and launch.py selects the content.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from imgui_bundle import hello_imgui, imgui, immapp

from lucida.app.checking.your_code.view import YourCode
from lucida.app.instruments.poses.view import PosesView
from lucida.app.state.app_state import AppState
from lucida.app.state.paths import is_unicode
from lucida.app.state.session import source_of
from lucida.app.state.settings import settings_file
from lucida.app.ui import layout, theme
from lucida.app.ui.focus_frame import FocusFrame
from lucida.app.ui.focusing import Focusing
from lucida.app.ui.instrument import Instrument
from lucida.renderer.files import SCENE_NAMES
from lucida.renderer.images.png import write_png
from lucida.renderer.system import compile_note
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import LucidaError

from .canvas import Target, WindowCanvas
from .keys import KeyFrames
from .main_window import MainWindow
from .memory import FreedMemory
from .platform import (
    Platform,
    begin_letters,
    create_context,
    default_size,
    flush_opengl,
    lock_letters,
    set_size,
    show_window,
    take_keys,
)
from .scene_saving import title
from .session_store import settings_folder
from .signals import ended_by_signals
from .start import Start

SCREENSHOT_LIMIT_S = 300.0  # the first image of an installation compiles the tracer
PICTURE_WAIT_S = 0.25  # at most, for a thread's result: the ray image, or the comparison
NULL_FPS = 60.0
IDLE_FPS = 0.5  # to end notifications and save the session; any other change requests frames
WAITING_FPS = 2.0  # while the ray image is being traced, to show its progress
UNSAVED = "The last session left unsaved changes of its scene. They are kept in"
RESTORE = "Open that file"
DOUBLE_CLICK_S = 0.5
SWITCH_INTERVAL_S = 0.001  # a busy Python thread (a compilation) delays a frame by this, not 5 ms


class WindowRun:
    """One run of the window. params may be changed before run(), as tests do.

    size: (width, height); None for the last run's, or the default.
    take_picture: True to end once both images are complete, and to ignore the user's settings.
    remember: True to save the layout in the user's settings. start: the session; None for none.
    """

    def __init__(
        self,
        platform: Platform,
        state: AppState,
        size: tuple[int, int] | None,
        take_picture: bool = False,
        remember: bool = True,
        start: Start | None = None,
    ) -> None:
        self._memory = FreedMemory()
        keeper = start.keeper if start is not None else None
        keeps = start is not None and remember and not take_picture
        folder = user_folder() if keeps else None
        self.window = MainWindow(state, not take_picture, keeper, folder)
        if start is not None:
            self._take(start)
        self._platform = platform
        self._size = size or default_size(platform)
        self._canvas: WindowCanvas | None = None
        self._keys: KeyFrames | None = None
        self._focusing = Focusing()
        self._focus_frame = FocusFrame()
        self.on_drawn: Callable[[Target], None] | None = None  # called for each visible frame
        self._take_picture = take_picture
        self.ends_once_complete = take_picture
        self._error: BaseException | None = None
        self._quiet_frames = 0
        self._told = compile_note.note()
        self._ended = False
        self._start_s = 0.0
        fresh = start is not None and start.fresh
        self.params = self._parameters(state, remember and not take_picture, fresh)
        window = self.params.app_window_params
        window.restore_previous_geometry = size is None and not self.params.ini_disable

    def run(self) -> np.ndarray:
        """Show the window until it is closed. Return its last picture, uint8 (height, width, 3).

        Raises the error of a frame that failed.
        """
        interval = sys.getswitchinterval()
        sys.setswitchinterval(SWITCH_INTERVAL_S)
        self._start_s = time.monotonic()
        try:
            with ended_by_signals(self._end):
                immapp.run(self.params)
        except Exception as error:  # often ImGui's error about an unfinished window
            self._error = self._error or error
        finally:
            sys.setswitchinterval(interval)
        if self._error is not None:
            raise self._error
        return np.ascontiguousarray(hello_imgui.final_app_window_screenshot()[..., :3])

    def to_the_end(self, picture: Path | None, tell: bool = False) -> int:
        """Run, save the picture if one was drawn instead of opening a window, and return the exit
        status.

        tell: True to print the picture's path.
        """
        pixels = self.run()
        if picture is not None:
            save_png(picture, pixels)
            if tell:
                print(f"lucida: saved {picture}")
        return 0

    def _take(self, start: Start) -> None:
        shown: tuple[str, ...] = ()
        if start.session is not None:
            shown = start.session.arrangement.visible
            self.window.shell.stage.restore(start.session.arrangement)
        if start.lecture is not None:
            self.window.lecture.resume(start.lecture, shown)
        elif start.session is not None and start.session.lecture is not None:
            self.window.lecture.put_off(start.session.lecture, source_of(start.state.scene))
        self.window.files.message = start.message
        if start.opened and start.opened not in SCENE_NAMES:
            self.window.files.recent.add(str(Path(start.opened).absolute()))
        if start.unsaved is not None:
            path, files = str(start.unsaved), self.window.files
            files.ask(f"{UNSAVED} {path}.", {RESTORE: lambda: files.open(path)})
        if start.code:
            self.window.open_code(start.code)
            self.window.files.recent.add(start.code)
        if start.poses is not None:
            self.window.view(PosesView).give(self.window, start.poses)
            self.window.files.recent.add(str(start.poses.path))

    def _end(self) -> None:
        self._ended = self.params.app_shall_exit = True

    def _parameters(self, state: AppState, remember: bool, fresh: bool) -> hello_imgui.RunnerParams:
        params = hello_imgui.RunnerParams()
        params.app_window_params.window_title = title(state.scene)
        geometry = params.app_window_params.window_geometry
        geometry.size = self._size
        geometry.window_size_measure_mode = hello_imgui.WindowSizeMeasureMode.screen_coords
        params.app_window_params.hidden = self._platform.has_display  # until there is a picture
        _settings(params, remember, fresh)
        docking = hello_imgui.DefaultImGuiWindowType.provide_full_screen_dock_space
        params.imgui_window_params.default_imgui_window_type = docking
        params.imgui_window_params.show_menu_bar = True
        params.imgui_window_params.show_menu_app = False
        params.imgui_window_params.show_menu_view = False
        params.imgui_window_params.remember_theme = False
        params.imgui_window_params.show_status_bar = True
        params.imgui_window_params.show_status_fps = False
        params.imgui_window_params.remember_status_bar_settings = False
        # Text and images need no multisampling, which would cost more than everything else.
        params.renderer_backend_options.open_gl_options.anti_aliasing_samples = 0
        params.fps_idling.fps_idle = 0.0 if self._take_picture else IDLE_FPS
        params.fps_idling.enable_idling = not self._take_picture
        if not (self._platform.has_display or self._take_picture):  # nothing else paces frames
            params.fps_idling.fps_max = NULL_FPS
        params.fps_idling.time_active_after_last_event = 0.6  # tooltips need 0.4
        params.docking_params, *params.alternative_docking_layouts = layout.docking(
            list(self.window.views.values()), self._draw, self._size, theme.TEXT_PX
        )
        callbacks = params.callbacks
        callbacks.setup_imgui_config = _configure
        callbacks.load_additional_fonts = self.guarded(self.window.fonts.load)
        callbacks.setup_imgui_style = self.guarded(lambda: theme.begin(state.preferences))
        callbacks.post_init = self.guarded(self._begin)
        callbacks.pre_new_frame = self.guarded(self._before_frame)
        # It runs before the views are drawn, too early for their images. See _before_render().
        callbacks.custom_background = self.guarded(self._begin_frame)
        callbacks.before_swap = self.guarded(self._before_swap)
        callbacks.before_imgui_render = self.guarded(self._before_render)
        callbacks.show_menus = self.guarded(self.window.menus)
        callbacks.show_status = self.guarded(self.window.status)
        callbacks.show_gui = self.guarded(self.window.frame)
        callbacks.after_swap = self.guarded(self._after_frame)
        callbacks.before_exit = self.guarded(self.window.end)
        return params

    def _draw(self, view: Instrument) -> Callable[[], None]:
        return self.guarded(lambda: self.window.draw_view(view))

    def guarded(self, function: Callable[[], Any]) -> Callable[[], None]:
        """Wrap a function for C++, which no exception may pass through; the run raises it later."""

        def call() -> None:
            if self._error is not None and function != self.window.end:
                return
            try:
                function()
            except BaseException as error:
                self._error = self._error or error
                self.params.app_shall_exit = True

        return call

    def _begin(self) -> None:
        context = create_context()
        if self._platform.has_display:
            self._keys = take_keys()
        else:
            set_size(self._size)
        # A requested size is also the next run's.
        self.params.app_window_params.restore_previous_geometry = not self.params.ini_disable
        self._canvas = WindowCanvas(context)
        self.window.begin(context)

    def _before_frame(self) -> None:
        self._focusing.before_frame()
        lock_letters()

    def _begin_frame(self) -> None:
        begin_letters()
        self._focusing.begin_frame()

    def _before_render(self) -> None:
        self.window.shell.note_popups()
        self._focus_frame.draw()
        theme.follow(self.window.state.preferences, self.window.state.step is not None)
        if self._keys is not None:
            self._keys.begin_frame()
        if self._canvas is not None:
            io = imgui.get_io()  # the window itself may have another size by now
            size, scale = io.display_size, io.display_framebuffer_scale
            pixels = max(1, round(size.x * scale.x)), max(1, round(size.y * scale.y))
            self.window.end_layout()
            drawn = self._canvas.bind(pixels, self.window.is_rearranging)
            drawn.framebuffer.clear(*self.params.imgui_window_params.background_color)

    def _before_swap(self) -> None:
        canvas = self._canvas
        if canvas is None:
            return
        shown = canvas.shown
        if canvas.keeps or shown is None:
            hello_imgui.request_refresh()
        elif self.on_drawn is not None:
            self.on_drawn(shown)
        canvas.show(self._platform.has_display)

    def _show_window(self) -> None:
        """Show the window once there is a picture, because it would be black until then."""
        window = self.params.app_window_params
        if window.hidden and self._canvas is not None and self._canvas.shown is not None:
            window.hidden = False
            canvas = self._canvas
            show_window(lambda: canvas.show(in_window=True))

    def _tell_compiling(self) -> None:
        """Print once what an invisible window is waiting for."""
        if compile_note.note() != self._told:
            self._told = compile_note.note()
            print(f"lucida: {self._told}", file=sys.stderr)

    def _after_frame(self) -> None:
        if self._ended:  # before the first frame, after which HelloImGui resets it
            self.params.app_shall_exit = True
        self._show_window()
        if not self._platform.has_display:
            flush_opengl()
        self._memory.follow(self.window.settled)
        if not self._take_picture:
            # A saved program must run at once.
            busy = self.window.renderers.busy or self.window.view(YourCode).seen
            self.params.fps_idling.fps_idle = WAITING_FPS if busy else IDLE_FPS
            return
        self._tell_compiling()
        self.window.check()
        if self.ends_once_complete:
            self._end_once_complete()
        if self.window.renderers.busy and not (self._canvas is None or self._canvas.keeps):
            # The images have their final size. Further invisible frames would slow them down.
            self.window.news.wait(PICTURE_WAIT_S)
            self.window.news.clear()

    def _end_once_complete(self) -> None:
        # The layout needs two frames; afterwards nothing may change.
        self._quiet_frames = self._quiet_frames + 1 if self.window.settled else 0
        if self._quiet_frames > 3:
            self.params.app_shall_exit = True
        elif time.monotonic() - self._start_s > SCREENSHOT_LIMIT_S:
            raise LucidaError(
                "screenshot",
                f"the images were not complete after {SCREENSHOT_LIMIT_S:g} s",
                "try a smaller model or --size",
            )


def _configure() -> None:
    """Configure ImGui, so that the keyboard can reach everything."""
    hello_imgui.imgui_default_settings.setup_default_imgui_config()
    io = imgui.get_io()
    io.config_flags |= int(imgui.ConfigFlags_.nav_enable_keyboard)
    # ImGui takes one change of a mouse button a frame: leave time for slow frames.
    io.mouse_double_click_time = DOUBLE_CLICK_S
    io.mouse_single_click_delay = 2 * io.mouse_double_click_time  # ImGui requires it to be longer


def save_png(path: Path, pixels: np.ndarray) -> None:
    """Save uint8 (height, width, 3), row 0 at the top, atomically."""
    with atomic_write(path) as file:
        write_png(file, pixels)


def user_folder() -> Path | None:
    """Return the user's settings folder; None if there is no home folder."""
    try:
        return settings_folder()
    except RuntimeError:
        return None


def _settings(params: hello_imgui.RunnerParams, remember: bool, fresh: bool) -> None:
    """Keep the layout in the user's settings folder, never in the working directory.

    fresh: True to move an existing file aside.
    """
    path = settings_file(fresh) if remember else None
    if path is not None and not is_unicode(str(path)):
        path = None  # ImGui takes UTF-8 only
    params.ini_disable = path is None
    if path is not None:
        params.ini_folder_type = hello_imgui.IniFolderType.absolute_path
        params.ini_filename = str(path)
        params.ini_filename_use_app_window_title = False
