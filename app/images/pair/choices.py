"""The choices for both images, as the menu "Image" and the strips above the images offer them."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

from lucida.app.images.imaging import (
    CHANNELS,
    COMPONENTS,
    samples_text,
    size_text,
    with_component,
    with_magnification,
    with_pixel_size,
    with_resolution,
)
from lucida.app.images.placement import magnification_text
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import MAGNIFICATIONS, PIXEL_SIZES, RESOLUTIONS, SAMPLES
from lucida.app.ui.action import Action, changing
from lucida.renderer.camera.pixels import ENLARGEMENTS

Change = Callable[[AppState], AppState]


class Choice(NamedTuple):
    """An entry of a menu.

    label: its name on the strip, if it has another one there. tip: its tooltip there.
    """

    name: str
    change: Change
    is_on: Callable[[AppState], bool]
    keys: str = ""
    tip: str = ""
    label: str = ""

    def action(self, menu: str, separated: bool = False) -> Action:
        return Action(
            menu,
            self.name,
            changing(self.change),
            self.keys,
            is_on=self.is_on,
            separated=separated,
        )


def setting(field: str, value: object) -> Change:
    """Return the change that sets a field of the images' options."""
    return lambda state: state.with_options(state.options.with_changes({"images": {field: value}}))


def has(field: str, value: object) -> Callable[[AppState], bool]:
    return lambda state: getattr(state.images, field) == value


def toggling(field: str, values: tuple[object, object] = (False, True)) -> Change:
    """Return the change that swaps two values of a field."""

    def change(state: AppState) -> AppState:
        return setting(field, values[getattr(state.images, field) == values[0]])(state)

    return change


def _pixel_size(size: int) -> Choice:
    name = "Fit to window" if size == 1 else f"Window, pixels {size} x {size}"
    keys = "Alt+W" if size == 1 else ""

    def is_on(state: AppState) -> bool:
        return state.images.resolution is None and state.images.pixel_size == size

    return Choice(name, partial(with_pixel_size, pixel_size=size), is_on, keys)


CHANNEL = tuple(
    Choice(
        name, setting("channel", channel), has("channel", channel), f"Alt+{number}",
        tip,
    )
    for number, (channel, (name, tip)) in enumerate(CHANNELS.items(), 1)
)  # fmt: skip
RGB, *COMPONENT = (
    Choice(
        f"{name} only", partial(with_component, component=component), has("component", component),
        "" if component == "rgb" else f"Alt+{name[0]}", tip, name,
    )
    for component, (name, tip) in COMPONENTS.items()
)  # fmt: skip
PIXEL_SIZE = tuple(map(_pixel_size, PIXEL_SIZES))
RESOLUTION = tuple(
    Choice(size_text(size), partial(with_resolution, resolution=size), has("resolution", size))
    for size in RESOLUTIONS
)
SAMPLE = tuple(
    Choice(
        samples_text(count), setting("samples", count), has("samples", count),
        tip="Of the ray image at rest: its pixels show their mean. Compared are the centres.",
    )
    for count in SAMPLES
)  # fmt: skip
LENS = tuple(
    Choice(
        f"Lens: look up, {count} x {count} texels per pixel",
        setting("lens_enlargement", count), has("lens_enlargement", count),
        tip="A pinhole image finds each pixel's primitive; its own ray shades it.",
        label=f"Look up, {count} x {count} texels per pixel",
    )
    for count in ENLARGEMENTS
)  # fmt: skip
FIT = Choice(
    "Fit", partial(with_magnification, magnification=None), has("magnification", None), "Alt+0",
    "All of the image in its window.",
)  # fmt: skip
MAGNIFICATION = tuple(
    Choice(
        magnification_text(factor), partial(with_magnification, magnification=factor),
        has("magnification", factor), "Alt+A" if factor == 1 else "",
        "Ctrl+wheel magnifies at the pointer, Ctrl+drag moves the image.",
    )
    for factor in MAGNIFICATIONS
)  # fmt: skip
GRID = Choice(
    "Pixel grid and values", toggling("grid"), has("grid", True), "Alt+X",
    "Lines from 8x on, numbers from 32x on.", "Pixel grid",
)  # fmt: skip
VALUES = Choice(
    "Values as linear light", toggling("values", ("bytes", "floats")), has("values", "floats"),
    "Alt+V", "A pixel's numbers: 0 to 255, or light.",
)  # fmt: skip
