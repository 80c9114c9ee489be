"""Everything that a menu or a key does, in one table.

Menus, shortcuts and the shortcut sheet are made from ACTIONS; nothing else binds a key. Owns the
names and keys. Knows nothing of how menus are drawn.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Protocol

from imgui_bundle import imgui

from app import comparing
from app.files import Files
from app.focus import Focus
from app.navigation import switched_projection
from app.options import PIXEL_SIZES, CompareMode
from app.renderers import Renderers
from app.state import AppState
from renderer.camera import Camera
from renderer.compare import Comparison

Key = imgui.Key
CTRL, SHIFT = int(Key.mod_ctrl), int(Key.mod_shift)

FLIP_KEY = Key.x  # held, it shows the other image; read by the compare view

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
    @property
    def renderers(self) -> Renderers: ...
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


def _differing(change: Callable[[AppState, Comparison], AppState]) -> Callable[[Window], None]:
    """A change that needs to know where the images differ; nothing happens until it is known."""

    def run(window: Window) -> None:
        verdict = window.renderers.verdict(window.state)
        if verdict is not None:
            window.change(change(window.state, verdict.comparison))

    return run


def _differ(window: Window) -> bool:
    verdict = window.renderers.verdict(window.state)
    return verdict is not None and verdict.comparison.agree < verdict.comparison.pixels


def _comparing(number: int, mode: CompareMode, name: str) -> Action:
    return Action(
        "View",
        f"Compare: {name.lower()}",
        _change(lambda state: comparing.with_mode(state, mode)),
        f"F{5 + number}",
        (int(Key.f5) + number,),
        is_on=lambda state: state.compare.mode == mode,
        separated=number == 0,
    )


def _gain(factor: float) -> Callable[[AppState], AppState]:
    return lambda state: comparing.with_gain(state, state.compare.gain * factor)


def _divider(step: float) -> Callable[[AppState], AppState]:
    return lambda state: comparing.with_divider(state, state.compare.divider + step)


COMPARING = (
    *(_comparing(number, mode, name) for number, (mode, name, _) in enumerate(comparing.MODES)),
    Action(
        "View",
        "Compare: the other image (hold the key)",
        _change(lambda state: state.with_options(compare={"flipped": not state.compare.flipped})),
        "X",
        is_on=lambda state: state.compare.flipped,
    ),
    Action(
        "View",
        "Compare: mark the causes",
        _change(lambda state: state.with_options(compare={"causes": not state.compare.causes})),
        "K",
        (int(Key.k),),
        is_on=lambda state: state.compare.causes,
    ),
    Action("View", "Compare: more gain", _change(_gain(2.0)), "]", (int(Key.right_bracket),)),
    Action("View", "Compare: less gain", _change(_gain(0.5)), "[", (int(Key.left_bracket),)),
    Action(
        "View",
        "Compare: divider to the right",
        _change(_divider(comparing.DIVIDER_STEP)),
        "Shift+]",
        (SHIFT | int(Key.right_bracket),),
    ),
    Action(
        "View",
        "Compare: divider to the left",
        _change(_divider(-comparing.DIVIDER_STEP)),
        "Shift+[",
        (SHIFT | int(Key.left_bracket),),
    ),
    Action(
        "View",
        "Compare: next differing pixel",
        _differing(comparing.stepped),
        "N",
        (int(Key.n),),
        can=_differ,
    ),
    Action(
        "View",
        "Compare: previous differing pixel",
        _differing(lambda state, comparison: comparing.stepped(state, comparison, forward=False)),
        "Shift+N",
        (SHIFT | int(Key.n),),
        can=_differ,
    ),
    Action(
        "View",
        "Compare: worst pixel",
        _differing(comparing.at_worst),
        "Shift+M",
        (SHIFT | int(Key.m),),
        can=_differ,
    ),
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
    *COMPARING,
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
