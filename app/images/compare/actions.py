"""The actions of the compare view: its modes, its gain, its divider, steps from pixel to pixel."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from lucida.app.images.compare import comparing
from lucida.app.state.app_state import AppState
from lucida.app.state.options.compare import CompareMode
from lucida.app.ui.action import Action, Key, choosing
from lucida.app.ui.host import Host
from lucida.renderer.compare.raster_and_ray import Comparison

MENU, STEP = "View/Compare", comparing.DIVIDER_STEP
FLIP_KEY = Key.x  # held, it shows the other image; read by the compare view


def _differing(change: Callable[[AppState, Comparison], AppState]) -> Callable[[Host], None]:
    """Return a change that depends on where the images differ; it does nothing until that is
    known.
    """

    def run(window: Host) -> None:
        verdict = window.renderers.verdict(window.state)
        if verdict is not None:
            window.change(change(window.state, verdict.comparison))

    return run


def _differ(window: Host) -> bool:
    verdict = window.renderers.verdict(window.state)
    return verdict is not None and verdict.comparison.agree < verdict.comparison.pixels


def _comparing(number: int, mode: CompareMode, name: str) -> Action:
    """Return the action that selects a mode, and shows the view."""
    choice = choosing(MENU, name, "compare.mode", mode, f"F{5 + number}")

    def run(window: Host) -> None:
        choice.run(window)
        window.show("Compare")

    return replace(choice, run=run)


def _tuned(factor: float = 1.0, step: float = 0.0) -> Callable[[Host], None]:
    """Return what multiplies the gain, and moves the divider to the right, within their bounds."""

    def run(window: Host) -> None:
        old = window.options.compare
        new = replace(old, gain=old.gain * factor, divider=old.divider + step)
        window.change(window.state.with_options(new))

    return run


def _previous(state: AppState, comparison: Comparison) -> AppState:
    return comparing.stepped(state, comparison, forward=False)


COMPARING = (
    *(_comparing(number, mode, name) for number, (mode, name, _) in enumerate(comparing.MODES)),
    choosing(
        MENU,
        "The other image (hold the key)",
        "compare.flipped",
        True,
        "X",
        off=False,
        binds=False,
    ),
    choosing(MENU, "Mark the causes", "compare.causes", True, "K", off=False),
    Action(MENU, "More gain", _tuned(factor=2.0), "]"),
    Action(MENU, "Less gain", _tuned(factor=0.5), "["),
    Action(MENU, "Divider to the right", _tuned(step=STEP), "Shift+]"),
    Action(MENU, "Divider to the left", _tuned(step=-STEP), "Shift+["),
    Action(MENU, "Next differing pixel", _differing(comparing.stepped), "N", can=_differ),
    Action(MENU, "Previous differing pixel", _differing(_previous), "Shift+N", can=_differ),
    Action(MENU, "Worst pixel", _differing(comparing.at_worst), "Shift+M", can=_differ),
)
