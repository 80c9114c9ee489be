"""The scene in hand in the window under test: what is chosen, where it is on the screen."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from imgui_bundle import hello_imgui
from outside_window import place
from window_driver import IMAGES, Driver, Key

from lucida.app.instruments.objects.choosing import chosen, rows_of
from lucida.app.instruments.objects.handles import length_px, middle_of
from lucida.app.instruments.outside.view import OUTSIDE
from lucida.renderer.editing.changing import ids_of
from lucida.renderer.scene.model import Sphere

CTRL, SHIFT = Key.mod_ctrl, Key.mod_shift
SCENE = """# A ball that is kept as it is written.
name = "kept"

[[objects]]
type = "sphere"   # round
name = "ball"
center = [0, 1, 0]

[[objects]]
type = "box"
name = "chest"
translate = [2.5, 0.5, 0]
"""


def enter(d: Driver) -> None:
    if hello_imgui.current_layout_name() != "Four views":
        d.layout("Four views")
        for name in ("Objects", "Inspector"):
            d.stage.show(name)
            d.frames(3)
    d.change(objects={"chosen": (), "selects": False, "handle": "none"})
    d.settle()


def item(d: Driver, name: str) -> int:
    """The key of what is called so."""
    found = next(row for row in rows_of(d.state.scene) if row.shown == name)
    return found.item


def now(d: Driver) -> tuple[str, ...]:
    """Return the selection, by name."""
    names = {row.item: row.shown for row in rows_of(d.state.scene)}
    return tuple(names[key] for key in chosen(d.state))


def ball(d: Driver, name: str) -> Sphere:
    (number,) = ids_of(d.state.scene, item(d, name))
    shape = d.state.scene.objects[number].shape
    assert isinstance(shape, Sphere)
    return shape


def in_image(d: Driver, name: str, point: np.ndarray) -> tuple[float, float]:
    """Return the place of a world point in an image on the screen."""
    window = d.window
    seen = window.renderers.camera(window.state).project(point, (1, 1))
    return d.point(name, float(seen.column) + 0.5, float(seen.row) + 0.5)


def seen_at(d: Driver, view: str, name: str) -> tuple[float, float]:
    """A pixel at which an object is to be seen in a view, far from its border."""
    center = np.asarray(ball(d, name).center)
    return place(d, center) if view == OUTSIDE else in_image(d, view, center)


def click(d: Driver, at: tuple[float, float], double: bool = False) -> None:
    d.move_to(at)
    if double:
        d.ctx.mouse_double_click(0)
    else:
        d.ctx.mouse_click(0)
    d.frames(3)


@contextmanager
def held(d: Driver, key: Key) -> Iterator[None]:
    d.ctx.key_down(key)
    d.frames()
    yield
    d.ctx.key_up(key)
    d.frames()


def in_list(d: Driver, name: str, part: str = "##row") -> str:
    return f"//###Objects/**/{item(d, name)}/{part}"


def opened(d: Driver, text: str = SCENE, name: str = "kept") -> Path:
    path = d.folder / f"{name}.toml"
    path.write_text(text)
    d.window.open(str(path))
    d.until(lambda: d.state.scene.name == "kept")
    d.settle()
    return path


def drag_handle(d: Driver, view: str, name: str, axis: int) -> None:
    """The arrow of an axis, dragged by its middle."""
    grip, way = arrow(d, view, name, axis)
    d.move_to(tuple(grip))
    d.drag(tuple(grip), tuple(grip + 25 * way))
    d.frames(3)


def arrow(d: Driver, view: str, name: str, axis: int) -> tuple[np.ndarray, np.ndarray]:
    """The middle of the arrow of an axis on the screen, and its direction there."""
    window = d.window
    focus = window.focus
    spot = middle_of(window.state.scene, (item(d, name),))
    step = np.eye(3)[axis] * 0.05 * focus.reach

    def on_screen(point):
        at = place(d, point) if view == OUTSIDE else in_image(d, view, point)
        return np.asarray(at)

    start = on_screen(spot)
    way = on_screen(spot + step) - start
    way = way / np.linalg.norm(way)
    return start + 0.6 * handle_px(d, view) * way, way


def handle_px(d: Driver, view: str) -> float:
    label = f"//###{OUTSIDE}/image##{OUTSIDE}" if view == OUTSIDE else IMAGES[view]
    box = d.box(label)
    return length_px(box.get_size(), box.get_size())
