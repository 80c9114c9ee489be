"""Go to pixel: the box, by the keyboard alone; the rows and columns counted as the user says."""

from window_driver import Key

OPEN = Key.mod_ctrl | Key.g


def typed(d, row, column):
    """Ctrl+G, a row, Tab, a column, Enter; nothing is clicked."""
    d.press(OPEN)
    for key, text in ((None, row), (Key.tab, column)):
        if key is not None:
            d.press(key)
        d.ctx.key_chars(text)
        d.frames(2)
    d.press(Key.enter)


def drive_a_pixel_is_typed(d):
    typed(d, "31", "41")
    assert d.state.marked == (30, 40)
    assert d.window.box is None
    d.change(one_based=False)
    typed(d, "31", "41")
    assert d.state.marked == (31, 41)


def drive_a_mistake_is_said_and_escape_leaves(d):
    d.change(marked=(5, 6))
    d.frames(2)
    typed(d, "99999", "1")
    assert "'99999' is no row of this image; give 1 to" in d.window.box.problem
    d.press(Key.escape)
    assert d.window.box is None
    assert d.state.marked == (5, 6), "Escape has left the box and nothing else"


def drive_a_pixel_out_of_sight_is_brought_into_it(d):
    d.change(images={"magnification": 16.0})
    d.settle()
    typed(d, "2", "3")
    d.settle()
    top, left, bottom, right = d.renderers.placement(d.state).visible_pixels
    assert top <= 1 < bottom
    assert left <= 2 < right
