"""The detective: a matrix is pasted, its readings are drawn, one is chosen, and written down."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from imgui_bundle import imgui
from window_driver import Driver, Key

from app.cameras.text import python
from app.detective import example, model, ranking
from app.detective.actions import QUESTIONS
from app.detective.options import DetectiveOptions
from app.detective.readings import Convention, is_same
from app.detective.view import DETECTIVE, DetectiveView
from renderer.camera import Camera
from renderer.scene import load_scene

CTRL = int(Key.mod_ctrl)
ODD = Convention("world-to-camera", True, "OpenCV", turned=True)


def _view(d: Driver) -> DetectiveView:
    view = d.window.views[DETECTIVE]
    assert isinstance(view, DetectiveView)
    return view


def _options(d: Driver) -> DetectiveOptions:
    return d.window.state.of(DetectiveOptions)


def _matrix(d: Driver, convention: Convention) -> str:
    return example.printed_matrix(example.matrix_of(d.window.state.camera, convention, "y"))


def _paste(d: Driver, text: str) -> DetectiveView:
    """Into the window, wherever the keyboard is."""
    imgui.set_clipboard_text(text)
    d.ctx.key_press(CTRL | int(Key.v))
    d.settle()
    return _view(d)


def _enlarge(d: Driver) -> None:
    d.window.shell.stage.show(DETECTIVE)
    d.window.shell.stage.maximise(DETECTIVE)
    d.settle()


def _close(d: Driver) -> None:
    d.window.shell.stage.maximise()
    d.window.shell.stage.show(DETECTIVE, False)
    d.settle()


def _item(name: str) -> str:
    return f"//{DETECTIVE} maximised/**/{name}"


def _pictures(d: Driver, count: int) -> list[np.ndarray]:
    """The readings' pictures as the window shows them, 16 x 12 of their places each."""
    d.ctx.mouse_teleport_to_pos((3, 3))
    d.ctx.yield_(2)
    boxes = [d.ctx.item_info(_item(f"reading {number}")).rect_full for number in range(count)]
    seen = d.picture().astype(int)
    found = []
    for box in boxes:
        y = np.linspace(box.min.y, box.max.y, 2 * 12 + 1)[1::2].astype(int)
        x = np.linspace(box.min.x, box.max.x, 2 * 16 + 1)[1::2].astype(int)
        found.append(seen[y][:, x])
    return found


def _image(d: Driver) -> np.ndarray:
    """The same places of the ray image itself."""
    image = d.images()[1].astype(int)
    height, width = image.shape[:2]
    y = ((np.arange(12) + 0.5) / 12 * height).astype(int)
    x = ((np.arange(16) + 0.5) / 16 * width).astype(int)
    return image[y][:, x]


def _alike(a: np.ndarray, b: np.ndarray) -> float:
    return float((np.abs(a - b).max(axis=2) <= 24).mean())


def drive_the_pictures_are_of_the_scene(d: Driver) -> None:
    camera = d.window.state.camera
    view = _paste(d, _matrix(d, ODD))
    assert d.window.files.message == "" and d.window.state.camera == camera  # none is selected
    image = _image(d)  # of the shape that it has beside the view
    _enlarge(d)
    found = view.findings
    assert found is not None and len(found.shown) == model.MOST_SHOWN
    assert found.shown[0].reading.convention == ODD
    pictures = _pictures(d, 2)
    assert _alike(pictures[0], image) > 0.9 > 0.5 > _alike(pictures[1], image)
    exposed = {"exposure_ev": -3.0}
    d.window.change(d.window.state.with_options(images=exposed))
    d.settle()
    assert _pictures(d, 1)[0].mean() < 0.7 * pictures[0].mean()
    d.window.change(d.window.state.with_options(images={"exposure_ev": 0.0}))
    d.window.change(replace(d.window.state, scene=load_scene("columns")))
    d.settle()
    assert _alike(_pictures(d, 1)[0], pictures[0]) < 0.9  # of the scene that is open now
    _close(d)
    assert view.findings is None and view.settled  # a hidden view reads nothing


def drive_one_is_chosen_and_written_down(d: Driver) -> None:
    start = d.window.state.view
    _paste(d, _matrix(d, ODD))
    _enlarge(d)
    view = _view(d)
    assert view.findings is not None
    second = view.findings.shown[1]
    past = len(d.window.history.past)
    d.ctx.item_click(_item("reading 1"))
    d.settle()
    assert is_same(d.window.state.camera, second.reading.view.camera)
    assert len(d.window.history.past) == past + 1
    assert _options(d).chosen == ranking.name(second.reading.convention, "y")
    d.ctx.item_click(_item("Copy as Python"))
    d.settle()
    made: dict[str, object] = {}
    exec(imgui.get_clipboard_text(), made)
    camera = made["camera"]
    assert isinstance(camera, Camera) and is_same(camera, second.reading.view.camera)
    d.window.undo()
    d.settle()
    assert d.window.state.view == start
    _close(d)


def drive_the_keyboard_is_enough(d: Driver) -> None:
    _enlarge(d)
    view = _paste(d, _matrix(d, ODD))
    assert view.findings is not None and _options(d).chosen == ""
    third = view.findings.shown[2]
    for _ in range(2):
        d.ctx.key_press(int(Key.right_arrow))
        d.ctx.yield_(3)
    d.ctx.key_press(int(Key.enter))
    d.settle()
    assert _options(d).chosen == ranking.name(third.reading.convention, "y")
    assert is_same(d.window.state.camera, third.reading.view.camera)
    _close(d)


def drive_a_matrix_to_find_out(d: Driver) -> None:
    _enlarge(d)
    view = _view(d)
    assert view.findings is not None and view.findings.given is None and not _options(d).text
    _ = d.picture()
    d.ctx.item_click(f"//{DETECTIVE} maximised/Practice matrix")
    d.settle()
    assert _options(d).text and view.findings is not None
    before = d.window.state.view
    d.ctx.item_click(_item("reading 0"))
    d.settle()
    assert any(text.startswith("Correct") for text in d.window.shell.toasts.texts)
    assert np.allclose(d.window.state.camera.eye, before.camera.eye, atol=1e-5)
    d.ctx.item_click(_item("reading 1"))
    d.settle()
    assert any(text.startswith("No:") for text in d.window.shell.toasts.texts)
    _close(d)


def drive_half_a_pixel_is_a_switch(d: Driver) -> None:
    usual = Convention("world-to-camera", False, "OpenCV")
    matrix = example.matrix_of(d.window.state.camera, usual, "y")
    _paste(d, f"K = [[20, 0, 8], [0, 20, 6], [0, 0, 1]]\n{matrix.tolist()}\n16x12")
    _enlarge(d)
    view = _view(d)
    assert view.findings is not None
    before = view.findings.shown[0].reading.view.camera
    d.ctx.item_click(f"//{DETECTIVE} maximised/corners##origin")
    d.settle()
    assert view.findings is not None
    assert _options(d).pixel_origin == "corner"
    after = view.findings.shown[0].reading.view.camera
    assert not is_same(before, after)
    assert np.isclose(before.viewport[0], after.viewport[0] - 0.5 / 20)
    _close(d)


def drive_texts_without_a_matrix_and_the_action(d: Driver) -> None:
    _paste(d, "no camera at all")
    assert "holds no camera" in d.window.files.message
    d.window.files.message = ""
    d.window.shell.stage.show(DETECTIVE)
    d.window.change(d.window.state.with_options(detective={"text": "1 2 3 4"}))
    d.settle()
    view = _view(d)
    assert view.findings is not None and "holds 4 numbers" in view.findings.error
    _ = d.picture()
    d.window.change(d.window.state.with_options(detective={"text": "1 " * 16}))
    d.settle()
    assert view.findings is not None and view.findings.error.startswith("No camera: by rows")
    imgui.set_clipboard_text(_matrix(d, ODD))
    next(action for action in QUESTIONS if action.name == "What is this matrix?").run(d.window)
    d.settle()
    assert _options(d).text.startswith("[[") and not view.findings.error
    # A camera's own text is pasted as a camera.
    _paste(d, python(d.window.state.view))
    assert any("is pasted" in text for text in d.window.shell.toasts.texts)
    _close(d)
