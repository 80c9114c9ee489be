"""Renderers and views that fail: told in the window, survived, tried again."""

from dataclasses import replace

import moderngl

from lucida.renderer.system.errors import LucidaError

TRY_AGAIN = "//##message/Try again"


def is_told(d):
    return d.ctx.item_exists(TRY_AGAIN)


def try_again(d):
    """Click where the button is. It may move or vanish meanwhile, with another message."""
    center = d.box(TRY_AGAIN).get_center()
    d.click_at((center.x, center.y))


def is_mended(d):
    """Try the raster image again, as often as the window says that it failed."""
    if d.renderers.raster_error is not None and is_told(d):
        try_again(d)
    return d.renderers.raster_error is None


def fail_until_retried(d, error, told):
    """The tracer fails; the window tells it, goes on, and tries again when asked."""
    renderers = d.renderers
    live = renderers.live
    good = live.make_tracer

    def bad(request):
        raise error

    live.make_tracer = bad
    d.change(shadows=not d.options.shadows)
    # The full image of a camera at rest is a request of its own, which fails once more.
    d.until(lambda: live.error is not None and not renderers.unfinished(d.state))
    d.until(lambda: live.error is not None and is_told(d))
    assert told in str(live.error) or told in type(live.error).__name__
    live.make_tracer = good

    def is_retried():  # a request that was under way at the click may fail after it
        if live.error is not None and is_told(d):
            try_again(d)
        return live.error is None and d.window.settled

    d.until(is_retried)


def drive_failures_of_the_tracer_are_told_and_tried_again(d):
    fail_until_retried(d, LucidaError("tracer", "broke", "mend it"), "broke")
    fail_until_retried(d, SystemExit(3), "SystemExit")
    d.window.history = replace(d.window.history, present=d.start)
    d.agreeing_images()


def drive_a_lost_context_is_told_and_the_window_goes_on(d):
    error = moderngl.Context.error
    moderngl.Context.error = property(lambda _: "GL_UNKNOWN_ERROR")  # of GL_CONTEXT_LOST
    try:
        d.change(images={"resolution": (50, 40)})
        d.until(lambda: d.renderers.raster_error is not None and is_told(d))
        assert "the context is lost" in str(d.renderers.raster_error)
    finally:
        moderngl.Context.error = error
    d.until(lambda: is_mended(d))
    d.undo()
    d.agreeing_images()


def drive_failures_of_the_rasterizer_are_told_and_survived(d):
    textures = d.renderers.textures
    rasterizer = textures.rasterizer.of(d.state.scene)
    errors = (
        moderngl.Error("GLSL: 0:1: syntax error"),
        LucidaError("OpenGL", "GL_OUT_OF_MEMORY at a texture of 1x1", "close other programs"),
        MemoryError(),
    )
    for height, error in enumerate(errors, 40):

        def fail(*_, error=error):
            raise error

        rasterizer.draw = fail
        d.change(images={"resolution": (50, height), "magnification": 1.0})
        d.until(lambda: d.renderers.raster_error is not None)
        d.until(lambda: is_told(d))
        del rasterizer.draw
        d.until(lambda: d.renderers.raster_error is None)
    d.agreeing_images()
