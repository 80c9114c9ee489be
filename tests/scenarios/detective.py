"""The detective: a matrix is pasted, its readings are drawn, one is chosen, and written down."""

from __future__ import annotations

import numpy as np
from imgui_bundle import imgui
from window_driver import Driver, Key

from app.detective import example, model
from app.detective.options import DetectiveOptions
from app.detective.readings import Convention, is_same
from app.detective.view import DETECTIVE, DetectiveView
from renderer.images import to_srgb8
from renderer.scene.model import View

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


def _looks_like(d: Driver, number: int, view: View, size: tuple[int, int]) -> bool:
    """Whether the reading's picture on the screen is what that view shows, in large."""
    box = d.ctx.item_info(_item(f"reading {number}")).rect_full
    d.ctx.mouse_teleport_to_pos((3, 3))
    d.ctx.yield_(2)
    y = np.linspace(box.min.y, box.max.y, 2 * 12 + 1)[1::2].astype(int)
    x = np.linspace(box.min.x, box.max.x, 2 * 16 + 1)[1::2].astype(int)
    seen = d.picture()[y][:, x].astype(int)
    live = d.window.renderers.live
    tracer = live.tracer_of(d.window.state.scene)
    assert tracer is not None
    light = model.traced(tracer, d.window.state.scene, view.for_size(size), size)
    wanted = to_srgb8(light, d.window.state.images.exposure_ev)
    rows = ((np.arange(12) + 0.5) / 12 * size[1]).astype(int)
    columns = ((np.arange(16) + 0.5) / 16 * size[0]).astype(int)
    apart = np.abs(wanted[rows][:, columns].astype(int) - seen).max(axis=2)
    return bool((apart <= 24).mean() > 0.85)


def drive_a_pasted_matrix_is_looked_at(d: Driver) -> None:
    camera = d.window.state.camera
    d.window.change(d.window.state.with_view(View(camera, fit=True)))
    view = _paste(d, _matrix(d, ODD))
    assert d.window.files.message == ""
    assert view.findings is not None and not view.findings.error
    assert view.findings.shown[0].reading.convention == ODD
    assert is_same(view.findings.shown[0].reading.view.camera, camera)
    assert d.window.state.camera == camera  # nothing is chosen yet
    _close(d)
    assert view.findings is None and view.settled  # who is not seen looks at nothing
