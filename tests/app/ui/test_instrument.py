"""Each room's description of itself appears where it is shown."""

from __future__ import annotations

from lucida.app.window.instruments import INSTRUMENTS
from lucida.app.window.shortcut_sheet import sections


def test_the_sheet_holds_what_mouse_and_keyboard_do_in_each_instrument() -> None:
    parts = dict(sections())
    rows = [row for part in parts.values() for row in part]
    for instrument in INSTRUMENTS:
        assert set(rows) >= {*instrument.mouse, *instrument.keyboard}
        if instrument.heading:  # keys that hold in its view only are nowhere else
            own = [action.keys for action in instrument.actions if action.keys]
            assert [keys for keys, _ in parts[instrument.heading]] == own
            names = {action.name for action in instrument.actions}
            assert not names & {what for _, what in rows}
    assert ("Space", "play and pause") in parts["Loop stepper, once it is clicked"]
