"""The window while it is open: one frame after another.

Owns the present state and everything that lives as long as the window: the renderers, the
threads, the history. Panels are given the state and return a new one; here the new one is kept,
and the renderers are told. Knows nothing of how the window was made (viewer.py).
"""

from __future__ import annotations

import time
from collections.abc import Callable

import moderngl
from imgui_bundle import ImVec2, hello_imgui, imgui

from app import __version__, layout, theme
from app.actions import run_shortcuts
from app.editing import Draft
from app.files import Files, Opened, describe
from app.focus import Focus, scene_focus
from app.panels.camera import Surroundings, camera_panel
from app.panels.images import Grab, Pane, Pixel, Zoom, available_px, image_pane
from app.panels.menus import help_sheet, menu_bar
from app.panels.messages import message_box
from app.panels.status import Status, status_line
from app.platform import on_drop, set_title
from app.renderers import Renderers
from app.state import AppState, History
from renderer.scene import BUILTIN_SCENES, Scene

RASTER, RAY = "Raster", "Ray"
TITLES = {RASTER: "Raster  object order", RAY: "Ray  image order"}
WHEEL_PAUSE_S = 0.5  # turns of the wheel closer together are one step of undo


class MainWindow:
    """Everything behind the window. Methods are called in its thread, in its context.

    smooth: keep the display's rate while tracing; not needed for a picture.
    """

    def __init__(self, state: AppState, smooth: bool = True) -> None:
        self.history = History(state)
        self.fonts = theme.Fonts()
        self.files = Files(hello_imgui.request_refresh)
        self.renderers = Renderers(hello_imgui.request_refresh, smooth)
        self._proportion = layout.Proportion()
        self._draft = Draft.of(state.camera)
        self._grab: Grab | None = None
        self._zoom: Zoom | None = None
        self._hovered: tuple[str, Pixel] | None = None
        self._next_hovered: tuple[str, Pixel] | None = None
        self._panes_px: dict[str, tuple[int, int]] = {}
        self._gesture = 0
        self._was_active = False
        self._wheel = (0, 0.0)
        self._help = False
        self._focused: tuple[Scene, Focus] | None = None

    # What actions and panels ask for.

    @property
    def state(self) -> AppState:
        return self.history.present

    @property
    def scene_center(self) -> tuple[float, float, float]:
        return self._focus().center

    @property
    def settled(self) -> bool:
        """Whether nothing will change by itself: both images are complete and compared."""
        return self.renderers.settled(self.state) and not self.files.busy

    def change(self, state: AppState) -> None:
        """A step of its own in the history."""
        self.history = self.history.change(state)

    def undo(self) -> None:
        self._grab = None  # a drag under way ends
        self.history = self.history.undo()

    def redo(self) -> None:
        self._grab = None
        self.history = self.history.redo()

    def can_undo(self) -> bool:
        return bool(self.history.past)

    def can_redo(self) -> bool:
        return bool(self.history.future)

    def open(self, source: str) -> None:
        self.files.open(source)

    def open_dialog(self) -> None:
        self.files.open_dialog()

    def save_view_dialog(self) -> None:
        self.files.save_view_dialog(self.state.view)

    def toggle_help(self) -> None:
        self._help = not self._help

    def quit(self) -> None:
        hello_imgui.get_runner_params().app_shall_exit = True

    # HelloImGui's callbacks.

    def dockable_windows(self) -> list[hello_imgui.DockableWindow]:
        """The windows, in the order in which they are drawn: the panel first, so that the images
        show what it changed in the same frame."""
        window = hello_imgui.DockableWindow
        camera = window("Camera", layout.CAMERA_SPACE, self._camera_window)
        raster = window(f"{TITLES[RASTER]}###{RASTER}", layout.LEFT_SPACE, self._raster_window)
        ray = window(f"{TITLES[RAY]}###{RAY}", layout.RIGHT_SPACE, self._ray_window)
        for pane in (raster, ray):
            pane.call_begin_end = False
        return [camera, raster, ray]

    def begin(self, context: moderngl.Context) -> None:
        """Once, when the window's context is there, and current."""
        self.renderers.begin(context, self.state.scene)
        on_drop(self._dropped)

    def menus(self) -> None:
        menu_bar(self, BUILTIN_SCENES, self.open)

    def frame(self) -> None:
        """The beginning of each frame: what has come from the threads, and the keys."""
        active = imgui.is_any_item_active() or self._grab is not None
        if active and not self._was_active:
            self._gesture += 1
        self._was_active = active
        self._hovered, self._next_hovered = self._next_hovered, None
        opened = self.files.poll()
        if opened is not None:
            self._take_opened(opened)
        self.renderers.update(self.state, moving=active)
        self._proportion.keep()
        run_shortcuts(self)
        if self._help:
            help_sheet(self, self.fonts, __version__)
        if self.files.message and message_box(self.files.message):
            self.files.message = ""
        if self.files.busy or self.renderers.unfinished(self.state):
            hello_imgui.request_refresh()

    def status(self) -> None:
        both, state = self.renderers, self.state
        image, verdict, failure = both.ray_image, both.verdict(state), both.agreement.error
        if image is not None and image.request.scene is not state.scene:
            image = None  # of another scene, until the first one of this scene comes
        pixel = self._hovered[1] if self._hovered else None
        status_line(
            Status(
                raster_s=both.pictures.raster_s if both.pictures else 0.0,
                raster_factor=both.pictures.raster_factor if both.pictures else 1,
                ray_s=image.frame.time_s if image else 0.0,
                size=both.size,
                factor=image.factor if image else 0,
                agreement=verdict.text if verdict else describe(failure) if failure else "",
                agrees=verdict is not None and verdict.unexplained == 0,
                scene=state.scene.name,
                pixel=pixel,
                seen=both.seen_at(state, pixel) if pixel else "",
                loading=self.files.loading,
            ),
            self.fonts,
        )

    def end(self) -> None:
        """Once, before the context goes."""
        self.renderers.end()
        self.files.close()

    # Windows.

    def _camera_window(self) -> None:
        around = Surroundings(self.fonts, self.renderers.camera(self.state), self._focus())
        state, self._draft = camera_panel(self.state, self._draft, around)
        self._apply(state)

    def _raster_window(self) -> None:
        self._pane(RASTER, self.renderers.raster_texture, self.renderers.raster_error)

    def _ray_window(self) -> None:
        both, image = self.renderers, self.renderers.ray_image
        refining = image is not None and image.factor > 1
        progress = both.live.progress if refining else 1.0
        if self._pane(RAY, both.ray_texture, both.ray_error, both.preparing(), progress):
            both.trace(self.state)

    def _pane(
        self,
        name: str,
        texture: Callable[[AppState], int | None],
        error: Exception | None,
        note: str = "",
        progress: float = 1.0,
    ) -> bool:
        """The window of one image; gives whether it is open."""
        flags = imgui.WindowFlags_
        dockable = hello_imgui.get_runner_params().docking_params.dockable_window_of_name(
            f"{TITLES[name]}###{name}"
        )
        if not dockable.is_visible:
            self._panes_px.pop(name, None)
            return False
        imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(1, 1))
        opened, visible = imgui.begin(
            dockable.label,
            True,
            flags.no_scrollbar | flags.no_scroll_with_mouse | flags.no_background,
        )
        dockable.is_visible = bool(visible)
        imgui.pop_style_var()
        if opened:
            both = self.renderers
            self._panes_px[name] = available_px()
            both.fit_into(self._panes_px.values(), self.state.pixel_size)
            marked = None
            if self._hovered is not None and (
                self._hovered[0] != name or self.state.pixel_size > 4
            ):
                marked = self._hovered[1]
            pane = Pane(
                name=name,
                texture=texture,
                shown=both.camera(self.state),
                size=both.size,
                center=self.scene_center,
                reach=self._focus().reach,
                depth_at=lambda pixel: both.depth_at(self.state, pixel),
                note=describe(error) if error else note,
                is_error=error is not None,
                progress=progress,
                marked=marked,
            )
            result = image_pane(pane, self.state, self._grab, self._zoom)
            self._grab, self._zoom = result.grab, result.zoom or self._zoom
            if result.hovered is not None:
                self._next_hovered = (name, result.hovered)
            self._apply(result.state, wheeled=result.zoom is not None)
        imgui.end()
        return bool(opened)

    # State.

    def _apply(self, state: AppState, wheeled: bool = False) -> None:
        """Keeps what a panel returned. A drag, or a turn of the wheel, is one step."""
        if state == self.state:
            return
        gesture: object = None
        if wheeled:
            number, last_s = self._wheel
            now_s = time.monotonic()
            number += now_s - last_s > WHEEL_PAUSE_S
            self._wheel = (number, now_s)
            gesture = ("wheel", number)
        elif self._was_active or imgui.is_any_item_active():
            gesture = ("drag", self._gesture if self._was_active else self._gesture + 1)
        self.history = self.history.change(state, gesture)

    def _take_opened(self, opened: Opened) -> None:
        if opened.scene is not None:
            self.change(self.state.with_scene(opened.scene))
            set_title(title(opened.scene))
        elif opened.view is not None:
            self.change(self.state.with_view(opened.view))

    def _dropped(self, paths: list[str]) -> None:
        if paths:
            self.open(paths[0])
            hello_imgui.request_refresh()

    def _focus(self) -> Focus:
        if self._focused is None or self._focused[0] is not self.state.scene:
            self._focused = (self.state.scene, scene_focus(self.state.scene))
        return self._focused[1]


def title(scene: Scene) -> str:
    """The window's title."""
    return f"Lucida: {scene.name}" if scene.name else "Lucida"
