"""Changes of a state's options, by their names."""

from __future__ import annotations

from typing import Any

from lucida.app.state.app_state import AppState


def with_options(state: AppState, **changes: Any) -> AppState:
    """Return the state with fields changed: with_options(state, stepper={"canvas": (8, 8)})."""
    return state.with_options(state.options.with_changes(changes))
