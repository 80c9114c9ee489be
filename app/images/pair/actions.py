"""The actions of the menu "Image": the channel, size and magnification of both images.

Their keys, if any, are Alt and a letter or digit.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from lucida.app.images.imaging import CHANNELS, size_text, with_magnification, with_resolution
from lucida.app.images.placement import magnification_text, step_from
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import MAGNIFICATIONS, RESOLUTIONS, SAMPLES
from lucida.app.ui.action import Action, changing, choosing
from lucida.app.ui.host import Host

from .boxes import ask_pixel, ask_resolution

RESOLUTION, MAGNIFY = "Image/Resolution", "Image/Magnification"
COUNTING = "Image/Rows and columns"


def _step(steps: int) -> Callable[[Host], None]:
    def run(window: Host) -> None:
        state = window.state
        placement = window.renderers.placement(state)
        if placement is not None:
            factor = step_from(placement, state.images, steps)
            window.change(with_magnification(state, factor))

    return run


def _exposure(stops: float) -> Callable[[Host], None]:
    def brighter(state: AppState) -> AppState:
        exposure_ev = state.images.exposure_ev + stops if stops else 0.0
        return state.with_options(replace(state.images, exposure_ev=exposure_ev))

    return changing(brighter)


def _resolution(size: tuple[int, int] | None) -> Action:
    return Action(
        RESOLUTION,
        size_text(size) if size else "Fit to window",
        changing(partial(with_resolution, resolution=size)),
        "" if size else "Alt+W",
        is_on=lambda state: state.images.resolution == size,
        separated=size == RESOLUTIONS[0],
    )


def _magnification(factor: float | None, name: str, keys: str, tip: str) -> Action:
    return Action(
        MAGNIFY,
        name,
        changing(partial(with_magnification, magnification=factor)),
        keys,
        is_on=lambda state: state.images.magnification == factor,
        separated=factor == MAGNIFICATIONS[0],
        tip=tip,
    )


IMAGE = (
    *(
        choosing("Image/Channel", name, "images.channel", channel, f"Alt+{number}", tip=tip)
        for number, (channel, (name, tip)) in enumerate(CHANNELS.items(), 1)
    ),
    *map(_resolution, (None, *RESOLUTIONS)),
    Action(
        RESOLUTION,
        "Custom size...",
        ask_resolution,
        "Alt+S",
        is_on=lambda state: state.images.resolution not in (None, *RESOLUTIONS),
        separated=True,
    ),
    *(
        choosing(
            RESOLUTION,
            "Ray: 1 sample per pixel" if count == 1 else f"Ray: mean of {count} samples",
            "images.samples",
            count,
            separated=count == 1,
            tip="The resting ray image shows the mean of the samples. The comparison uses centres.",
        )
        for count in SAMPLES
    ),
    _magnification(None, "Fit", "Alt+0", "Show the whole image in its window."),
    Action(MAGNIFY, "Magnify", _step(1), "Alt++"),
    Action(MAGNIFY, "Reduce", _step(-1), "Alt+-"),
    *(
        _magnification(
            factor,
            magnification_text(factor),
            "Alt+A" if factor == 1 else "",
            "Ctrl+wheel magnifies at the pointer, Ctrl+drag moves the image.",
        )
        for factor in MAGNIFICATIONS
    ),
    choosing(
        MAGNIFY,
        "Pixel grid and values",
        "images.grid",
        True,
        "Alt+X",
        off=False,
        separated=True,
        tip="Shows lines from 8x on, and numbers from 32x on.",
    ),
    Action("Image", "Brighter", _exposure(0.5), "+", separated=True),
    Action("Image", "Darker", _exposure(-0.5), "-"),
    Action("Image", "Exposure 0", _exposure(0.0), "0"),
    choosing(
        "Image",
        "Linear light (no sRGB curve)",
        "images.transfer",
        "linear",
        "Alt+L",
        off="srgb",
        tip="Shows linear light without the sRGB curve, which is too dark.",
    ),
    choosing(
        "Image",
        "Straight lines",
        "pair.straight_lines",
        True,
        off=False,
        can=lambda window: not window.state.camera.is_parallel,
    ),
    Action("Image", "Go to pixel...", ask_pixel, "Ctrl+G", separated=True),
    *(
        choosing(
            COUNTING,
            name,
            "one_based",
            from_one,
            can=lambda window: window.state.step is None,  # a lecture has its own numbering
        )
        for name, from_one in (("Pixels from 1 (lecture)", True), ("Pixels from 0 (arrays)", False))
    ),
    Action(
        "Image",
        "Clear mark",
        changing(lambda state: state.with_options(replace(state.options, marked=None))),
        "Esc",
        binds=False,  # the shell handles Escape, which closes other things first
        can=lambda w: w.state.marked is not None,
    ),
)
MOUSE = (
    ("drag an image", "turn the camera about the point under the pointer"),
    ("Shift+drag, right or middle drag", "move the camera; the point follows the pointer"),
    ("wheel", "closer and farther (parallel: a smaller or larger viewport)"),
    ("click an image", "mark the pixel; click again, or Esc, clears the mark"),
    ("arrow keys, mouse over an image", "move the mark; with Shift, by ten pixels"),
    ("Ctrl+wheel over an image", "magnify its pixels at the pointer"),
    ("Ctrl+drag an image", "move the magnified image"),
)
