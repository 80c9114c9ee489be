"""Everything that a menu or a key does, in one table.

Menus, shortcuts and the shortcut sheet are made from ACTIONS; nothing else binds a key. Owns the
names and keys. Knows nothing of how menus are drawn.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Protocol

from imgui_bundle import imgui

from app.files import Files
from app.focus import Focus
from app.navigation import switched_projection
from app.options import PIXEL_SIZES
from app.state import AppState
from renderer.camera import Camera

Key = imgui.Key
CTRL, SHIFT = int(Key.mod_ctrl), int(Key.mod_shift)

MENUS = ("File", "Edit", "Camera", "View", "Help")


class Window(Protocol):
    """What actions ask of the window."""

    @property
    def state(self) -> AppState: ...
    @property
    def focus(self) -> Focus: ...
    def change(self, state: AppState) -> None: ...
    def undo(self) -> None: ...
    def redo(self) -> None: ...
    def can_undo(self) -> bool: ...
    def can_redo(self) -> bool: ...
    @property
    def files(self) -> Files: ...
    def toggle_help(self) -> None: ...
    def quit(self) -> None: ...


@dataclass(frozen=True)
class Action:
    """menu: where it stands. keys: as shown; chords: as ImGui takes them, any of them.

    is_on: for switches. can: whether it is possible now. separated: a line above it.
    """

    menu: str
    name: str
    run: Callable[[Window], None]
    keys: str = ""
    chords: tuple[int, ...] = ()
    is_on: Callable[[AppState], bool] | None = None
    can: Callable[[Window], bool] | None = None
    separated: bool = False


def _change(change: Callable[[AppState], AppState]) -> Callable[[Window], None]:
    return lambda window: window.change(change(window.state))


def _canonical(state: AppState) -> AppState:
    return state.with_view(replace(state.view, camera=Camera.canonical()))


def _switch_projection(window: Window) -> None:
    camera = switched_projection(window.state.camera, window.focus.center)
    window.change(window.state.with_camera(camera))


def _exposure(stops: float) -> Callable[[AppState], AppState]:
    return lambda state: state.with_options(
        images={"exposure_ev": state.images.exposure_ev + stops if stops else 0.0}
    )


def _pixel_size(size: int) -> Action:
    return Action(
        "View",
        f"Pixels {size} x {size}",
        _change(lambda state: state.with_options(images={"pixel_size": size})),
        is_on=lambda state: state.images.pixel_size == size,
        separated=size == PIXEL_SIZES[0],
    )


ACTIONS = (
    Action("File", "Open...", lambda w: w.files.open_dialog(), "Ctrl+O", (CTRL | int(Key.o),)),
    Action(
        "File",
        "Save view...",
        lambda w: w.files.save_view_dialog(w.state.view),
        "Ctrl+S",
        (CTRL | int(Key.s),),
    ),
    Action("File", "Quit", lambda w: w.quit(), "Ctrl+Q", (CTRL | int(Key.q),), separated=True),
    Action(
        "Edit",
        "Undo",
        lambda w: w.undo(),
        "Ctrl+Z",
        (CTRL | int(Key.z),),
        can=lambda w: w.can_undo(),
    ),
    Action(
        "Edit",
        "Redo",
        lambda w: w.redo(),
        "Ctrl+Shift+Z",
        (CTRL | SHIFT | int(Key.z), CTRL | int(Key.y)),
        can=lambda w: w.can_redo(),
    ),
    Action(
        "Camera",
        "Parallel projection",
        _switch_projection,
        "P",
        (int(Key.p),),
        is_on=lambda state: state.camera.is_parallel,
    ),
    Action(
        "Camera",
        "Keep orthonormal",
        _change(lambda state: state.with_keep_orthonormal(not state.keep_orthonormal)),
        "O",
        (int(Key.o),),
        is_on=lambda state: state.keep_orthonormal,
    ),
    Action(
        "Camera",
        "Fit to the image's aspect ratio",
        _change(lambda state: state.with_fit(not state.view.fit)),
        is_on=lambda state: state.view.fit,
    ),
    Action(
        "Camera",
        "Scene's view",
        _change(lambda state: state.with_view(state.scene.view)),
        "Home",
        (int(Key.home),),
        separated=True,
    ),
    Action("Camera", "Canonical camera", _change(_canonical)),
    Action("View", "Brighter", _change(_exposure(0.5)), "+", (int(Key.equal), int(Key.keypad_add))),
    Action(
        "View", "Darker", _change(_exposure(-0.5)), "-", (int(Key.minus), int(Key.keypad_subtract))
    ),
    Action("View", "Exposure 0", _change(_exposure(0.0)), "0", (int(Key._0),)),
    Action(
        "View",
        "Shadows (ray image only)",
        _change(lambda state: state.with_options(shadows=not state.options.shadows)),
        is_on=lambda state: state.options.shadows,
        separated=True,
    ),
    Action(
        "View",
        "Mirrors (ray image only)",
        _change(lambda state: state.with_options(mirrors=not state.options.mirrors)),
        is_on=lambda state: state.options.mirrors,
    ),
    *(_pixel_size(size) for size in PIXEL_SIZES),
    Action(
        "Help",
        "Mouse and keys",
        lambda w: w.toggle_help(),
        "F1",
        (int(Key.f1), SHIFT | int(Key.slash)),
    ),
)

MOUSE = (
    ("drag an image", "turn the camera about the point under the pointer"),
    ("Shift+drag, right or middle drag", "move the camera; the point follows the pointer"),
    ("wheel", "closer and farther (parallel: a smaller or larger viewport)"),
    ("drag a number", "change it; Shift: faster, Alt: slower"),
    ("double-click a number", "type it"),
)


def run_shortcuts(window: Window) -> None:
    """Runs the actions whose keys were pressed; call once a frame, in any window."""
    flags = imgui.InputFlags_.route_global
    for action in ACTIONS:
        for chord in action.chords:
            if imgui.shortcut(chord, flags) and (action.can is None or action.can(window)):
                action.run(window)
