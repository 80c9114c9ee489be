"""The actions of the menu "Image": what both images show, how large, how magnified.

Their keys are Alt and a letter or digit, as far as they have any.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from lucida.app.images.imaging import with_magnification
from lucida.app.images.pair import choices
from lucida.app.images.pair.choices import Choice, has, toggling
from lucida.app.images.placement import step_from
from lucida.app.state.app_state import AppState
from lucida.app.ui.action import Action, changing
from lucida.app.ui.host import Host

CHANNEL, RESOLUTION, MAGNIFY = "Image/Channel", "Image/Resolution", "Image/Magnification"
COUNTING, LENS = "Image/Rows and columns", "Image/Lens in the raster image"


def _step(steps: int) -> Callable[[Host], None]:
    def run(window: Host) -> None:
        state = window.state
        placement = window.renderers.placement(state)
        if placement is not None:
            factor = step_from(placement, state.images, steps)
            window.change(with_magnification(state, factor))

    return run


def _exposure(stops: float) -> Callable[[AppState], AppState]:
    return lambda state: state.with_options(
        replace(
            state.options.images, exposure_ev=state.images.exposure_ev + stops if stops else 0.0
        )
    )


def _with_lines(state: AppState) -> AppState:
    on = not state.options.pair.straight_lines
    return state.with_options(replace(state.options.pair, straight_lines=on))


def _counting(name: str, one_based: bool) -> Action:
    return Action(
        COUNTING,
        name,
        changing(lambda state: state.with_options(replace(state.options, one_based=one_based))),
        is_on=lambda state: state.options.one_based == one_based,
        can=lambda window: window.state.step is None,  # a lecture's text counts in its own way
    )


def _lens(choice: Choice) -> Action:
    return replace(choice.action(LENS), can=has_lens)


def has_lens(window: Host) -> bool:
    return window.state.camera.lens is not None


IMAGE = (
    *(choice.action(CHANNEL) for choice in choices.CHANNEL),
    *(choice.action(CHANNEL, k == 0) for k, choice in enumerate(choices.COMPONENT)),
    *(choice.action(RESOLUTION) for choice in choices.PIXEL_SIZE),
    *(choice.action(RESOLUTION, k == 0) for k, choice in enumerate(choices.RESOLUTION)),
    Action(RESOLUTION, "Custom size...", lambda w: w.ask_resolution(), "Alt+S", separated=True),
    *(choice.action(RESOLUTION, k == 0) for k, choice in enumerate(choices.SAMPLE)),
    *map(_lens, choices.LENS),
    choices.FIT.action(MAGNIFY),
    Action(
        MAGNIFY,
        "Magnify",
        _step(1),
        "Alt++",
    ),
    Action(
        MAGNIFY,
        "Reduce",
        _step(-1),
        "Alt+-",
    ),
    *(choice.action(MAGNIFY, k == 0) for k, choice in enumerate(choices.MAGNIFICATION)),
    choices.GRID.action(MAGNIFY, separated=True),
    choices.VALUES.action(MAGNIFY),
    Action(
        "Image",
        "Brighter",
        changing(_exposure(0.5)),
        "+",
        separated=True,
    ),
    Action(
        "Image",
        "Darker",
        changing(_exposure(-0.5)),
        "-",
    ),
    Action("Image", "Exposure 0", changing(_exposure(0.0)), "0"),
    Action(
        "Image",
        "Linear light without sRGB's curve",
        changing(toggling("transfer", ("srgb", "linear"))),
        "Alt+L",
        is_on=has("transfer", "linear"),
    ),
    Action(
        "Image",
        "Straight lines",
        changing(_with_lines),
        is_on=lambda state: state.options.pair.straight_lines,
        can=lambda window: not window.state.camera.is_parallel,
    ),
    Action(
        "Image",
        "Go to pixel...",
        lambda w: w.ask_pixel(),
        "Ctrl+G",
        separated=True,
    ),
    _counting("Pixels from 1 (lecture)", one_based=True),
    _counting("Pixels from 0 (arrays)", one_based=False),
    Action(
        "Image",
        "Clear mark",
        changing(lambda state: state.with_options(replace(state.options, marked=None))),
        "Esc",
        binds=False,  # the shell handles Escape, which ends other things first
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
