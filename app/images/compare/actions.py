"""The actions of the compare view: its modes, its gain, its divider, steps from pixel to pixel."""

from __future__ import annotations

from collections.abc import Callable

from lucida.app.images.compare import comparing
from lucida.app.state.app_state import AppState
from lucida.app.state.options.compare import CompareMode
from lucida.app.ui.action import Action, Key, changing
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


def _shown(change: Callable[[AppState], AppState]) -> Callable[[Host], None]:
    """Return a change that also brings the view to the front."""

    def run(window: Host) -> None:
        window.change(change(window.state))
        window.show("Compare")

    return run


def _comparing(number: int, mode: CompareMode, name: str) -> Action:
    return Action(
        MENU,
        name,
        _shown(lambda state: comparing.with_mode(state, mode)),
        f"F{5 + number}",
        is_on=lambda state: state.options.compare.mode == mode,
    )


def _switch(name: str, field: str, keys: str, binds: bool = True) -> Action:
    """Return an action that toggles an option."""

    def is_on(state: AppState) -> bool:
        return bool(getattr(state.options.compare, field))

    def toggled(state: AppState) -> AppState:
        return state.with_options(
            state.options.with_changes({"compare": {field: not is_on(state)}})
        )

    return Action(MENU, name, changing(toggled), keys, binds=binds, is_on=is_on)


def _gain(factor: float) -> Callable[[Host], None]:
    return changing(lambda state: comparing.with_gain(state, state.options.compare.gain * factor))


def _divider(step: float) -> Callable[[Host], None]:
    return changing(
        lambda state: comparing.with_divider(state, state.options.compare.divider + step)
    )


def _previous(state: AppState, comparison: Comparison) -> AppState:
    return comparing.stepped(state, comparison, forward=False)


COMPARING = (
    *(_comparing(number, mode, name) for number, (mode, name, _) in enumerate(comparing.MODES)),
    _switch("The other image (hold the key)", "flipped", "X", binds=False),
    _switch("Mark the causes", "causes", "K"),
    Action(MENU, "More gain", _gain(2.0), "]"),
    Action(MENU, "Less gain", _gain(0.5), "["),
    Action(MENU, "Divider to the right", _divider(STEP), "Shift+]"),
    Action(MENU, "Divider to the left", _divider(-STEP), "Shift+["),
    Action(MENU, "Next differing pixel", _differing(comparing.stepped), "N", can=_differ),
    Action(MENU, "Previous differing pixel", _differing(_previous), "Shift+N", can=_differ),
    Action(MENU, "Worst pixel", _differing(comparing.at_worst), "Shift+M", can=_differ),
)
