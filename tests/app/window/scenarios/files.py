"""Files and failures: dialogs, what is opened, what is broken, what takes long."""

import os
import sys
import threading

from imgui_bundle import ImVec2, hello_imgui, imgui
from window_driver import PATIENT_S, Key, changed

from lucida.app.ui import messages
from lucida.app.window import files as window_files
from lucida.app.window.viewer import IDLE_FPS, WAITING_FPS
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import load_scene, save_view
from lucida.renderer.files.export import export_scene

CTRL, SHIFT = Key.mod_ctrl, Key.mod_shift


def drive_files_are_opened_and_broken_ones_told(d):
    window = d.window
    window.open(str(d.folder / "missing.toml"))
    d.until(lambda: bool(window.files.message))
    assert "missing.toml" in window.files.message
    assert window.state == d.start
    d.frames(3)
    d.click("//##message/Close")
    assert window.files.message == ""
    os.environ["PATH"], path = "", os.environ["PATH"]  # no program that draws dialogs
    window.files.native = True
    d.press(Key.mod_ctrl | Key.o)
    os.environ["PATH"] = path
    window.files.native = False
    if sys.platform.startswith("linux"):
        assert window.files.dialog.is_open  # the window's own
        d.press(Key.escape)
    assert not window.files.dialog.is_open
    broken = d.folder / "broken.obj"
    broken.write_bytes(b"\x00\xff nothing of use")
    d.drop([str(broken)])
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
    d.ctx.key_press(Key.mod_ctrl | Key.z, 2)
    d.settle()
    assert window.state == d.start


def drive_a_model_s_own_cameras_are_chosen_and_undone(d):
    window, start = d.window, d.state
    scene = load_scene("spheres")
    camera = Camera.look_at((0, 2, 12), (0, 1, 0), fov_y_deg=20)
    export_scene(d.folder / "seen.glb", scene, camera, (64, 64))
    window.open(str(d.folder / "seen.glb"))
    d.until(lambda: window.state.scene.name == "seen")
    opened = window.state
    assert opened.view == opened.scene.view  # framed, whatever cameras there are
    (named,) = opened.scene.views
    d.menu("Camera/From the file/###view0")
    d.until(lambda: window.state.view == named.view)
    assert window.state.camera.eye == (0, 2, 12)
    window.undo()
    d.settle()
    assert window.state == opened
    window.undo()
    d.settle()
    assert window.state == start


def drive_no_frame_waits_for_the_tracer(d):
    """The tracer's thread is held up: the window goes on, with the raster image of now."""
    live, gate = d.renderers.live, threading.Event()
    good = live.make_tracer

    def slow(scene):
        gate.wait(PATIENT_S)
        return good(scene)

    live.make_tracer = slow
    d.window.open("columns")
    d.until(lambda: d.state.scene.name == "columns")
    d.change(mirrors=True)  # that needs a new one
    d.until(lambda: "preparing" in d.renderers.preparing())
    told = d.renderers.preparing()
    d.until(lambda: d.renderers.preparing() != told)  # the seconds, which are seen at rest
    assert hello_imgui.get_runner_params().fps_idling.fps_idle == WAITING_FPS
    before = d.images()[0]
    d.drag_field("eye.x", 30)
    d.until(lambda: not d.renderers.textures.unfinished)
    assert changed(before, d.images()[0]) > 0.05
    assert d.renderers.live.busy
    live.make_tracer = good
    gate.set()
    d.change(mirrors=False)
    d.agreeing_images()
    assert hello_imgui.get_runner_params().fps_idling.fps_idle == IDLE_FPS


def drive_the_windows_own_dialog_opens_and_saves(d):
    files = d.files
    folder = d.folder / "scenes"
    folder.mkdir()
    (folder / "mine.toml").write_text('name = "mine"\n[[objects]]\ntype = "sphere"\n')
    d.press(CTRL | Key.o)
    assert files.dialog.is_open
    d.ctx.key_chars_replace_enter(str(folder / "yours.toml"))
    assert files.dialog.is_open, "there is no such file"
    d.ctx.key_chars_replace_enter(str(folder / "mine.toml"))
    d.until(lambda: d.state.scene.name == "mine")
    assert not files.dialog.is_open
    d.press(CTRL | SHIFT | Key.s)
    d.ctx.key_chars_replace_enter("copy")
    d.until(lambda: (folder / "copy.toml").exists())
    assert load_scene(folder / "copy.toml").view == d.state.view
    d.until(lambda: any("copy.toml" in text for text in d.window.shell.toasts.texts))
    # What is there already is not replaced unasked.
    d.press(CTRL | SHIFT | Key.s)
    d.ctx.key_chars_replace_enter("copy.toml")
    assert files.dialog.is_open
    d.press(Key.escape)
    assert not files.dialog.is_open
    assert "objects" in (folder / "copy.toml").read_text()
    d.until(lambda: [entry.name for entry in files.recent.entries][:1] == ["copy.toml"])
    d.menu("File/Recent files/###recent1")
    d.until(lambda: d.files.loading == "" and d.state.scene.origin is not None)
    d.menu("File/Recent files/Clear the list")
    assert files.recent.entries == ()


def drive_loading_is_told_and_cancelled(d):
    good = window_files.open_sources
    for _ in range(2):
        gate = threading.Event()
        window_files.open_sources = lambda *_, gate=gate: gate.wait(PATIENT_S)
        d.window.open("slow.obj")
        d.until(lambda: loading_box() is not None)
        d.frames(2)
        box, pad = loading_box(), imgui.get_style().window_padding
        low_right = box.pos.x + box.size.x - 2 * pad.x, box.pos.y + box.size.y - 2 * pad.y
        d.ctx.mouse_move_to_pos(ImVec2(*low_right))  # the button
        d.ctx.mouse_click()
        d.until(lambda: not d.files.busy)
        assert "cancelled" in d.window.shell.toasts.texts[-1]
        gate.set()
    window_files.open_sources = good
    d.window.open("spheres")  # a new thread does it
    d.until(lambda: d.state.scene.name == "spheres")


def drive_a_scene_taken_back_is_drawn_without_being_prepared_again(d):
    window, path = d.window, d.folder / "twice.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    window.open(str(path))
    d.until(lambda: window.state.scene.name == "twice")
    d.settle()
    opened = window.state.scene
    window.undo()
    d.settle()
    textures = window.renderers.textures
    rasterizer = textures.rasterizer.of(window.state.scene)
    taken = []
    good = rasterizer.set_scene

    def set_scene(scene, prepared=None):
        taken.append(scene is opened and prepared is not None)
        good(scene, prepared)

    rasterizer.set_scene = set_scene
    window.redo()
    d.settle()
    del rasterizer.set_scene
    assert taken == [True]
    d.agreeing_images()


def loading_box():
    """ImGui's window, while it is shown. The test engine does not find it a second time."""
    windows = imgui.get_current_context().windows
    return next((one for one in windows if one.name == messages.LOADING and one.active), None)
