"""The loop stepper's controls: the buttons, the speed, the canvas, the algorithms, the language."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple, TypeVar

from imgui_bundle import ImVec2, imgui

from lucida.app.state.bounds import range_of
from lucida.app.state.options.shared import Language
from lucida.app.state.options.stepper import StepperOptions
from lucida.app.ui.checks import checkbox
from lucida.app.ui.rows import button_width, follow, tip

T = TypeVar("T")
CANVASES: dict[tuple[int, int], str] = {
    (width, 3 * width // 4): f"{width} x {3 * width // 4} pixels" for width in (4, 8, 16, 32, 64)
}
ORDERS: dict[Literal["both", "object", "image"], str] = {
    "both": "both",
    "object": "object order",
    "image": "image order",
}
Wish = Literal["", "first", "back", "play", "step", "pixel", "object", "last"]


class Step(NamedTuple):
    """A wish, its button, what it does, and its keys: shown, and as ImGui counts them."""

    wish: Wish
    button: str
    told: str
    shown: str
    chord: int
    repeats: bool = False


_KEY = imgui.Key
STEPS = (
    Step("first", "First", "to the beginning", "Home", int(_KEY.home)),
    Step("back", "Back", "one line back", "Left", int(_KEY.left_arrow), True),
    Step("play", "Play", "play and pause", "Space", int(_KEY.space)),
    Step("step", "Step", "one line on", "Right", int(_KEY.right_arrow), True),
    Step("pixel", "Next pixel", "to the next pixel's turn", "Down", int(_KEY.down_arrow), True),
    Step(
        "object", "Next object", "to the next object's turn", "Shift+Down",
        int(_KEY.mod_shift) | int(_KEY.down_arrow), True,
    ),
    Step("last", "Last", "to the end", "End", int(_KEY.end)),
)  # fmt: skip
SPEED_EM = 6.5


@dataclass(frozen=True)
class Asked:
    """The options and the language after a frame, and the button that was clicked."""

    options: StepperOptions
    language: Language
    wish: Wish = ""


def controls(now: Asked, playing: bool) -> Asked:
    """Draw the controls."""
    wish: Wish = ""
    for number, (name, label, told, keys, *_) in enumerate(STEPS):
        # Play and Pause have the same width.
        width = button_width("Pause" if name == "play" else label)
        if number:
            follow(width)
        shown = "Pause" if name == "play" and playing else label
        if imgui.button(f"{shown}###{name}", ImVec2(width, 0)):
            wish = name
        imgui.set_item_tooltip(f"{told} ({keys})")
    options, canvas = _speed(now.options), now.options.canvas
    # A lecture's file may ask for any size.
    sizes = CANVASES | {canvas: f"{canvas[0]} x {canvas[1]} pixels"}
    options = _combo(
        "pixels", sizes, canvas, options, lambda o, v: replace(o, canvas=v, steps=(0, 0))
    )
    options = _combo("order", ORDERS, options.order, options, lambda o, v: replace(o, order=v))
    follow(imgui.calc_text_size("depth").x + 1.5 * imgui.get_frame_height())
    options = replace(options, depth=checkbox("depth", options.depth)[1])
    tip("the nearest t of each pixel so far, near ones bright, in object order's canvas")
    follow(imgui.calc_text_size("Julia").x + 1.5 * imgui.get_frame_height())
    changed, is_julia = checkbox("Julia", now.language == "julia")
    tip("the same lines in Julia; what runs is Python")
    language: Language = "julia" if is_julia else "python"
    return Asked(options, language if changed else now.language, wish)


def keys() -> Wish:
    """Return what the keys ask for while the panel has them.

    They are taken from ImGui's navigation, which keeps Tab and Enter.
    """
    focused, repeat = imgui.InputFlags_.route_focused, imgui.InputFlags_.repeat
    pressed = [
        step.wish
        for step in STEPS
        if imgui.shortcut(step.chord, int(focused) | int(repeat) * step.repeats)
    ]
    return pressed[0] if pressed and not imgui.is_any_item_active() else ""


def _speed(options: StepperOptions) -> StepperOptions:
    width = SPEED_EM * imgui.get_font_size()
    follow(width)
    imgui.set_next_item_width(width)
    changed, speed = imgui.slider_float(
        "##speed",
        options.speed,
        *range_of(StepperOptions, "speed"),
        "%.0f steps/s",
        imgui.SliderFlags_.logarithmic,
    )
    return replace(options, speed=speed) if changed else options


def _combo(
    name: str,
    choices: Mapping[T, str],
    current: T,
    options: StepperOptions,
    chosen: Callable[[StepperOptions, T], StepperOptions],
) -> StepperOptions:
    """Draw a drop-down list. Return the options, those of chosen() after a click."""
    width = max(imgui.calc_text_size(text).x for text in choices.values())
    width += 2.2 * imgui.get_frame_height()
    follow(width)
    imgui.set_next_item_width(width)
    if imgui.begin_combo(f"##{name}", choices[current]):
        for key, text in choices.items():
            if imgui.selectable(text, key == current)[0] and key != current:
                options = chosen(options, key)
        imgui.end_combo()
    return options
