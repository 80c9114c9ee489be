"""The actions of the menu "Image": what both images show, how large, how magnified.

Owns their names and keys: Alt and a letter or digit, as far as they have any. What they do is
imaging.py's.
"""

from __future__ import annotations

from collections.abc import Callable

from app.host.action import ALT, CTRL, SHIFT, Action, Key, Window, changing
from app.images.imaging import (
    CHANNELS,
    COMPONENTS,
    samples_text,
    size_text,
    with_channel,
    with_component,
    with_magnification,
    with_pixel_size,
    with_resolution,
    with_transfer_switched,
)
from app.images.placement import magnification_text, step_from
from app.state.app_state import AppState
from app.state.options import (
    MAGNIFICATIONS,
    PIXEL_SIZES,
    RESOLUTIONS,
    SAMPLES,
    Channel,
    Component,
)

CHANNEL, RESOLUTION, MAGNIFY = "Image/Channel", "Image/Resolution", "Image/Magnification"
COUNTING = "Image/Rows and columns"


def _channel(number: int, channel: Channel, name: str) -> Action:
    return Action(
        CHANNEL,
        name,
        changing(lambda state: with_channel(state, channel)),
        f"Alt+{number + 1}",
        (ALT | (int(Key._1) + number),),
        is_on=lambda state: state.images.channel == channel,
    )


def _component(component: Component, name: str) -> Action:
    key = {"red": Key.r, "green": Key.g, "blue": Key.b}[component]
    return Action(
        CHANNEL,
        f"{name} only",
        changing(lambda state: with_component(state, component)),
        f"Alt+{name[0]}",
        (ALT | int(key),),
        is_on=lambda state: state.images.component == component,
        separated=component == "red",
    )


def _pixel_size(size: int) -> Action:
    name = "Fit to window" if size == 1 else f"Window, pixels {size} x {size}"
    return Action(
        RESOLUTION,
        name,
        changing(lambda state: with_pixel_size(state, size)),
        "Alt+W" if size == 1 else "",
        (ALT | int(Key.w),) if size == 1 else (),
        is_on=lambda state: state.images.resolution is None and state.images.pixel_size == size,
    )


def _resolution(number: int, size: tuple[int, int]) -> Action:
    return Action(
        RESOLUTION,
        size_text(size),
        changing(lambda state: with_resolution(state, size)),
        is_on=lambda state: state.images.resolution == size,
        separated=number == 0,
    )


def _samples(number: int, samples: int) -> Action:
    return Action(
        RESOLUTION,
        samples_text(samples),
        changing(lambda state: state.with_options(images={"samples": samples})),
        is_on=lambda state: state.images.samples == samples,
        separated=number == 0,
    )


def _magnification(number: int, factor: int) -> Action:
    return Action(
        MAGNIFY,
        magnification_text(factor),
        changing(lambda state: with_magnification(state, factor)),
        "Alt+A" if factor == 1 else "",
        (ALT | int(Key.a),) if factor == 1 else (),
        is_on=lambda state: state.images.magnification == factor,
        separated=number == 0,
    )


def _step(steps: int) -> Callable[[Window], None]:
    def run(window: Window) -> None:
        state = window.state
        placement = window.renderers.placement(state)
        if placement is not None:
            factor = step_from(placement, state.images, steps)
            window.change(with_magnification(state, factor))

    return run


def _exposure(stops: float) -> Callable[[AppState], AppState]:
    return lambda state: state.with_options(
        images={"exposure_ev": state.images.exposure_ev + stops if stops else 0.0}
    )


def _switch(name: str) -> Callable[[AppState], AppState]:
    return lambda state: state.with_options(images={name: not getattr(state.images, name)})


def _switch_values(state: AppState) -> AppState:
    floats = state.images.values == "floats"
    return state.with_options(images={"values": "bytes" if floats else "floats"})


def _counting(name: str, one_based: bool) -> Action:
    return Action(
        COUNTING,
        name,
        changing(lambda state: state.with_options(one_based=one_based)),
        is_on=lambda state: state.options.one_based == one_based,
    )


IMAGE = (
    *(_channel(k, channel, name) for k, (channel, (name, _)) in enumerate(CHANNELS.items())),
    *(_component(part, name) for part, (name, _) in COMPONENTS.items() if part != "rgb"),
    Action(
        CHANNEL,
        "Tint single channels",
        changing(_switch("tinted")),
        "Alt+T",
        (ALT | int(Key.t),),
        is_on=lambda state: state.images.tinted,
    ),
    *(_pixel_size(size) for size in PIXEL_SIZES),
    *(_resolution(number, size) for number, size in enumerate(RESOLUTIONS)),
    Action(
        RESOLUTION,
        "Custom size...",
        lambda w: w.ask_resolution(),
        "Alt+S",
        (ALT | int(Key.s),),
        separated=True,
    ),
    *(_samples(number, samples) for number, samples in enumerate(SAMPLES)),
    Action(
        MAGNIFY,
        "Fit",
        changing(lambda state: with_magnification(state, None)),
        "Alt+0",
        (ALT | int(Key._0), ALT | int(Key.keypad0)),
        is_on=lambda state: state.images.magnification is None,
    ),
    Action(
        MAGNIFY,
        "Magnify",
        _step(1),
        "Alt++",
        (ALT | int(Key.equal), ALT | SHIFT | int(Key.equal), ALT | int(Key.keypad_add)),
    ),
    Action(
        MAGNIFY,
        "Reduce",
        _step(-1),
        "Alt+-",
        (ALT | int(Key.minus), ALT | int(Key.keypad_subtract)),
    ),
    *(_magnification(number, factor) for number, factor in enumerate(MAGNIFICATIONS)),
    Action(
        MAGNIFY,
        "Pixel grid and values",
        changing(_switch("grid")),
        "Alt+X",
        (ALT | int(Key.x),),
        is_on=lambda state: state.images.grid,
        separated=True,
    ),
    Action(
        MAGNIFY,
        "Values as linear light",
        changing(_switch_values),
        "Alt+V",
        (ALT | int(Key.v),),
        is_on=lambda state: state.images.values == "floats",
    ),
    Action(
        "Image",
        "Brighter",
        changing(_exposure(0.5)),
        "+",
        (int(Key.equal), SHIFT | int(Key.equal), int(Key.keypad_add)),
        separated=True,
    ),
    Action(
        "Image",
        "Darker",
        changing(_exposure(-0.5)),
        "-",
        (int(Key.minus), int(Key.keypad_subtract)),
    ),
    Action("Image", "Exposure 0", changing(_exposure(0.0)), "0", (int(Key._0),)),
    Action(
        "Image",
        "Linear light without sRGB's curve",
        changing(with_transfer_switched),
        "Alt+L",
        (ALT | int(Key.l),),
        is_on=lambda state: state.images.transfer == "linear",
    ),
    Action(
        "Image",
        "Go to pixel...",
        lambda w: w.ask_pixel(),
        "Ctrl+G",
        (CTRL | int(Key.g),),
        separated=True,
    ),
    _counting("Pixels from 1 (lecture)", one_based=True),
    _counting("Pixels from 0 (arrays)", one_based=False),
    Action(
        "Image",
        "Clear mark",
        changing(lambda state: state.with_options(marked=None)),
        "Esc",  # which ends other things first: the shell's
        can=lambda w: w.state.marked is not None,
    ),
)
MOUSE = (
    ("drag an image", "turn the camera about the point under the pointer"),
    ("Shift+drag, right or middle drag", "move the camera; the point follows the pointer"),
    ("wheel", "closer and farther (parallel: a smaller or larger viewport)"),
    ("click an image", "mark the pixel; again, or Esc: clear the mark"),
    ("arrow keys, mouse over an image", "move the mark; Shift: by ten"),
    ("Ctrl+wheel over an image", "magnify its pixels at the pointer"),
    ("Ctrl+drag an image", "move the magnified image"),
)
