"""Every view of the window alone, one after another: for drives that look at all of them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import get_args, get_type_hints

from window_driver import Driver

from app.laboratory.options import LaboratoryOptions
from app.laboratory.view import LABORATORY
from app.mistakes.options import Mode
from app.mistakes.view import MISTAKES

PAGES = get_args(get_type_hints(LaboratoryOptions)["page"])
MODES = get_args(Mode)


def views_in_turn(d: Driver) -> Iterator[str]:
    """Shows every view alone, and every page of those that have several."""
    stage = d.window.shell.stage
    pages = {LABORATORY: ("laboratory", "page", PAGES), MISTAKES: ("mistakes", "mode", MODES)}
    for name in stage.views:
        options, field, choices = pages.get(name, ("", "", ("",)))
        stage.show(name)
        stage.maximise(name)
        for choice in choices:
            if field:
                d.window.change(d.window.state.with_options(**{options: {field: choice}}))
            d.ctx.yield_(6)
            d.until(lambda name=name: stage.views[name].settled)  # type: ignore[misc]
            yield f"{name} {choice}"
        stage.maximise()
        stage.show(name, False)
