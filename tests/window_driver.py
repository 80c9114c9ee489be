"""Drives the real window with ImGui's test engine, on GLFW's null platform; a process of its own.

    python window_driver.py REPORT.json FOLDER [PART OF A NAME ...]

runs every function of this file whose name begins with `drive_` (or those named), in order, in
one window, and writes a JSON object from their names to "" or the traceback of their failure.
Pictures of the window are left in FOLDER. test_window.py runs it and tells the results.
"""

from __future__ import annotations

import json
import os
import sys
import threading
import time
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

os.environ.pop("DISPLAY", None)
os.environ.pop("WAYLAND_DISPLAY", None)

from imgui_bundle import hello_imgui, imgui
from PIL import Image

from app.layout import CAMERA_SPACE
from app.panels.images import framebuffer_scale
from app.platform import start_platform
from app.state import AppState, History
from app.viewer import Run
from app.window import RASTER, RAY
from renderer.scene import load_scene, save_view

SIZE = (1100, 720)
PATIENT_S = 120.0  # the first tracing compiles
IMAGES = {name: f"//###{name}/image##{name}" for name in (RASTER, RAY)}
Key = imgui.Key


class Driver:
    """The window under test, and what tests do with it. ctx: the test engine's context."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        state = AppState.for_scene(load_scene("still-life"))
        self.start = state
        self.run = Run(start_platform(want_display=False), state, SIZE, remember=False)
        self.window = self.run.window
        self.ctx: Any = None
        self.stay = False  # the mouse, while a picture is taken
        self._pictures = 0

    def reset(self) -> None:
        """Every test begins with the same state, at rest."""
        self.window.history = History(self.start)
        self.window.files.message = ""
        self.stay = False
        self.ctx.mouse_teleport_to_pos((3, SIZE[1] - 3))
        self.settle()

    def until(self, condition: Callable[[], bool]) -> None:
        end_s = time.monotonic() + PATIENT_S
        while not condition():
            assert time.monotonic() < end_s, "nothing happened"
            self.ctx.yield_()

    def settle(self) -> None:
        """Until both images are complete and compared."""
        self.ctx.yield_(3)
        self.until(lambda: self.window.settled)
        self.ctx.yield_(2)

    def picture(self) -> np.ndarray:
        """What the window shows, uint8 (height, width, 3)."""
        self._pictures += 1
        path = self.folder / f"{self._pictures:02d}.png"
        self.ctx.capture_reset()
        self.ctx.capture_set_filename(str(path))
        assert self.ctx.capture_screenshot(int(imgui.test_engine.CaptureFlags_.hide_mouse_cursor))
        return np.asarray(Image.open(path).convert("RGB"))

    def rect(self, name: str) -> tuple[float, float, float, float]:
        """Left, top, right, bottom of an image in the window."""
        box = self.ctx.item_info(IMAGES[name]).rect_full
        return box.min.x, box.min.y, box.max.x, box.max.y

    def images(self) -> tuple[np.ndarray, np.ndarray]:
        """The pixels of both images as shown, int16. Tooltips are not in the way."""
        if not self.stay:
            self.ctx.mouse_teleport_to_pos((3, SIZE[1] - 3))
            self.ctx.yield_(3)
        window, scale = self.picture(), framebuffer_scale()
        cut = []
        for name in (RASTER, RAY):
            left, top, right, bottom = (round(edge * scale) for edge in self.rect(name))
            cut.append(window[top:bottom, left:right].astype(np.int16))
        return cut[0], cut[1]

    def agreeing_images(self) -> tuple[np.ndarray, np.ndarray]:
        """Both images at rest; they must agree, and show something."""
        self.settle()
        verdict = self.window.renderers.agreement.verdict_on(
            self.window.renderers.request(self.window.state)
        )
        assert verdict is not None
        assert verdict.unexplained == 0, verdict.text
        raster, ray = self.images()
        assert raster.shape == ray.shape
        assert raster.shape[:2] == (self.window.renderers.size[1], self.window.renderers.size[0])
        different = (np.abs(raster - ray).max(axis=2) > 3).mean()
        assert different < 0.002, f"{different:.2%} of the pixels differ on the screen"
        assert raster.std() > 5
        return raster, ray

    def point(self, name: str, x: float, y: float) -> tuple[float, float]:
        """A place in an image, as parts of its width and height."""
        left, top, right, bottom = self.rect(name)
        return left + x * (right - left), top + y * (bottom - top)

    def drag(self, start: tuple[float, float], end: tuple[float, float], button: int = 0) -> None:
        self.ctx.mouse_teleport_to_pos(start)
        self.ctx.yield_()
        self.ctx.mouse_down(button)
        for part in (0.25, 0.5, 0.75, 1.0):
            x, y = (a + part * (b - a) for a, b in zip(start, end, strict=True))
            self.ctx.mouse_teleport_to_pos((x, y))
            self.ctx.yield_()
        self.ctx.mouse_up(button)
        self.ctx.yield_()

    def field(self, name: str) -> str:
        return f"//Camera/##{name}"

    def drag_field(self, name: str, pixels: float) -> None:
        center = self.ctx.item_info(self.field(name)).rect_full.get_center()
        self.drag((center.x, center.y), (center.x + pixels, center.y))

    def type(self, name: str, text: str) -> None:
        """Double-clicks a field and types."""
        self.ctx.item_double_click(self.field(name))
        self.ctx.key_chars_replace_enter(text)
        self.ctx.yield_(2)


def changed(before: np.ndarray, after: np.ndarray) -> float:
    """The part of the pixels that differ visibly."""
    return float((np.abs(before - after).max(axis=2) > 8).mean())


def drive_01_a_slider_is_dragged(d: Driver) -> None:
    before = d.agreeing_images()
    center = d.ctx.item_info(d.field("w.x")).rect_full.get_center()
    d.ctx.mouse_teleport_to_pos((center.x, center.y))
    d.ctx.mouse_down(0)
    seen = []
    for step in range(1, 30):
        d.ctx.mouse_teleport_to_pos((center.x + 2 * step, center.y))
        d.ctx.yield_()
        image = d.window.renderers.ray_image
        seen.append(image.request.camera.eye)
        shown = d.window.renderers.ray_texture(d.window.state)
        assert shown is not None  # never nothing
    d.ctx.mouse_up(0)
    assert d.window.state.camera.w[0] > d.start.camera.w[0] + 0.05
    after = d.agreeing_images()
    assert changed(before[0], after[0]) > 0.1
    assert changed(before[1], after[1]) > 0.1
    assert len(d.window.history.past) == 1  # the whole drag
    assert d.window.renderers.ray_image.factor == 1


def drive_02_a_switch_is_clicked(d: Driver) -> None:
    before = d.agreeing_images()
    d.ctx.item_click("//Camera/parallel")
    assert d.window.state.camera.projection == "parallel"
    after = d.agreeing_images()
    assert changed(before[0], after[0]) > 0.05
    assert changed(before[1], after[1]) > 0.05
    d.ctx.item_click("//Camera/perspective")
    assert d.window.state.camera.projection == "perspective"
    again = d.agreeing_images()
    assert changed(before[0], again[0]) < 0.01


def drive_03_a_number_is_typed(d: Driver) -> None:
    before = d.agreeing_images()
    d.type("eye.x", "-2.25")
    assert d.window.state.camera.eye[0] == -2.25
    d.type("distance", "1.1")
    assert d.window.state.camera.distance == 1.1
    d.type("left", "-0.9")
    assert d.window.state.camera.viewport[0] == -0.9
    after = d.agreeing_images()
    assert changed(before[0], after[0]) > 0.1
    assert changed(before[1], after[1]) > 0.1
    assert len(d.window.history.past) == 3


def drive_04_a_singular_basis_is_told_and_survived(d: Driver) -> None:
    d.ctx.item_click("//Camera/keep orthonormal")
    assert not d.window.state.keep_orthonormal
    d.settle()
    legal, before = d.window.state, d.images()
    for axis in "xyz":
        d.type(f"w.{axis}", "0")
    draft = d.window._draft
    assert draft.error is not None
    assert draft.error.field == "w"
    assert "independent" in str(draft.error)
    assert d.window.state.camera.w[2] == legal.camera.w[2]  # only the legal steps were taken
    assert d.ctx.item_exists("//Camera/Back to the camera shown")
    shown = d.agreeing_images()
    assert shown[0].std() > 5
    d.type("distance", "-1")
    assert d.window.state.camera.distance == legal.camera.distance
    d.type("right", "-5")
    assert d.window._draft.error is not None
    d.ctx.item_click("//Camera/Back to the camera shown")
    d.type("w.x", "0.34567")
    d.type("w.y", "0.24567")
    for name in ("u", "v", "w"):
        d.type(f"{name}.z", "0")
    assert "lies in the plane" in str(d.window._draft.error)  # the longest text there is
    d.ctx.yield_(2)
    assert d.ctx.get_window_by_ref("//Camera").scroll_max.y == 0
    d.ctx.item_click("//Camera/Back to the camera shown")
    d.ctx.yield_(2)
    assert d.window._draft.error is None
    assert d.window._draft.camera == d.window.state.camera
    while d.window.state != legal and d.window.can_undo():
        d.ctx.key_press(int(Key.mod_ctrl) | int(Key.z))
    d.settle()
    assert d.window.state == legal
    assert changed(before[0], d.images()[0]) == 0


def drive_05_a_left_handed_skewed_camera_agrees(d: Driver) -> None:
    d.ctx.item_click("//Camera/keep orthonormal")
    d.type("u.x", "-0.8")
    d.type("u.y", "0.25")
    d.type("v.y", "1.4")
    d.agreeing_images()
    d.ctx.item_click("//Camera/keep orthonormal")
    assert d.window.state.camera.determinant < 0
    basis = d.window.state.camera.basis
    assert np.allclose(basis.T @ basis, np.eye(3))
    d.agreeing_images()


def drive_06_the_mouse_turns_moves_and_zooms(d: Driver) -> None:
    window, start = d.window, d.start.camera
    for name in (RASTER, RAY):
        before = d.agreeing_images()
        d.drag(d.point(name, 0.5, 0.5), d.point(name, 0.7, 0.45))
        camera = window.state.camera
        assert np.allclose(camera.basis.T @ camera.basis, np.eye(3))
        assert abs(camera.u[1]) < 1e-9  # no roll
        assert not np.allclose(camera.w, start.w)
        after = d.agreeing_images()
        assert min(changed(a, b) for a, b in zip(before, after, strict=True)) > 0.1
        for button, key in ((1, 0), (2, 0), (0, int(Key.mod_shift))):
            was = window.state.camera
            pixel = (window.renderers.size[1] // 2, window.renderers.size[0] // 2)
            parameter = window.renderers.depth_at(window.state, pixel)
            ray = window.renderers.camera(window.state).ray(*pixel, window.renderers.size)
            world = ray.origin + parameter * ray.direction
            if key:
                d.ctx.key_down(key)
            x, y = d.point(name, 0, 0)
            middle = (x + pixel[1] + 0.5, y + pixel[0] + 0.5)
            d.drag(middle, (middle[0] + 37, middle[1] - 21), button)
            if key:
                d.ctx.key_up(key)
            assert window.state.camera.w == was.w
            assert window.state.camera.eye != was.eye
            row, column, _ = window.renderers.camera(window.state).project(
                world, window.renderers.size
            )
            assert abs(row - (pixel[0] - 21)) < 0.05
            assert abs(column - (pixel[1] + 37)) < 0.05
            d.settle()
        was = window.state.camera
        steps = len(window.history.past)
        d.ctx.mouse_teleport_to_pos(d.point(name, 0.5, 0.6))
        d.ctx.yield_()
        d.ctx.mouse_wheel_y(2)
        d.ctx.mouse_wheel_y(1)
        d.ctx.yield_(2)
        assert window.state.camera.eye != was.eye
        assert len(window.history.past) == steps + 1
        d.agreeing_images()
        d.reset()
    d.ctx.item_click("//Camera/parallel")
    d.settle()
    was = window.state.camera
    d.ctx.mouse_teleport_to_pos(d.point(RAY, 0.3, 0.3))
    d.ctx.yield_()
    d.ctx.mouse_wheel_y(3)
    d.ctx.yield_(2)
    assert window.state.camera.eye == was.eye
    assert window.state.camera.viewport[1] < was.viewport[1]
    d.agreeing_images()


def drive_07_undo_and_redo(d: Driver) -> None:
    d.drag_field("eye.x", 40)
    moved = d.window.state
    d.drag(d.point(RAY, 0.5, 0.5), d.point(RAY, 0.6, 0.5))
    turned = d.window.state
    assert len(d.window.history.past) == 2
    ctrl, shift = int(Key.mod_ctrl), int(Key.mod_shift)
    d.ctx.key_press(ctrl | int(Key.z))
    assert d.window.state == moved
    d.ctx.key_press(ctrl | int(Key.z))
    assert d.window.state == d.start
    d.ctx.key_press(ctrl | shift | int(Key.z))
    assert d.window.state == moved
    d.ctx.key_press(ctrl | int(Key.y))
    assert d.window.state == turned
    d.ctx.menu_click("//##MainMenuBar/Edit/Undo")
    assert d.window.state == moved
    d.agreeing_images()


def drive_08_keys_and_menus(d: Driver) -> None:
    window = d.window
    d.ctx.mouse_move(IMAGES[RASTER])
    d.ctx.key_press(int(Key.p))
    assert window.state.camera.is_parallel
    d.ctx.key_press(int(Key.o))
    assert not window.state.keep_orthonormal
    d.ctx.key_press(int(Key.home))
    assert window.state.view == d.start.view
    d.ctx.menu_click("//##MainMenuBar/Camera/Canonical camera")
    assert window.state.camera.eye == (0, 0, 0)
    assert window.state.camera.viewport == (-0.5, 0.5, -0.5, 0.5)
    d.ctx.menu_click("//##MainMenuBar/Camera/Fit to the image's aspect ratio")
    d.settle()
    assert window.renderers.camera(window.state).viewport == (-0.5, 0.5, -0.5, 0.5)
    d.ctx.item_click("//Camera/Scene's view")
    assert window.state.camera == d.start.camera
    d.ctx.key_press(int(Key.f1))
    d.ctx.yield_(2)
    assert d.ctx.window_info("//Mouse and keys").id_ != 0
    d.picture()
    d.ctx.key_press(int(Key.escape))
    d.ctx.yield_(2)
    assert not window._help


def drive_09_letters_typed_into_a_field_are_no_shortcuts(d: Driver) -> None:
    d.ctx.item_double_click(d.field("eye.y"))
    d.ctx.key_chars_replace("po")
    d.ctx.key_press(int(Key.p))
    d.ctx.key_press(int(Key.escape))
    assert d.window.state == d.start


def drive_10_pixels_can_be_large_and_are_marked(d: Driver) -> None:
    before = d.window.renderers.size
    d.ctx.menu_click("//##MainMenuBar/View/Pixels 8 x 8")
    d.settle()
    assert d.window.renderers.size == (before[0] // 8, before[1] // 8)
    raster, ray = d.images()
    assert raster.shape[:2] == (8 * d.window.renderers.size[1], 8 * d.window.renderers.size[0])
    blocks = raster.reshape(d.window.renderers.size[1], 8, d.window.renderers.size[0], 8, 3)
    assert (blocks == blocks[:, :1, :, :1]).all()  # nearest neighbour: no pixel is blurred
    x, y, *_ = d.rect(RASTER)
    d.ctx.mouse_teleport_to_pos((x + 8 * 20 + 4, y + 8 * 30 + 4))
    d.ctx.yield_(3)
    assert d.window._hovered == (RASTER, (30, 20))
    d.stay = True
    marked = d.images()[1]
    places = np.argwhere(np.abs(marked - ray).max(axis=2) > 8)
    assert places.min(axis=0).tolist() == [8 * 30 - 2, 8 * 20 - 2]
    assert places.max(axis=0).tolist() == [8 * 31 + 1, 8 * 21 + 1]


def drive_11_exposure_brightens_both(d: Driver) -> None:
    before = d.agreeing_images()
    d.type("exposure", "1")
    after = d.agreeing_images()
    for dark, bright in zip(before, after, strict=True):
        assert bright.mean() > dark.mean() + 10
    d.type("exposure", "99")
    assert d.window.state.exposure_ev == 8.0


def drive_12_files_are_opened_and_broken_ones_told(d: Driver) -> None:
    window = d.window
    window.open(str(d.folder / "missing.toml"))
    d.until(lambda: bool(window.files.message))
    assert "missing.toml" in window.files.message
    assert window.state == d.start
    d.ctx.yield_(3)
    d.picture()
    d.ctx.item_click("//##message/Close")
    assert window.files.message == ""
    os.environ["PATH"], path = "", os.environ["PATH"]  # no program that draws dialogs
    d.ctx.key_press(int(Key.mod_ctrl) | int(Key.o))
    d.ctx.yield_(2)
    os.environ["PATH"] = path
    if sys.platform.startswith("linux"):
        assert "zenity" in window.files.message
    broken = d.folder / "broken.obj"
    broken.write_bytes(b"\x00\xff nothing of use")
    window._dropped([str(broken)])
    d.until(lambda: "broken.obj" in window.files.message)
    assert window.state == d.start
    window.open("spheres")
    d.until(lambda: window.state.scene is not d.start.scene)
    assert window.state.scene.name == "spheres"
    d.agreeing_images()
    view = d.folder / "view.toml"
    save_view(view, d.start.view)
    window.open(str(view))
    d.until(lambda: window.state.view == d.start.view)
    assert window.state.scene.name == "spheres"
    d.ctx.key_press(int(Key.mod_ctrl) | int(Key.z), 2)
    d.settle()
    assert window.state == d.start


def drive_13_a_failing_tracer_is_told_and_survived(d: Driver) -> None:
    live = d.window.renderers.live
    good = live._make_tracer

    def bad(scene: object) -> Any:
        raise MemoryError

    live._make_tracer = bad
    d.window.open("canonical")
    d.until(lambda: live.error is not None)
    d.ctx.yield_(3)
    d.picture()
    live._make_tracer = good
    d.window.open("spheres")
    d.until(lambda: d.window.state.scene.name == "spheres")
    d.agreeing_images()


def drive_14_no_frame_waits_for_the_tracer(d: Driver) -> None:
    """The tracer's thread is held up: the window goes on, with the raster image of now."""
    live, gate = d.window.renderers.live, threading.Event()
    good = live._make_tracer

    def slow(scene: object) -> Any:
        gate.wait(PATIENT_S)
        return good(scene)

    live._make_tracer = slow
    d.window.open("columns")
    d.until(lambda: d.window.state.scene.name == "columns")
    d.until(lambda: "preparing" in d.window.renderers.preparing())
    before = d.images()[0]
    d.drag_field("eye.x", 30)
    d.until(lambda: not d.window.renderers.pictures.unfinished)
    assert changed(before, d.images()[0]) > 0.05
    assert d.window.renderers.live.busy
    live._make_tracer = good
    gate.set()
    d.agreeing_images()


def drive_15_windows_can_be_hidden(d: Driver) -> None:
    both = d.window.renderers.size
    d.ctx.window_close(f"//###{RAY}")
    d.ctx.yield_(3)
    d.until(lambda: d.window.renderers.size[0] > both[0])
    d.ctx.menu_click("//##MainMenuBar/View/Ray  image order")
    d.ctx.yield_(3)
    d.ctx.menu_click("//##MainMenuBar/View/Reset the layout")
    d.ctx.yield_(5)
    d.agreeing_images()
    assert abs(d.window.renderers.size[0] - both[0]) <= 2


def drive_16_the_window_is_resized(d: Driver) -> None:
    hello_imgui.change_window_size((1500, 640))
    d.ctx.yield_(5)
    d.agreeing_images()
    widths = [width for width, _ in d.window._panes_px.values()]
    assert abs(widths[0] - widths[1]) <= 2, "both images have half of the room"
    hello_imgui.change_window_size(SIZE)
    d.ctx.yield_(5)


def drive_17_the_wheel_goes_through_nothing(d: Driver) -> None:
    """Scrolling faster than images are finished: the point under the mouse stays the aim."""
    window = d.window
    pixel = (window.renderers.size[1] // 2 + 30, window.renderers.size[0] // 2)
    x, y, *_ = d.rect(RASTER)
    d.ctx.mouse_teleport_to_pos((x + pixel[1], y + pixel[0]))  # ImGui's mouse has whole numbers
    d.ctx.yield_()
    corner = pixel[0] - 0.5, pixel[1] - 0.5
    ray = window.renderers.camera(window.state).ray(*corner, window.renderers.size)
    aim = ray.origin + window.renderers.depth_at(window.state, pixel) * ray.direction
    for _ in range(30):
        d.ctx.mouse_wheel_y(3)
    d.ctx.yield_(2)
    to_aim = aim - np.asarray(window.state.camera.eye)
    assert to_aim @ ray.direction > -0.01, "the eye has gone through what was under the mouse"
    assert np.linalg.norm(to_aim) < 0.01, to_aim
    for _ in range(20):
        d.ctx.mouse_wheel_y(-10)
    d.ctx.yield_(2)
    assert 100 < np.linalg.norm(window.state.camera.eye) < 1e4
    d.ctx.key_press(int(Key.home))
    assert window.state == d.start


def drive_18_keys_count_while_an_image_is_dragged(d: Driver) -> None:
    window = d.window
    d.ctx.mouse_teleport_to_pos(d.point(RAY, 0.5, 0.5))
    d.ctx.yield_()
    d.ctx.mouse_down(0)
    d.ctx.mouse_teleport_to_pos(d.point(RAY, 0.6, 0.5))
    d.ctx.yield_(2)
    turned = window.state.camera
    d.ctx.key_press(int(Key.p))
    d.ctx.mouse_teleport_to_pos(d.point(RAY, 0.7, 0.5))
    d.ctx.yield_(2)
    assert window.state.camera.is_parallel
    assert window.state.camera.w != turned.w  # and the drag goes on
    assert len(window.history.past) == 3
    d.ctx.key_press(int(Key.mod_ctrl) | int(Key.z), 3)
    d.ctx.mouse_teleport_to_pos(d.point(RAY, 0.8, 0.5))
    d.ctx.yield_(2)
    assert window.state == d.start  # undone is undone
    d.ctx.mouse_up(0)
    d.ctx.yield_()
    assert window.state == d.start
    assert len(window.history.future) == 3


def drive_19_the_distance_is_not_dragged_below_zero(d: Driver) -> None:
    d.drag_field("distance", -280)
    d.drag_field("distance", -280)
    assert 0 < d.window.state.camera.distance < d.start.camera.distance
    for _ in range(12):
        d.drag_field("distance", -280)
    assert d.window._draft.error is None
    assert d.window.state.camera.distance > 0
    d.type("distance", "0.00002")
    assert d.window.state.camera.distance == 0.00002


def drive_20_a_tiny_window_is_survived(d: Driver) -> None:
    hello_imgui.change_window_size((300, 60))
    d.ctx.yield_(5)
    hello_imgui.change_window_size(SIZE)
    d.ctx.yield_(5)
    d.agreeing_images()
    widths = [width for width, _ in d.window._panes_px.values()]
    assert abs(widths[0] - widths[1]) <= 2, "both images have half of the room again"


def drive_21_shadows_and_mirrors_are_the_ray_images_alone(d: Driver) -> None:
    raster, ray = d.agreeing_images()
    d.ctx.menu_click("//##MainMenuBar/View/Shadows (ray image only)")
    d.settle()
    raster_after, shaded = d.images()
    assert (np.abs(raster_after - raster) <= 3).all()
    assert (ray - shaded).max() > 30
    d.ctx.menu_click("//##MainMenuBar/View/Mirrors (ray image only)")
    d.settle()
    assert np.abs(d.images()[1] - shaded).max() > 30
    verdict = d.window.renderers.verdict(d.window.state)
    assert verdict is not None
    assert verdict.text.startswith("not compared")
    d.window.undo()
    d.window.undo()
    d.agreeing_images()


def drive_22_the_camera_panel_stays_wide_enough_for_its_numbers(d: Driver) -> None:
    params = d.run.params.docking_params
    node = imgui.internal.dock_builder_get_node(params.dock_space_id_from_name(CAMERA_SPACE))
    wide = node.size.x
    imgui.internal.dock_builder_set_node_size(node.id_, (150, node.size.y))
    d.ctx.yield_(4)
    assert d.ctx.get_window_by_ref("//Camera").size.x > wide - 3
    d.agreeing_images()


def close_at_work(report: Path, folder: Path) -> None:
    """Closes the window while a tracer prepares, which nothing can cancel."""
    driver = Driver(folder)
    driver.window.renderers.live._make_tracer = lambda scene: threading.Event().wait()
    frames = iter(range(20))

    def count() -> None:
        driver.run.params.app_shall_exit = next(frames, None) is None

    driver.run.params.callbacks.post_new_frame = count
    driver.run.run()
    busy = driver.window.renderers.live.busy
    report.write_text(json.dumps({"close_at_work": "" if busy else "the tracer was not at work"}))


def main(report: Path, folder: Path, only: list[str]) -> None:
    tests = {name: test for name, test in globals().items() if name.startswith("drive_")}
    tests = {n: t for n, t in tests.items() if not only or any(part in n for part in only)}
    results = dict.fromkeys(tests, "was not run")
    driver = Driver(folder)
    params = driver.run.params

    def wrapped(name: str, test: Callable[[Driver], None]) -> Callable[[Any], None]:
        def call(ctx: Any) -> None:
            driver.ctx = ctx
            try:
                driver.reset()
                test(driver)
                results[name] = "the test engine found an error" if ctx.is_error() else ""
            except BaseException:
                results[name] = traceback.format_exc()
            if name == list(tests)[-1]:
                params.app_shall_exit = True

        return call

    def register() -> None:
        engine = hello_imgui.get_imgui_test_engine()
        io = imgui.test_engine.get_io(engine)
        io.config_run_speed = imgui.test_engine.TestRunSpeed.fast
        io.config_log_to_tty = True
        io.config_watchdog_warning = io.config_watchdog_kill_test = 2 * PATIENT_S
        for name, test in tests.items():
            entry = imgui.test_engine.register_test(engine, "window", name)
            entry.test_func = wrapped(name, test)
            imgui.test_engine.queue_test(engine, entry)

    params.use_imgui_test_engine = True
    params.callbacks.register_tests = register
    params.fps_idling.enable_idling = False
    try:
        driver.run.run()
    finally:
        report.write_text(json.dumps(results, indent=1))


if __name__ == "__main__":
    if sys.argv[3:] == ["close_at_work"]:
        close_at_work(Path(sys.argv[1]), Path(sys.argv[2]))
    else:
        main(Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3:])
