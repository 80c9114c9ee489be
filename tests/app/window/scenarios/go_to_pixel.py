"""Go to pixel: the box, by the keyboard alone; the rows and columns counted as the user says."""

from option_changes import with_options
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
    window = d.window
    typed(d, "31", "41")
    assert window.state.marked == (30, 40)
    assert window.box is None
    d.change(one_based=False)
    typed(d, "31", "41")
    assert window.state.marked == (31, 41)
    assert d.steps == 3


def drive_a_mistake_is_said_and_escape_leaves(d):
    window = d.window
    before = with_options(window.state, marked=(5, 6))
    window.change(before)
    d.frames(2)
    typed(d, "99999", "1")
    assert window.box is not None
    assert "'99999' is no row of this image; give 1 to" in window.box.problem
    assert with_options(window.state, marked_size=None) == before
    d.press(Key.escape)
    assert window.box is None
    assert window.state.marked == (5, 6), "Escape has left the box and nothing else"


def drive_keys_in_the_box_are_for_the_box(d):
    """Escape leaves nothing else, and digits are no bookmarks, where no field has them yet."""
    window = d.window
    d.change(preferences={"presentation": True})
    d.settle()
    before = window.state
    d.press(OPEN)
    d.press(Key.tab)
    d.press(Key.tab)  # on to the button
    d.press(Key._2)
    assert not window.shell.toasts.texts
    d.press(Key.p)  # would switch the projection
    assert window.box is not None
    assert window.state == before
    d.press(Key.escape)
    assert window.box is None
    assert window.state == before, "presentation goes on"
    window.undo()
    d.settle()


def drive_a_pixel_out_of_sight_is_brought_into_it(d):
    d.change(images={"magnification": 16.0})
    d.settle()
    typed(d, "2", "3")
    d.settle()
    placement = d.renderers.placement(d.state)
    top, left, bottom, right = placement.visible_pixels
    assert top <= 1 < bottom
    assert left <= 2 < right
