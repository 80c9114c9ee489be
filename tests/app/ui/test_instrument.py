"""Each room's description of itself appears where it is shown."""

from __future__ import annotations

from lucida.app.window.instruments import INSTRUMENTS
from lucida.app.window.shortcut_sheet import sections


def test_the_sheet_holds_what_mouse_and_keyboard_do_in_each_instrument() -> None:
    parts = dict(sections())
    rows = [row for part in parts.values() for row in part]
    for instrument in INSTRUMENTS:
        assert set(rows) >= {*instrument.mouse, *instrument.keyboard}
    assert ("Right in the stepper", "one line on") in parts["Everywhere"]
