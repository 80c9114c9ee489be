"""Type in a lecture hall: what is read grows with it, and is not cut."""

from capitals import capital_heights
from imgui_bundle import imgui
from views_in_turn import views_in_turn
from window_driver import Key

from lucida.app.lecture.reading import BUILTIN, load_lecture
from lucida.app.lecture.view import LECTURE

SIZE = 1024, 728  # 1024x768 less a title bar: the smallest hall


def overflow(d):
    """How far the step's text can be scrolled."""
    found = []
    end_child = imgui.end_child

    def told():
        if "/step_" in imgui.internal.get_current_window().name:
            found.append(imgui.get_scroll_max_y())
        end_child()

    imgui.end_child = told
    try:
        d.frames(2)
    finally:
        imgui.end_child = end_child
    return max(found, default=0.0)  # over a picture, nothing can be scrolled


def drive_in_a_hall_no_capital_is_low_and_no_text_is_scrolled(d):
    """1/50 of the window's height at least: at the end of all steps, and in all views alone."""
    lecture, low, scrolled = load_lecture(BUILTIN), {}, {}
    d.resize(SIZE)

    def look(name):
        while not (heights := d.in_draw_lists(capital_heights)):
            d.settle()
        if small := below(heights, SIZE[1] / 50):
            low[name] = small

    d.window.lecture.give(lecture, BUILTIN)
    d.settle()
    assert d.state.preferences.presentation
    for number, step in enumerate(lecture.steps):
        d.window.lecture.go(d.window, number, lecture.count(number) - 1)
        d.until(lambda: not d.window.lecture.is_entering)
        d.frames(8)
        look(step.title)
        scrolled |= {step.title: px} if (px := overflow(d)) else {}
    before = imgui.get_font_size()
    d.press(Key.f9)  # which leaves presentation mode
    assert not d.state.preferences.presentation
    assert imgui.get_font_size() == before
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


def drive_the_lecture_ends(d):
    """The scene and the camera from before the lecture come back."""
    camera, scene = d.state.camera, d.state.scene
    d.window.lecture.give(load_lecture(BUILTIN), BUILTIN)
    d.settle()
    d.window.lecture.go(d.window, 26)  # an image of 8 x 8 pixels
    d.settle()
    assert d.state.camera != camera
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
