"""Nothing stale is shown: no ray image of another scene or size, no name, no time, no mark."""

import numpy as np
from option_changes import with_options

from lucida.app.images.pair.view import RASTER, RAY
from lucida.renderer.camera.navigation import orbited

COMPARE = "Compare"


def middle(d, name):
    """The pixels in the middle of a view, away from what is written at its edges."""
    left, top, right, bottom = d.stage.rects[name]
    wide, high = right - left, bottom - top
    picture = d.picture()
    return picture[
        int(top + 0.35 * high) : int(top + 0.6 * high),
        int(left + 0.2 * wide) : int(right - 0.2 * wide),
    ].reshape(-1, 3)


def drive_a_ray_image_that_has_not_come_is_plain_ground(d):
    window = d.window
    live = window.renderers.live
    for view, mode in ((RAY, ""), (COMPARE, "wipe")):
        d.layout(COMPARE if mode else "Side by side")
        window.change(with_options(d.start, images={"channel": "depth", "resolution": (120, 90)}))
        if mode:
            options = {"mode": mode, "divider": 0.1}
            d.change(compare=options)
        d.settle()
        assert len(np.unique(middle(d, view), axis=0)) > 20
        live.request = lambda *_: None
        try:
            camera = window.state.camera
            window.change(window.state.with_camera(orbited(camera, (0, 0, 0), 0.1, 0.0)))
            d.frames(3)
            assert len(np.unique(middle(d, view), axis=0)) > 20, "an image of a camera on its way"
            window.undo()
            shown = window.state
            window.change(with_options(shown, images={"resolution": (300, 100)}))
            d.frames(3)
            assert len(np.unique(middle(d, view), axis=0)) == 1, "an image of another size"
            window.undo()
            window.open("columns")
            d.until(lambda: window.state.scene.name == "columns")
            d.frames(3)
            assert len(np.unique(middle(d, view), axis=0)) == 1, "an image of another scene"
        finally:
            del live.request
        d.settle()
        assert len(np.unique(middle(d, view), axis=0)) > 20


def seen_at(d, pixel):
    """Return the status line's words for a pixel, from the window's thread, which has OpenGL."""
    callbacks, said = d.run.params.callbacks, []

    def once():
        callbacks.post_new_frame = lambda: None
        said.append(d.renderers.seen_at(d.state, pixel))

    callbacks.post_new_frame = once
    d.until(lambda: bool(said))
    return said[0]


def drive_without_a_ray_view_the_status_is_of_the_raster_image(d):
    d.layout("Side by side")
    window, both = d.window, d.renderers
    pixel = both.size[1] // 2, both.size[0] // 2
    of_rays = seen_at(d, pixel)
    assert ", t = " in of_rays and both.raster_s > 0
    window.shell.stage.show(RAY, False)
    d.frames(3)
    window.open("spheres")
    d.until(lambda: window.state.scene.name == "spheres")
    d.settle()
    assert not both.is_tracing and both.raster_s > 0
    pixel = both.size[1] // 2, both.size[0] // 2
    found = both.object_at(window.state, pixel)
    name = "background" if found is None else window.state.scene.objects[found].name
    assert seen_at(d, pixel).startswith(name)
    window.shell.stage.show(RASTER, False)
    d.frames(3)
    assert seen_at(d, pixel) == "" and both.raster_s == 0
