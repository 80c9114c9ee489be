"""The window's shell without a window."""

from unittest.mock import Mock

from lucida.app.window.shell import REDRAWN, Shell


def test_frames_are_requested_until_the_division_rests():
    """Otherwise an idle window shows a division that is under way, as after F9."""
    shell, window = Shell([], None, Mock()), Mock(has_tools=True)

    def requested():
        window.animate.reset_mock()
        for _ in range(2 * REDRAWN):
            shell.draw_until_divided(window)
        return window.animate.call_count

    requested()
    assert requested() == 0
    window.has_tools = False
    assert requested() == REDRAWN
    shell.stage.rects = {"Raster": (0, 0, 100, 100)}
    assert requested() == REDRAWN
    assert requested() == 0
