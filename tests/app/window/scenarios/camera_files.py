"""Cameras of other programs in the window: copied, pasted, dropped, saved; scenes exported; K, R
and t in the panel."""

import numpy as np
from format_cameras import colmap_model
from imgui_bundle import imgui
from window_driver import Key

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.files import load_scene
from lucida.renderer.files.cameras import PosedCamera, written

CTRL = Key.mod_ctrl
PANEL = "//Camera"
SIZE = (64, 48)
AIMED = Camera.look_at((3, 2, 5), (0, 0.5, 0), fov_y_deg=40, aspect=SIZE[0] / SIZE[1])
LENS = '{"image_width": 20, "image_height": 16, "K": [9, 9, 10, 8], "D": [0.5, 0, 0, 0]}'


def only_sections(d, *names):
    for other in ("Look at", "K, R and t"):
        d.ctx.item_close(f"{PANEL}/{other}")
    d.frames(2)
    for wanted in names:
        d.ctx.item_open(f"{PANEL}/{wanted}")
        d.frames(2)


def said(d):
    texts = d.window.shell.toasts.texts
    return texts[-1] if texts else ""


def answer(d, words):
    d.click(f"//##message/{words}")


def save_as(d, action, path):
    """Through the menu and the window's own dialog, until the file is there."""
    d.menu(f"File/{action}")
    assert d.files.dialog.is_open
    d.ctx.key_chars_replace_enter(str(path))
    d.until(lambda: path.exists() and not d.files.busy)
    d.frames(3)


def same_camera(one, other, size=SIZE):
    points = np.random.default_rng(1).uniform(-1, 1, (9, 3))
    seen, wanted = one.project(points, size), other.project(points, size)
    return np.allclose(seen.row, wanted.row) and np.allclose(seen.column, wanted.column)


def drive_a_camera_is_copied_and_pasted(d):
    shown, size = d.renderers.camera(d.state), d.renderers.size
    d.menu("Edit/Copy camera as/OpenGL matrices")
    assert said(d).endswith("OpenGL matrices.")
    d.window.change(d.state.with_camera(AIMED))
    d.press(CTRL | Key.v)
    assert same_camera(d.renderers.camera(d.state), shown, size)
    assert "pasted from the clipboard: " in said(d)


def drive_a_pasted_matrix_asks_for_its_meaning(d):
    pose = np.linalg.inv(AIMED.camera_from_world) * (1, -1, -1, 1)
    imgui.set_clipboard_text(str(pose.tolist()))
    d.press(CTRL | Key.v)
    question = d.files.question
    assert len(question.answers) == 4
    opencv = "camera to world, y down"
    answer(d, next(words for words in question.answers if opencv in words))
    d.until(lambda: not d.window.travelling)
    assert np.allclose(d.state.camera.u, AIMED.u)
    assert np.allclose(d.state.camera.eye, AIMED.eye)
    assert d.steps == 1


def drive_a_dropped_camera_is_taken_with_its_lens(d):
    plain, bent = d.folder / "plain.yml", d.folder / "bent.json"
    plain.write_bytes(written([PosedCamera(AIMED, SIZE)], "opencv"))
    bent.write_text(LENS)
    d.drop([str(plain)])
    d.until(lambda: d.state.camera != d.start.camera)
    d.frames(3)
    assert same_camera(d.state.camera, AIMED)
    assert said(d).startswith("The camera is plain.yml's: OpenCV's K, R and t")
    assert d.files.question is None
    before = d.state
    d.drop([str(bent)])
    d.until(lambda: d.state.camera != before.camera)
    d.frames(3)
    assert d.state.camera.lens == Lens("brown", {"k1": 0.5})
    assert said(d).startswith("The camera is bent.json's: ")
    # A glTF file of a camera alone, which ends as models do.
    path = d.folder / "alone.gltf"
    path.write_bytes(written([PosedCamera(AIMED, SIZE)], "gltf"))
    d.window.change(d.start)
    d.drop([str(path)])
    d.until(lambda: same_camera(d.state.camera, AIMED))
    d.frames(3)
    assert said(d).startswith("The camera is alone.gltf's: ")
    d.window.change(d.start)
    # A folder of COLMAP with one image, and no points.
    folder = d.folder / "one"
    colmap_model(folder, [PosedCamera(AIMED, SIZE, "a.png")])
    d.drop([str(folder)])
    d.until(lambda: same_camera(d.state.camera, AIMED))
    d.frames(3)
    assert "COLMAP" in said(d)


def drive_a_scene_is_exported_and_what_is_left_out_is_listed(d):
    path = d.folder / "out.glb"
    d.press(CTRL | Key.e)
    assert d.files.dialog.is_open
    d.ctx.key_chars_replace_enter(str(path))
    d.until(lambda: bool(d.files.message))
    assert len(load_scene(path).objects) == len(d.state.scene.objects)
    title, *notes = d.files.message.splitlines()
    assert str(path) in title and notes
    d.click("//##message/Close")
    assert not d.files.message


def drive_k_r_and_t_are_read_switched_and_copied(d):
    only_sections(d, "K, R and t")
    shown, size = d.renderers.camera(d.state), d.renderers.size
    assert d.options.pixel_origin == "center"
    for origin, button in (("corner", "corners"), ("center", "centres")):
        d.click(f"{PANEL}/{button}")
        assert d.options.pixel_origin == origin
        d.click(f"{PANEL}/Copy K, R, t")
        names = {}
        exec(imgui.get_clipboard_text(), names)
        assert np.allclose(names["K"], shown.intrinsics(size, origin).K, atol=1e-9)
        d.window.change(d.state.with_camera(AIMED))
        d.press(CTRL | Key.v)
        assert same_camera(d.renderers.camera(d.state), shown, size)
    d.press(Key.p)
    assert not d.ctx.item_exists(f"{PANEL}/Copy K, R, t")
    only_sections(d)
