"""The probe's actions: its pins."""

from __future__ import annotations

from dataclasses import replace

from lucida.app.state.app_state import AppState
from lucida.app.ui.action import Action, changing


def _pinned(state: AppState) -> AppState:
    pins, pixel = state.options.probe.pins, state.marked
    if pixel is None or pixel in pins:
        return state
    return state.with_options(replace(state.options.probe, pins=(*pins, pixel)))


PINNING = (
    Action(
        "Instruments",
        "Pin the marked pixel",
        changing(_pinned),
        can=lambda w: w.state.marked is not None,
        separated=True,
    ),
    Action(
        "Instruments",
        "Remove all pins",
        changing(lambda state: state.with_options(replace(state.options.probe, pins=()))),
        can=lambda w: bool(w.state.options.probe.pins),
    ),
)
