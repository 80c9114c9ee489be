"""The loop stepper in the window: its buttons, keys and sliders; the image it ends in."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from imgui_bundle import hello_imgui
from window_driver import Driver, Key

from app.host import layout
from app.outside.projected import Strokes
from app.outside.view import OUTSIDE, OutsideView
from app.stepper.model import Moment
from app.stepper.recording import Order
from app.stepper.view import STEPPER, StepperView
from app.window.palette_entries import entries
from app.window.shortcut_sheet import sections
from renderer.images.display import encode_srgb
from renderer.scene.model import Scene, SceneObject, Sphere
from renderer.trace import Tracer

WINDOW = f"//###{STEPPER}"


def view(d: Driver) -> StepperView:
    found = d.window.views[STEPPER]
    assert isinstance(found, StepperView)
    return found


def enter(d: Driver, form: str = "rays", **options: object) -> None:
    layout.switch("Loops")
    d.ctx.yield_(5)
    d.window.change(d.window.state.with_options(stepper={"form": form, **options}))
    d.settle()
    d.until(lambda: len(view(d).moments) > 0)


def leave(d: Driver) -> None:
    hello_imgui.switch_layout("Side by side")
    d.ctx.yield_(5)


def press(d: Driver, name: str) -> None:
    d.ctx.item_click(f"{WINDOW}/###{name}")
    d.ctx.yield_(2)


def moments(d: Driver) -> tuple[Moment, Moment]:
    both = view(d).moments
    return both[Order.OBJECT], both[Order.IMAGE]


def strokes(d: Driver, name: str) -> int:
    outside = d.window.views[OUTSIDE]
    assert isinstance(outside, OutsideView)
    found = [p for p in outside.primitives if isinstance(p, Strokes) and p.name == name]
    return sum(len(part.points) for part in found)


def drive_buttons_go_through_both_runs(d: Driver) -> None:
    enter(d, steps=(0, 0), canvas=(16, 12), order="both")
    steps = len(d.window.history.past)
    assert [moment.step for moment in moments(d)] == [0, 0]
    for count in (1, 2, 3):
        press(d, "step")
        assert [moment.step for moment in moments(d)] == [count, count]
    press(d, "back")
    assert [moment.step for moment in moments(d)] == [2, 2]
    press(d, "pixel")
    by_object, by_image = moments(d)
    assert by_image.pixel == (0, 0) and by_object.pixel is not None
    press(d, "pixel")
    assert moments(d)[1].pixel == (0, 1)
    press(d, "object")
    assert moments(d)[1].object == 0 and moments(d)[1].pixel == (0, 1)
    press(d, "last")
    by_object, by_image = moments(d)
    assert by_object.finished and by_image.finished
    assert np.array_equal(by_object.canvas, by_image.canvas)
    camera = d.window.state.view.for_size((16, 12))
    with Tracer(d.window.state.scene) as tracer:
        frame = tracer.render(camera, (16, 12))
    difference = np.abs(encode_srgb(frame.color) - encode_srgb(by_image.canvas)).max(axis=2)
    assert (difference > 2 / 255).sum() <= 2  # at an edge, float32 may see the other side
    press(d, "first")
    assert [moment.step for moment in moments(d)] == [0, 0]
    assert len(d.window.history.past) == steps  # steps are nothing to undo


def drive_it_plays_and_stops_at_the_end(d: Driver) -> None:
    enter(d, steps=(0, 0), canvas=(8, 6), order="both", speed=2000.0)
    press(d, "play")
    assert view(d).playing
    d.until(lambda: not view(d).playing)
    assert all(moment.finished for moment in moments(d))
    press(d, "play")  # from the beginning again
    d.until(lambda: moments(d)[1].step > 0)
    d.ctx.window_focus(WINDOW)
    d.ctx.key_press(int(Key.space))
    d.ctx.yield_(2)
    assert not view(d).playing
    stopped = [moment.step for moment in moments(d)]
    d.ctx.yield_(10)
    assert [moment.step for moment in moments(d)] == stopped


def drive_one_order_alone_and_every_canvas(d: Driver) -> None:
    enter(d, steps=(10**6, 10**6), canvas=(16, 12), order="image")
    assert list(view(d).moments) == [Order.IMAGE]
    for canvas in ((4, 3), (7, 5), (32, 24), (64, 48)):
        enter(d, steps=(10**6, 10**6), canvas=canvas, order="object")
        d.until(lambda: view(d).moments[Order.OBJECT].finished)
        shape = view(d).moments[Order.OBJECT].canvas.shape
        assert shape == (canvas[1], canvas[0], 3)
        d.picture()


def drive_rasterization_goes_from_triangle_to_triangle(d: Driver) -> None:
    enter(d, form="triangles", steps=(0, 0), canvas=(8, 6), order="both")
    assert list(view(d).moments) == [Order.RASTER, Order.IMAGE]
    for name in ("object", "pixel", "step", "step"):
        press(d, name)
    now = view(d).moments[Order.RASTER]
    assert now.triangle is not None and now.corners is not None and now.pixel is not None
    d.settle()
    assert strokes(d, "raster triangle") > 0 and strokes(d, "raster object") == 0
    press(d, "last")
    d.until(lambda: all(moment.finished for moment in view(d).moments.values()))
    by_triangles, by_rays = (moment.canvas for moment in view(d).moments.values())
    assert np.allclose(by_triangles, by_rays, atol=1e-9)
    # The other form, by its control: from the beginning, and a step of undo.
    steps = len(d.window.history.past)
    d.ctx.item_click(f"{WINDOW}/##form")
    d.ctx.item_click("//$FOCUSED/by rays")
    d.until(lambda: Order.OBJECT in view(d).moments)
    assert d.window.state.options.stepper.form == "rays"
    assert view(d).moments[Order.OBJECT].step == 0
    assert len(d.window.history.past) == steps + 1
    d.window.change(d.window.state.with_scene(Scene((SceneObject(Sphere((0, 0, -3), 1)),))))
    d.window.change(d.window.state.with_options(stepper={"form": "triangles"}))
    d.settle()
    d.until(lambda: Order.OBJECT in view(d).moments)  # it has no triangles


def drive_the_outside_view_shows_the_ray_and_the_object(d: Driver) -> None:
    enter(d, steps=(0, 0), canvas=(16, 12), order="both")
    assert strokes(d, "image ray") == strokes(d, "object object") == 0
    press(d, "pixel")
    for _ in range(4):
        press(d, "step")
    d.settle()
    assert strokes(d, "image ray") > 0 and strokes(d, "object ray") > 0
    assert strokes(d, "object object") > 0 and strokes(d, "bounding box") > 0
    d.window.shell.stage.show(STEPPER, False)
    d.ctx.yield_(4)
    assert strokes(d, "image ray") == strokes(d, "object object") == 0
    d.window.shell.stage.show(STEPPER)
    d.ctx.yield_(4)


def drive_it_follows_the_camera_and_the_scene(d: Driver) -> None:
    enter(d, steps=(10**6, 10**6), canvas=(16, 12), order="both")
    before = moments(d)[1].canvas
    camera = replace(d.start.camera, eye=(0.0, 6.0, 7.0))
    d.window.change(d.window.state.with_camera(camera))
    d.settle()
    d.until(lambda: not np.array_equal(moments(d)[1].canvas, before))
    press(d, "last")
    with Tracer(d.window.state.scene) as tracer:
        frame = tracer.render(d.window.state.view.for_size((16, 12)), (16, 12))
    difference = np.abs(encode_srgb(frame.color) - encode_srgb(moments(d)[0].canvas)).max(axis=2)
    assert (difference > 2 / 255).sum() <= 2
    d.window.change(d.window.state.with_scene(Scene((), background=(0.5, 0.5, 0.5))))
    d.settle()
    d.until(lambda: bool(view(d).moments))
    press(d, "last")
    assert all((moment.canvas == 0.5).all() for moment in moments(d))
    leave(d)


def drive_the_palette_and_the_keys_step(d: Driver) -> None:
    enter(d, steps=(5, 5), canvas=(16, 12), order="both")
    assert not d.window.renderers.is_tracing  # so that no verdict on both images is announced
    offered = {entry.name: entry for entry in entries(d.window)}
    rows = dict(sections())["Loop stepper, once it is clicked"]
    for name, keys, key, steps in (
        ("Stepper: one line on", "Right", "right_arrow", (6, 6)),
        ("Stepper: one line back", "Left", "left_arrow", (5, 5)),
        ("Stepper: to the beginning", "Home", "home", (0, 0)),
    ):
        entry = offered[name]
        assert entry.enabled and entry.keys == keys
        assert (keys, name.removeprefix("Stepper: ")) in rows
        before = d.window.state.options.stepper.steps
        entry.run()
        d.ctx.yield_(3)
        assert d.window.state.options.stepper.steps == steps
        d.window.change(d.window.state.with_options(stepper={"steps": before}))
        d.ctx.window_focus(WINDOW)
        d.ctx.yield_(2)
        d.ctx.key_press(int(getattr(Key, key)))
        d.ctx.yield_(2)
        assert d.window.state.options.stepper.steps == steps
    d.ctx.key_press(int(Key.down_arrow))
    d.ctx.yield_(2)
    assert moments(d)[1].pixel == (0, 0)
    d.ctx.key_press(int(Key.end))
    d.ctx.yield_(2)
    assert all(moment.finished for moment in moments(d))
    leave(d)


def drive_the_same_lines_stand_beside_it_in_julia(d: Driver) -> None:
    enter(d, steps=(0, 0), canvas=(16, 12), order="image")
    d.ctx.item_click(f"{WINDOW}/Julia")
    d.ctx.yield_(2)
    assert d.window.state.options.language == "julia"
    for _ in range(3):
        press(d, "step")  # with two listings in the panel as with one
    assert view(d).moments[Order.IMAGE].step == 3
    d.ctx.item_click(f"{WINDOW}/Julia")
    d.ctx.yield_(2)
    assert d.window.state.options.language == "python"
    d.window.undo()
    assert d.window.state.options.language == "julia"
    leave(d)
