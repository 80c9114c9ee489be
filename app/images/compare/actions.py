"""The actions of the compare view: its modes, its marks, and steps from pixel to pixel."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from lucida.app.state.options.compare import CompareMode
from lucida.app.ui.action import Action, choosing
from lucida.app.ui.host import Host

from . import comparing

MENU = "Image/Compare"


def _step(forward: bool) -> Callable[[Host], None]:
    """Return the action's step to a differing pixel, which does nothing until they are known."""

    def run(window: Host) -> None:
        verdict = window.renderers.verdict(window.state)
        if verdict is not None:
            window.change(comparing.stepped(window.state, verdict.comparison, forward))

    return run


def show_differing(window: Host) -> None:
    """Show the difference of both images, with a mark on each differing pixel."""
    compare = replace(window.options.compare, mode="absolute", causes=True)
    window.edit(compare)
    window.show("Compare")


def _differ(window: Host) -> bool:
    verdict = window.renderers.verdict(window.state)
    return verdict is not None and verdict.comparison.differing > 0


def _comparing(mode: CompareMode, name: str, keys: str) -> Action:
    """Return the action that selects a mode, and shows the view."""
    choice = choosing(MENU, name, "compare.mode", mode, keys)

    def run(window: Host) -> None:
        choice.run(window)
        window.show("Compare")

    return replace(choice, run=run)


COMPARING = (
    *(_comparing(mode, name, f"F{5 + k}") for k, (mode, name, _) in enumerate(comparing.MODES)),
    choosing(MENU, "Mark the causes", "compare.causes", True, "K", off=False),
    Action(MENU, "Next differing pixel", _step(True), "N", can=_differ),
    Action(MENU, "Previous differing pixel", _step(False), "Shift+N", can=_differ),
)
