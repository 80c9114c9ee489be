"""Everything that a menu or a key does, in one table.

Menus, shortcuts and the shortcut sheet are made from ACTIONS; nothing else binds a key. Owns the
names and keys. Knows nothing of how menus are drawn.
"""

from __future__ import annotations

from collections.abc import Callable

from imgui_bundle import imgui

from app.actions.base import CTRL, SHIFT, Action, Key, Window, changing
from app.actions.camera import CAMERA, EDIT
from app.actions.camera import MOUSE as CAMERA_MOUSE
from app.actions.image import IMAGE
from app.actions.image import MOUSE as IMAGE_MOUSE
from app.actions.lecture import LECTURE
from app.actions.outside import DIAGRAM, OUTSIDE
from app.actions.shell import BOOKMARKS, FILE, HELP, LOOK
from app.images import comparing
from app.options import CompareMode
from app.state import AppState
from renderer.compare import Comparison

FLIP_KEY = Key.x  # held, it shows the other image; read by the compare view

MENUS = ("File", "Edit", "Camera", "Image", "View", "Lecture", "Help")


_change = changing


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


def _compare(window: Window, mode: CompareMode) -> None:
    window.change(comparing.with_mode(window.state, mode))
    window.shell.stage.show("Compare")


def _comparing(number: int, mode: CompareMode, name: str) -> Action:
    return Action(
        "View/Compare",
        name,
        lambda window: _compare(window, mode),
        f"F{5 + number}",
        (int(Key.f5) + number,),
        is_on=lambda state: state.compare.mode == mode,
    )


def _gain(factor: float) -> Callable[[AppState], AppState]:
    return lambda state: comparing.with_gain(state, state.compare.gain * factor)


def _divider(step: float) -> Callable[[AppState], AppState]:
    return lambda state: comparing.with_divider(state, state.compare.divider + step)


COMPARING = (
    *(_comparing(number, mode, name) for number, (mode, name, _) in enumerate(comparing.MODES)),
    Action(
        "View/Compare",
        "The other image (hold the key)",
        _change(lambda state: state.with_options(compare={"flipped": not state.compare.flipped})),
        "X",
        is_on=lambda state: state.compare.flipped,
    ),
    Action(
        "View/Compare",
        "Mark the causes",
        _change(lambda state: state.with_options(compare={"causes": not state.compare.causes})),
        "K",
        (int(Key.k),),
        is_on=lambda state: state.compare.causes,
    ),
    Action("View/Compare", "More gain", _change(_gain(2.0)), "]", (int(Key.right_bracket),)),
    Action("View/Compare", "Less gain", _change(_gain(0.5)), "[", (int(Key.left_bracket),)),
    Action(
        "View/Compare",
        "Divider to the right",
        _change(_divider(comparing.DIVIDER_STEP)),
        "Shift+]",
        (SHIFT | int(Key.right_bracket),),
    ),
    Action(
        "View/Compare",
        "Divider to the left",
        _change(_divider(-comparing.DIVIDER_STEP)),
        "Shift+[",
        (SHIFT | int(Key.left_bracket),),
    ),
    Action(
        "View/Compare",
        "Next differing pixel",
        _differing(comparing.stepped),
        "N",
        (int(Key.n),),
        can=_differ,
    ),
    Action(
        "View/Compare",
        "Previous differing pixel",
        _differing(lambda state, comparison: comparing.stepped(state, comparison, forward=False)),
        "Shift+N",
        (SHIFT | int(Key.n),),
        can=_differ,
    ),
    Action(
        "View/Compare",
        "Worst pixel",
        _differing(comparing.at_worst),
        "Shift+M",
        (SHIFT | int(Key.m),),
        can=_differ,
    ),
)

ACTIONS = (
    *FILE,
    *DIAGRAM,
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
    *EDIT,
    *CAMERA,
    *BOOKMARKS,
    *LOOK,
    *IMAGE,
    *OUTSIDE,
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
    *COMPARING,
    *LECTURE,
    *HELP,
)

MOUSE = (
    ("drag an image", "turn the camera about the point under the pointer"),
    ("Shift+drag, right or middle drag", "move the camera; the point follows the pointer"),
    ("wheel", "closer and farther (parallel: a smaller or larger viewport)"),
    *IMAGE_MOUSE,
    *CAMERA_MOUSE,
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
