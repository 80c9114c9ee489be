"""The arrow keys: who gets them, wherever the mouse rests and whatever has been clicked before."""

from window_driver import RASTER, RAY, Key

from lucida.app.instruments.stepper.view import STEPPER, StepperView

START = (100, 120)
F3, ESCAPE = Key.f3, Key.escape


def enter(d, name):
    """A layout, with a pixel marked."""
    d.layout(name)
    d.change(marked=START)
    d.settle()


def rest(d, name=RASTER):
    d.move_to(d.point(name, 0.4, 0.4))


def right(d):
    """By how many columns one press moves the mark."""
    before = d.state.marked
    d.press(Key.right_arrow)
    after = d.state.marked
    assert after[0] == before[0]
    return after[1] - before[1]


def stands(d):
    found = d.window.views[STEPPER]
    assert isinstance(found, StepperView)
    return d.options.stepper.steps


def drive_after_a_click_in_the_camera_panel_or_by_the_keyboard(d):
    """F3 shows the keyboard's own frame; the mouse has not moved since."""
    enter(d, "Side by side")
    for item in ("//Camera/Canonical", d.field("eye.x")):
        d.click(item)
        rest(d, RAY if item == d.field("eye.x") else RASTER)
        assert [right(d), right(d)] == [1, 1], item
    rest(d)
    d.press(F3)
    assert [right(d), right(d)] == [1, 1]


def drive_a_box_over_the_views_keeps_its_keys(d):
    enter(d, "Side by side")
    d.files.open_dialog()
    d.frames(3)
    assert d.files.dialog.is_open
    d.move_to(d.point(RASTER, 0.02, 0.02))
    assert [right(d), right(d)] == [0, 0]
    d.press(ESCAPE)
    assert not d.files.dialog.is_open
    assert [right(d), right(d)] == [1, 1]


def drive_after_a_click_in_the_stepper(d):
    """Its own keys hold where the mouse is not on an image."""
    enter(d, "Loops")
    d.click(f"//###{STEPPER}/###step")
    before = stands(d)
    d.press(Key.right_arrow)
    assert stands(d) != before
    before = stands(d)
    rest(d, RASTER if RASTER in d.stage.rects else RAY)
    assert [right(d), right(d)] == [1, 1]
    assert stands(d) == before
