"""The outside view as a figure: its page in the laboratory, and its file."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from pathlib import Path

from maximised import Maximised
from window_driver import Driver, Key

from app.laboratory.vector_view import Both
from app.laboratory.view import LaboratoryView

ALONE = Maximised(LaboratoryView, "laboratory")
SPACE = "{http://www.w3.org/2000/svg}"


def _page(d: Driver) -> LaboratoryView:
    d.window.change(d.window.state.with_options(marked=(60, 90)))
    return ALONE.open(d, page="vector")


def _made(view: LaboratoryView) -> Both:
    assert view.vector.made is not None and view.vector.error is None
    return view.vector.made


def _box(d: Driver, number: int) -> tuple[int, int, int, int]:
    box = d.ctx.item_info(ALONE.item(f"pane {number}")).rect_full
    left, top, right, bottom = (round(x) for x in (box.min.x, box.min.y, box.max.x, box.max.y))
    return left, top, right, bottom


def _middle(d: Driver, number: int) -> tuple[float, float]:
    left, top, right, bottom = _box(d, number)
    return (left + right) / 2, (top + bottom) / 2


def drive_the_mouse_magnifies_and_moves_both(d: Driver) -> None:
    _page(d)
    window = d.window
    before = len(window.history.past)
    x, y = _middle(d, 1)
    left, _, right, _ = _box(d, 1)
    place = (left + 0.75 * (right - left), y)
    d.ctx.mouse_teleport_to_pos(place)
    d.ctx.yield_(2)
    d.ctx.mouse_wheel_y(4)
    d.ctx.yield_(3)
    options = window.state.options.laboratory
    assert options.zoom > 2
    # What was under the pointer is still there: 0.75 of the page's width.
    assert abs(options.zoom_center[0] + 0.25 / options.zoom - 0.75) < 2e-3
    center = options.zoom_center
    d.drag((x, y), (x + 0.1 * (right - left), y))
    moved = window.state.options.laboratory
    assert abs(moved.zoom_center[0] - (center[0] - 0.1 / options.zoom)) < 2e-3
    assert moved.zoom == options.zoom
    d.drag(_middle(d, 0), (_middle(d, 0)[0] + 3000, _middle(d, 0)[1]))  # not beyond the page
    assert abs(window.state.options.laboratory.zoom_center[0] - 0.5 / options.zoom) < 1e-6
    assert len(window.history.past) <= before + 4  # no step for each frame
    window.undo()
    assert window.state.options.laboratory.zoom_center[0] > 0.5 / options.zoom
    ALONE.close(d)


def drive_the_drawing_follows_the_camera_and_the_switches(d: Driver) -> None:
    view = _page(d)
    first = _made(view)
    names = {part.name for part in first.figure.parts}
    assert {"u", "v", "w", "grid", "ray", "pixel"} <= names
    d.window.change(d.window.state.with_options(outside={"basis": False, "bundle": (2, 2)}))
    d.settle()
    second = _made(view)
    names = {part.name for part in second.figure.parts}
    assert "u" not in names and any(name.startswith("bundle") for name in names)
    assert (second.picture != first.picture).any()
    d.window.change(d.window.state.with_camera(d.window.state.camera.shifted(0, 9, (100, 100))))
    d.settle()
    assert _made(view) is not second
    ALONE.close(d)


def _store(d: Driver, path: Path) -> ElementTree.Element:
    """Answers the window's own dialog and reads what was written."""
    dialog = d.window.files.dialog
    d.until(lambda: dialog.is_open)
    assert dialog.question is not None
    question = dialog.question
    assert question.saves and question.endings == (".svg",)
    dialog.cancel()
    question.chosen([str(path)])
    d.until(lambda: not d.window.files.busy)
    d.settle()
    assert d.window.files.message == ""
    return ElementTree.parse(f"{path}.svg").getroot()


def drive_the_diagram_is_exported_as_it_is_seen(d: Driver) -> None:
    d.window.change(d.window.state.with_options(marked=(60, 90), outside={"bundle": (2, 2)}))
    d.settle()
    d.ctx.key_press(int(Key.mod_ctrl) | int(Key.mod_shift) | int(Key.e))
    root = _store(d, d.folder / "first")
    assert root.tag == f"{SPACE}svg"
    (image,) = root.iter(f"{SPACE}image")
    assert (image.get("width"), image.get("height")) == (root.get("width"), root.get("height"))
    names = {part.get("data-name") for part in root.iter()}
    assert {"edges", "image plane", "ray", "u", "eye"} <= names, names
    d.ctx.menu_click("//##MainMenuBar/File/Picture/Export figure as SVG without a ground...")
    third = _store(d, d.folder / "third")
    assert list(third.iter(f"{SPACE}image")) and not list(third.iter(f"{SPACE}rect"))
