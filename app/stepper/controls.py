"""The loop stepper's controls: the buttons, the speed, the canvas, the algorithms, the language.

In a row that is too short for all of them, the last ones wait behind a button.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Literal, TypeVar

from imgui_bundle import ImVec2, imgui

from app.state.bounds import range_of
from app.state.options import Language
from app.stepper.options import StepperOptions
from app.widgets.checks import checkbox
from app.widgets.rows import follow, tip
from app.widgets.sliders import slider_float

T = TypeVar("T")
Form = Literal["triangles", "rays"]
CANVASES: dict[tuple[int, int], str] = {
    (width, 3 * width // 4): f"{width} x {3 * width // 4} pixels" for width in (4, 8, 16, 32, 64)
}
ORDERS: dict[Literal["both", "object", "image"], str] = {
    "both": "both",
    "object": "object order",
    "image": "image order",
}
FORMS: dict[Form, str] = {
    "triangles": "by triangles",
    "rays": "by rays",
}
Wish = Literal["", "first", "back", "play", "step", "pixel", "object", "last"]
_BUTTONS: tuple[tuple[Wish, str, str], ...] = (
    ("first", "First", "to the beginning (Home)"),
    ("back", "Back", "one step back (Left)"),
    ("play", "", "play and pause (Space)"),
    ("step", "Step", "one step: one line (Right)"),
    ("pixel", "Next pixel", "to where the next pixel's turn begins (Down)"),
    ("object", "Next object", "to where the next object's or triangle's turn begins (Shift+Down)"),
    ("last", "Last", "to the end (End)"),
)

MORE = "..."
MAIN: tuple[Wish, ...] = ("play", "step", "pixel", "back", "object", "first", "last")
SPEED_EM = 6.5


@dataclass(frozen=True)
class Asked:
    """The options and the language after a frame, and what a button asks for."""

    options: StepperOptions
    language: Language
    wish: Wish = ""


@dataclass(frozen=True)
class _Control:
    """A control, and its width."""

    width: float
    draw: Callable[[Asked], Asked]


def controls(now: Asked, playing: bool, has_triangles: bool, beside: float | None = None) -> Asked:
    """Draw the controls. The form of object order is among them if the scene allows both.

    beside: the width of what follows in the row; None if there is room for a second one.
    """
    shown, hidden = _controls(now, playing, has_triangles, beside is not None), []
    if beside is not None:
        hidden = shown[_fitting(shown, beside) :]
    asked = now
    for number, one in enumerate(shown[: len(shown) - len(hidden)]):
        if number:
            follow(one.width)
        asked = one.draw(asked)
    if not hidden:
        return asked
    imgui.same_line()
    if imgui.button(f"{MORE}###more"):
        imgui.open_popup("more controls")
    imgui.set_item_tooltip("more: speed, canvas, algorithms, Julia")
    if imgui.begin_popup("more controls"):
        for one in hidden:
            asked = one.draw(asked)
        imgui.end_popup()
    return asked


def _controls(now: Asked, playing: bool, has_triangles: bool, few: bool) -> list[_Control]:
    """Return the controls. few: not all of them may be seen, so begin with the main ones."""
    canvas = now.options.canvas
    # A lecture's file may ask for any size.
    sizes = CANVASES | {canvas: f"{canvas[0]} x {canvas[1]} pixels"}
    buttons = sorted(_BUTTONS, key=lambda one: MAIN.index(one[0])) if few else _BUTTONS
    found = [_button(wish, label, said, playing) for wish, label, said in buttons]
    found += [
        _Control(SPEED_EM * imgui.get_font_size(), _speed),
        _combo(
            "pixels", sizes, lambda o: o.canvas, lambda o, v: replace(o, canvas=v, steps=(0, 0))
        ),
        _combo("order", ORDERS, lambda o: o.order, lambda o, v: replace(o, order=v)),
    ]
    if now.options.order != "image":
        found.append(_form(has_triangles))
    julia = imgui.calc_text_size("Julia").x + 1.5 * imgui.get_frame_height()
    return [*found, _Control(julia, _julia)]


def _fitting(controls: list[_Control], beside: float) -> int:
    """Return how many controls fit into a row, with the button for the others."""
    space = imgui.get_style().item_spacing.x
    room = imgui.get_content_region_avail().x - beside
    if sum(one.width + space for one in controls) - space <= room:
        return len(controls)
    left, count = room - _button_width(MORE), 0
    while controls[count].width + space <= left:
        left -= controls[count].width + space
        count += 1
    return max(1, count)


def keys() -> Wish:
    """Return what the keys ask for while the panel has them.

    They are taken from ImGui's navigation, which keeps Tab and Enter.
    """
    key, shift = imgui.Key, int(imgui.Key.mod_shift)
    focused = int(imgui.InputFlags_.route_focused)
    repeated = focused | int(imgui.InputFlags_.repeat)
    table: tuple[tuple[Wish, int, int], ...] = (
        ("play", int(key.space), focused),
        ("step", int(key.right_arrow), repeated),
        ("back", int(key.left_arrow), repeated),
        ("pixel", int(key.down_arrow), repeated),
        ("object", shift | int(key.down_arrow), repeated),
        ("first", int(key.home), focused),
        ("last", int(key.end), focused),
    )
    pressed = [wish for wish, chord, flags in table if imgui.shortcut(chord, flags)]
    return pressed[0] if pressed and not imgui.is_any_item_active() else ""


def _button(wish: Wish, label: str, said: str, playing: bool) -> _Control:
    is_play = wish == "play"
    shown = ("Pause" if playing else "Play") if is_play else label
    width = _button_width("Pause" if is_play else label)

    def draw(asked: Asked) -> Asked:
        clicked = imgui.button(f"{shown}###{wish}", ImVec2(width, 0))
        imgui.set_item_tooltip(said)
        return replace(asked, wish=wish) if clicked else asked

    return _Control(width, draw)


def _speed(asked: Asked) -> Asked:
    imgui.set_next_item_width(SPEED_EM * imgui.get_font_size())
    changed, speed = slider_float(
        "##speed",
        asked.options.speed,
        *range_of(StepperOptions, "speed"),
        "%.0f steps/s",
        imgui.SliderFlags_.logarithmic,
    )
    return replace(asked, options=replace(asked.options, speed=speed)) if changed else asked


def _julia(asked: Asked) -> Asked:
    """Draw the switch for the same lines in Julia. What runs is Python in any case."""
    changed, beside = checkbox("Julia", asked.language == "julia")
    tip("the same lines in Julia, for reading; Python is what runs")
    return replace(asked, language="julia" if beside else "python") if changed else asked


def _form(has_triangles: bool) -> _Control:
    combo = _combo(
        "form",
        FORMS,
        lambda o: o.form if has_triangles else "rays",
        lambda o, v: replace(o, form=v, steps=(0, o.steps[1])),
    )

    def draw(asked: Asked) -> Asked:
        imgui.begin_disabled(not has_triangles)
        asked = combo.draw(asked)
        imgui.end_disabled()
        tip(
            "object order, triangle by triangle, as graphics cards do it (spheres, which have\n"
            "none, are drawn before, by their rays), or each object by the rays of its pixels"
        )
        return asked

    return _Control(combo.width, draw)


def _combo(
    name: str,
    choices: Mapping[T, str],
    now: Callable[[StepperOptions], T],
    chosen: Callable[[StepperOptions, T], StepperOptions],
) -> _Control:
    """Return a drop-down list. now: the current entry. chosen: the options after a click."""
    width = max(imgui.calc_text_size(text).x for text in choices.values())
    width += 2.2 * imgui.get_frame_height()

    def draw(asked: Asked) -> Asked:
        imgui.set_next_item_width(width)
        current = now(asked.options)
        if imgui.begin_combo(f"##{name}", choices[current]):
            for key, text in choices.items():
                if imgui.selectable(text, key == current)[0] and key != current:
                    asked = replace(asked, options=chosen(asked.options, key))
            imgui.end_combo()
        return asked

    return _Control(width, draw)


def _button_width(text: str) -> float:
    return float(imgui.calc_text_size(text).x + 2 * imgui.get_style().frame_padding.x)
