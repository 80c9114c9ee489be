"""Things that nobody does on purpose: windows without room, mistakes in a view, random events."""

import moderngl
from imgui_bundle import imgui
from window_driver import SIZE

from lucida.app.cameras.camera_panel.view import CAMERA
from lucida.app.images.pair.view import RAY
from lucida.app.ui import layout
from lucida.app.window.platform import set_size


def resize(d, size):
    """Resize the window, in its own thread, and wait until that is drawn."""
    callbacks = d.run.params.callbacks

    def once():
        callbacks.post_new_frame = lambda: None
        set_size(size)

    callbacks.post_new_frame = once
    d.until(lambda: tuple(imgui.get_io().display_size) == size)
    d.frames(2)


def drive_no_view_fails_where_it_has_no_room(d):
    stage = d.stage
    for size, scale in (((1600, 120), 3.0), ((16, 16), 1.0)):
        d.change(preferences={"font_scale": scale})
        resize(d, size)
        for one in layout.LAYOUTS:
            layout.switch(one.name)
            d.until(lambda name=one.name: layout.current().name == name)
            d.frames(4)
            assert not stage.failed.errors, (size, scale, one.name)
    layout.switch(layout.LAYOUTS[0].name)
    resize(d, SIZE)
    d.window.change(d.start)
    d.agreeing_images()


def drive_a_mistake_in_a_view_is_told_in_its_place(d):
    stage = d.stage
    view = stage.views[CAMERA]
    for error in (None, moderngl.Error("GLSL: 0:1: syntax error")):

        def fail(_, error=error):
            imgui.begin_child("half drawn")
            imgui.push_id("and more")
            if error is not None:
                raise error
            imgui.push_font(None, 30.0)
            imgui.push_font(None, -1.0)  # ImGui's assertions are exceptions

        before = d.state
        view.draw = fail
        d.until(lambda: CAMERA in stage.failed.errors)
        d.drag(d.point(RAY, 0.5, 0.5), d.point(RAY, 0.6, 0.5))
        assert d.state != before
        del view.draw
        d.click(f"//{CAMERA}/Try again")
        d.until(lambda: not stage.failed.errors)
    d.settle()
