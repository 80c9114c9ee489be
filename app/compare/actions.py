"""The actions of the compare view: its modes, its gain, its divider, steps from pixel to pixel."""

from __future__ import annotations

from collections.abc import Callable

from app.compare import comparing
from app.compare.options import CompareMode, CompareOptions, Pair
from app.host.action import SHIFT, Action, Key, Window, changing
from app.photograph.actions import is_open
from app.state.app_state import AppState
from renderer.compare import Comparison

FLIP_KEY = Key.x  # held, it shows the other image; read by the compare view


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
        is_on=lambda state: state.of(CompareOptions).mode == mode,
    )


def _gain(factor: float) -> Callable[[AppState], AppState]:
    return lambda state: comparing.with_gain(state, state.of(CompareOptions).gain * factor)


def _divider(step: float) -> Callable[[AppState], AppState]:
    return lambda state: comparing.with_divider(state, state.of(CompareOptions).divider + step)


def _pair(pair: Pair, name: str) -> Action:
    def run(window: Window) -> None:
        window.change(comparing.with_pair(window.state, pair))
        window.shell.stage.show("Compare")

    return Action(
        "View/Compare",
        name.capitalize().replace("|", "against"),
        run,
        is_on=lambda state: state.of(CompareOptions).pair == pair,
        can=lambda window: pair == "raster-ray" or is_open(window),
    )


COMPARING = (
    *(_comparing(number, mode, name) for number, (mode, name, _) in enumerate(comparing.MODES)),
    *(_pair(pair, name) for pair, name in comparing.PAIRS),
    Action(
        "View/Compare",
        "The other image (hold the key)",
        changing(
            lambda state: state.with_options(
                compare={"flipped": not state.of(CompareOptions).flipped}
            )
        ),
        "X",
        is_on=lambda state: state.of(CompareOptions).flipped,
    ),
    Action(
        "View/Compare",
        "Mark the causes",
        changing(
            lambda state: state.with_options(
                compare={"causes": not state.of(CompareOptions).causes}
            )
        ),
        "K",
        (int(Key.k),),
        is_on=lambda state: state.of(CompareOptions).causes,
    ),
    Action("View/Compare", "More gain", changing(_gain(2.0)), "]", (int(Key.right_bracket),)),
    Action("View/Compare", "Less gain", changing(_gain(0.5)), "[", (int(Key.left_bracket),)),
    Action(
        "View/Compare",
        "Divider to the right",
        changing(_divider(comparing.DIVIDER_STEP)),
        "Shift+]",
        (SHIFT | int(Key.right_bracket),),
    ),
    Action(
        "View/Compare",
        "Divider to the left",
        changing(_divider(-comparing.DIVIDER_STEP)),
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
