"""The window while it is open: one frame after another.

Owns the present state and everything that lives as long as the window: the renderers, the
threads, the history. Panels are given the state and return a new one; here the new one is kept,
and the renderers are told. Knows nothing of how the window was made (viewer.py).
"""

from __future__ import annotations

import math
import time

import moderngl
from imgui_bundle import ImVec2, hello_imgui, imgui

from app import __version__, layout, theme
from app.actions import run_shortcuts
from app.agreement import Agreement
from app.editing import Draft
from app.files import Files, Opened, describe
from app.focus import Focus, scene_focus
from app.live import LiveTrace, RayImage, Request
from app.panels.camera import Surroundings, camera_panel
from app.panels.images import Grab, Pane, Pixel, available_px, image_pane
from app.panels.menus import help_sheet, menu_bar
from app.panels.messages import message_box
from app.panels.status import Status, status_line
from app.pictures import Pictures, Wanted
from app.platform import lower_priority, on_drop, set_title
from app.state import AppState, History
from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.frame import LARGEST_PIXELS, LARGEST_SIDE
from renderer.scene import BUILTIN_SCENES, Scene

RASTER, RAY = "Raster", "Ray"
TITLES = {RASTER: "Raster  object order", RAY: "Ray  image order"}
WHEEL_PAUSE_S = 0.5  # turns of the wheel closer together are one step of undo
NOTE_AFTER_S = 0.3


class MainWindow:
    """Everything behind the window. Methods are called in its thread, in its context."""

    def __init__(self, state: AppState) -> None:
        self.history = History(state)
        self.fonts = theme.Fonts()
        self.agreement = Agreement(hello_imgui.request_refresh)
        self.files = Files(hello_imgui.request_refresh)
        self.live = LiveTrace(hello_imgui.request_refresh, _make_tracer, lower_priority)
        self.pictures: Pictures | None = None
        self.ray_image: RayImage | None = None
        self.size = (0, 0)  # of both images
        self.frame_times_s: list[float] = []
        self._proportion = layout.Proportion()
        self._draft = Draft.of(state.camera)
        self._grab: Grab | None = None
        self._hovered: tuple[str, Pixel] | None = None
        self._next_hovered: tuple[str, Pixel] | None = None
        self._panes_px: dict[str, tuple[int, int]] = {}
        self._gesture = 0
        self._was_active = False
        self._wheel = (0, 0.0)
        self._compared: Request | None = None
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
    def shown_camera(self) -> Camera:
        """The camera that both images are drawn with."""
        return self.state.view.for_size(self.size if min(self.size) else (1, 1))

    @property
    def request(self) -> Request | None:
        """The image that both renderers are to draw; None before the first layout."""
        if not min(self.size):
            return None
        return Request(self.state.scene, self.shown_camera, self.size)

    @property
    def settled(self) -> bool:
        """Whether both images are complete and compared: nothing will change by itself."""
        return (
            self.ray_image is not None
            and self.ray_image.factor == 1
            and self.ray_image.request == self.request
            and self.agreement.verdict_on(self.request) is not None
            and not (self.live.busy or self.files.busy or self.agreement.busy)
            and not (self.pictures is None or self.pictures.unfinished)
        )

    @property
    def failure(self) -> Exception | None:
        """What keeps an image from being complete."""
        drawn = (self.pictures.raster_error or self.pictures.ray_error) if self.pictures else None
        return drawn or self.live.error or self.agreement.error

    def change(self, state: AppState) -> None:
        """A step of its own in the history."""
        self.history = self.history.change(state)

    def undo(self) -> None:
        self.history = self.history.undo()

    def redo(self) -> None:
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
        self.pictures = Pictures(context, self.state.scene)
        on_drop(self._dropped)

    def menus(self) -> None:
        menu_bar(self, BUILTIN_SCENES, self.open)

    def frame(self) -> None:
        """The beginning of each frame: what has come from the threads, and the keys."""
        self.frame_times_s.append(time.perf_counter())
        del self.frame_times_s[:-600]
        active = imgui.is_any_item_active() or self._grab is not None
        if active and not self._was_active:
            self._gesture += 1
        self._was_active = active
        self._hovered, self._next_hovered = self._next_hovered, None
        opened = self.files.poll()
        if opened is not None:
            self._take_opened(opened)
        self._take_ray_image()
        self.agreement.poll()
        self._proportion.keep()
        run_shortcuts(self)
        if self._help:
            help_sheet(self, self.fonts, __version__)
        if self.files.message and message_box(self.files.message):
            self.files.message = ""
        if self.files.busy or (self.pictures is not None and self.pictures.unfinished):
            hello_imgui.request_refresh()

    def status(self) -> None:
        image, verdict = self.ray_image, self.agreement.verdict_on(self.request)
        failed = "" if self.agreement.error is None else describe(self.agreement.error)
        if image is not None and image.request.scene is not self.state.scene:
            image = None  # of another scene, until the first one of this scene comes
        pixel = self._hovered[1] if self._hovered else None
        status_line(
            Status(
                raster_s=self.pictures.raster_s if self.pictures else 0.0,
                raster_factor=self.pictures.raster_factor if self.pictures else 1,
                ray_s=image.frame.time_s if image else 0.0,
                size=self.size,
                factor=image.factor if image else 0,
                agreement=verdict.text if verdict else failed,
                agrees=verdict is not None and verdict.unexplained == 0,
                scene=self.state.scene.name,
                pixel=pixel,
                seen=self._seen(pixel),
            ),
            self.fonts,
        )

    def end(self) -> None:
        """Once, before the context goes."""
        self.live.close()
        self.agreement.close()
        self.files.close()
        if self.pictures is not None:
            self.pictures.release()

    # Windows.

    def _camera_window(self) -> None:
        around = Surroundings(self.fonts, self.shown_camera, self._focus())
        state, self._draft = camera_panel(self.state, self._draft, around)
        self._apply(state)

    def _raster_window(self) -> None:
        assert self.pictures is not None
        error = self.pictures.raster_error
        self._pane(RASTER, self._raster_texture, describe(error) if error else "", bool(error))

    def _ray_window(self) -> None:
        error = self.live.error or (self.pictures.ray_error if self.pictures else None)
        note = describe(error) if error else self._preparing_note()
        progress = 1.0
        if self.ray_image is not None and self.ray_image.factor > 1:
            progress = self.live.progress
        self._pane(RAY, self._ray_texture, note, bool(error), progress)
        request = self.request
        if request is not None:
            self.live.request(request)

    def _pane(self, name, texture, note, is_error, progress=1.0) -> None:  # type: ignore[no-untyped-def]
        flags = imgui.WindowFlags_
        dockable = hello_imgui.get_runner_params().docking_params.dockable_window_of_name(
            f"{TITLES[name]}###{name}"
        )
        if not dockable.is_visible:
            self._panes_px.pop(name, None)
            return
        imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(1, 1))
        opened, visible = imgui.begin(
            dockable.label,
            True,
            flags.no_scrollbar | flags.no_scroll_with_mouse | flags.no_background,
        )
        dockable.is_visible = bool(visible)
        imgui.pop_style_var()
        if opened:
            self._panes_px[name] = available_px()
            self._update_size()
            marked = None
            if self._hovered is not None and (
                self._hovered[0] != name or self.state.pixel_size > 4
            ):
                marked = self._hovered[1]
            pane = Pane(
                name=name,
                texture=texture,
                shown=self.shown_camera,
                size=self.size,
                center=self.scene_center,
                depth_at=self._depth_at,
                note=note,
                is_error=is_error,
                progress=progress,
                marked=marked,
            )
            result = image_pane(pane, self.state, self._grab)
            self._grab = result.grab
            if result.hovered is not None:
                self._next_hovered = (name, result.hovered)
            self._apply(result.state, wheeled=result.wheeled)
        imgui.end()

    # Images.

    def _raster_texture(self, state: AppState) -> int | None:
        assert self.pictures is not None
        wanted = Wanted(state.scene, state.view.for_size(self.size), self.size)
        texture = self.pictures.raster(wanted, state.exposure_ev, self._shown_px(state))
        return texture.glo if texture is not None else None

    def _ray_texture(self, state: AppState) -> int | None:
        assert self.pictures is not None
        texture = self.pictures.ray(state.exposure_ev, self._shown_px(state))
        return texture.glo if texture is not None else None

    def _shown_px(self, state: AppState) -> tuple[int, int]:
        """An image's size on the screen, in framebuffer pixels."""
        return self.size[0] * state.pixel_size, self.size[1] * state.pixel_size

    def _take_ray_image(self) -> None:
        image = self.live.poll()
        if image is not None and self.pictures is not None:
            self.pictures.take_ray(image)
            self.ray_image = image
        image, request = self.ray_image, self.request
        if image is None or image.factor != 1 or image.request != request:
            return
        if self._compared == request or self._grab is not None or self.pictures is None:
            return
        self._compared = request
        try:
            raster = self.pictures.read_back(Wanted(request.scene, request.camera, request.size))
            self.agreement.submit(image, raster)
        except LucidaError as error:
            self.pictures.raster_error = error

    def _preparing_note(self) -> str:
        if self.live.preparing_s < NOTE_AFTER_S:
            return ""
        if self.live.first_ever:
            return "compiling the ray tracer, once for this installation ..."
        return "preparing the scene for the ray tracer ..."

    def _update_size(self) -> None:
        """Both images have the same size: the smaller window's."""
        sizes = list(self._panes_px.values())
        pixel = self.state.pixel_size
        width, height = (max(1, min(size[k] for size in sizes) // pixel) for k in (0, 1))
        width, height = min(width, LARGEST_SIDE), min(height, LARGEST_SIDE)
        self.size = (width, min(height, LARGEST_PIXELS // width))

    # The pixel under the mouse.

    def _depth_at(self, pixel: Pixel) -> float | None:
        frame = self.agreement.frame_of(self.state.scene, self.shown_camera, self.size)
        if frame is None or frame.depth is None:
            return None
        depth = float(frame.depth[pixel])
        return depth if math.isfinite(depth) else None

    def _seen(self, pixel: Pixel | None) -> str:
        """The name of the object at a pixel, once that is known."""
        frame = self.agreement.frame_of(self.state.scene, self.shown_camera, self.size)
        if pixel is None or frame is None or frame.id is None:
            return ""
        if pixel[0] >= frame.size[1] or pixel[1] >= frame.size[0]:
            return ""
        number = int(frame.id[pixel])
        if number < 0:
            return "background"
        name = self.state.scene.objects[number].name or f"object {number}"
        return f"{name}, t = {float(frame.depth[pixel]):.4g}" if frame.depth is not None else name

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


def _make_tracer(scene: Scene):  # type: ignore[no-untyped-def]
    from renderer.trace import Tracer

    return Tracer(scene)
