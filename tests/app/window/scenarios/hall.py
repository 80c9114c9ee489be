"""Type in a lecture hall: what is read grows with it, and is not cut."""

from contextlib import contextmanager

from capitals import capital_heights
from imgui_bundle import imgui
from lecture_window import untraced, untraced_drive
from views_in_turn import views_in_turn
from window_driver import Key

from lucida.app.lecture.reading import BUILTIN, load_lecture
from lucida.app.lecture.view import LECTURE

SIZE = 1024, 728  # 1024x768 less a title bar: the smallest hall


@contextmanager
def noted_overflow():
    """Note how far each drawn step's text can be scrolled. Over a picture, nothing can be."""
    found, end_child = [], imgui.end_child

    def noting():
        if "/step_" in imgui.internal.get_current_window().name:
            found.append(imgui.get_scroll_max_y())
        end_child()

    imgui.end_child = noting
    try:
        yield found
    finally:
        imgui.end_child = end_child


def drive_in_a_hall_no_capital_is_low_and_no_text_is_scrolled(d):
    """1/50 of the window's height at least: at every second step's end, in all views alone. Every
    fourth step shows its views too, which are drawn slowly.
    """
    lecture, low, scrolled = load_lecture(BUILTIN), {}, {}
    failed, draw = d.stage.failed, d.stage.failed.draw
    d.resize(SIZE)

    def look(name):
        heights = d.in_draw_lists(capital_heights)
        if small := below(heights, SIZE[1] / 50):
            low[name] = small

    d.window.lecture.give(lecture, BUILTIN)
    d.settle()
    assert d.state.preferences.presentation
    with noted_overflow() as overflow, untraced(d):  # nothing is read in an image
        for number, step in list(enumerate(lecture.steps))[::2]:
            seen = set(d.stage.views) if number % 4 == 0 else {LECTURE}
            failed.draw = lambda view, host, seen=seen: view.name in seen and draw(view, host)
            d.window.lecture.go(d.window, number, lecture.count(number) - 1)
            d.until(lambda: not d.window.lecture.is_entering)
            d.frames(2)
            overflow.clear()
            look(step.title)
            scrolled |= {step.title: max(overflow)} if max(overflow, default=0.0) else {}
    before = imgui.get_font_size()
    d.press(Key.f9)  # which leaves presentation mode
    assert not d.state.preferences.presentation
    assert imgui.get_font_size() == before
    del failed.draw
    d.window.lecture.leave(d.window)
    d.settle()
    d.change(preferences={"presentation": True})
    for name in views_in_turn(d):
        look(name)
    d.window.change(d.start)
    d.settle()
    assert not low, low
    assert not scrolled, scrolled


def below(heights, least):
    return {height: letters for height, letters in heights.items() if height < least}


@untraced_drive
def drive_the_lecture_ends(d):
    """The scene and the camera from before the lecture come back."""
    camera, scene = d.state.camera, d.state.scene
    d.window.lecture.give(load_lecture(BUILTIN), BUILTIN, (26, 0))  # an image of 8 x 8 pixels
    d.until(lambda: d.state.camera != camera and not d.window.lecture.is_entering)
    d.frames(3)
    d.ctx.mouse_move_to_pos((300, 300))
    d.click("//##stage menu/Menu")
    d.ctx.menu_click("//$FOCUSED/Lecture/End the lecture")
    d.settle()
    state = d.state
    assert not d.window.lecture.is_given and state.step is None
    assert (state.scene, state.camera) == (scene, camera)
    assert state.images.resolution is None and not state.preferences.presentation
    shown = {view.name for view in d.stage.shown}
    assert {"Camera", "Raster", "Ray"} <= shown and LECTURE not in shown
